//! Fitted boxes of clouds whose rays nobody can ask: by exact assignments of the segments.

use super::{understand, Answer, Bodies};
use crate::body::ObjectAnswer;
use crate::error::Result;
use crate::inference::{ObjectModel, SearchSettings};
use crate::model::{Body, OpenBoxRoles, Template};
use crate::open_box::{recast, Kinds, Shape};
use crate::perception::Scene;

const NO_FREE_SPACE: &str =
    "free space was not used: the cloud has no image grid or no viewpoint, so what hides a part and \
                             what is not there look alike, and no part's state is told";

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
    name_kinds(&mut answer, models, kinds);
    if answer.objects.iter().any(|object| Shape::of_answer(object).is_some()) {
        answer.warnings.push(NO_FREE_SPACE.to_owned());
    }
    Ok(answer)
}

/// Boxes without flaps are found as boxes whose flaps are not seen, where there is a template of such.
fn searched(models: &[ObjectModel]) -> Vec<ObjectModel> {
    let has_flaps = |roles: &OpenBoxRoles| roles.flaps.iter().any(Option::is_some);
    let some_have = models.iter().any(|model| matches!(&model.template.body, Body::OpenBox(roles) if has_flaps(roles)));
    let is_covered = |body: &Body| some_have && matches!(body, Body::OpenBox(roles) if !has_flaps(roles));
    models.iter().filter(|model| !is_covered(&model.template.body)).cloned().collect()
}

fn unfitted(answer: &Answer, models: &[ObjectModel]) -> Vec<String> {
    let is_box = |name: &str| models.iter().any(|m| m.template.name == name && m.template.body != Body::Free);
    let left = answer.objects.iter().filter(|object| Shape::of_answer(object).is_none());
    left.map(|object| object.template.clone()).filter(|name| is_box(name)).collect()
}

fn fitted_count(answer: &Answer) -> usize {
    answer.objects.iter().filter_map(Shape::of_answer).count()
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
