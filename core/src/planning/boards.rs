//! Which boards meet when a flap turns, whatever the arm does.

use super::flap::Flap;
use super::problem::BoxProblem;
use super::reason::Obstacle;
use super::settings::PlanningSettings;
use crate::geometry::Vec3;

/// The moving board is taken to be this much smaller all round: boards that only graze are given way by the folds, and models err
/// by millimetres.
const GRAZE_M: f64 = 0.006;
/// Between two angles at which boards are held against each other.
const STEP_RAD: f64 = 0.06;
/// Boards that meet this soon after the start met there already, by the model's error.
const START_RAD: f64 = 0.09;

/// The first board that a flap meets on its way to an angle, while the others stand at `angles_rad`; None where the way is free.
///
/// It may come to lie on flaps that are closed. Its own side and what hangs on itself do not count.
pub fn met(
    problem: &BoxProblem,
    angles_rad: &[f64],
    flap: usize,
    to_rad: f64,
    settings: &PlanningSettings,
) -> Option<Obstacle> {
    let moving = &problem.flaps[flap];
    let others: Vec<(&str, [Vec3; 4])> = problem
        .flaps
        .iter()
        .enumerate()
        .filter(|&(k, other)| k != flap && has_extent(other) && angles_rad[k] > settings.closed_rad)
        .flat_map(|(k, other)| {
            let tucks = other.tuck_corners(angles_rad[k]);
            std::iter::once((other.name.as_str(), other.corners(angles_rad[k]))).chain(tucks)
        })
        .collect();
    let from_rad = angles_rad[flap];
    let steps = ((from_rad - to_rad).abs() / STEP_RAD).ceil().max(1.0) as usize;
    for step in 1..=steps {
        let angle_rad = from_rad + (to_rad - from_rad) * step as f64 / steps as f64;
        if (from_rad - angle_rad).abs() < START_RAD {
            continue;
        }
        let board = shrunk(&moving.corners(angle_rad));
        if let Some((name, _)) = others.iter().find(|(_, other)| quads_cross(&board, other)) {
            return Some(Obstacle::Boards { flap: moving.name.clone(), other: (*name).to_string() });
        }
    }
    None
}

fn has_extent(flap: &Flap) -> bool {
    flap.standing != super::flap::Standing::Absent && flap.length_m() > 0.0
}

/// A quadrilateral with each corner moved in along both of its edges.
fn shrunk(corners: &[Vec3; 4]) -> [Vec3; 4] {
    std::array::from_fn(|k| {
        let toward = |other: &Vec3| {
            let edge = other - corners[k];
            edge * (GRAZE_M / edge.norm().max(2.0 * GRAZE_M))
        };
        corners[k] + toward(&corners[(k + 1) % 4]) + toward(&corners[(k + 3) % 4])
    })
}

/// Do two flat convex quadrilaterals pass through each other?
pub fn quads_cross(a: &[Vec3; 4], b: &[Vec3; 4]) -> bool {
    edges_cross(a, b) || edges_cross(b, a)
}

fn edges_cross(a: &[Vec3; 4], b: &[Vec3; 4]) -> bool {
    let normal = (b[2] - b[0]).cross(&(b[3] - b[1]));
    (0..4).any(|k| {
        let (p, q) = (a[k], a[(k + 1) % 4]);
        let (over, under) = ((p - b[0]).dot(&normal), (q - b[0]).dot(&normal));
        if over * under >= 0.0 {
            return false;
        }
        let point = p + (q - p) * (over / (over - under));
        let turns: [f64; 4] = std::array::from_fn(|j| (b[(j + 1) % 4] - b[j]).cross(&(point - b[j])).dot(&normal));
        turns.iter().all(|turn| *turn >= 0.0) || turns.iter().all(|turn| *turn <= 0.0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quad(corners: [[f64; 3]; 4]) -> [Vec3; 4] {
        corners.map(|[x, y, z]| Vec3::new(x, y, z))
    }

    #[test]
    fn quads_cross_where_an_edge_of_one_goes_through_the_other() {
        let flat = quad([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
        let upright = |x: f64| quad([[x, 0.2, -0.5], [x, 0.8, -0.5], [x, 0.8, 0.5], [x, 0.2, 0.5]]);
        assert!(quads_cross(&flat, &upright(0.5)));
        assert!(!quads_cross(&flat, &upright(1.1)));
        assert!(!quads_cross(&flat, &flat.map(|p| p + Vec3::z())));
    }
}
