//! Fitted boxes of clouds whose rays nobody can ask: by exact assignments of the segments.

use super::{understand, Answer, Bodies};
use crate::body::ObjectAnswer;
use crate::error::Result;
use crate::inference::{ObjectModel, SearchSettings};
use crate::model::{Body, OpenBoxRoles, Template};
use crate::open_box::{few_panels, recast, Kinds, Shape};
use crate::perception::Scene;

const NO_FREE_SPACE: &str =
    "free space was not used: the cloud has no image grid or no viewpoint, so what hides a part and \
                             what is not there look alike, and no part's state is told";

const NO_CLOSED: &str =
    "closed boxes were not looked for: the cloud has no image grid or no viewpoint, and rays tell them";

const NOTHING_SCORES: &str = "no object: no assignment of the segments to a template's parts scores enough";

/// As `understand`; the template of each box is then the most probable of all that were asked for.
///
/// # Errors
/// As of `understand`.
pub fn fitted_boxes(
    scene: &Scene,
    point_count: usize,
    models: &[ObjectModel],
    settings: &SearchSettings,
    bodies: Bodies,
    kinds: &Kinds,
) -> Result<Answer> {
    let mut searched = searched(models);
    let mut answer = understand(scene, point_count, &searched, settings, bodies)?;
    // The templates whose bodies did not fit give way to the others.
    loop {
        let failed = unfitted(&answer, &searched);
        searched.retain(|model| !failed.contains(&model.template.name));
        if failed.is_empty() || searched.is_empty() {
            break;
        }
        let other = understand(scene, point_count, &searched, settings, bodies)?;
        if fitted_count(&other) > fitted_count(&answer) {
            answer = other;
        }
    }
    if models.iter().any(|model| matches!(model.template.body, Body::ClosedBox(_))) {
        answer.warnings.push(NO_CLOSED.to_owned());
    }
    name_kinds(&mut answer, models, kinds);
    drop_unfitted(&mut answer, models);
    if answer.objects.iter().any(|object| Shape::of_answer(object).is_some()) {
        answer.warnings.push(NO_FREE_SPACE.to_owned());
    }
    Ok(answer)
}

/// Boxes without flaps are found as boxes whose flaps are not seen, where there is a template of such; closed boxes by rays alone.
fn searched(models: &[ObjectModel]) -> Vec<ObjectModel> {
    let has_flaps = |roles: &OpenBoxRoles| roles.flaps.iter().any(Option::is_some);
    let some_have = models.iter().any(|model| matches!(&model.template.body, Body::OpenBox(roles) if has_flaps(roles)));
    let is_covered = |body: &Body| some_have && matches!(body, Body::OpenBox(roles) if !has_flaps(roles));
    let is_closed = |body: &Body| matches!(body, Body::ClosedBox(_));
    let is_left_out = |body: &Body| is_covered(body) || is_closed(body);
    models.iter().filter(|model| !is_left_out(&model.template.body)).cloned().collect()
}

fn unfitted(answer: &Answer, models: &[ObjectModel]) -> Vec<String> {
    let is_box = |name: &str| models.iter().any(|m| m.template.name == name && m.template.body != Body::Free);
    let left = answer.objects.iter().filter(|object| Shape::of_answer(object).is_none());
    left.map(|object| object.template.clone()).filter(|name| is_box(name)).collect()
}

fn fitted_count(answer: &Answer) -> usize {
    answer.objects.iter().filter_map(Shape::of_answer).count()
}

/// Boxes without a fitted body are no objects, nor are those of which too little was seen; why is told among the refused.
fn drop_unfitted(answer: &mut Answer, models: &[ObjectModel]) {
    let unfitted = unfitted(answer, models);
    let mut kept = Vec::new();
    for (number, object) in answer.objects.iter().enumerate() {
        let is_fitted = Shape::of_answer(object).is_some();
        let seen = object.parts.iter().filter(|part| part.observed).count();
        if let Some(why) = few_panels(seen).filter(|_| is_fitted) {
            answer.refused.push(format!("no object of {}: {why}", object.template));
        } else if is_fitted || !unfitted.contains(&object.template) {
            kept.push(number);
        }
    }
    answer.keep(&kept);
    if answer.objects.is_empty() && answer.refused.is_empty() {
        answer.refused.push(NOTHING_SCORES.to_owned());
    }
}

/// The template of each fitted object is the most probable of all that were asked for, whichever found its segments.
fn name_kinds(answer: &mut Answer, models: &[ObjectModel], kinds: &Kinds) {
    let templates: Vec<&Template> = models.iter().map(|model| &model.template).collect();
    for number in 0..answer.objects.len() {
        let object = &answer.objects[number];
        let Some(shape) = Shape::of_answer(object) else { continue };
        answer.shapes[number] = Some(shape);
        let Some((chosen, template_probability)) = kinds.choose(&shape, &templates) else { continue };
        // Nobody can tell templates apart without weights: then the one that found the segments stays.
        if template_probability.is_none() {
            continue;
        }
        let from = templates.iter().find(|template| template.name == object.template);
        let other = from.filter(|from| from.name != templates[chosen].name);
        match other.and_then(|from| recast(object, from, templates[chosen])) {
            Some((told, new_number)) => {
                answer.objects[number] = ObjectAnswer { template_probability, ..told };
                answer.renumber_parts(number, &new_number);
            }
            None => answer.objects[number].template_probability = template_probability,
        }
    }
}

impl Answer {
    /// The objects of these numbers alone, in their order.
    fn keep(&mut self, kept: &[usize]) {
        for (of, part) in self.object_of_point.iter_mut().zip(&mut self.part_of_point) {
            let place = usize::try_from(*of).ok().and_then(|old| kept.iter().position(|&number| number == old));
            match place {
                Some(new) => *of = new as i16,
                None => (*of, *part) = (-1, -1),
            }
        }
        self.objects = kept.iter().map(|&number| self.objects[number].clone()).collect();
        self.shapes = kept.iter().map(|&number| self.shapes[number]).collect();
    }

    /// Gives the points of an object to its parts' new numbers, those of a part that is no more to nothing.
    fn renumber_parts(&mut self, object: usize, new_number: &[Option<usize>]) {
        for (of, part) in self.object_of_point.iter_mut().zip(&mut self.part_of_point) {
            if *of != object as i16 {
                continue;
            }
            match new_number[*part as usize] {
                Some(new) => *part = new as i16,
                None => (*of, *part) = (-1, -1),
            }
        }
    }
}
