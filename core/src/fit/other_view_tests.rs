//! Readings of a view whose place was told a little wrong: the place comes back, and what it leaves open is counted.

use nalgebra::{DVector, Isometry3};

use super::derivative_tests::Draw;
use super::layout::*;
use super::linearized::Linearized;
use super::other_view::{OtherView, PlaceSigma};
use super::readings::PartReadings;
use super::recovery_tests::{a_box, disturbed, hinge_errors, problem, readings};
use super::roles::Role;
use super::settings::FitSettings;
use super::solve::solve;
use super::FittedBody;
use crate::geometry::Vec3;

const CUT: f64 = 3.0;
const STEP: f64 = 1e-5;

fn all_roles() -> impl Iterator<Item = Role> {
    (0..4).flat_map(|k| [Role::Side(k), Role::Flap(k)]).chain([Role::Base])
}

/// Exact readings of all panels, moved in the object's frame.
fn moved_readings(body: &FittedBody, motion: &Isometry3<f64>) -> Vec<PartReadings> {
    let moved = |p: Vec3| body.to_input(&motion.transform_point(&body.to_object(&p).into()).coords);
    let mut parts: Vec<PartReadings> = all_roles().map(|role| readings(body, role, false)).collect();
    for part in &mut parts {
        part.faces.iter_mut().for_each(|reading| reading.point = moved(reading.point));
        part.ends.iter_mut().for_each(|reading| reading.point = moved(reading.point));
    }
    parts
}

fn small_motion(draw: &mut Draw) -> Isometry3<f64> {
    Isometry3::new(draw.vector(0.004), draw.vector(0.006))
}

#[test]
fn a_misplaced_view_is_put_in_its_place() {
    let mut draw = Draw::new(21);
    let mut cases = 0;
    for _ in 0..10 {
        let body = a_box(&mut draw);
        let start = disturbed(&mut draw, &body);
        let motion = small_motion(&mut draw);
        let first = all_roles().map(|role| readings(&body, role, false)).collect();
        let mut problem = problem(&body, first, &start);
        let sigma = PlaceSigma { turn_rad: 0.01, shift_m: 0.01 };
        problem.others = vec![OtherView { parts: moved_readings(&body, &motion), sigma }];
        let found = solve(&problem, &start).unwrap();
        let [axis, distance, angle] = hinge_errors(&found.body, &body);
        assert!(axis < 2e-3 && distance < 5e-4 && angle < 1e-2, "{axis} {distance} {angle}");
        let left = found.motions[0] * motion;
        assert!(left.translation.vector.norm() < 5e-4, "{}", left.translation);
        assert!(left.rotation.angle() < 1e-3, "{}", left.rotation.angle());
        cases += 1;
    }
    assert_eq!(cases, 10);
}

#[test]
fn the_gradient_is_that_of_the_objective_with_the_place_left_free() {
    let mut draw = Draw::new(22);
    let mut cases = 0;
    for _ in 0..4 {
        let body = a_box(&mut draw);
        let near = disturbed(&mut draw, &body);
        let parts = moved_readings(&body, &small_motion(&mut draw));
        let view = OtherView { parts, sigma: PlaceSigma { turn_rad: 0.004, shift_m: 0.003 } };
        let mut problem = problem(&body, Vec::new(), &near);
        problem.others = vec![view];
        // With hardly a cut: the robust loss is the other tests' matter.
        let cut = 1e3;
        let told = problem.linearize(&near, cut).gradient;
        for place in 0..PARAMETER_COUNT {
            let at = |step: f64| {
                let mut by = super::body::Parameters::zeros();
                by[place] = step;
                problem.linearize(&near.moved(&by), cut).cost
            };
            let difference = (at(STEP) - at(-STEP)) / (2.0 * STEP);
            let error = (told[place] - difference).abs() / (1.0 + difference.abs());
            assert!(error < 1e-3, "parameter {place}: {} told, {difference} found", told[place]);
            cases += 1;
        }
    }
    assert_eq!(cases, 4 * PARAMETER_COUNT);
}

/// The curvature that a view adds, full.
fn curvature(view: &OtherView, body: &FittedBody) -> nalgebra::DMatrix<f64> {
    let mut sums = Linearized::zeros();
    view.add_to(&mut sums, body, &view.motion(body, &Isometry3::identity(), CUT), CUT);
    nalgebra::DMatrix::from_fn(PARAMETER_COUNT, PARAMETER_COUNT, |i, j| sums.curvature[(i.max(j), i.min(j))])
}

#[test]
fn a_place_that_is_known_well_says_all_and_one_that_is_not_says_nothing_of_the_pose() {
    let mut draw = Draw::new(23);
    let mut cases = 0;
    for _ in 0..6 {
        let body = a_box(&mut draw);
        let parts = moved_readings(&body, &Isometry3::identity());
        let of = |sigma: f64| OtherView { parts: parts.clone(), sigma: PlaceSigma { turn_rad: sigma, shift_m: sigma } };
        let mut exact = problem(&body, parts.clone(), &body);
        (exact.priors, exact.support, exact.settings) = (Vec::new(), None, FitSettings::default());
        let exact = exact.linearize(&body, CUT).curvature;
        let [known, unknown] = [1e-7, 1e3].map(|sigma| curvature(&of(sigma), &body));
        for i in 0..PARAMETER_COUNT {
            let mut way = DVector::zeros(PARAMETER_COUNT);
            way[i] = 1.0;
            let (all, told) = (exact[(i, i)], way.dot(&(&known * &way)));
            assert!((told - all).abs() <= 1e-4 * all.max(1e-9), "{i}: {told} of {all}");
            let left = way.dot(&(&unknown * &way));
            let most = if i < POSE_COUNT { 1e-6 } else { 1.0 + 1e-9 };
            assert!((-1e-6 * all..=most * all + 1e-9).contains(&left), "{i}: {left} of {all}");
            cases += 1;
        }
    }
    assert_eq!(cases, 6 * PARAMETER_COUNT);
}
