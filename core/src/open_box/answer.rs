use std::collections::BTreeMap;

use super::found_box::FoundBox;
use super::hidden::unseen_parts;
use super::judgement::{probability, Judgement};
use super::limits::narrowed;
use super::sight::{reading_of, Sight};
use super::told::is_told;
use crate::body::{InferenceAnswer, ObjectAnswer, PartAnswer, ScoreTermAnswer};
use crate::fit::{fill, lean_name, wall_lean, FitSettings, KnownSize, Role};
use crate::free_space::PartState;
use crate::model::{Body, Template};

/// Parts by their numbers in the template, with the indices of their readings.
pub type PartReadings = Vec<(usize, Vec<u32>)>;

/// A box as `model.json` tells it by a template, of that probability, and the readings of each of its parts; `None` where the template's body is no box.
///
/// Coordinates are those of the first view's input; the readings of several views are numbered on from view to view.
pub fn answer(
    found: &FoundBox,
    template: &Template,
    template_probability: Option<f64>,
    sights: &[Sight],
    sizes: &[KnownSize],
    settings: &FitSettings,
    judgement: Option<&Judgement>,
) -> Option<(ObjectAnswer, PartReadings)> {
    let box_roles = template.body.box_roles()?;
    let roles = Role::of_parts(box_roles);
    let mut seen = vec![false; template.parts.len()];
    let mut parts: Vec<PartAnswer> = template.parts.iter().map(|part| PartAnswer::unseen(&part.name)).collect();
    let mut readings = Vec::new();
    for &(part, role) in &roles {
        if !is_told(found, role, judgement) {
            continue;
        }
        let points = found.labels.of(role);
        seen[part] = true;
        parts[part].points = points.len();
        parts[part].probability = judgement.and_then(|judgement| found.part_probability(role, judgement));
        readings.push((part, points.to_vec()));
    }
    let input_from_level = sights.first()?.input_from_level;
    let mut solution = found.solution.clone();
    solution.body.input_from_object = input_from_level * solution.body.input_from_object;
    let judged = judgement.map(|judgement| judgement.of_box(&found.features));
    let mut object = ObjectAnswer {
        template: template.name.clone(),
        template_probability,
        score: judged.as_ref().map_or(found.score, |(log_odds, _)| *log_odds),
        probability: judged.as_ref().map(|(log_odds, _)| probability(*log_odds)),
        inference: InferenceAnswer::new(f64::INFINITY, found.rivals, None),
        sums: None,
        score_terms: judged.map_or_else(Vec::new, |(_, terms)| terms.into_iter().map(term).collect()),
        dimensions: None,
        outer_dimensions: None,
        thickness: None,
        size: None,
        pose: None,
        parameters: BTreeMap::new(),
        parts,
        joints: Vec::new(),
    };
    fill(&mut object, template, &roles, &seen, &solution, settings);
    for joint in &mut object.joints {
        let child = template.parts.iter().position(|part| part.name == joint.child);
        let role = roles.iter().find(|(part, _)| Some(*part) == child).map(|(_, role)| *role);
        joint.limits = role.map_or(joint.limits, |role| narrowed(joint.limits, &found.solution.body, role));
    }
    if let Body::ClosedBox(_) = template.body {
        // Its top is no flap, and lies on the rim.
        object.parameters.retain(|name, _| !name.starts_with("flap"));
        let above = solution.body.board_m() / 2.0;
        for dimensions in [&mut object.dimensions, &mut object.outer_dimensions].into_iter().flatten() {
            dimensions[2] += above;
        }
    }
    object.size = found.size.map(|size| size.answer(sizes));
    for k in (0..4).filter(|&k| !found.labels.of(Role::Side(k)).is_empty()) {
        let points = found.labels.of(Role::Side(k)).iter().filter_map(|&index| reading_of(sights, index as usize));
        let lean = wall_lean(points, &found.solution.body, k, settings);
        object.parameters.extend(lean.map(|lean| (lean_name(k), lean)));
    }
    for &(part, role) in roles.iter().filter(|(part, _)| seen[*part]) {
        let looked = found.evidence.iter().find(|(r, _)| *r == role).map(|(_, evidence)| evidence.looked());
        object.parts[part].state = looked.map(|looked| match object.parts[part].probability {
            Some(probability) => PartState::seen_with(&looked, probability),
            None => PartState::of(&looked),
        });
    }
    let unseen: Vec<Role> = roles.iter().filter(|(part, _)| !seen[*part]).map(|(_, role)| *role).collect();
    let has_seen_tuck = box_roles.tucks.map(|tuck| tuck.is_some_and(|tuck| seen[tuck]));
    for told in unseen_parts(found, sights, &unseen, has_seen_tuck) {
        let part = roles.iter().find(|(_, role)| *role == told.role).map(|(part, _)| *part)?;
        object.parts[part].state = Some(told.state);
        object.parts[part].seen_from = told.seen_from.map(|d| (input_from_level.rotation * d).into());
    }
    Some((object, readings))
}

fn term((name, value, weight): (&'static str, f64, f64)) -> ScoreTermAnswer {
    ScoreTermAnswer { name: name.to_owned(), kind: "evidence", value, weight, contribution: weight * value }
}
