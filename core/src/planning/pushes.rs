//! One flap's closing while the others stand as they do: a push, or what turns it first and then a push.

use std::ops::Range;

use super::boards::{met, Descent};
use super::closing::Closer;
use super::contact::Contacts;
use super::effort::{Effort, USUAL};
use super::guard::{Guard, Moment};
use super::known::{Force, Tried};
use super::orientations::OrientationGrid;
use super::planes::PlanesSearch;
use super::push::{closed_finger, layers_between, PushMotion, Pusher};
use super::reason::{Obstacle, Status, WhyNot};
use super::request::Method;
use super::settings::PlanningSettings;

/// A push that ends before this does not end for want of room beyond closed.
const LATE_RAD: f64 = 0.8;

impl<G: Guard> Closer<'_, G> {
    /// One flap's push while the others stand as they do, with as much effort as it takes up to this one.
    ///
    /// # Errors
    /// The status and the reason why there is none.
    pub fn push(&self, flap: usize, moment: &Moment, effort: Effort, descent: Descent) -> Tried {
        if let Some(obstacle) = self.meets(flap, moment, descent).filter(|_| self.method == Method::Layered) {
            let is_steep = self.meets(flap, moment, Descent::Steep).is_none();
            return Err(WhyNot { is_steep, ..WhyNot::by_boards(&obstacle) });
        }
        let mut tried = Err(WhyNot::not_searched());
        for effort in effort.up_to() {
            let plan = || self.push_anew(flap, moment, effort);
            let again = self.margins.push(flap, moment, Force::Careful(effort), plan);
            tried = match (tried, again) {
                // An effort that the settings leave no search tells nothing that the one before did not.
                (Err(why), Err(none)) if none.status == Status::OutOfTime => {
                    Err(WhyNot { by_flaps: why.by_flaps || none.by_flaps, ..why })
                }
                (_, again) => again,
            };
            if tried.as_ref().map_or_else(|why| !why.searched, |_| true) {
                break;
            }
        }
        tried
    }

    fn push_anew(&self, flap: usize, moment: &Moment, effort: Effort) -> Tried {
        if self.method == Method::Paper {
            return self.paper_push(flap, moment);
        }
        let hold_rad = self.hold_rad(flap, moment);
        if let Some(obstacle) = self.kept_open(flap, moment, hold_rad) {
            return Err(WhyNot::by_boards(&obstacle));
        }
        if let Some(obstacle) = self.meets_base(flap, moment, hold_rad) {
            return Err(WhyNot { by_flaps: false, ..WhyNot::by_boards(&obstacle) });
        }
        if effort == Effort::Quick {
            if let Some(push) = self.let_down(flap, moment, hold_rad) {
                return Ok(push);
            }
        }
        let strain = self.load.worst_strain(self.problem, flap);
        // A box that a push nearly moves is moved by many: rather by a couple.
        let is_safe = strain <= self.settings.fork.least_strain;
        if effort == Effort::Deep && strain > self.settings.most_strain.max(1.0) {
            return Err(WhyNot::moving());
        }
        if is_safe || effort == Effort::Deep {
            let pushed = self.careful_push(flap, moment, hold_rad, effort.searches());
            if effort != Effort::Thorough {
                return pushed;
            }
            let pushed = pushed.or_else(|why| self.fork_and_push(flap, moment, hold_rad, why));
            return pushed.or_else(|why| self.in_two_pushes(flap, moment, hold_rad, why));
        }
        if effort == Effort::Quick {
            return Err(WhyNot::moving());
        }
        match self.fork_and_push(flap, moment, hold_rad, WhyNot::moving()) {
            Err(_) if strain <= self.settings.most_strain.max(1.0) => self.careful_push(flap, moment, hold_rad, USUAL),
            tried => tried,
        }
    }

    /// A push with a reserve to what moves the box.
    pub fn careful_push(&self, flap: usize, moment: &Moment, hold_rad: f64, searches: Range<usize>) -> Tried {
        let most_strain = self.settings.most_strain;
        let pushed = |to_rad: f64| self.pusher(flap, moment, to_rad, most_strain, searches.clone()).plan();
        let short_rad = self.settings.short_on_others_rad;
        match pushed(hold_rad) {
            // A second way to end it is not looked for where the widest search found none.
            Err(why) if searches == Effort::Deep.searches() => Err(why),
            // Arms that cannot follow the flap beyond closed may still lay it down.
            Err(why) if hold_rad < 0.0 && why.at_rad.is_none_or(|at_rad| at_rad <= LATE_RAD) && !why.at_start => {
                pushed(short_rad).or_else(|_| self.laid_short(flap, &why, &pushed)).map_err(|_| why)
            }
            Err(why) => self.laid_short(flap, &why, &pushed).map_err(|_| why),
            tried => tried,
        }
    }

    /// Of a push that ends just before closed (no room over flaps that lie there): let go where the crease still lets it rest closed.
    fn laid_short(&self, flap: usize, why: &WhyNot, pushed: &impl Fn(f64) -> Tried) -> Tried {
        let settings = self.settings;
        let lay_rad = self.load.folds[flap].held_rad(settings.closed_rad - settings.rest_aim_rad);
        let ends_late = why.at_rad.is_some_and(|at_rad| at_rad <= lay_rad + settings.layer_rad);
        if !ends_late || lay_rad < settings.least_lay_rad {
            return Err(why.clone());
        }
        pushed(lay_rad)
    }

    /// Turned in stages until a push can go on: where a push from the start moves the box, or has no room.
    fn fork_and_push(&self, flap: usize, moment: &Moment, hold_rad: f64, why: WhyNot) -> Tried {
        let is_down = moment.angles_rad[flap] <= self.settings.fork.far_enough_rad;
        if !self.problem.flaps[flap].tucks.is_empty() || is_down {
            return Err(why);
        }
        // Other flaps may stand better for it, before or after.
        let first = self.turned_down(flap, moment, why.by_flaps).ok_or(WhyNot { by_flaps: true, ..why })?;
        let rest_rad = first.last().map_or(moment.angles_rad[flap], |(_, rest_rad)| *rest_rad);
        let turned = moment.left(flap, rest_rad);
        let push = self.careful_push(flap, &turned, hold_rad, USUAL);
        let push = push.or_else(|why| match why.moves_box {
            true => self.pusher(flap, &turned, hold_rad, f64::INFINITY, USUAL).plan(),
            // Nothing was left out for its load where the way ended: more force leads no further.
            false => Err(why),
        })?;
        Ok(PushMotion { first: first.into_iter().map(|(motion, _)| motion).collect(), ..push })
    }

    /// The same without a reserve of force; a flap that stands low closes even if the box slides a little. None where there is none.
    pub fn push_home(&self, flap: usize, moment: &Moment) -> Option<PushMotion> {
        let hold_rad = self.hold_rad(flap, moment);
        let is_low = moment.angles_rad[flap] <= self.settings.slides_home_rad;
        let is_kept = || self.meets(flap, moment, Descent::Steep).or_else(|| self.kept_open(flap, moment, hold_rad));
        if is_kept().is_some() || !(is_low || self.load.is_bearable(self.problem, flap)) {
            return None;
        }
        let most_strain = if is_low { f64::INFINITY } else { 1.0 };
        let plan = || self.pusher(flap, moment, hold_rad, most_strain, USUAL).plan();
        self.margins.push(flap, moment, Force::Home, plan).ok()
    }

    /// The board that a flap meets on its way, whatever the arm does.
    fn meets(&self, flap: usize, moment: &Moment, descent: Descent) -> Option<Obstacle> {
        let to_rad = self.hold_rad(flap, moment).max(0.0);
        met(self.problem, &moment.angles_rad, flap, to_rad, descent, self.settings)
    }

    /// What keeps a flap from resting closed, whatever the arm does.
    fn kept_open(&self, flap: usize, moment: &Moment, hold_rad: f64) -> Option<Obstacle> {
        if self.falls_in(flap, moment) {
            return Some(Obstacle::Falls { flap: self.problem.flaps[flap].name.clone() });
        }
        let (settings, rest_rad) = (self.settings, self.load.folds[flap].rest_rad(hold_rad));
        let is_propped = hold_rad > settings.most_propped_rad || rest_rad > settings.most_propped_rest_rad;
        is_propped.then(|| Obstacle::Propped { flap: self.problem.flaps[flap].name.clone() })
    }

    /// The arm's own base, where it stands in a flap's way.
    fn meets_base(&self, flap: usize, moment: &Moment, hold_rad: f64) -> Option<Obstacle> {
        let angles_rad = layers_between(moment.angles_rad[flap], hold_rad, self.settings.layer_rad / 2.0);
        angles_rad.into_iter().find_map(|at_rad| self.guard.base_conflict(&moment.pushing(flap, at_rad)))
    }

    /// A flap's settings, as wide as its margins are by now.
    pub fn settings_of(&self, flap: usize) -> &PlanningSettings {
        self.margins.settings_of(flap).unwrap_or(self.settings)
    }

    pub fn pusher(
        &self,
        flap: usize,
        moment: &Moment,
        hold_rad: f64,
        most_strain: f64,
        searches: Range<usize>,
    ) -> Pusher<'_, G> {
        let settings = self.settings_of(flap);
        let half_board_m = self.problem.thickness_m / 2.0;
        Pusher {
            arm: self.arm,
            guard: self.guard,
            settings,
            contacts: Contacts::new(
                &self.problem.flaps[flap],
                closed_finger(self.arm),
                half_board_m,
                settings,
                (self.load.folds[flap], self.load.stand.as_ref()),
                OrientationGrid::coarse(),
            ),
            searches,
            most_strain,
            flap,
            moment: moment.clone(),
            hold_rad,
            rest_rad: self.load.folds[flap].rest_rad(hold_rad).min(self.settings.lying_rad),
        }
    }

    /// The paper's push, to closed and no further.
    fn paper_push(&self, flap: usize, moment: &Moment) -> Tried {
        let pusher = self.pusher(flap, moment, 0.0, f64::INFINITY, USUAL);
        PlanesSearch { pusher: &pusher, settings: self.settings_of(flap) }.plan()
    }
}
