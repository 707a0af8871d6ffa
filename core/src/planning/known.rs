//! Pushes that were planned before: a plan that is made again with a wider margin for one flap needs only that flap's anew.

use std::cell::RefCell;
use std::collections::HashMap;
use std::time::Instant;

use super::effort::Effort;
use super::guard::Moment;
use super::push::PushMotion;
use super::reason::WhyNot;
use super::settings::PlanningSettings;

pub type Tried = Result<PushMotion, WhyNot>;

/// How hard a flap is pushed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Force {
    /// With a reserve to what moves the box, searched for with this effort.
    Careful(Effort),
    /// Without.
    Home,
}

/// The flap, how often its margins were widened, where all flaps stood (bits of the angles), and how hard.
type Key = (usize, usize, Vec<u64>, Force);

/// What was tried of one box before one arm.
#[derive(Debug, Default)]
pub struct Known {
    tried: RefCell<HashMap<Key, Tried>>,
    /// Spent on each flap's pushes, by flap.
    seconds: RefCell<HashMap<usize, f64>>,
}

impl Known {
    /// What became of a push, which is planned where it is not known.
    pub fn push(
        &self,
        flap: usize,
        widened: usize,
        moment: &Moment,
        force: Force,
        plan: impl FnOnce() -> Tried,
    ) -> Tried {
        let angles = moment.angles_rad.iter().map(|angle_rad| angle_rad.to_bits()).collect();
        let key = (flap, widened, angles, force);
        if let Some(known) = self.tried.borrow().get(&key) {
            return known.clone();
        }
        let started = Instant::now();
        let tried = plan();
        *self.seconds.borrow_mut().entry(flap).or_default() += started.elapsed().as_secs_f64();
        self.tried.borrow_mut().insert(key, tried.clone());
        tried
    }

    pub fn seconds(&self, flap: usize) -> f64 {
        self.seconds.borrow().get(&flap).copied().unwrap_or(0.0)
    }
}

/// How often a flap is planned again with wider margins, where its motion came too near to something between two postures, before
/// it is left open.
const WIDER: i32 = 2;

/// How wide each flap's margins are by now, and what was tried so far.
#[derive(Debug)]
pub struct Margins {
    /// The settings of flaps whose margins were widened, once, twice, and so on; and how often each was, in the problem's order.
    wider: Vec<PlanningSettings>,
    widened: Vec<usize>,
    pub known: Known,
}

impl Margins {
    /// Of so many flaps, none of them widened yet.
    pub fn new(settings: &PlanningSettings, flaps: usize) -> Self {
        Self {
            wider: (1..=WIDER).map(|times| widened(settings, f64::from(times))).collect(),
            widened: vec![0; flaps],
            known: Known::default(),
        }
    }

    /// Its settings; None where its margins are the usual ones.
    pub fn settings_of(&self, flap: usize) -> Option<&PlanningSettings> {
        self.widened[flap].checked_sub(1).map(|times| &self.wider[times])
    }

    /// Once more for this flap; false where it was widened often enough.
    pub fn widen(&mut self, flap: usize) -> bool {
        let more = self.widened[flap] < self.wider.len();
        self.widened[flap] += usize::from(more);
        more
    }

    /// As [`Known::push`], with the flap's margins.
    pub fn push(&self, flap: usize, moment: &Moment, force: Force, plan: impl FnOnce() -> Tried) -> Tried {
        self.known.push(flap, self.widened[flap], moment, force, plan)
    }
}

/// Settings with wider margins for what lies between postures, and postures closer together where the finger touches.
fn widened(settings: &PlanningSettings, times: f64) -> PlanningSettings {
    PlanningSettings {
        search_margin_m: settings.search_margin_m + settings.wider_m * times,
        sample_rad: settings.sample_rad / (times + 1.0),
        touch_gap_m: settings.touch_gap_m * (times + 1.0),
        ..settings.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::super::reason::Obstacle;
    use super::*;

    #[test]
    fn a_push_is_planned_once_for_its_flap_margins_angles_and_force() {
        let known = Known::default();
        let planned = std::cell::Cell::new(0);
        let ask = |flap: usize, widened: usize, angle_rad: f64, force: Force| {
            let tried = known.push(flap, widened, &Moment::resting(&[angle_rad]), force, || {
                planned.set(planned.get() + 1);
                Err(WhyNot::by_boards(&Obstacle::Something))
            });
            assert!(tried.is_err());
        };
        let asked = [
            (0, 0, 1.0, Force::Careful(Effort::Quick)),
            (1, 0, 1.0, Force::Careful(Effort::Quick)),
            (0, 1, 1.0, Force::Careful(Effort::Quick)),
            (0, 0, 1.5, Force::Careful(Effort::Quick)),
            (0, 0, 1.0, Force::Careful(Effort::Deep)),
        ];
        for (flap, widened, angle_rad, force) in asked.into_iter().chain([(0, 0, 1.0, Force::Home)]) {
            ask(flap, widened, angle_rad, force);
            ask(flap, widened, angle_rad, force);
        }
        assert_eq!(planned.get(), 6);
        assert!(known.seconds(0) > 0.0 && known.seconds(2) == 0.0);
    }
}
