//! Bodies come back from exact readings of their own faces, with panels hidden and ends cut off.

use super::body::FittedBody;
use super::derivative_tests::Draw;
use super::forward::hinge;
use super::layout::*;
use super::panel::Panel;
use super::priors::priors;
use super::problem::{Problem, Support};
use super::readings::{EndReading, FaceReading, PartReadings};
use super::roles::Role;
use super::settings::FitSettings;
use super::solve::solve;
use crate::geometry::{Plane, Vec3};

const SIGMA_M: f64 = 0.001;

/// A point on the panel's face: Newton's steps from the middle board at these coordinates of it.
fn on_face(body: &FittedBody, role: Role, face: f64, [along, away]: [f64; 2]) -> Vec3 {
    let panel = Panel::new(body, role);
    let [a, b] = panel.axes();
    let origin = super::rim::Rim::new(body, role.side()).place(0.0, 0.0, 0.0);
    let base = if role == Role::Base { Vec3::zeros() } else { origin };
    let mut q = base + a * along + b * away;
    for _ in 0..20 {
        q -= panel.normal() * panel.face(&q, face).value;
        let flat = panel.flat(&q);
        q += a * (along - flat[0]) + b * (away - flat[1]);
    }
    body.to_input(&q)
}

/// Exact readings of a panel: a grid on its face, and points on its four ends; `cut` takes the outer half of it away.
pub fn readings(body: &FittedBody, role: Role, cut: bool) -> PartReadings {
    let k = role.side();
    let reach = match role {
        Role::Base => [body.get(LENGTH) / 2.0, body.get(WIDTH) / 2.0],
        Role::Side(_) => [body.edge_m(k) / 2.0, body.get(HEIGHT)],
        _ => [body.get(flap(k) + FLAP_WIDTH) / 2.0, body.get(flap(k) + FLAP_LENGTH)],
    };
    let face = if k < 2 { 1.0 } else { -1.0 };
    let most = if cut { 0.5 } else { 0.95 };
    let at = |u: f64, v: f64| on_face(body, role, face, [u * reach[0], v * reach[1]]);
    let low = if role == Role::Base { -0.9 } else { 0.05 };
    let grid = (0..100).map(|i| (f64::from(i % 10) / 9.0, f64::from(i / 10) / 9.0));
    let faces = grid.map(|(u, v)| FaceReading { point: at(1.8 * u - 0.9, low + (most - low) * v), sigma_m: SIGMA_M });
    let faces = faces.collect();
    let panel = Panel::new(body, role);
    let mut ends = Vec::new();
    for end in 0..4 {
        let (axis, sign) = super::panel::outward_coordinate(role, end);
        for i in 0..10 {
            let t = f64::from(i) / 9.0;
            let (u, v) = if axis == 0 { (sign * 0.9, low + (most - low) * t) } else { (1.8 * t - 0.9, 0.5) };
            let point = at(u, v);
            // How far the end lies beyond that point is exact, so the strip is.
            let is_cut = cut && end == 3;
            let to_end = -panel.beyond(&body.to_object(&point), end, face).value;
            let reach_m = if is_cut { 0.0 } else { to_end };
            ends.push(EndReading { point, end, reach_m, sigma_m: SIGMA_M, is_least: is_cut, information: 1.0 });
        }
    }
    PartReadings { role, face, faces, face_information: 1.0, ends }
}

pub fn a_box(draw: &mut Draw) -> FittedBody {
    let mut body = draw.body();
    for k in 0..4 {
        body.numbers[bulge(k)] *= 0.3;
        body.numbers[flap(k) + FLAP_OFFSET] *= 0.2;
        body.numbers[flap(k) + FLAP_TAPER] *= 0.3;
        body.numbers[flap(k) + FLAP_WIDTH] = body.edge_m(k) - 0.006;
        body.numbers[flap(k) + FLAP_LENGTH] = 0.12;
        body.numbers[flap(k) + FLAP_CURL] *= 0.4;
        body.numbers[flap(k) + FLAP_ANGLE] = draw.between(0.2, 4.0);
    }
    body.numbers[RACK] *= 0.3;
    body
}

pub fn disturbed(draw: &mut Draw, body: &FittedBody) -> FittedBody {
    let mut step = super::body::Parameters::zeros();
    for place in 0..3 {
        (step[TURN + place], step[SHIFT + place]) = (draw.between(-0.03, 0.03), draw.between(-0.01, 0.01));
    }
    for place in [LENGTH, WIDTH, HEIGHT] {
        step[place] = draw.between(-0.015, 0.015);
    }
    for k in 0..4 {
        step[flap(k) + FLAP_ANGLE] = draw.between(-0.1, 0.1);
        step[flap(k) + FLAP_LENGTH] = draw.between(-0.02, 0.02);
        step[flap(k) + FLAP_CURL] = -body.get(flap(k) + FLAP_CURL);
        step[bulge(k)] = -body.get(bulge(k));
    }
    body.moved(&step)
}

pub fn problem(body: &FittedBody, parts: Vec<PartReadings>, start: &FittedBody) -> Problem {
    let normal = body.input_from_object * Vec3::z();
    let support = Plane { normal, distance: normal.dot(&body.input_from_object.translation.vector) };
    let support = Support { plane: support, is_level: true };
    Problem {
        parts,
        others: Vec::new(),
        support: Some(support),
        priors: priors(start),
        settings: FitSettings::default(),
    }
}

/// Of all hinges: the largest turn of the axis (rad), distance (m) and angle (rad).
pub fn hinge_errors(found: &FittedBody, body: &FittedBody) -> [f64; 3] {
    let mut worst = [0.0_f64; 3];
    for k in 0..4 {
        let Some((a, b)) = hinge(found, Role::Flap(k)).zip(hinge(body, Role::Flap(k))) else { continue };
        let off = b.origin - a.origin;
        let errors = [(a.axis - b.axis).norm(), off.cross(&a.axis).norm(), (a.position_rad - b.position_rad).abs()];
        (0..3).for_each(|i| worst[i] = worst[i].max(errors[i]));
    }
    worst
}

#[test]
fn whole_boxes_come_back() {
    let mut draw = Draw::new(7);
    let mut cases = 0;
    for _ in 0..20 {
        let body = a_box(&mut draw);
        let start = disturbed(&mut draw, &body);
        let roles = (0..4).flat_map(|k| [Role::Side(k), Role::Flap(k)]).chain([Role::Base]);
        let parts = roles.map(|role| readings(&body, role, false)).collect();
        let found = solve(&problem(&body, parts, &start), &start).unwrap().body;
        let [axis, distance, angle] = hinge_errors(&found, &body);
        assert!(axis < 2e-3 && distance < 5e-4 && angle < 1e-2, "{axis} {distance} {angle}");
        for place in [LENGTH, WIDTH, HEIGHT] {
            assert!((found.get(place) - body.get(place)).abs() < 5e-4, "{place}: {}", found.get(place));
        }
        cases += 1;
    }
    assert_eq!(cases, 20);
}

#[test]
fn hidden_sides_and_cut_flaps_follow_from_the_rest() {
    let mut draw = Draw::new(8);
    let mut cases = 0;
    for case in 0..20 {
        let body = a_box(&mut draw);
        let start = disturbed(&mut draw, &body);
        // One side and the flap beyond it hidden, one flap's free edge outside of the frame.
        let hidden = case % 4;
        let cut = Role::Flap((hidden + 2) % 4);
        let roles = (0..4).flat_map(|k| [Role::Side(k), Role::Flap(k)]);
        let seen = roles.filter(|role| role.side() != hidden);
        let parts = seen.map(|role| readings(&body, role, role == cut)).collect();
        let found = solve(&problem(&body, parts, &start), &start).unwrap();
        for k in (0..4).filter(|k| *k != hidden) {
            let (a, b) = (hinge(&found.body, Role::Flap(k)).unwrap(), hinge(&body, Role::Flap(k)).unwrap());
            assert!((a.origin - b.origin).cross(&a.axis).norm() < 1e-3, "case {case}, flap {k}");
            assert!((a.position_rad - b.position_rad).abs() < 0.03, "case {case}, flap {k}");
        }
        for place in [LENGTH, WIDTH, HEIGHT] {
            let error = (found.body.get(place) - body.get(place)).abs();
            assert!(error < 3e-3, "case {case}, {place}: {error}");
        }
        // What is cut off is at least as long as it was seen, and nobody is sure of it.
        let length = flap(cut.side()) + FLAP_LENGTH;
        assert!(found.body.get(length) > 0.5 * body.get(length));
        let sigma = |place: usize| found.covariance[(place, place)].sqrt();
        assert!(sigma(length) > 10.0 * sigma(flap((hidden + 1) % 4) + FLAP_LENGTH));
        cases += 1;
    }
    assert_eq!(cases, 20);
}
