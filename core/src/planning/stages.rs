//! Turns a flap down in stages, each from where the one before leaves it: with the fingers astride it, pushed part of the way.

use std::cell::Cell;

use super::closing::Closer;
use super::effort::{FIRST, USUAL};
use super::fork::Fork;
use super::guard::{Guard, Moment};
use super::known::Tried;
use super::push::{layers_between, PushMotion, Pusher};
use super::reason::WhyNot;
use super::settings::{ForkSettings, PlanningSettings};

/// A motion, and where the flap rests after it, rad.
pub type Stage = (PushMotion, f64);

impl<G: Guard> Closer<'_, G> {
    /// Stages that leave a flap where a push can go on; None where none are found. Of a flap that others keep open, `by_flaps`, one
    /// alone is looked for: it may be easier once they have moved.
    pub fn turned_down(&self, flap: usize, moment: &Moment, by_flaps: bool) -> Option<Vec<Stage>> {
        self.in_stages(flap, moment, if by_flaps { 1 } else { self.settings.fork.most_stages })
    }

    /// A push as far as the way from the start leads, and another, from elsewhere, from where the flap springs back to.
    ///
    /// # Errors
    /// The reason why one push alone does not do.
    pub fn in_two_pushes(&self, flap: usize, moment: &Moment, hold_rad: f64, why: WhyNot) -> Tried {
        let settings = self.settings;
        let Some(stuck_rad) = why.at_rad.filter(|_| settings.fork.most_stages > 1) else { return Err(why) };
        let start_rad = moment.angles_rad[flap];
        let ends = (0..).map(|part| stuck_rad + settings.layer_rad + f64::from(part) * settings.fork.least_part_rad);
        let ends = ends.take_while(|&to_rad| to_rad <= start_rad - settings.fork.least_part_rad / 2.0);
        let bears = |to_rad: &f64| self.load.strain_at(self.problem, flap, *to_rad) <= settings.most_strain;
        let mut reached_rad = f64::NEG_INFINITY;
        for to_rad in ends.filter(bears) {
            // What the search for another end did not come to, this one will not come to either.
            if to_rad < reached_rad - settings.layer_rad {
                continue;
            }
            let (motion, rest_rad) = match self.pushed_to(flap, moment, to_rad) {
                Ok(stage) => stage,
                Err(short) if short.at_start => break,
                Err(short) => {
                    reached_rad = short.at_rad.unwrap_or(reached_rad);
                    continue;
                }
            };
            let turned = moment.left(flap, rest_rad);
            // It does not come to rest exactly there: a finger that comes along the board would catch on it.
            let lifted = PlanningSettings { slide_off_m: 0.0, ..self.settings_of(flap).clone() };
            let pusher = self.pusher(flap, &turned, hold_rad, settings.most_strain, USUAL);
            let home = Pusher { settings: &lifted, ..pusher }.plan();
            return home.map(|push| PushMotion { first: vec![motion], ..push }).map_err(|_| why);
        }
        Err(why)
    }

    fn in_stages(&self, flap: usize, moment: &Moment, most: usize) -> Option<Vec<Stage>> {
        let fork = &self.settings.fork;
        let start_rad = moment.angles_rad[flap];
        if start_rad <= fork.far_enough_rad {
            return Some(Vec::new());
        }
        let whole = self.forked(flap, moment, fork.far_enough_rad);
        if whole.is_some() || most < 2 {
            return whole.map(|stage| vec![stage]);
        }
        let in_part = || self.forked(flap, moment, start_rad - fork.least_part_rad);
        let pushed = self.parts_rad(flap, start_rad);
        let stages = std::iter::once_with(in_part)
            .chain(pushed.into_iter().map(|to_rad| self.pushed_to(flap, moment, to_rad).ok()));
        stages.flatten().find_map(|stage| {
            let turned = moment.left(flap, stage.1);
            let mut rest = self.in_stages(flap, &turned, most - 1)?;
            rest.insert(0, stage);
            Some(rest)
        })
    }

    /// A flap that would fall hard by itself, let down between the fingers and then pushed home. None where it does not fall so, or
    /// where there is no way.
    pub fn let_down(&self, flap: usize, moment: &Moment, hold_rad: f64) -> Option<PushMotion> {
        let (settings, length_m) = (self.settings_of(flap), self.problem.flaps[flap].length_m());
        let (fork, start_rad) = (&settings.fork, moment.angles_rad[flap]);
        let fall_m_per_s = |from_rad: f64| self.load.folds[flap].fall_m_per_s(length_m, from_rad);
        if fall_m_per_s(start_rad) <= fork.most_fall_m_per_s {
            return None;
        }
        let slower_m_per_s = fall_m_per_s(start_rad) * fork.slower_fall;
        let angles = layers_between(start_rad, fork.let_down_rad, settings.sample_rad);
        let until_rad = angles.into_iter().find(|&angle_rad| fall_m_per_s(angle_rad) <= slower_m_per_s)?;
        let fork = ForkSettings { wanted_rad: fork.let_down_rad, ..fork.clone() };
        let settings = PlanningSettings { fork, ..settings.clone() };
        let (first, rest_rad) = self.forked_by(flap, moment, until_rad, &settings)?;
        let push = self.careful_push(flap, &moment.left(flap, rest_rad), hold_rad, USUAL).ok()?;
        Some(PushMotion { first: vec![first], ..push })
    }

    /// With the fingers astride it, at the least to an angle.
    fn forked(&self, flap: usize, moment: &Moment, until_rad: f64) -> Option<Stage> {
        self.forked_by(flap, moment, until_rad, self.settings_of(flap))
    }

    fn forked_by(&self, flap: usize, moment: &Moment, until_rad: f64, settings: &PlanningSettings) -> Option<Stage> {
        let (arm, guard, thickness_m) = (self.arm, self.guard, self.problem.thickness_m);
        let fork = Fork {
            arm,
            guard,
            settings,
            flap: &self.problem.flaps[flap],
            number: flap,
            thickness_m,
            fold: self.load.folds[flap],
            stand: self.load.stand.as_ref(),
            before: moment,
            until_rad,
            caught: Cell::new(0),
        };
        fork.plan()
    }

    /// Where a push may end part of the way: as long as statics bear it, the furthest first.
    fn parts_rad(&self, flap: usize, start_rad: f64) -> Vec<f64> {
        let fork = &self.settings.fork;
        let ends = (1..).map(|part| start_rad - f64::from(part) * fork.least_part_rad);
        let ends = ends.take_while(|&to_rad| to_rad > fork.far_enough_rad);
        let borne =
            ends.take_while(|&to_rad| self.load.strain_at(self.problem, flap, to_rad) <= self.settings.most_strain);
        let mut found: Vec<f64> = borne.collect();
        found.reverse();
        found
    }

    /// Pushed to an angle with a reserve to what moves the box; one search alone.
    fn pushed_to(&self, flap: usize, moment: &Moment, to_rad: f64) -> Result<Stage, WhyNot> {
        let pusher = self.pusher(flap, moment, to_rad, self.settings.most_strain, FIRST);
        let rest_rad = self.load.folds[flap].rest_rad(to_rad);
        let motion = Pusher { rest_rad, ..pusher }.plan()?;
        Ok((motion, rest_rad))
    }
}
