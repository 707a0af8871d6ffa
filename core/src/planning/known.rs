//! Pushes that were planned before: a plan that is made again with a wider margin for one flap needs only that flap's anew.

use std::cell::RefCell;
use std::collections::HashMap;
use std::time::Instant;

use super::guard::Moment;
use super::push::PushMotion;
use super::reason::WhyNot;

pub type Tried = Result<PushMotion, WhyNot>;

/// How hard a flap is pushed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Force {
    /// With a reserve to what moves the box.
    Careful,
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
