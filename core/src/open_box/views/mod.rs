//! Several views of one scene, taken from known places: each finds its boxes, and one body is fitted to what all of them see
//! (docs/maths.md, "Several views").

mod disagree;
mod flaps;
mod gather;
mod joint;
mod level;
mod matching;
mod places;

use nalgebra::Isometry3;

use super::assignments::Assignments;
use super::choose::choose;
use super::find::find;
use super::found_box::FoundBox;
use super::judgement::Judgement;
use super::refused::{Refusal, Refused};
use super::sight::Sight;
use crate::cloud::CloudView;
use crate::fit::{FitSettings, KnownSize};
use crate::perception::readings::Readings;
use crate::perception::Scene;

use gather::Views;
use level::common_level;
use matching::{groups, Sighting};

/// One frame of the scene, and where its coordinates lie in those of the first.
pub struct View<'a> {
    pub cloud: CloudView<'a>,
    pub readings: Readings<'a>,
    pub scene: &'a Scene,
    pub assignments: Assignments<'a>,
    pub first_from_view: Isometry3<f64>,
}

/// Boxes of several views, best first, in the level frame that all of `sights` share; readings are numbered on from view to view.
pub struct Fused<'a> {
    pub sights: Vec<Sight<'a>>,
    pub found: Vec<FoundBox>,
    /// Boxes of one or more views that no joint fit ended in.
    pub refused: Vec<Refused>,
    /// What each frame refused by itself, one line each, in its own coordinates.
    pub refused_by_frames: Vec<String>,
    /// What a user should know, one line each.
    pub warnings: Vec<String>,
}

/// The boxes of a scene that several views show (eq. 98 to 101). A single view's are those that `find` finds.
///
/// # Errors
/// The number of a view without an image or a viewpoint.
pub fn fuse<'a>(
    views: &'a [View<'a>],
    sizes: &[KnownSize],
    settings: &FitSettings,
    judgement: Option<&Judgement>,
) -> Result<Fused<'a>, usize> {
    let own: Vec<Sight> = views
        .iter()
        .enumerate()
        .map(|(number, view)| Sight::new(&view.cloud, &view.readings, view.scene).ok_or(number))
        .collect::<Result<_, _>>()?;
    let (mut found, mut refused) = (Vec::new(), Vec::new());
    for (sight, view) in own.iter().zip(views) {
        let of_view = find(sight, view.scene, &view.assignments, sizes, settings, judgement);
        found.push(of_view.boxes);
        refused.push(of_view.refused);
    }
    if views.len() == 1 {
        let (found, refused) = (found.remove(0), refused.remove(0));
        return Ok(Fused { sights: own, found, refused, refused_by_frames: Vec::new(), warnings: Vec::new() });
    }
    let refused_by_frames = refused.iter().zip(&own).enumerate().flat_map(|(number, (refused, sight))| {
        refused.iter().map(move |one| format!("frame {}: {}", number + 1, one.line(&sight.input_from_level)))
    });
    let refused_by_frames = refused_by_frames.collect();
    let (first_from_level, strange) = common_level(views, &own, &found).ok_or(0_usize)?;
    let mut warnings: Vec<String> = strange.into_iter().map(|k| level::told(k, views.len())).collect();
    let sights: Vec<Sight> = views
        .iter()
        .enumerate()
        .map(|(number, view)| {
            let view_from_level = view.first_from_view.inverse() * first_from_level;
            Sight::in_level(&view.cloud, &view.readings, view_from_level).ok_or(number)
        })
        .collect::<Result<_, _>>()?;
    let mut sightings = Vec::new();
    for (view, of_view) in found.into_iter().enumerate() {
        let level_from_own = sights[view].input_from_level.inverse() * own[view].input_from_level;
        sightings.extend(of_view.into_iter().map(|one| Sighting::new(view, &level_from_own, one, judgement)));
    }
    let groups = groups(sightings);
    let (sights, of_places) = places::bettered(views, sights, &groups, settings).ok_or(0_usize)?;
    warnings.extend(of_places);
    warnings.extend(disagree::looked_through(&sights, &groups));
    let assignments = views.iter().map(|view| &view.assignments).collect();
    let all = Views { sights: &sights, assignments, judgement };
    let (mut fitted, mut refused) = (Vec::new(), Vec::new());
    for group in &groups {
        match joint::fit_group(&all, group, sizes, settings) {
            Ok(one) => fitted.push(one),
            Err(why) => refused.push(Refused { body: group[0].body().clone(), why: Refusal::NotFitted(why) }),
        }
    }
    // All images as one row.
    let points = sights.iter().map(|sight| sight.points.len()).sum();
    let found = choose(&fitted, points).into_iter().map(|chosen| chosen.one).collect();
    Ok(Fused { sights, found, refused, refused_by_frames, warnings })
}
