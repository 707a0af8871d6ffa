//! Boxes that the depth image bears out, told by the most probable template.

use std::collections::BTreeMap;
use std::time::Instant;

use super::{Answer, ObjectFeatures};
use crate::cloud::CloudView;
use crate::error::Result;
use crate::fit::{FitSettings, KnownSize};
use crate::inference::ObjectModel;
use crate::model::Template;
use crate::open_box::{self, closed_boxes, find_closed, open_boxes, Assignments, Found, FoundBox, Judgement};
use crate::open_box::{few_panels, refusal, Kinds, PartReadings, Refusal, Refused, Shape, Sight};
use crate::perception::readings::Readings;
use crate::perception::Scene;

const NOTHING_HELD: &str = "no object: no box that the segments propose holds enough readings of the depth image";

/// How fitted boxes become objects: templates that compete, what tells them apart, what is known of boxes.
#[derive(Clone, Copy)]
pub struct Telling<'a> {
    pub templates: &'a [&'a Template],
    pub kinds: &'a Kinds,
    pub judgement: Option<&'a Judgement>,
    pub sizes: &'a [KnownSize],
    pub settings: FitSettings,
}

/// Open boxes judged by the depth image; `None` for a cloud without image or viewpoint, and where no template is an open box.
pub fn whole_boxes(
    cloud: &CloudView,
    scene: &Scene,
    readings: &Readings,
    models: &[ObjectModel],
    kinds: &Kinds,
    judgement: Option<&Judgement>,
    sizes: &[KnownSize],
) -> Result<Option<Answer>> {
    let start = Instant::now();
    let templates: Vec<&Template> = models.iter().map(|model| &model.template).collect();
    let (has_open, closed) = (open_boxes(&templates).next().is_some(), closed_boxes(&templates).next());
    if !has_open && closed.is_none() {
        return Ok(None);
    }
    let telling = Telling { templates: &templates, kinds, judgement, sizes, settings: FitSettings::default() };
    let Some(sight) = Sight::new(cloud, readings, scene) else { return Ok(None) };
    let assignments = Assignments::new(scene, cloud.points.len(), models)?;
    let assigned = start.elapsed().as_secs_f64();
    let found = if has_open {
        open_box::find(&sight, scene, &assignments, sizes, &telling.settings, judgement)
    } else {
        Found::default()
    };
    let in_stages: f64 = found.stage_seconds.iter().map(|(_, seconds)| seconds).sum();
    let sights = [sight];
    let mut answer = tell_boxes(&found.boxes, &found.refused, &sights, &telling);
    if let Some(number) = closed {
        tell_closed(&mut answer, scene, &sights, templates[number], &telling);
        let others = closed_boxes(&templates).skip(1).map(|other| &templates[other].name);
        let name = &templates[number].name;
        answer.warnings.extend(others.map(|other| format!("{other} was not used: closed boxes are told as {name}")));
    }
    if answer.objects.is_empty() && answer.refused.is_empty() {
        answer.refused.push(NOTHING_HELD.to_owned());
    }
    answer.stage_seconds = [vec![("assignments", assigned)], found.stage_seconds].concat();
    answer.stage_seconds.push(("box_answers", start.elapsed().as_secs_f64() - assigned - in_stages));
    Ok(Some(answer))
}

/// The boxes that are sure enough, in the first view's input frame; points are numbered on from view to view.
pub fn tell_boxes(found: &[FoundBox], refused: &[Refused], sights: &[Sight], telling: &Telling) -> Answer {
    let point_count = sights.iter().map(|sight| sight.points.len()).sum();
    let mut answer = Answer {
        objects: Vec::new(),
        object_of_point: vec![-1; point_count],
        part_of_point: vec![-1; point_count],
        warnings: Vec::new(),
        shapes: Vec::new(),
        free_space: true,
        stage_seconds: Vec::new(),
        refused: sights.first().map_or_else(Vec::new, |first| lines(refused, first)),
        features: Vec::new(),
    };
    // The best first, as they come out in the end; a stable sort: equals stay in their order.
    let score = |one: &FoundBox| telling.judgement.map_or(one.score, |judgement| judgement.of_box(&one.features).0);
    let mut found: Vec<&FoundBox> = found.iter().collect();
    found.sort_by(|a, b| score(b).total_cmp(&score(a)));
    for one in found {
        if let Some(why) = tell_box(&mut answer, one, sights, telling) {
            let refused = Refused { body: one.solution.body.clone(), why };
            answer.refused.extend(sights.first().map(|first| refused.line(&first.input_from_level)));
        }
    }
    answer
}

/// Adds the closed boxes among the readings that no open one has. Nobody has learnt how probable they are.
fn tell_closed(answer: &mut Answer, scene: &Scene, sights: &[Sight; 1], template: &Template, telling: &Telling) {
    let Telling { sizes, settings, .. } = telling;
    let taken: Vec<bool> = answer.object_of_point.iter().map(|&object| object >= 0).collect();
    for one in find_closed(&sights[0], scene, &taken, settings) {
        if let Some((object, parts)) = open_box::answer(&one, template, None, sights, sizes, settings, None) {
            answer.give(parts);
            answer.features.push(ObjectFeatures { of_box: BTreeMap::new(), parts: BTreeMap::new() });
            answer.objects.push(object);
            answer.shapes.push(None);
        }
    }
}

fn lines(refused: &[Refused], first: &Sight) -> Vec<String> {
    refused.iter().map(|one| one.line(&first.input_from_level)).collect()
}

/// Adds a box to the answer, or says why it is none.
fn tell_box(answer: &mut Answer, one: &FoundBox, sights: &[Sight], telling: &Telling) -> Option<Refusal> {
    let Telling { templates, kinds, judgement, sizes, settings } = telling;
    let shape = Shape::of_found(one, *judgement);
    // Some template is an open box, so one is chosen and tells it.
    let (number, probability) = kinds.choose(&shape, templates)?;
    let told = open_box::answer(one, templates[number], probability, sights, sizes, settings, *judgement);
    let (object, parts) = told?;
    // Of the panels that are told, the template may have fewer.
    let seen = object.parts.iter().filter(|part| part.observed).count();
    if let Some(why) = refusal(one, *judgement).or_else(|| few_panels(seen)) {
        return Some(why);
    }
    if let Some(why) = &one.of_fewer {
        let number = answer.objects.len();
        answer.warnings.push(format!("object {number}: its body is fitted to fewer of its readings: of all, {why}"));
    }
    answer.give(parts);
    let by_name = |features: &open_box::Features| features.iter().copied().collect();
    let parts = one.part_features.iter().map(|(role, features)| (role.name(), by_name(features)));
    answer.features.push(ObjectFeatures { of_box: by_name(&one.features), parts: parts.collect() });
    answer.objects.push(object);
    answer.shapes.push(Some(shape));
    None
}

impl Answer {
    /// Gives the next object its parts' readings.
    fn give(&mut self, parts: PartReadings) {
        for (part, points) in parts {
            for point in points {
                self.object_of_point[point as usize] = self.objects.len() as i16;
                self.part_of_point[point as usize] = part as i16;
            }
        }
    }
}
