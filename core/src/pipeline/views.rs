//! From several clouds of one scene to its objects.

use std::time::Instant;

use nalgebra::Isometry3;

use super::boxes::{tell_boxes, Telling};
use super::Answer;
use crate::cloud::CloudView;
use crate::error::{InputError, Result};
use crate::fit::{size_warnings, FitSettings, KnownSize};
use crate::inference::ObjectModel;
use crate::model::Template;
use crate::open_box::{closed_boxes, fuse, open_boxes, Assignments, Judgement, Kinds, View};
use crate::perception::readings::Readings;
use crate::perception::{perceive, PerceptionSettings, Scene};

/// One frame of a scene, and where its input's frame lies in that of the first.
#[derive(Debug, Clone, Copy)]
pub struct InputView<'a> {
    pub cloud: CloudView<'a>,
    pub first_from_view: Isometry3<f64>,
}

/// From frames of one static scene to its objects, in the first frame's coordinates; points are numbered on from frame to frame.
///
/// `perception.up` is told in the first frame. With the answer what was perceived in each frame.
///
/// # Errors
/// No frame, templates none of which is an open box, a frame without image grid or viewpoint, what `perceive` refuses of any: the frame
/// is named, counted from 1.
pub fn infer_views(
    views: &[InputView],
    perception: &PerceptionSettings,
    models: &[ObjectModel],
    kinds: &Kinds,
    judgement: Option<&Judgement>,
    sizes: &[KnownSize],
) -> Result<(Vec<Scene>, Answer)> {
    let templates: Vec<&Template> = models.iter().map(|model| &model.template).collect();
    if open_boxes(&templates).next().is_none() {
        let mend = "frames are fused into open boxes: give templates with a base and four sides";
        return Err(InputError::new("no template is an open box").mend(mend));
    }
    if views.is_empty() {
        return Err(InputError::new("there is no frame").mend("give at least one"));
    }
    let named = |number: usize| format!("frame {}", number + 1);
    let settings: Vec<PerceptionSettings> = views.iter().map(|view| turned(perception, view)).collect();
    let perceived = views.iter().zip(&settings).enumerate();
    let perceived = perceived.map(|(number, (view, settings))| {
        perceive(&view.cloud, settings).map_err(|error| error.in_source(named(number)))
    });
    let scenes: Vec<Scene> = perceived.collect::<Result<_>>()?;

    let start = Instant::now();
    let frames: Vec<View> = views
        .iter()
        .zip(&settings)
        .zip(&scenes)
        .map(|((view, settings), scene)| {
            Ok(View {
                cloud: view.cloud,
                readings: Readings::new(&view.cloud, settings),
                scene,
                assignments: Assignments::new(scene, view.cloud.points.len(), models)?,
                first_from_view: view.first_from_view,
            })
        })
        .collect::<Result<_>>()?;
    let telling = Telling { templates: &templates, kinds, judgement, sizes, settings: FitSettings::default() };
    let fused = fuse(&frames, sizes, &telling.settings, judgement).map_err(|number| {
        let mend = "frames that are fused are organized clouds (height above 1) with a viewpoint";
        InputError::new("has no image grid, no viewpoint or no readings").mend(mend).in_source(named(number))
    })?;
    let mut answer = tell_boxes(&fused.found, &fused.refused, &fused.sights, &telling);
    answer.refused.extend(fused.refused_by_frames);
    answer.warnings.extend(fused.warnings);
    if closed_boxes(&templates).next().is_some() {
        answer.warnings.push(NO_CLOSED.to_owned());
    }
    answer.warnings.extend(size_warnings(&answer.objects, sizes));
    answer.stage_seconds.push(("boxes", start.elapsed().as_secs_f64()));
    Ok((scenes, answer))
}

const NO_CLOSED: &str = "closed boxes were not looked for: they are told frame by frame, without --poses";

/// What is known of up, told in the view's own frame.
fn turned(perception: &PerceptionSettings, view: &InputView) -> PerceptionSettings {
    let up = perception.up.map(|up| view.first_from_view.rotation.inverse() * up);
    PerceptionSettings { up, ..*perception }
}
