use nalgebra::{Matrix3, Vector3};

use super::body::FittedBody;
use super::rim::Rim;
use super::settings::FitSettings;
use crate::body::ParameterAnswer;
use crate::geometry::Vec3;

const LEAST_READINGS: usize = 60;
/// Root mean square of the readings' heights off their middle.
const LEAST_SPREAD_M: f64 = 0.003;
/// Readings farther off the plane than this many times their root mean square are left out of a second look.
const CUT: f64 = 2.5;

/// How far wall `k` leans outwards at its top, rad, by a plane through its own readings (eq. 88): the fitted body's walls
/// are upright. `None` of too few readings, or of a strip that tells no lean.
pub fn wall_lean(
    points: impl Iterator<Item = Vec3> + Clone,
    body: &FittedBody,
    k: usize,
    settings: &FitSettings,
) -> Option<ParameterAnswer> {
    let rim = Rim::new(body, k);
    let place = |p: Vec3| {
        let at = rim.locate(body.to_object(&p));
        (Vector3::new(1.0, at.along, at.above), -at.inward)
    };
    let rows = points.map(place);
    let first = Plane::through(rows.clone())?;
    let kept = Plane::through(rows.filter(|(row, out)| (out - row.dot(&first.slopes)).abs() <= CUT * first.rms))?;
    let slope = kept.slopes.z;
    // Neighbouring readings share errors.
    let sigma = kept.rms * (kept.spread[(2, 2)] * settings.readings_that_agree).sqrt();
    Some(ParameterAnswer { value: slope.atan(), sigma: Some(sigma / (1.0 + slope * slope)) })
}

/// How far out a wall's readings lie, as a plane over their places along and above.
struct Plane {
    slopes: Vector3<f64>,
    /// Inverse of the normal equations.
    spread: Matrix3<f64>,
    rms: f64,
}

impl Plane {
    fn through(rows: impl Iterator<Item = (Vector3<f64>, f64)> + Clone) -> Option<Self> {
        let mut normal_equations = Matrix3::zeros();
        let (mut right, mut count) = (Vector3::zeros(), 0_usize);
        for (row, out) in rows.clone() {
            normal_equations += row * row.transpose();
            right += row * out;
            count += 1;
        }
        if count < LEAST_READINGS {
            return None;
        }
        let spread = normal_equations.cholesky()?.inverse();
        // Not so a number that is none.
        let tells_lean = 1.0 / spread[(2, 2)] > count as f64 * LEAST_SPREAD_M * LEAST_SPREAD_M;
        if !tells_lean {
            return None;
        }
        let slopes = spread * right;
        let squares: f64 = rows.map(|(row, out)| (out - row.dot(&slopes)).powi(2)).sum();
        Some(Self { slopes, spread, rms: (squares / (count - 3) as f64).sqrt() })
    }
}
