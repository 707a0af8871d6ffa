//! The searches for one flap's push: from where it stands, and from its end.

use std::cell::Cell;

use super::beam::State;
use super::contact::{Contacts, Grip};
use super::guard::{Guard, Moment};
use super::layers::{Found, Layers};
use super::line::Lines;
use super::push::{PushMotion, Pusher};
use super::reason::{Tally, WhyNot, CAUGHT};
use super::settings::PlanningSettings;
use super::transit::Transit;
use crate::arm::{Arm, JointPositions};

/// One flap's searches, and where the flaps are before, during and after them.
pub struct Search<'a, 'b, G: Guard> {
    pub pusher: &'a Pusher<'b, G>,
    pub lines: Lines<'a, G>,
    pub before: Moment,
    pub touching: Moment,
    pub held: Moment,
    pub after: Moment,
    pub pressed: Moment,
    pub angles_rad: Vec<f64>,
    pub moments: Vec<Moment>,
    /// Motions so far after which the arm was caught.
    pub caught: Cell<usize>,
}

impl<G: Guard> Search<'_, '_, G> {
    /// From where the flap stands, and where that ends on the way, from its end: some ways narrow towards it.
    /// Where `alike_once`, of first postures that differ by whole turns of joints alone, or by half a turn of the gripper, one is looked at.
    pub fn run(&self, beam: usize, contacts: &Contacts<'_>, alike_once: bool) -> Result<PushMotion, WhyNot> {
        let pusher = self.pusher;
        let layers = Layers {
            arm: pusher.arm,
            guard: pusher.guard,
            contacts,
            settings: pusher.settings,
            most_strain: pusher.most_strain,
            alike_once,
            flap: pusher.flap,
            moment: &self.pressed,
            angles_rad: &self.angles_rad,
            moments: &self.moments,
        };
        let (start, end) = (contacts.flap.frame(self.angles_rad[0]), contacts.flap.frame(pusher.hold_rad));
        let mut comes = |from: &JointPositions, grip: &Grip| {
            self.lines.leave(from, grip, &start, &self.touching, &self.before).err()
        };
        let mut leaves =
            |from: &JointPositions, grip: &Grip| self.lines.leave(from, grip, &end, &self.held, &self.after).err();
        let found = layers.search(beam, &mut comes, &mut leaves);
        let stuck = match self.followed(&layers, found) {
            Ok(motion) => return Ok(motion),
            Err(stuck) => stuck,
        };
        let (layer, tally) = stuck;
        if layer > 0 && !self.is_caught() {
            let (back_rad, back_moments) = (reversed(&self.angles_rad), reversed(&self.moments));
            let back = Layers { angles_rad: &back_rad, moments: &back_moments, ..layers };
            let found = back.search(beam, &mut leaves, &mut comes).reversed();
            if let Ok(motion) = self.followed(&layers, found) {
                return Ok(motion);
            }
        }
        Err(pusher.why_stuck(self.angles_rad[layer], layer == 0, &tally))
    }

    fn comes_and_goes(&self, motion: &PushMotion) -> bool {
        let Pusher { arm, guard, settings, .. } = self.pusher;
        comes_and_goes(arm, *guard, settings, motion, (&self.before, &self.after))
    }

    /// Was the arm caught so often that it will be again?
    pub fn is_caught(&self) -> bool {
        self.caught.get() > MOST_CAUGHT_IN_ALL
    }

    /// The first of the paths that holds between its layers too and whose ends lie open, else the layer at which they end and what was in the way.
    fn followed(&self, layers: &Layers<'_, G>, found: Found) -> Result<PushMotion, (usize, Tally)> {
        let paths = match found {
            Found::Stuck { layer, tally } => return Err((layer, tally)),
            Found::Paths(paths) => paths,
        };
        let mut tally = Tally::default();
        self.pusher.guard.explain_anew();
        let mut caught: Vec<PushMotion> = Vec::new();
        for path in &paths {
            // Another turn of the wrist does not lead out of where the arm is caught.
            if caught.iter().any(|motion| is_alike(motion, path)) {
                continue;
            }
            let (first, last) = ((&self.touching, &self.before), (&self.held, &self.after));
            match self.pusher.dense(layers, path, &self.lines, first, last) {
                Ok(motion) if self.comes_and_goes(&motion) => return Ok(motion),
                Ok(motion) => caught.push(motion),
                Err(obstacle) => tally.add(obstacle),
            }
            if caught.len() > MOST_CAUGHT || self.caught.get() + caught.len() > MOST_CAUGHT_IN_ALL {
                break;
            }
        }
        self.caught.set(self.caught.get() + caught.len());
        if !caught.is_empty() {
            tally.add(CAUGHT);
        }
        Err((self.angles_rad.len() - 1, tally))
    }
}

/// Do a motion's ends lie open, before and after it, so that the arm finds from one to its ready pose and from there to the other?
pub fn comes_and_goes<G: Guard>(
    arm: &Arm,
    guard: &G,
    settings: &PlanningSettings,
    motion: &PushMotion,
    (before, after): (&Moment, &Moment),
) -> bool {
    let settings = PlanningSettings { transit_tries: CAUGHT_TRIES, ..settings.clone() };
    let leads = |end: Option<&JointPositions>, moment: &Moment| {
        let transit = Transit { arm, guard, settings: &settings, moment, step_rad: settings.joint_step_rad };
        end.is_some_and(|end| transit.is_connected(end, &arm.ready))
    };
    leads(motion.retreat.last(), after) && leads(motion.approach.first(), before)
}

/// How hard it is tried to get out of where a motion ends, and how many paths are given up for it, in one search and in all.
const CAUGHT_TRIES: usize = 1000;
const MOST_CAUGHT: usize = 2;
pub const MOST_CAUGHT_IN_ALL: usize = 4;

/// Does a path begin and end with the arm, but for its wrist, where a motion does?
fn is_alike(motion: &PushMotion, path: &[State]) -> bool {
    let same =
        |a: &JointPositions, b: &JointPositions| a.iter().zip(b.iter()).take(3).all(|(p, q)| (p - q).abs() < ALIKE_RAD);
    same(&motion.push[0], &path[0].positions)
        && same(&motion.push[motion.push.len() - 1], &path[path.len() - 1].positions)
}

/// Arms no joint of which is turned further than this from one to the other stand alike.
const ALIKE_RAD: f64 = 0.15;

fn reversed<T: Clone>(items: &[T]) -> Vec<T> {
    items.iter().rev().cloned().collect()
}
