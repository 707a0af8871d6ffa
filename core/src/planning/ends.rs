//! Free edges of flaps across from one another that come upon each other end to end.

use super::flap::Flap;

/// From the middle of a board to the edge of its outer face, as physics has it (docs/physics.md).
const EDGE_M: f64 = 0.002;
/// Ends that pass one another by less than this are taken to meet: boards give way that far before they do.
const PASS_M: f64 = 0.0015;

/// Would the free edge of a flap, on its way down between two angles, run into that of the flap across from it, which stands at an
/// angle? What reaches further than the other's edge comes down on its outer face and presses it down; what reaches less goes under
/// it; end to end boards jam.
pub fn run_into(moving: &Flap, (from_rad, to_rad): (f64, f64), other: &Flap, at_rad: f64) -> bool {
    let (closed, frame) = (moving.frame(0.0), other.frame(at_rad));
    let passes = [2, 3].map(|k| {
        let [u, v] = other.outline[k];
        let [inner, outer] = [0.0, EDGE_M].map(|w| closed.coordinates(&frame.at(u, v, w)));
        let is_passed = (to_rad..=from_rad).contains(&inner.z.atan2(inner.y));
        let [near_m, far_m] = [inner, outer].map(|point| point.y.hypot(point.z));
        let reach_m = reach_m(moving, inner.x);
        (is_passed, reach_m > far_m + PASS_M, reach_m < near_m - PASS_M)
    });
    passes.iter().any(|(is_passed, ..)| *is_passed)
        && !passes.iter().all(|(_, is_over, _)| *is_over)
        && !passes.iter().all(|(.., is_under)| *is_under)
}

/// From the hinge to the free edge, at so much along the hinge.
fn reach_m(flap: &Flap, along_m: f64) -> f64 {
    let [[end, end_m], [start, start_m]] = [flap.outline[2], flap.outline[3]];
    let share = (along_m - start) / (end - start).max(f64::MIN_POSITIVE);
    start_m + (end_m - start_m) * share.clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::super::sample_box::carton;
    use super::*;

    #[test]
    fn free_edges_meet_where_neither_flap_reaches_beyond_the_other() {
        // Two flaps of 0.22 m with 0.3 m between their hinges stand edge to edge at 47.0 degrees (0.8208 rad): cos a = 0.15 / 0.22.
        let flaps = carton(0.004, [0.22; 4]).flaps;
        let meets = |from_rad: f64, at_rad: f64| run_into(&flaps[0], (from_rad, 0.0), &flaps[2], at_rad);
        // Lower by a degree or more it is pressed down; higher by a hair the other goes under it.
        let asked = [(0.79, false), (0.815, true), (0.8208, true), (0.825, true), (0.831, false), (0.85, false)];
        let counted = asked.map(|(at_rad, expected)| {
            assert_eq!(meets(1.2, at_rad), expected, "{at_rad}");
            // From below there is nothing to pass.
            assert!(!meets(0.6, at_rad), "{at_rad}");
        });
        assert_eq!(counted.len(), 6);
    }

    #[test]
    fn an_edge_that_is_passed_over_at_one_end_and_under_at_the_other_is_met() {
        let mut flaps = carton(0.004, [0.22; 4]).flaps;
        assert!(!run_into(&flaps[0], (1.2, 0.0), &flaps[2], 0.85));
        flaps[0].outline[2][1] += 0.02;
        assert!(run_into(&flaps[0], (1.2, 0.0), &flaps[2], 0.85));
    }
}
