//! The paper's way through: from a cloud to articulated objects in one call.

use std::time::Instant;

use crate::body::{build_object, ObjectAnswer};
use crate::cloud::CloudView;
use crate::error::Result;
use crate::free_space::{look, Facet, PartState};
use crate::geometry::Vec3;
use crate::inference::{find_objects, FoundObject, ObjectModel, SearchMethod, SearchSettings};
use crate::model::{Assignment, Body, SegmentSet};
use crate::perception::readings::Readings;
use crate::perception::{perceive, PerceptionSettings, Scene};

const NO_POSE: &str = "fewer than two sides were seen, so it has no pose, no hinges and no URDF";
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
    /// Whether the rays between the camera and the readings were asked for the parts' states.
    pub free_space: bool,
    /// Seconds of each stage, in order.
    pub stage_seconds: Vec<(&'static str, f64)>,
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
) -> Result<(Scene, Answer)> {
    let scene = perceive(cloud, perception)?;
    let mut answer = understand(&scene, cloud.points.len(), models, search)?;
    if search.search == SearchMethod::Exact {
        let start = Instant::now();
        let readings = Readings::new(cloud, perception);
        let told = answer.objects.iter_mut().all(|object| tell_states(object, cloud, &readings).is_some());
        answer.free_space = told && cloud.is_organized();
        answer.stage_seconds.push(("free_space", start.elapsed().as_secs_f64()));
    }
    Ok((scene, answer))
}

/// What the rays say of each part with corners; `None` where they say nothing of the cloud.
fn tell_states(object: &mut ObjectAnswer, cloud: &CloudView, readings: &Readings) -> Option<()> {
    let facet = |corners: [[f64; 3]; 4]| Facet::new(corners.map(Vec3::from));
    let facets = object.parts.iter().enumerate().filter_map(|(p, part)| Some((p, facet(part.corners?)?)));
    let (numbers, facets): (Vec<usize>, Vec<Facet>) = facets.unzip();
    for (part, looked) in numbers.into_iter().zip(look(cloud, readings, &facets)?) {
        object.parts[part].state = Some(PartState::of(&looked));
    }
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

    let start = Instant::now();
    let mut answer = Answer {
        objects: Vec::new(),
        object_of_point: vec![-1; point_count],
        part_of_point: vec![-1; point_count],
        warnings: Vec::new(),
        free_space: false,
        stage_seconds: Vec::new(),
    };
    answer.warnings.extend(missed.iter().map(|score| {
        format!(
            "a search for more objects ended without a proof: one of score {score:.3} at most may be missing; {MORE}"
        )
    }));
    for (set, object) in &found {
        let ObjectModel { template, weights, .. } = &models[object.model];
        let (built, assignment) = build_object(template, weights, scene, set, object);
        if built.pose.is_none() && template.body != Body::Free {
            let number = answer.objects.len();
            answer.warnings.push(format!("object {number} ({}): {NO_POSE}", template.name));
        }
        if settings.search == SearchMethod::Exact && object.gap > 0.0 {
            let (number, gap) = (answer.objects.len(), object.gap);
            let what = format!("the search ended without a proof, another assignment may score {gap:.3} more");
            answer.warnings.push(format!("object {number} ({}): {what}; {MORE}", template.name));
        }
        answer.add(built, scene, set, &assignment);
    }
    answer.stage_seconds = vec![("inference", inference_seconds), ("body", start.elapsed().as_secs_f64())];
    Ok(answer)
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
    }
}
