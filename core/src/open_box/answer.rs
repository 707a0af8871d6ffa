use std::collections::BTreeMap;

use super::find::FoundBox;
use super::hidden::unseen_parts;
use super::sight::Sight;
use crate::body::{InferenceAnswer, ObjectAnswer, PartAnswer};
use crate::fit::{fill, FitSettings, KnownSize, Role, Solution};
use crate::free_space::PartState;
use crate::model::{Body, Template};

/// A box as `model.json` tells it, and the readings of each of its parts; `None` where the template's body is no open box.
pub fn answer(
    found: &FoundBox,
    template: &Template,
    sight: &Sight,
    sizes: &[KnownSize],
    settings: &FitSettings,
) -> Option<(ObjectAnswer, Vec<(usize, Vec<u32>)>)> {
    let Body::OpenBox(box_roles) = &template.body else { return None };
    let roles = Role::of_parts(box_roles);
    let mut seen = vec![false; template.parts.len()];
    let mut parts: Vec<PartAnswer> = template.parts.iter().map(|part| blank(&part.name)).collect();
    let mut readings = Vec::new();
    for &(part, role) in &roles {
        let points = found.labels.of(role);
        if points.is_empty() {
            continue;
        }
        seen[part] = true;
        parts[part].points = points.len();
        readings.push((part, points.to_vec()));
    }
    let mut body = found.solution.body.clone();
    body.input_from_object = sight.input_from_level * body.input_from_object;
    let solution = Solution { body, covariance: found.solution.covariance.clone() };
    let mut object = ObjectAnswer {
        template: template.name.clone(),
        template_probability: None,
        score: found.score,
        probability: None,
        inference: InferenceAnswer::new(f64::INFINITY, 0),
        score_terms: Vec::new(),
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
    object.size = found.size.map(|size| size.answer(sizes));
    for &(part, role) in &roles {
        let state = found.evidence.iter().find(|(r, _)| *r == role).map(|(_, e)| PartState::of(&e.looked()));
        object.parts[part].state = state;
    }
    let unseen: Vec<Role> = roles.iter().filter(|(part, _)| !seen[*part]).map(|(_, role)| *role).collect();
    for told in unseen_parts(found, sight, &unseen) {
        let part = roles.iter().find(|(_, role)| *role == told.role).map(|(part, _)| *part)?;
        object.parts[part].state = Some(told.state);
        object.parts[part].seen_from = told.seen_from.map(|d| (sight.input_from_level.rotation * d).into());
    }
    Some((object, readings))
}

fn blank(name: &str) -> PartAnswer {
    PartAnswer { name: name.to_owned(), observed: false, state: None, seen_from: None, probability: None, corners: None, points: 0 }
}
