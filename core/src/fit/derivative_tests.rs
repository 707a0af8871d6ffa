//! Every derivative against differences of the values, on random bodies.

use nalgebra::{Isometry3, Translation3, UnitQuaternion};

use super::body::{FittedBody, Parameters};
use super::layout::*;
use super::panel::Panel;
use super::priors::priors;
use super::problem::{Problem, Support};
use super::readings::{EndReading, FaceReading, PartReadings};
use super::roles::Role;
use super::row::Row;
use super::settings::FitSettings;
use crate::geometry::{Plane, SplitMix64, Vec3};

const STEP: f64 = 1e-6;
const BODIES: usize = 20;

/// Random bodies and points.
pub struct Draw(SplitMix64);

impl Draw {
    pub fn new(seed: u64) -> Self {
        Self(SplitMix64::new(seed))
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.unit()
    }

    pub fn vector(&mut self, size: f64) -> Vec3 {
        Vec3::new(self.between(-size, size), self.between(-size, size), self.between(-size, size))
    }

    pub fn body(&mut self) -> FittedBody {
        let mut numbers = Parameters::zeros();
        for (place, low, high) in
            [(LENGTH, 0.2, 0.5), (WIDTH, 0.2, 0.5), (HEIGHT, 0.1, 0.4), (RACK, -0.1, 0.1), (THICKNESS, 0.001, 0.008)]
        {
            numbers[place] = self.between(low, high);
        }
        for k in 0..4 {
            numbers[bulge(k)] = self.between(-0.01, 0.01);
            for (place, low, high) in [
                (FLAP_LENGTH, 0.05, 0.3),
                (FLAP_WIDTH, 0.15, 0.4),
                (FLAP_TAPER, -0.02, 0.03),
                (FLAP_OFFSET, -0.02, 0.02),
                (FLAP_ANGLE, -1.0, 4.0),
                (FLAP_CURL, -1.5, 1.5),
            ] {
                numbers[flap(k) + place] = self.between(low, high);
            }
            for (place, low, high) in [(TUCK_ANGLE, -1.5, 3.0), (TUCK_LENGTH, 0.02, 0.1), (TUCK_WIDTH, 0.1, 0.3)] {
                numbers[tuck(k) + place] = self.between(low, high);
            }
        }
        let turn = UnitQuaternion::from_scaled_axis(self.vector(2.0));
        FittedBody { input_from_object: Isometry3::from_parts(Translation3::from(self.vector(1.0)), turn), numbers }
    }
}

fn all_roles() -> Vec<Role> {
    let sides = (0..4).flat_map(|k| [Role::Side(k), Role::Flap(k), Role::Tuck(k)]);
    std::iter::once(Role::Base).chain(sides).collect()
}

fn one(place: usize, step: f64) -> Parameters {
    let mut out = Parameters::zeros();
    out[place] = step;
    out
}

/// The largest difference between the row's derivatives, by all parameters, and those of its value.
fn worst(body: &FittedBody, role: Role, measure: impl Fn(&FittedBody) -> Row) -> f64 {
    let mut told = [0.0; PARAMETER_COUNT];
    for (slot, by) in measure(body).slots.iter().enumerate() {
        told[place_of_slot(slot, role.side())] = *by;
    }
    let difference = |place: usize| {
        let at = |step: f64| measure(&body.moved(&one(place, step))).value;
        (at(STEP) - at(-STEP)) / (2.0 * STEP)
    };
    (0..PARAMETER_COUNT).map(|place| (told[place] - difference(place)).abs()).fold(0.0, f64::max)
}

#[test]
fn rows_have_the_derivatives_of_their_values() {
    let mut draw = Draw::new(3);
    let mut cases = 0;
    for _ in 0..BODIES {
        let body = draw.body();
        for role in all_roles() {
            let q = draw.vector(0.25) + Vec3::new(0.0, 0.0, body.get(HEIGHT) * 0.7);
            let p = body.to_input(&q);
            let face = if draw.0.unit() < 0.5 { -1.0 } else { 1.0 };
            let error = worst(&body, role, |body| Panel::new(body, role).face(&body.to_object(&p), face));
            assert!(error < 1e-6, "{role:?} face: {error}");
            for end in 0..4 {
                let error = worst(&body, role, |body| Panel::new(body, role).beyond(&body.to_object(&p), end, face));
                assert!(error < 1e-6, "{role:?} end {end}: {error}");
            }
            cases += 5 * PARAMETER_COUNT;
        }
    }
    assert_eq!(cases, BODIES * 13 * 5 * PARAMETER_COUNT);
}

#[test]
fn the_gradient_is_that_of_the_whole_objective() {
    let mut draw = Draw::new(4);
    let mut cases = 0;
    for number in 0..BODIES {
        let body = draw.body();
        let parts = all_roles().into_iter().map(|role| {
            let mut near = || body.to_input(&(draw.vector(0.25) + Vec3::new(0.0, 0.0, body.get(HEIGHT))));
            let faces = (0..4).map(|_| FaceReading { point: near(), sigma_m: 0.01 }).collect();
            let end = |end| EndReading {
                point: near(),
                end,
                reach_m: 0.001,
                sigma_m: 0.01,
                is_least: end % 2 == 0,
                information: 0.7,
            };
            PartReadings { role, face: 1.0, faces, face_information: 0.3, ends: (0..4).map(end).collect() }
        });
        let (parts, others) = (parts.collect(), Vec::new());
        let normal = (body.input_from_object * (Vec3::z() + draw.vector(0.05))).normalize();
        let plane = Plane { normal, distance: draw.between(-0.1, 0.1) };
        let support = Some(Support { plane, is_level: number % 2 == 0 });
        let (priors, settings) = (priors(&draw.body()), FitSettings::default());
        let problem = Problem { parts, others, support, priors, settings };
        let told = problem.linearize(&body, 5.0).gradient;
        for place in 0..PARAMETER_COUNT {
            let at = |step: f64| problem.linearize(&body.moved(&one(place, step)), 5.0).cost;
            let difference = (at(STEP) - at(-STEP)) / (2.0 * STEP);
            let error = (told[place] - difference).abs() / (1.0 + difference.abs());
            assert!(error < 1e-4, "parameter {place}: {} told, {difference} found", told[place]);
            cases += 1;
        }
    }
    assert_eq!(cases, BODIES * PARAMETER_COUNT);
}
