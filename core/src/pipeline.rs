//! From a cloud to articulated objects in one call, by each of the methods.

mod boxes;
mod fitted;
mod views;

use std::collections::BTreeMap;
use std::time::Instant;

use serde::Serialize;

use boxes::whole_boxes;
use fitted::fitted_boxes;
pub use views::{infer_views, InputView};

use crate::body::{build_object, ObjectAnswer};
use crate::cloud::CloudView;
use crate::error::Result;
use crate::fit::{fit_object, size_warnings, FitSettings, KnownSize};
use crate::free_space::{look, Facet, PartState};
use crate::geometry::Vec3;
use crate::inference::{find_objects, FoundObject, ObjectModel, SearchMethod, SearchSettings};
use crate::model::{Assignment, Body, SegmentSet};
use crate::open_box::{Judgement, Kinds, Shape};
use crate::perception::readings::Readings;
use crate::perception::{perceive, PerceptionSettings, Scene};

/// How an assignment becomes a body.
#[derive(Debug, Clone, Copy)]
pub enum Bodies<'a> {
    /// Read off the segments' rectangles, as the paper's method does.
    Rectangles,
    /// Fitted to the readings of this cloud; what speaks for a box is weighed as the judgement says, if there is one, and boxes
    /// that have one of these sizes are of it.
    Fitted(&'a CloudView<'a>, Option<&'a Judgement>, &'a [KnownSize]),
}

const TWO_SIDES: &str = "fewer than two sides were seen";
const NO_POSE: &str = "so it has no pose, no hinges and no URDF";
const MORE: &str = "raise max_nodes";

/// The objects of a scene, best first, and which of their parts each point belongs to.
#[derive(Debug, Clone)]
pub struct Answer {
    pub objects: Vec<ObjectAnswer>,
    /// For each point the number of its object, -1 for none.
    pub object_of_point: Vec<i16>,
    /// For each point the number of its part among that object's parts, -1 for none.
    pub part_of_point: Vec<i16>,
    pub warnings: Vec<String>,
    /// For each object what tells its kind, where a body was fitted.
    pub shapes: Vec<Option<Shape>>,
    /// Whether the rays between the camera and the readings were asked for the parts' states.
    pub free_space: bool,
    /// Seconds of each stage, in order.
    pub stage_seconds: Vec<(&'static str, f64)>,
    /// Of whole boxes: which candidates are no objects, and why, one line each.
    pub refused: Vec<String>,
    /// What each object, and each of its parts, was judged by; of boxes judged by the depth image alone.
    pub features: Vec<ObjectFeatures>,
}

/// Of an object, and of its parts that have readings.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ObjectFeatures {
    #[serde(rename = "box")]
    pub of_box: BTreeMap<&'static str, f64>,
    pub parts: BTreeMap<String, BTreeMap<&'static str, f64>>,
}

/// From a cloud to its objects: perception, inference, bodies.
///
/// # Errors
/// What `perceive` and `understand` refuse.
pub fn infer(
    cloud: &CloudView,
    perception: &PerceptionSettings,
    models: &[ObjectModel],
    search: &SearchSettings,
    bodies: Bodies,
    kinds: &Kinds,
) -> Result<(Scene, Answer)> {
    let scene = perceive(cloud, perception)?;
    if let Bodies::Fitted(_, judgement, sizes) = bodies {
        let readings = Readings::new(cloud, perception);
        if let Some(mut answer) = whole_boxes(cloud, &scene, &readings, models, kinds, judgement, sizes)? {
            answer.warnings.extend(size_warnings(&answer.objects, sizes));
            return Ok((scene, answer));
        }
    }
    let mut answer = match bodies {
        Bodies::Fitted(..) => fitted_boxes(&scene, cloud.points.len(), models, search, bodies, kinds)?,
        Bodies::Rectangles => understand(&scene, cloud.points.len(), models, search, bodies)?,
    };
    if let Bodies::Fitted(_, _, sizes) = bodies {
        answer.warnings.extend(size_warnings(&answer.objects, sizes));
    }
    if search.search == SearchMethod::Exact {
        let start = Instant::now();
        let readings = Readings::new(cloud, perception);
        let told = answer.objects.iter_mut().all(|object| tell_states(object, cloud, &readings).is_some());
        answer.free_space = told && cloud.is_organized();
        answer.stage_seconds.push(("free_space", start.elapsed().as_secs_f64()));
    }
    Ok((scene, answer))
}

/// What the rays say of each part with corners, and probabilities that know it; `None` where they say nothing of the cloud.
fn tell_states(object: &mut ObjectAnswer, cloud: &CloudView, readings: &Readings) -> Option<()> {
    let facet = |corners: [[f64; 3]; 4]| Facet::new(corners.map(Vec3::from));
    let facets = object.parts.iter().enumerate().filter_map(|(p, part)| Some((p, facet(part.corners?)?)));
    let (numbers, facets): (Vec<usize>, Vec<Facet>) = facets.unzip();
    for (part, looked) in numbers.into_iter().zip(look(cloud, readings, &facets)?) {
        object.parts[part].state = Some(PartState::of(&looked));
    }
    object.tell_probabilities();
    Some(())
}

/// Understands a scene of `point_count` points: every group of segments against every object model.
///
/// # Errors
/// What the exact search refuses: values that are no finite numbers.
pub fn understand(
    scene: &Scene,
    point_count: usize,
    models: &[ObjectModel],
    settings: &SearchSettings,
    bodies: Bodies,
) -> Result<Answer> {
    let start = Instant::now();
    let mut found: Vec<(SegmentSet, FoundObject)> = Vec::new();
    let mut missed: Vec<f64> = Vec::new();
    for set in SegmentSet::by_group(scene) {
        let of_group = find_objects(models, &set, settings)?;
        missed.extend(of_group.missed);
        found.extend(of_group.objects.into_iter().map(|object| (set.clone(), object)));
    }
    // A stable sort: groups keep their order among equal scores.
    found.sort_by(|a, b| b.1.candidate.score.total_cmp(&a.1.candidate.score));
    let inference_seconds = start.elapsed().as_secs_f64();

    let mut answer = describe(scene, point_count, models, &found, bodies);
    if settings.search == SearchMethod::Exact {
        let unproven = unproven(models, &found, &missed);
        answer.warnings.splice(0..0, unproven);
    }
    answer.stage_seconds.insert(0, ("inference", inference_seconds));
    Ok(answer)
}

/// What the exact search left open, one line each.
fn unproven(models: &[ObjectModel], found: &[(SegmentSet, FoundObject)], missed: &[f64]) -> Vec<String> {
    let more = missed.iter().map(|score| {
        format!(
            "a search for more objects ended without a proof: one of score {score:.3} at most may be missing; {MORE}"
        )
    });
    let better = found.iter().enumerate().filter(|(_, (_, object))| object.gap > 0.0).map(|(number, (_, object))| {
        let (name, gap) = (&models[object.model].template.name, object.gap);
        let what = format!("the search ended without a proof, another assignment may score {gap:.3} more");
        format!("object {number} ({name}): {what}; {MORE}")
    });
    more.chain(better).collect()
}

/// The bodies of objects that are found, in their order.
pub fn describe(
    scene: &Scene,
    point_count: usize,
    models: &[ObjectModel],
    found: &[(SegmentSet, FoundObject)],
    bodies: Bodies,
) -> Answer {
    let start = Instant::now();
    let mut answer = Answer {
        objects: Vec::new(),
        object_of_point: vec![-1; point_count],
        part_of_point: vec![-1; point_count],
        warnings: Vec::new(),
        shapes: Vec::new(),
        free_space: false,
        stage_seconds: Vec::new(),
        refused: Vec::new(),
        features: Vec::new(),
    };
    let mut fit_seconds = 0.0;
    for (set, object) in found {
        let ObjectModel { template, weights, .. } = &models[object.model];
        let (mut built, mut assignment) = build_object(template, weights, scene, set, object);
        let name = format!("object {} ({})", answer.objects.len(), template.name);
        if built.pose.is_none() && template.body != Body::Free {
            match bodies {
                Bodies::Fitted(..) => answer.refused.push(format!("no object of {}: {TWO_SIDES}", template.name)),
                Bodies::Rectangles => answer.warnings.push(format!("{name}: {TWO_SIDES}, {NO_POSE}")),
            }
        } else if let (Bodies::Fitted(cloud, _, sizes), Body::OpenBox(_)) = (bodies, &template.body) {
            let start = Instant::now();
            let (of, settings) = ((set, &assignment), FitSettings::default());
            match fit_object(&built, template, scene, of, cloud, sizes, &settings) {
                Ok(fitted) => (built, assignment) = fitted,
                Err(reason) => answer.refused.push(format!("no object of {}: {reason}", template.name)),
            }
            fit_seconds += start.elapsed().as_secs_f64();
        }
        built.tell_probabilities();
        answer.add(built, scene, set, &assignment);
    }
    answer.stage_seconds = vec![("body", start.elapsed().as_secs_f64() - fit_seconds)];
    if let Bodies::Fitted(..) = bodies {
        answer.stage_seconds.push(("fit", fit_seconds));
    }
    answer
}

impl Answer {
    fn add(&mut self, object: ObjectAnswer, scene: &Scene, set: &SegmentSet, assignment: &Assignment) {
        let number = self.objects.len();
        for (part, segment) in assignment.iter().enumerate() {
            let Some(s) = segment else { continue };
            for &point in scene.segments.points_of(set.scene_index[*s]) {
                self.object_of_point[point as usize] = number as i16;
                self.part_of_point[point as usize] = part as i16;
            }
        }
        self.objects.push(object);
        self.shapes.push(None);
    }
}
