//! A revolute joint stands alike a whole turn further on: wide joints reach one angle in several positions.

use std::f64::consts::TAU;

use arrayvec::ArrayVec;

/// Positions within limits that lie within 360 degrees either way: three where both ends count.
pub const MAX_WRAPS: usize = 3;
/// A position this far beyond a limit is on it, rad: what rounding does to a pose that was made at the limit.
const ROUNDING_RAD: f64 = 1e-9;

/// How many positions one angle may have between these limits, at most.
pub fn most_wraps(lower_rad: f64, upper_rad: f64) -> usize {
    (((upper_rad - lower_rad + 2.0 * ROUNDING_RAD) / TAU).floor() as usize + 1).min(MAX_WRAPS)
}

/// Every position between the limits that stands like `angle_rad`, lowest first.
pub fn wraps(angle_rad: f64, lower_rad: f64, upper_rad: f64) -> ArrayVec<f64, MAX_WRAPS> {
    let mut found = ArrayVec::new();
    let first = ((lower_rad - ROUNDING_RAD - angle_rad) / TAU).ceil();
    for turn in 0..MAX_WRAPS {
        let position_rad = angle_rad + (first + turn as f64) * TAU;
        if position_rad > upper_rad + ROUNDING_RAD {
            break;
        }
        found.push(position_rad.clamp(lower_rad, upper_rad));
    }
    found
}
