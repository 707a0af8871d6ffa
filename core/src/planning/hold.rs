//! How far a flap is pushed, and where it rests then.

use super::boards::{are_opposite, met, overlap_closed, propped_rad, Descent};
use super::closing::Closer;
use super::flap::Standing;
use super::guard::{Guard, Moment};
use super::push::PushMotion;
use super::reason::Obstacle;
use super::rims::{stopped_by_box, stopped_by_rims};

/// How far a flap that sprang up is pressed down again, between where it was held, where it lies on boards itself, and where its crease
/// alone would let it go: chosen by what stacks of flaps do in physics.
const PRESSED_SHARE: f64 = 0.8;
/// Boards that cross at an edge crush it: what is left of their thickness there, as physics has it (docs/physics.md).
const CRUSHED_M: f64 = 0.002;

/// A flap that is pressed onto a stack to come to rest closed is aimed this far within that, as stacks rest a little higher than told,
/// and goes down by so much more for it at the most: half of what its crease gives back, within these. Where a crease gives back little,
/// a flap far from closed lies on much, and would be pressed hard.
const HOME_RAD: f64 = 0.0175;
const MOST_PRESSED_RAD: [f64; 2] = [0.0611, 0.108];

impl<G: Guard> Closer<'_, G> {
    /// How far a flap is pushed: less where it comes to lie on others or carries a tuck.
    pub fn hold_rad(&self, flap: usize, moment: &Moment) -> f64 {
        let settings = self.settings;
        let below = self.lies_on(flap, moment);
        if let Some((propped_rad, is_hard)) = self.propped_rad(flap, &below, moment) {
            let hold_rad = propped_rad.max(settings.short_on_stacks_rad);
            return if is_hard { hold_rad } else { self.pressed_home_rad(flap, hold_rad) };
        }
        if !below.is_empty() || !self.problem.flaps[flap].tucks.is_empty() {
            return settings.short_on_others_rad;
        }
        let fold = &self.load.folds[flap];
        let beyond_rad = fold.return_rad - settings.rest_aim_rad;
        // One whose weight keeps it down is not pushed so far that it comes to rest in the box.
        let hold_rad = (-beyond_rad.clamp(0.0, settings.most_overclose_rad)).max(fold.held_rad(0.0).min(0.0));
        if stopped_by_rims(self.problem, flap, hold_rad, settings) {
            return settings.short_on_rims_rad;
        }
        // Not onto the base of a flat box.
        let steps = ((settings.short_on_rims_rad - hold_rad) / settings.sample_rad).ceil().max(0.0) as usize;
        let mut holds = (0..steps).map(|step| hold_rad + step as f64 * settings.sample_rad);
        holds.find(|&rad| !stopped_by_box(self.problem, flap, rad, settings)).unwrap_or(settings.short_on_rims_rad)
    }

    /// Of a push that ends on a stack that still gives way: a little further down where the flap comes to rest closed for it. Beyond
    /// closed it counts as closed only where it still touches what it was pressed onto, which springs up less than it does.
    fn pressed_home_rad(&self, flap: usize, hold_rad: f64) -> f64 {
        let (settings, fold) = (self.settings, &self.load.folds[flap]);
        let home_rad = fold.held_rad(settings.closed_rad - HOME_RAD);
        let most_rad = (fold.return_rad / 2.0).clamp(MOST_PRESSED_RAD[0], MOST_PRESSED_RAD[1]);
        let is_near = fold.rest_rad(hold_rad) > settings.closed_rad && hold_rad - home_rad <= most_rad;
        if is_near {
            hold_rad.min(home_rad)
        } else {
            hold_rad
        }
    }

    /// The closed flaps that a flap comes to lie on.
    fn lies_on(&self, flap: usize, moment: &Moment) -> Vec<usize> {
        let flaps = &self.problem.flaps;
        let is_below = |k: &usize| {
            *k != flap
                && flaps[*k].standing != Standing::Absent
                && moment.angles_rad[*k].abs() <= self.settings.lying_rad
                && overlap_closed(&flaps[flap], &flaps[*k])
        };
        (0..flaps.len()).filter(is_below).collect()
    }

    /// Would a flap that is let go fall into the box, being heavier than its crease bears, while nothing lies below it? What hangs on
    /// it holds it on the side across; one that stands in the way of others may fall.
    pub fn falls_in(&self, flap: usize, moment: &Moment) -> bool {
        let closed_rad = self.settings.closed_rad;
        self.load.folds[flap].closing_n_m(closed_rad) < 0.0
            && self.problem.flaps[flap].tucks.is_empty()
            && !stopped_by_box(self.problem, flap, -closed_rad, self.settings)
            && self.lies_on(flap, moment).is_empty()
            && !self.is_in_the_way(flap, moment)
    }

    /// Does another flap that stands open meet this one on its way?
    fn is_in_the_way(&self, flap: usize, moment: &Moment) -> bool {
        let flaps = &self.problem.flaps;
        let is_met = |k: usize| match met(self.problem, &moment.angles_rad, k, 0.0, Descent::Steep, self.settings) {
            Some(Obstacle::Boards { other, .. }) => flaps[flap].is_own(&other),
            _ => false,
        };
        (0..flaps.len()).any(|k| k != flap && moment.angles_rad[k] > self.settings.lying_rad && is_met(k))
    }

    /// Where a flap comes to lie on those of `below` that overlap the one across from them, or itself: boards on boards, which give
    /// way no further, and whether what stops it lies on the rims itself. None where there are none.
    fn propped_rad(&self, flap: usize, below: &[usize], moment: &Moment) -> Option<(f64, bool)> {
        let flaps = &self.problem.flaps;
        let lies_over = |a: usize, b: usize| are_opposite(&flaps[a], &flaps[b]) && overlap_closed(&flaps[a], &flaps[b]);
        let stacked = |k: usize| lies_over(flap, k) || below.iter().any(|&other| lies_over(k, other));
        let props = below.iter().copied().filter(|&k| stacked(k)).map(|k| {
            let over_m = self.crossing_m(flap, k);
            let soft_rad = propped_rad(&flaps[flap], &flaps[k], self.pressed_rad(k, moment), over_m, false);
            let hard_rad = self.lowest_rad(k, below, moment);
            let hard_rad = hard_rad.map(|at_rad| propped_rad(&flaps[flap], &flaps[k], at_rad, over_m, true));
            hard_rad.filter(|hard_rad| *hard_rad >= soft_rad).map_or((soft_rad, false), |hard_rad| (hard_rad, true))
        });
        props.max_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// How far a flap that lies is pressed down by what comes down near its hinge.
    fn pressed_rad(&self, flap: usize, moment: &Moment) -> f64 {
        let (fold, rest_rad) = (&self.load.folds[flap], moment.angles_rad[flap]);
        let (held_rad, free_rad) = (fold.held_rad(rest_rad).max(0.0), (rest_rad - fold.return_rad).max(0.0));
        held_rad + (free_rad - held_rad) * PRESSED_SHARE
    }

    /// Lower than this nothing presses a flap that lies on the one across from it, where that lies on the rims: boards on boards give
    /// way no further. Of two the upper is the one that was held higher. None where nothing stops it.
    fn lowest_rad(&self, flap: usize, below: &[usize], moment: &Moment) -> Option<f64> {
        let flaps = &self.problem.flaps;
        let held_rad = |k: usize| self.load.folds[k].held_rad(moment.angles_rad[k]);
        let is_under = |&k: &usize| {
            are_opposite(&flaps[flap], &flaps[k])
                && overlap_closed(&flaps[flap], &flaps[k])
                && held_rad(k) < held_rad(flap)
                && stopped_by_rims(self.problem, k, -self.settings.rest_aim_rad, self.settings)
        };
        let across = below.iter().copied().find(is_under);
        across.map(|k| propped_rad(&flaps[flap], &flaps[k], 0.0, self.crossing_m(flap, k), true))
    }

    /// How far above the middle of one flap that of another comes to lie that crosses its edge; neighbours lie flush.
    fn crossing_m(&self, upper: usize, lower: usize) -> f64 {
        let flaps = &self.problem.flaps;
        if are_opposite(&flaps[upper], &flaps[lower]) {
            CRUSHED_M.min(self.problem.thickness_m)
        } else {
            0.0
        }
    }

    /// Where a flap rests after a push: closed or not, it lies.
    pub fn rest_rad(&self, flap: usize, push: &PushMotion) -> f64 {
        let hold_rad = push.hinge_rad[push.hinge_rad.len() - 1];
        self.load.folds[flap].rest_rad(hold_rad).min(self.settings.lying_rad)
    }
}
