use super::answer::fill;
use super::body::FittedBody;
use super::known_size::{with_known_size, KnownSize};
use super::layout::{lean_name, HEIGHT, LENGTH, RACK, THICKNESS, WIDTH};
use super::panel::{Panel, NEAR};
use super::priors::priors;
use super::problem::{Problem, Support};
use super::readings::{PartEnds, PartReadings, PartSegment};
use super::refusal::NotFitted;
use super::roles::Role;
use super::sensor::Sensor;
use super::settings::FitSettings;
use super::solve::{solve, Solution};
use super::start::start;
use super::wall_lean::wall_lean;
use crate::body::{ObjectAnswer, PartAnswer};
use crate::cloud::CloudView;
use crate::geometry::{Plane, Vec3};
use crate::model::{Assignment, Body, SegmentSet, Template};
use crate::perception::Scene;

/// The object with its body fitted to the readings of its segments, and the assignment in the fitted body's order of sides.
///
/// `object` and `assignment` are what `build_object` made of rectangles; the fit starts there. Of `sizes` the one that the
/// body matches, if any, is taken as known.
///
/// # Errors
/// Says why there is no fitted body; a fit that has not converged is none.
pub fn fit_object(
    object: &ObjectAnswer,
    template: &Template,
    scene: &Scene,
    (set, assignment): (&SegmentSet, &Assignment),
    cloud: &CloudView,
    sizes: &[KnownSize],
    settings: &FitSettings,
) -> Result<(ObjectAnswer, Assignment), NotFitted> {
    let Body::OpenBox(box_roles) = &template.body else { return Err(NotFitted::NoBox) };
    let roles = Role::of_parts(box_roles);
    let first = start(object, &roles).ok_or(NotFitted::NoBox)?;
    let segments = part_segments(&roles, scene, set, assignment);
    let sample = segments.iter().max_by_key(|s| s.points.len()).map_or(&[][..], |s| s.points);
    let sensor = Sensor::new(cloud, sample, settings);

    let solution = fit(&segments, &first, scene, &sensor, settings)?;
    let turn = canonical_turn(&solution.body, sensor.viewpoint);
    let taken_from = parts_before_turn(&roles, template.parts.len(), turn);
    let solution = if turn == 0 {
        solution
    } else {
        let segments: Vec<PartSegment> =
            segments.iter().map(|s| PartSegment { role: s.role.turned(turn), ..*s }).collect();
        fit(&segments, &solution.body.turned(turn), scene, &sensor, settings)?
    };
    let (solution, size) = with_known_size(solution, sizes, settings.seen_scale.dimension);
    check(&solution.body)?;

    let mut out = object.clone();
    let turned: Assignment = taken_from.iter().map(|&from| assignment[from]).collect();
    for (part, &from) in out.parts.iter_mut().zip(&taken_from) {
        *part = PartAnswer { name: part.name.clone(), ..object.parts[from].clone() };
    }
    let seen: Vec<bool> = turned.iter().map(Option::is_some).collect();
    fill(&mut out, template, &roles, &seen, &solution, settings);
    out.size = size.map(|size| size.answer(sizes));
    for segment in part_segments(&roles, scene, set, &turned) {
        let Role::Side(k) = segment.role else { continue };
        let points = segment.points.iter().map(|&index| sensor.point(index));
        let lean = wall_lean(points, &solution.body, k, settings);
        out.parameters.extend(lean.map(|lean| (lean_name(k), lean)));
    }
    Ok((out, turned))
}

fn part_segments<'a>(
    roles: &[(usize, Role)],
    scene: &'a Scene,
    set: &SegmentSet,
    assignment: &Assignment,
) -> Vec<PartSegment<'a>> {
    let of = |&(part, role): &(usize, Role)| {
        let s = set.scene_index[assignment[part]?];
        Some(PartSegment {
            role,
            normal: scene.segments.planes[s].normal,
            center: scene.segments.rectangles[s].center(),
            ends: PartEnds::OfRectangle(&scene.segments.rectangles[s], scene.segments.edges[s]),
            points: scene.segments.points_of(s),
        })
    };
    roles.iter().filter_map(of).collect()
}

fn fit(
    segments: &[PartSegment],
    first: &FittedBody,
    scene: &Scene,
    sensor: &Sensor,
    settings: &FitSettings,
) -> Result<Solution, NotFitted> {
    let bottom = first.input_from_object.translation.vector;
    let stands = |plane: &Plane| plane.height_of(&bottom).abs() < settings.stands_on_support_m;
    let problem = Problem {
        parts: segments.iter().map(|segment| PartReadings::new(segment, first, sensor, settings)).collect(),
        others: Vec::new(),
        support: scene.support.filter(stands).map(|plane| Support { plane, is_level: true }),
        priors: priors(first),
        settings: *settings,
    };
    solve(&problem, first)
}

/// The turn that makes side 0 the longer side nearest the camera.
pub fn canonical_turn(body: &FittedBody, viewpoint: Option<Vec3>) -> usize {
    let eye = body.to_object(&viewpoint.unwrap_or_else(Vec3::zeros));
    let first = usize::from(body.get(WIDTH) > body.get(LENGTH));
    // The distance from the line of a side's top is that in its frame across it; both of a pair are equally long.
    let distance = |k: usize| {
        let side = Panel::new(body, Role::Side(k));
        let above = side.beyond(&eye, NEAR, 0.0).value;
        side.flat(&eye)[0].hypot(above).hypot(side.face(&eye, 0.0).value)
    };
    if distance(first) <= distance(first + 2) {
        first
    } else {
        first + 2
    }
}

/// For each part the one that had its place before side `by` became side 0.
fn parts_before_turn(roles: &[(usize, Role)], parts: usize, by: usize) -> Vec<usize> {
    let mut out: Vec<usize> = (0..parts).collect();
    for &(part, role) in roles {
        if let Some(&(to, _)) = roles.iter().find(|(_, other)| *other == role.turned(by)) {
            out[to] = part;
        }
    }
    out
}

/// Numbers outside of these belong to no box: the fit went astray.
const SIZES_M: [f64; 2] = [0.01, 3.0];
const MOST_RACK_RAD: f64 = 0.35;
const MOST_THICKNESS_M: f64 = 0.03;

pub fn check(body: &FittedBody) -> Result<(), NotFitted> {
    let absurd = |name: &'static str, value: f64| Err(NotFitted::Absurd { name, value });
    for (name, place) in [("length", LENGTH), ("width", WIDTH), ("height", HEIGHT)] {
        if !(SIZES_M[0]..=SIZES_M[1]).contains(&body.get(place)) {
            return absurd(name, body.get(place));
        }
    }
    if body.get(RACK).abs() > MOST_RACK_RAD {
        return absurd("rack", body.get(RACK));
    }
    if body.get(THICKNESS).abs() > MOST_THICKNESS_M {
        return absurd("thickness", body.get(THICKNESS));
    }
    Ok(())
}
