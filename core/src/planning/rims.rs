//! What of the box itself stops a flap that is pushed below closed: the rims of its sides, its base.

use super::problem::BoxProblem;
use super::settings::PlanningSettings;
use crate::collision::{clear_by, OrientedBox, Solid};
use crate::geometry::Vec3;

/// Would a flap that is pushed below closed come to lie on other sides than its own? Their edges end half a board short of where they
/// are told, as what is folded there turns about the middle of its board.
pub fn stopped_by_rims(problem: &BoxProblem, flap: usize, hold_rad: f64, settings: &PlanningSettings) -> bool {
    let own = &problem.flaps[flap].side;
    stopped_by(problem, flap, hold_rad, settings, |name| name.starts_with("side_") && name != own)
}

/// The same of the box's base besides, which stops what falls into a flat box.
pub fn stopped_by_box(problem: &BoxProblem, flap: usize, hold_rad: f64, settings: &PlanningSettings) -> bool {
    let base = || stopped_by(problem, flap, hold_rad, settings, |name| name == "base");
    stopped_by_rims(problem, flap, hold_rad, settings) || base()
}

fn stopped_by(
    problem: &BoxProblem,
    flap: usize,
    hold_rad: f64,
    settings: &PlanningSettings,
    counts: impl Fn(&str) -> bool,
) -> bool {
    let moving = &problem.flaps[flap];
    let Some(board) = OrientedBox::of_panel(&moving.corners(hold_rad), problem.thickness_m) else { return false };
    let sides = problem.fixed.iter().filter(|side| counts(&side.name));
    sides.filter_map(|side| OrientedBox::of_panel(&side.corners, problem.thickness_m)).any(|mut side| {
        let half_m = Vec3::new(1.0, 1.0, 0.0) * (problem.thickness_m / 2.0);
        side.half_m = (side.half_m - half_m).sup(&Vec3::repeat(problem.thickness_m / 4.0));
        !clear_by(&Solid::Box(board), &Solid::Box(side), settings.rim_gap_m)
    })
}

#[cfg(test)]
mod tests {
    use super::super::sample_box::carton as carton_of;
    use super::*;

    #[test]
    fn rims_stop_flaps_that_are_wider_than_the_opening() {
        let settings = PlanningSettings::default();
        let counted = [(0.0, true), (0.001, true), (0.004, false)].map(|(narrower_m, stops)| {
            let carton = carton_of(narrower_m, [0.1; 4]);
            for flap in 0..4 {
                assert_eq!(stopped_by_rims(&carton, flap, -0.15, &settings), stops, "{narrower_m} {flap}");
            }
            // One that reaches the side across from it lies on that.
            assert!(stopped_by_rims(&carton_of(narrower_m, [0.3; 4]), 0, -0.05, &settings));
        });
        assert_eq!(counted.len(), 3);
    }
}
