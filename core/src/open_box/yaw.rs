use std::f64::consts::FRAC_PI_2;

use super::patch::Patch;
use crate::geometry::Vec3;

/// Directions this near to each other may be of one box, rad: racked boxes are some degrees out of square.
const SAME_RAD: f64 = 0.07;
/// Directions of boxes, at most.
const MOST: usize = 6;
/// What remains below this share of the strongest direction's votes is no box's.
const LEAST_SHARE: f64 = 0.08;
/// A flap's hinge is known worse than a wall.
const OF_FLAPS: f64 = 0.4;

/// The directions in which boxes may stand, rad in [0, pi/2), strongest first: every wall votes with its normal, every
/// tilted panel with its hinge.
///
/// Angles are about `frame`'s third axis, from its first towards its second.
pub fn yaws(patches: &[Patch], frame: &[Vec3; 3]) -> Vec<f64> {
    let mut votes: Vec<(f64, f64)> = patches.iter().filter_map(|patch| vote(patch, frame)).collect();
    votes.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut out = Vec::new();
    let mut strongest = 0.0_f64;
    while out.len() < MOST {
        let weight_about = |yaw: f64| votes.iter().filter(|v| near(v.0, yaw)).map(|v| v.1).sum::<f64>();
        let best =
            votes.iter().map(|v| (weight_about(v.0), v.0)).fold((0.0, 0.0), |a, b| if b.0 > a.0 { b } else { a });
        strongest = strongest.max(best.0);
        if best.0 <= 0.0 || best.0 < LEAST_SHARE * strongest {
            break;
        }
        let near_best = votes.iter().filter(|v| near(v.0, best.1));
        let shift: f64 = near_best.map(|v| v.1 * difference(v.0, best.1)).sum::<f64>() / best.0;
        out.push((best.1 + shift).rem_euclid(FRAC_PI_2));
        votes.retain(|v| !near(v.0, best.1));
    }
    out
}

fn vote(patch: &Patch, frame: &[Vec3; 3]) -> Option<(f64, f64)> {
    let [x, y, up] = frame;
    let along = patch.level_direction(up)?;
    let yaw = along.dot(y).atan2(along.dot(x)).rem_euclid(FRAC_PI_2);
    let [low, high] = patch.span(&along);
    // A longer and better seen edge tells its direction better.
    let weight = (high - low) * patch.readings.min(4000.0).sqrt();
    let lean = patch.normal.cross(up).norm();
    Some((yaw, if patch.is_upright(up) { weight } else { OF_FLAPS * weight * lean }))
}

/// The shorter way from b to a, of directions that a quarter turn leaves alike.
pub fn difference(a: f64, b: f64) -> f64 {
    (a - b + FRAC_PI_2 / 2.0).rem_euclid(FRAC_PI_2) - FRAC_PI_2 / 2.0
}

pub fn near(a: f64, b: f64) -> bool {
    difference(a, b).abs() < SAME_RAD
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_a_quarter_turn_apart_are_one() {
        for (a, b, expected) in [(0.01, FRAC_PI_2 - 0.01, 0.02), (0.3, 0.2, 0.1), (0.2, 0.3, -0.1)] {
            assert!((difference(a, b) - expected).abs() < 1e-12);
        }
    }
}
