use std::collections::BTreeMap;

use super::ends::{ends, FAR};
use super::evidence::Sheet;
use super::labels::{Labels, Present};
use super::settle::{lowest_m, settled, LEVEL_COS};
use super::sight::Sight;
use super::surfaces::Surface;
use super::upright::{lies, lower_side};
use crate::cloud::CloudView;
use crate::fit::{
    kept_length, layout, lid_length, priors, solve, FaceReading, FitSettings, FittedBody, NotFitted, OtherView,
    PartEnds, PartReadings, PartSegment, PlaceSigma, Prior, Problem, Rim, Role, Sensor, Solution, Support,
};
use crate::geometry::{Plane, Vec3};

/// Fewer readings tell nothing of a panel.
const LEAST_READINGS: usize = 60;
const LEAST_SAMPLES: usize = 8;

/// The body fitted to readings that are given to its panels (eq. 81, 82), in the level frame.
///
/// # Errors
/// As of the fit.
pub fn refit(
    sight: &Sight,
    body: &FittedBody,
    present: &Present,
    labels: &Labels,
    settings: &FitSettings,
) -> Result<Solution, NotFitted> {
    refit_views(&[(sight, labels)], body, present, settings)
}

/// The same, fitted to the readings of several views in one level frame, each of which sees its own faces (eq. 99). Further views'
/// places are known only so well.
///
/// # Errors
/// As of the fit.
pub fn refit_views(
    views: &[(&Sight, &Labels)],
    body: &FittedBody,
    present: &Present,
    settings: &FitSettings,
) -> Result<Solution, NotFitted> {
    let body = &settled(body);
    let shared = |role: Role| shared_by(views, role, settings);
    let told: Vec<Vec<(PartReadings, bool)>> =
        views.iter().map(|(sight, labels)| readings_of(sight, body, present, labels, shared)).collect();
    let kept = kept_lengths(&told, body);
    let mut parts = told.into_iter().map(|told| told.into_iter().map(|(readings, _)| readings).collect());
    let mut first: Vec<PartReadings> = parts.next().unwrap_or_default();
    let others = views
        .iter()
        .skip(1)
        .zip(parts)
        .map(|((sight, _), parts)| OtherView { parts, sigma: sigma(sight, body, settings) });
    let up = (body.input_from_object.rotation * Vec3::z()).z;
    let stands = lowest_m(body).abs() < settings.stands_on_support_m;
    let plane = Plane { normal: Vec3::z(), distance: 0.0 };
    if stands && lies(body) {
        first.push(on_support(body, settings));
    }
    let lids = (0..4).filter(|&k| present.flaps[k] && present.tucks[k]).map(lid_length);
    let problem = Problem {
        parts: first,
        others: others.collect(),
        support: (stands && !lies(body)).then_some(Support { plane, is_level: up > LEVEL_COS }),
        priors: priors(body).into_iter().chain(kept).chain(lids).collect(),
        settings: *settings,
    };
    solve(&problem, body)
}

/// The support below a body that lies, as readings on the outer face of its lower side.
fn on_support(body: &FittedBody, settings: &FitSettings) -> PartReadings {
    let role = Role::Side(lower_side(body));
    let (rim, half_m) = (Rim::new(body, role.side()), UNDER_SHARE * body.edge_m(role.side()) / 2.0);
    let below = [1.0 - UNDER_SHARE, UNDER_SHARE].map(|share| -share * body.get(layout::HEIGHT));
    let places = below.iter().flat_map(|&above| [(-half_m, above), (half_m, above)]);
    let reading = |(along, above): (f64, f64)| {
        let place = body.to_input(&rim.place(along, 0.0, above));
        FaceReading { point: Vec3::new(place.x, place.y, 0.0), sigma_m: settings.support_sigma_m }
    };
    PartReadings { role, face: 1.0, faces: places.map(reading).collect(), face_information: 1.0, ends: Vec::new() }
}

/// How far towards its corners a box is held against what it lies on.
const UNDER_SHARE: f64 = 0.9;

/// Of a view's place where the body is: far off a turn of the camera is a shift.
fn sigma(sight: &Sight, body: &FittedBody, settings: &FitSettings) -> PlaceSigma {
    let range_m = (body.input_from_object.translation.vector - sight.eye).norm();
    let turn_rad = settings.place_sigma_rad;
    PlaceSigma { turn_rad, shift_m: settings.place_sigma_m.hypot(range_m * turn_rad) }
}

/// What one view's readings tell of each panel, and whether they show its far end.
fn readings_of(
    sight: &Sight,
    body: &FittedBody,
    present: &Present,
    labels: &Labels,
    settings_of: impl Fn(Role) -> FitSettings,
) -> Vec<(PartReadings, bool)> {
    let cloud =
        CloudView { points: &sight.points, width: sight.width, height: sight.height, viewpoint: Some(sight.eye) };
    let used: Vec<_> = labels.parts.iter().filter(|(_, points)| tells(labels, points)).collect();
    let sample = used.iter().max_by_key(|(_, points)| points.len()).map_or(&[][..], |(_, points)| points);
    let sensor = Sensor::new(&cloud, sample, &settings_of(Role::Base));
    let parts = used.iter().map(|(role, points)| {
        let sheet = Sheet::new(body, *role, &sight.eye);
        let (center, normal) = sheet.at(0.0, sheet.length_m / 2.0);
        let normal = if normal.dot(&(sight.eye - center)) < 0.0 { -normal } else { normal };
        // A flap that is seen from its edge shows neither of its faces nor, but by some pixels, its ends; another view may see it well.
        let is_thin = Surface::new(sight, body, *role).seen_from_edge(present.is_thin(*role)).is_from_edge();
        let ends = if is_thin { [None; 4] } else { ends(sight, body, present, *role) };
        let segment = PartSegment { role: *role, normal, center, ends: PartEnds::Told(ends), points };
        let readings = PartReadings::new(&segment, body, &sensor, &settings_of(*role));
        let face = if is_thin { 0.0 } else { readings.face };
        (PartReadings { face, ..readings }, ends[FAR].is_some())
    });
    parts.collect()
}

/// Keeps the length of each part whose far end no view that sees it shows.
fn kept_lengths(told: &[Vec<(PartReadings, bool)>], body: &FittedBody) -> Vec<Prior> {
    let mut shown: BTreeMap<Role, bool> = BTreeMap::new();
    for (readings, shows_end) in told.iter().flatten() {
        *shown.entry(readings.role).or_default() |= shows_end;
    }
    shown.iter().filter(|(_, shows_end)| !**shows_end).filter_map(|(&role, _)| kept_length(body, role)).collect()
}

fn tells(labels: &Labels, points: &[u32]) -> bool {
    labels.count(points) >= LEAST_READINGS && points.len() >= LEAST_SAMPLES
}

/// Boards that are not quite flat, and ends that are not quite straight, are so in every view: what a face or an end says at most
/// is shared by the views that see it.
fn shared_by(views: &[(&Sight, &Labels)], role: Role, settings: &FitSettings) -> FitSettings {
    let count = views.iter().filter(|(_, labels)| tells(labels, labels.of(role))).count().max(1) as f64;
    FitSettings {
        most_face_information: settings.most_face_information / count,
        most_end_information: settings.most_end_information / count,
        ..*settings
    }
}
