use nalgebra::{Isometry3, Translation3, UnitQuaternion};

use super::body::{FittedBody, Parameters};
use super::layout::{HEIGHT, LENGTH, WIDTH};
use super::rim::Rim;
use super::settings::FitSettings;
use super::wall_lean::wall_lean;
use crate::geometry::Vec3;

fn body() -> FittedBody {
    let turn = UnitQuaternion::from_euler_angles(0.3, -2.1, 0.8);
    let mut numbers = Parameters::zeros();
    (numbers[LENGTH], numbers[WIDTH], numbers[HEIGHT]) = (0.5, 0.3, 0.2);
    FittedBody { input_from_object: Isometry3::from_parts(Translation3::new(0.2, -0.4, 1.1), turn), numbers }
}

/// Readings of wall `k` that leans outwards at its top by `lean_rad`, `noise_m` to and fro off it.
fn readings(body: &FittedBody, k: usize, lean_rad: f64, noise_m: f64) -> Vec<Vec3> {
    let rim = Rim::new(body, k);
    let mut out = Vec::new();
    for i in 0..20 {
        for j in 0..15 {
            let (along, below) = (0.01 * f64::from(i) - 0.1, 0.012 * f64::from(j));
            let noise = if (i + j) % 2 == 0 { noise_m } else { -noise_m };
            out.push(body.to_input(&rim.place(along, below * lean_rad.tan() + noise - 0.003, -below)));
        }
    }
    out
}

#[test]
fn each_wall_tells_its_own_lean() {
    let body = body();
    let mut cases = 0;
    for k in 0..4 {
        for lean_deg in [-8.0, 0.0, 0.5, 6.0, 15.0_f64] {
            let points = readings(&body, k, lean_deg.to_radians(), 0.001);
            let found = wall_lean(points.iter().copied(), &body, k, &FitSettings::default()).unwrap();
            let off = found.value - lean_deg.to_radians();
            assert!(off.abs() < found.sigma.unwrap(), "wall {k}: {lean_deg} deg, off by {off} rad");
            assert!(found.sigma.unwrap() < 0.01);
            cases += 1;
        }
    }
    assert_eq!(cases, 20);
}

#[test]
fn few_readings_tell_nothing() {
    let body = body();
    let points = readings(&body, 1, 0.1, 0.001);
    assert!(wall_lean(points.iter().copied().take(59), &body, 1, &FitSettings::default()).is_none());
    let strip = vec![points[0]; 200];
    assert!(wall_lean(strip.into_iter(), &body, 1, &FitSettings::default()).is_none());
}
