use super::ends::{ends, FAR};
use super::evidence::Sheet;
use super::settle::{lowest_m, settled, LEVEL_COS};
use super::sight::Sight;
use super::surfaces::{Labels, Present};
use crate::cloud::CloudView;
use crate::fit::{
    kept_length, priors, solve, FitSettings, FittedBody, NotFitted, PartEnds, PartReadings, PartSegment, Problem, Sensor, Solution,
    Support,
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
    let body = &settled(body);
    let cloud =
        CloudView { points: &sight.points, width: sight.width, height: sight.height, viewpoint: Some(sight.eye) };
    let used: Vec<_> = labels
        .parts
        .iter()
        .filter(|(_, points)| labels.count(points) >= LEAST_READINGS && points.len() >= LEAST_SAMPLES)
        .collect();
    let sample = used.iter().max_by_key(|(_, points)| points.len()).map_or(&[][..], |(_, points)| points);
    let sensor = Sensor::new(&cloud, sample, settings);
    let parts = used.iter().map(|(role, points)| {
        let sheet = Sheet::new(body, *role, &sight.eye);
        let (center, normal) = sheet.at(0.0, sheet.length_m / 2.0);
        let normal = if normal.dot(&(sight.eye - center)) < 0.0 { -normal } else { normal };
        let ends = ends(sight, body, present, *role);
        let segment = PartSegment { role: *role, normal, center, ends: PartEnds::Told(ends), points };
        let kept = if ends[FAR].is_none() { kept_length(body, *role) } else { None };
        (PartReadings::new(&segment, body, &sensor, settings), kept)
    });
    let (parts, kept): (Vec<_>, Vec<_>) = parts.unzip();
    let up = (body.input_from_object.rotation * Vec3::z()).z;
    let stands = lowest_m(body).abs() < settings.stands_on_support_m;
    let plane = Plane { normal: Vec3::z(), distance: 0.0 };
    let problem = Problem {
        parts,
        support: stands.then_some(Support { plane, is_level: up > LEVEL_COS }),
        priors: priors(body).into_iter().chain(kept.into_iter().flatten()).collect(),
        settings: *settings,
    };
    solve(&problem, body)
}
