//! How far a flap is pushed, and where it rests then.

use super::boards::{are_opposite, overlap_closed, propped_rad, stopped_by_rims};
use super::closing::Closer;
use super::flap::Standing;
use super::guard::{Guard, Moment};
use super::push::PushMotion;

/// How far a flap that sprang up is pressed down again, between where it was held, where it lies on boards itself, and where its crease
/// alone would let it go: chosen by what stacks of flaps do in physics.
const PRESSED_SHARE: f64 = 0.8;
/// Boards that cross at an edge crush it: what is left of their thickness there.
const CRUSHED_SHARE: f64 = 0.4;

impl<G: Guard> Closer<'_, G> {
    /// How far a flap is pushed: less where it comes to lie on others or carries a tuck.
    pub fn hold_rad(&self, flap: usize, moment: &Moment) -> f64 {
        let settings = self.settings;
        let flaps = &self.problem.flaps;
        let is_below = |k: &usize| {
            *k != flap
                && flaps[*k].standing != Standing::Absent
                && moment.angles_rad[*k].abs() <= settings.lying_rad
                && overlap_closed(&flaps[flap], &flaps[*k])
        };
        let below: Vec<usize> = (0..flaps.len()).filter(is_below).collect();
        if let Some(propped_rad) = self.propped_rad(flap, &below, moment) {
            return propped_rad.max(settings.short_on_stacks_rad);
        }
        if !below.is_empty() || !flaps[flap].tucks.is_empty() {
            return settings.short_on_others_rad;
        }
        let beyond_rad = self.load.folds[flap].return_rad - settings.rest_aim_rad;
        let hold_rad = -beyond_rad.clamp(0.0, settings.most_overclose_rad);
        if stopped_by_rims(self.problem, flap, hold_rad, settings) {
            settings.short_on_rims_rad
        } else {
            hold_rad
        }
    }

    /// Where a flap comes to lie on those of `below` that overlap the one across from them, or itself: boards on boards, which give
    /// way no further. None where there are none.
    fn propped_rad(&self, flap: usize, below: &[usize], moment: &Moment) -> Option<f64> {
        let flaps = &self.problem.flaps;
        let lies_over = |a: usize, b: usize| are_opposite(&flaps[a], &flaps[b]) && overlap_closed(&flaps[a], &flaps[b]);
        let stacked = |k: usize| lies_over(flap, k) || below.iter().any(|&other| lies_over(k, other));
        let props = below.iter().copied().filter(|&k| stacked(k)).map(|k| {
            let (fold, rest_rad) = (&self.load.folds[k], moment.angles_rad[k]);
            let (held_rad, free_rad) = (fold.held_rad(rest_rad).max(0.0), (rest_rad - fold.return_rad).max(0.0));
            let pressed_rad = held_rad + (free_rad - held_rad) * PRESSED_SHARE;
            let board_m = if are_opposite(&flaps[flap], &flaps[k]) { self.problem.thickness_m } else { 0.0 };
            let over_m = CRUSHED_SHARE * board_m;
            propped_rad(&flaps[flap], &flaps[k], pressed_rad, over_m)
        });
        props.max_by(f64::total_cmp)
    }

    /// Where a flap rests after a push: closed or not, it lies.
    pub fn rest_rad(&self, flap: usize, push: &PushMotion) -> f64 {
        let hold_rad = push.hinge_rad[push.hinge_rad.len() - 1];
        self.load.folds[flap].rest_rad(hold_rad).min(self.settings.lying_rad)
    }
}
