use nalgebra::{Matrix3, Vector3};

use super::sight::Sight;
use super::surfaces::Surface;
use crate::fit::{FittedBody, Role};

/// Readings that are asked, at most.
const SAMPLES: usize = 400;
const LEAST: u32 = 20;

/// By how much the readings that a panel was given lean off it: the tangent. Where another surface crosses the panel, the
/// strip of it that lies within the tolerance leans as that surface does. `None` of too few readings.
pub fn lean(sight: &Sight, body: &FittedBody, role: Role, points: &[u32]) -> Option<f64> {
    let surface = Surface::new(sight, body, role);
    let step = points.len().div_ceil(SAMPLES).max(1);
    let mut normal_equations = Matrix3::zeros();
    let mut right = Vector3::zeros();
    let mut count = 0_u32;
    for &index in points.iter().step_by(step) {
        let Some(point) = sight.reading(index as usize) else { continue };
        let Some([along, away, off]) = surface.place(&body.to_object(&point)) else { continue };
        let row = Vector3::new(1.0, along, away);
        normal_equations += row * row.transpose();
        right += row * off;
        count += 1;
    }
    if count < LEAST {
        return None;
    }
    // A narrow strip does not tell how it leans along itself.
    let n = f64::from(count);
    normal_equations[(1, 1)] += n * NARROW_M * NARROW_M;
    normal_equations[(2, 2)] += n * NARROW_M * NARROW_M;
    let fitted = normal_equations.cholesky()?.solve(&right);
    Some(fitted.y.hypot(fitted.z))
}

/// Readings that spread less than this in a direction tell no lean that way, metres.
const NARROW_M: f64 = 0.0015;
