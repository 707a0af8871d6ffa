//! Boxes as assignments of segments to parts: those that score best propose, and each box amounts to one.

use std::collections::BTreeMap;

use super::found_box::FoundBox;
use super::owners::Owners;
use crate::body::build_object;
use crate::error::Result;
use crate::fit::{start, FittedBody, Role};
use crate::inference::{likely_assignments, Candidate, ExactSettings, FoundObject, ObjectModel};
use crate::model::{Assignment, Body, FeatureTables, SegmentSet};
use crate::perception::Scene;

/// Of each object that the segments make up so many assignments are followed.
const MOST: usize = 3;
/// Nodes that the search may visit for each of them: it proposes, so its answers need no proof.
const MOST_NODES: u64 = 20_000;

/// The groups of a scene's segments, the templates that they are held against, and whose each reading is.
pub struct Assignments<'a> {
    pub owners: Owners,
    /// Those of the best assignments of each group, in the input's frame.
    pub bodies: Vec<FittedBody>,
    models: Vec<&'a ObjectModel>,
    /// Each model's parts as roles of an open box.
    roles: Vec<Vec<(usize, Role)>>,
    groups: Vec<Group>,
    /// For each of the scene's segments its group, and its place there; none for the room's.
    place: Vec<Option<(usize, usize)>>,
}

struct Group {
    set: SegmentSet,
    tables: Vec<FeatureTables>,
}

impl<'a> Assignments<'a> {
    /// Of the models that are open boxes with flaps: a box without is one whose flaps nobody sees. The cloud has `point_count` points.
    ///
    /// # Errors
    /// What the exact search refuses: values that are no finite numbers.
    pub fn new(scene: &Scene, point_count: usize, models: &'a [ObjectModel]) -> Result<Self> {
        let with_roles = models.iter().filter_map(|model| match &model.template.body {
            Body::OpenBox(roles) if roles.flaps.iter().any(Option::is_some) => Some((model, Role::of_parts(roles))),
            _ => None,
        });
        let (models, roles): (Vec<_>, Vec<_>) = with_roles.unzip();
        let tables = |set: &SegmentSet| models.iter().map(|model| FeatureTables::new(&model.template, set)).collect();
        let of_group = |set: SegmentSet| Group { tables: tables(&set), set };
        let groups: Vec<Group> = SegmentSet::by_group(scene).into_iter().map(of_group).collect();
        let mut place = vec![None; scene.segments.len()];
        for (number, group) in groups.iter().enumerate() {
            group.set.scene_index.iter().enumerate().for_each(|(member, &s)| place[s] = Some((number, member)));
        }
        let out = Self { owners: Owners::new(scene, point_count), bodies: Vec::new(), models, roles, groups, place };
        Ok(Self { bodies: out.proposed(scene)?, ..out })
    }

    fn proposed(&self, scene: &Scene) -> Result<Vec<FittedBody>> {
        let settings = ExactSettings { max_nodes: MOST_NODES, ..ExactSettings::default() };
        let mut out = Vec::new();
        for Group { set, tables } in &self.groups {
            for (number, candidate) in likely_assignments(&self.models, tables, &settings, MOST)? {
                let (model, found) = (self.models[number], unproven(number, candidate));
                let (object, _) = build_object(&model.template, &model.weights, scene, set, &found);
                out.extend(start(&object, &self.roles[number]));
            }
        }
        Ok(out)
    }

    /// The score of the assignment that a box amounts to (eq. 1): each panel takes the segment that it holds most of, by the template, and
    /// whichever way round, that scores best; 0 where it holds none.
    pub fn score(&self, found: &FoundBox) -> f64 {
        let held = segments_of(&self.owners, found);
        let Some(group) = self.group_of(&held) else { return 0.0 };
        let mut best: Option<f64> = None;
        for (number, model) in self.models.iter().enumerate() {
            for turn in 0..4 {
                let assignment = self.assignment(number, group, &held, turn);
                let tables = &self.groups[group].tables[number];
                let values = tables.feature_vector(&model.template, &assignment);
                let score = values.iter().zip(&model.weights.values).map(|(value, weight)| value * weight).sum();
                best = Some(best.map_or(score, |best| best.max(score)));
            }
        }
        best.unwrap_or(0.0)
    }

    /// The group that most panels' segments are of.
    fn group_of(&self, held: &BTreeMap<usize, (Role, u32)>) -> Option<usize> {
        let mut counts = vec![0_u32; self.groups.len()];
        held.keys().filter_map(|&s| self.place[s]).for_each(|(group, _)| counts[group] += 1);
        let most = counts.iter().copied().max().filter(|&count| count > 0)?;
        counts.iter().position(|&count| count == most)
    }

    /// With side `turn` as the template's side 0.
    fn assignment(&self, model: usize, group: usize, held: &BTreeMap<usize, (Role, u32)>, turn: usize) -> Assignment {
        let mut out = vec![None; self.models[model].template.parts.len()];
        for (&segment, &(role, _)) in held {
            let part = self.roles[model].iter().find(|(_, other)| *other == role.turned(turn)).map(|(part, _)| *part);
            let member = self.place[segment].filter(|(of, _)| *of == group).map(|(_, member)| member);
            if let (Some(part), Some(member)) = (part, member) {
                out[part] = Some(member);
            }
        }
        out
    }
}

/// The segment that each panel holds most of, by its number in the scene; of panels that want one, the panel with more of it.
fn segments_of(owners: &Owners, found: &FoundBox) -> BTreeMap<usize, (Role, u32)> {
    let mut out: BTreeMap<usize, (Role, u32)> = BTreeMap::new();
    for (role, points) in &found.labels.parts {
        let Some((segment, count)) = owners.most_held(points.iter()) else { continue };
        let holder = out.entry(segment).or_insert((*role, count));
        if count > holder.1 {
            *holder = (*role, count);
        }
    }
    out
}

fn unproven(model: usize, candidate: Candidate) -> FoundObject {
    FoundObject {
        model,
        candidate,
        feature_vector: Vec::new(),
        gap: f64::INFINITY,
        alternatives: 0,
        probability: None,
        marginals: None,
    }
}
