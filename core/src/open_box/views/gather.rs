//! What several views say of one body, as if one had seen it.

use std::collections::BTreeMap;

use super::super::assignments::Assignments;
use super::super::evidence::Evidence;
use super::super::feature_names::Features;
use super::super::features;
use super::super::found_box::FoundBox;
use super::super::grow::weigh;
use super::super::judgement::{probability, Judgement};
use super::super::labels::{roles, Labels, Present};
use super::super::sight::Sight;
use super::super::told::is_told;
use crate::fit::{Role, SizeMatch, Solution};

/// All views, in one level frame.
pub struct Views<'a> {
    pub sights: &'a [Sight<'a>],
    pub assignments: Vec<&'a Assignments<'a>>,
    pub judgement: Option<&'a Judgement>,
}

impl Views<'_> {
    /// Readings for a body less those against it, of all views.
    pub fn score(&self, solution: &Solution, present: Present, stride: usize) -> f64 {
        self.sights.iter().map(|sight| weigh(sight, solution.clone(), present, stride).score).sum()
    }

    /// A fitted box with the readings of all views, numbered on from view to view, and what their rays say together (eq. 100).
    pub fn gather(&self, solution: &Solution, present: Present, size: Option<SizeMatch>) -> FoundBox {
        let seen: Vec<FoundBox> = self.sights.iter().map(|sight| weigh(sight, solution.clone(), present, 1)).collect();
        let present = seen[0].present;
        let evidence: Vec<(Role, Evidence)> =
            roles(&present).into_iter().map(|role| (role, together(&seen, role))).collect();
        let mut out = FoundBox {
            labels: self.labels(&seen, &present),
            features: self.box_features(&seen),
            part_features: self.part_features(&seen, &evidence),
            score: seen.iter().map(|one| one.score).sum(),
            evidence,
            size,
            ..seen[0].clone()
        };
        out.probability = self.judgement.map_or(1.0, |judgement| probability(judgement.of_box(&out.features).0));
        out
    }

    fn labels(&self, seen: &[FoundBox], present: &Present) -> Labels {
        let mut parts: Vec<(Role, Vec<u32>)> = roles(present).into_iter().map(|role| (role, Vec::new())).collect();
        let mut before = 0;
        for (one, sight) in seen.iter().zip(self.sights) {
            for (role, points) in &mut parts {
                points.extend(one.labels.of(*role).iter().map(|index| before + index));
            }
            before += sight.points.len() as u32;
        }
        Labels { parts, stride: 1 }
    }

    /// The mean over the views, each counted by its readings on the box.
    fn box_features(&self, seen: &[FoundBox]) -> Features {
        let each = seen.iter().zip(self.sights).zip(&self.assignments);
        let of =
            |one: &FoundBox, sight, its| features::of_box(sight, its, one, &|role| is_told(one, role, self.judgement));
        let each = each.map(|((one, sight), its)| (readings_on(one), of(one, sight, its)));
        let each: Vec<(f64, Features)> = each.collect();
        let total: f64 = each.iter().map(|(readings, _)| readings).sum::<f64>().max(1.0);
        let mut sums: BTreeMap<&str, f64> = BTreeMap::new();
        for (readings, features) in &each {
            features.iter().for_each(|(name, value)| *sums.entry(name).or_default() += readings / total * value);
        }
        each[0].1.iter().map(|(name, _)| (*name, sums[name])).collect()
    }

    /// Of each part those of the view that sees most of it, looked through as often as in all views together.
    fn part_features(&self, seen: &[FoundBox], evidence: &[(Role, Evidence)]) -> Vec<(Role, Features)> {
        let of = |(role, all): &(Role, Evidence)| {
            let count = |view: usize| seen[view].labels.of(*role).len();
            let best = (1..seen.len()).fold(0, |best, view| if count(view) > count(best) { view } else { best });
            let points = seen[best].labels.of(*role);
            let own = seen[best].evidence.iter().find(|(r, _)| r == role).map(|(_, evidence)| *evidence)?;
            let judged = Evidence { through: own.met * all.through / all.met.max(1.0), ..own };
            let (sight, owners) = (&self.sights[best], &self.assignments[best].owners);
            (!points.is_empty()).then(|| (*role, features::of_part(sight, owners, &seen[best], *role, points, &judged)))
        };
        evidence.iter().filter_map(of).collect()
    }
}

fn together(seen: &[FoundBox], role: Role) -> Evidence {
    let of = |one: &FoundBox| one.evidence.iter().find(|(r, _)| *r == role).map(|(_, evidence)| *evidence);
    seen.iter().filter_map(of).fold(Evidence::default(), |sum, one| sum.and(&one))
}

fn readings_on(found: &FoundBox) -> f64 {
    found.labels.parts.iter().filter(|(role, _)| *role != Role::Base).map(|(_, points)| points.len() as f64).sum()
}
