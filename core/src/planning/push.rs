//! One flap's push: the layered search's path made smooth and dense, with the ways to it and away from it.

use std::cell::Cell;
use std::ops::Range;

use nalgebra::UnitQuaternion;

use super::beam::State;
use super::contact::Contacts;
use super::guard::{Guard, Moment};
use super::layers::Layers;
use super::line::Lines;
use super::orientations::blend;
use super::posture::nearest;
use super::reason::{Obstacle, Status, Tally, WhyNot, CAUGHT};
use super::searches::Search;
use super::settings::PlanningSettings;
use super::touch::Finger;
use crate::arm::{Arm, JointPositions};
use crate::geometry::Vec3;

/// A flap's closing: postures close together, each part beginning where the one before ends.
#[derive(Debug, Clone, Default)]
pub struct PushMotion {
    pub approach: Vec<JointPositions>,
    pub push: Vec<JointPositions>,
    /// Of each sample of the push: the hinge's angle, rad, and where the finger touches, base frame.
    pub hinge_rad: Vec<f64>,
    pub contact: Vec<Vec3>,
    pub retreat: Vec<JointPositions>,
    /// Where all flaps are meanwhile, rad: those that are closed give way.
    pub meanwhile_rad: Vec<f64>,
    /// The free gap between the fingers.
    pub opening_m: f64,
    /// What turns the flap first, one after the other, until this can push it.
    pub first: Vec<PushMotion>,
}

/// Plans the push of one flap.
pub struct Pusher<'a, G: Guard> {
    pub arm: &'a Arm,
    pub guard: &'a G,
    pub settings: &'a PlanningSettings,
    pub contacts: Contacts<'a>,
    /// Which of the settings' searches are made, one after the other.
    pub searches: Range<usize>,
    /// The greatest share of what moves the box that the push may be.
    pub most_strain: f64,
    pub flap: usize,
    /// Where all flaps are before the push.
    pub moment: Moment,
    /// How far it is pushed, and where it is taken to rest afterwards, rad.
    pub hold_rad: f64,
    pub rest_rad: f64,
}

impl<G: Guard> Pusher<'_, G> {
    /// Searches, wider each time, for a push with a way to it and away from it.
    ///
    /// # Errors
    /// The status and the reason why there is none.
    pub fn plan(&self) -> Result<PushMotion, WhyNot> {
        let pressed = self.pressed();
        let angles_rad = layers_between(self.moment.angles_rad[self.flap], self.hold_rad, self.settings.layer_rad);
        let moments: Vec<Moment> = angles_rad.iter().map(|&angle_rad| pressed.pushing(self.flap, angle_rad)).collect();
        let search = Search {
            pusher: self,
            lines: Lines { arm: self.arm, guard: self.guard, settings: self.settings },
            before: self.moment.clone(),
            touching: pressed.pushing(self.flap, angles_rad[0]),
            held: pressed.pushing(self.flap, self.hold_rad),
            after: pressed.left(self.flap, self.rest_rad),
            pressed,
            angles_rad,
            moments,
            caught: Cell::new(0),
        };
        let finer_settings = self.settings.with_finer_contacts();
        self.guard.explain_anew();
        let (mut why, mut last) = (None, None);
        for (k, &beam) in self.settings.beams.iter().enumerate().filter(|(k, _)| self.searches.contains(k)) {
            if search.is_caught() {
                break;
            }
            let finer =
                k.checked_sub(1).map(|finer| self.contacts.finer(&finer_settings[finer.min(finer_settings.len() - 1)]));
            match search.run(beam, finer.as_ref().unwrap_or(&self.contacts), k > 0) {
                Ok(motion) => return Ok(motion),
                Err(found) => (why, last) = (Some(found), Some(finer)),
            }
        }
        let why = why.unwrap_or_else(WhyNot::not_searched);
        // Hands come too near to things at places that the arm does not reach, too.
        let is_near_all = why.at_start && why.status == Status::Blocked;
        let finest = last.flatten();
        let is_reached = || self.comes_within_reach(finest.as_ref().unwrap_or(&self.contacts));
        Err(if is_near_all && !is_reached() { why.out_of_reach() } else { why })
    }

    /// Whether some posture of the arm, limits and all that is in its way aside, holds the tool at some of these contacts where the flap
    /// stands; a few places of them that hold all others between them are asked. Arms without a closed form are not asked.
    fn comes_within_reach(&self, contacts: &Contacts<'_>) -> bool {
        if !self.arm.has_closed_form() {
            return true;
        }
        let frame = contacts.flap.frame(self.moment.angles_rad[self.flap]);
        let turned = (0..contacts.grid.size()).filter_map(|k| contacts.turned(&frame, &contacts.rotation(k)));
        let (along_m, away_m) = (spread(&contacts.along_m), spread(&contacts.away_m));
        let places = || along_m.iter().flat_map(|&along| away_m.iter().map(move |&away| [along, away]));
        turned.into_iter().any(|turned| {
            let mut grips = places().filter_map(|place| contacts.grip_turned(&frame, place, &turned));
            grips.any(|grip| !self.arm.branches(&grip.base_from_tool).is_empty())
        })
    }

    /// Where the flaps are during the push: those that are closed already give way to the one that comes to lie on them.
    pub fn pressed(&self) -> Moment {
        let mut pressed = self.moment.clone();
        for (flap, angle_rad) in pressed.angles_rad.iter_mut().enumerate() {
            if flap != self.flap && angle_rad.abs() <= self.settings.lying_rad {
                *angle_rad = angle_rad.min(self.hold_rad - self.settings.under_rad);
            }
        }
        pressed
    }

    /// The path of a search, dense, smooth where that keeps the clearance, and with its ends.
    pub fn dense(
        &self,
        layers: &Layers<'_, G>,
        path: &[State],
        lines: &Lines<'_, G>,
        first: (&Moment, &Moment),
        last: (&Moment, &Moment),
    ) -> Result<PushMotion, Obstacle> {
        let knots: Vec<([f64; 2], UnitQuaternion<f64>)> = path
            .iter()
            .map(|state| (layers.place_m(state.place), layers.contacts.rotation(state.orientation)))
            .collect();
        let sampled = self.sampled(layers, &knots, path[0].positions, smooth);
        let mut motion = sampled.or_else(|_| self.sampled(layers, &knots, path[0].positions, straight))?;
        let grip_at = |angle_rad: f64, knot: &([f64; 2], UnitQuaternion<f64>)| {
            let frame = self.contacts.flap.frame(angle_rad);
            layers.contacts.grip(&frame, knot.0, &knot.1).map(|grip| (frame, grip)).ok_or(Obstacle::Jump)
        };
        let (frame, grip) = grip_at(layers.angles_rad[0], &knots[0])?;
        motion.approach = lines.leave(&motion.push[0], &grip, &frame, first.0, first.1)?;
        motion.approach.reverse();
        let (frame, grip) = grip_at(self.hold_rad, &knots[knots.len() - 1])?;
        let end = motion.push[motion.push.len() - 1];
        motion.retreat = lines.leave(&end, &grip, &frame, last.0, last.1)?;
        Ok(motion)
    }

    fn sampled(
        &self,
        layers: &Layers<'_, G>,
        knots: &[([f64; 2], UnitQuaternion<f64>)],
        start: JointPositions,
        weigh: fn(f64, usize) -> Vec<(usize, f64)>,
    ) -> Result<PushMotion, Obstacle> {
        let angles_rad = layers.angles_rad;
        let span_rad = (angles_rad[0] - self.hold_rad).abs();
        let steps = (span_rad / self.settings.sample_rad).ceil().max(1.0) as usize;
        let mut motion = PushMotion {
            approach: Vec::new(),
            push: Vec::new(),
            hinge_rad: Vec::new(),
            contact: Vec::new(),
            retreat: Vec::new(),
            meanwhile_rad: layers.moment.angles_rad.clone(),
            opening_m: self.arm.gripper.opening_m[0],
            first: Vec::new(),
        };
        let mut last = start;
        for step in 0..=steps {
            let share = step as f64 / steps as f64;
            let angle_rad = angles_rad[0] + (self.hold_rad - angles_rad[0]) * share;
            let weights = weigh(share * (knots.len() - 1) as f64, knots.len());
            let (at, rotation) = mixed(knots, &weights);
            let frame = self.contacts.flap.frame(angle_rad);
            let grip = layers.contacts.grip(&frame, at, &rotation).ok_or(Obstacle::Jump)?;
            let solutions = self.arm.inverse_near(&grip.base_from_tool, &last);
            let (positions, turn) = nearest(&solutions, &last).ok_or(Obstacle::Reach)?;
            if step > 0 && turn > self.settings.most_sample_turn_rad {
                return Err(Obstacle::Jump);
            }
            let moment = layers.moment.pushing(self.flap, angle_rad);
            let clearance_m = self.settings.clearance_m + self.settings.search_margin_m / 2.0;
            if let Some(obstacle) = self.guard.conflict(&positions, &moment, clearance_m) {
                return Err(obstacle);
            }
            motion.push.push(positions);
            motion.hinge_rad.push(angle_rad);
            motion.contact.push(grip.contact);
            last = positions;
        }
        Ok(motion)
    }

    /// Does the box bear a push at an angle, at some place of the flap?
    fn is_borne(&self, angle_rad: f64) -> bool {
        let Contacts { fold, stand, flap, half_board_m, .. } = &self.contacts;
        stand.is_none_or(|stand| stand.least_strain(fold, flap, *half_board_m, angle_rad) <= self.most_strain)
    }

    pub fn why_stuck(&self, angle_rad: f64, at_start: bool, tally: &Tally) -> WhyNot {
        let degrees = angle_rad.to_degrees();
        let place = if at_start { "where it stands".to_string() } else { format!("at {degrees:.0} degrees") };
        // Where the box bears a push at some place, what is in the way there is the reason, however many places it does not bear.
        let is_borne = self.is_borne(angle_rad);
        let counts = |obstacle: &Obstacle| !(is_borne && *obstacle == Obstacle::Moves);
        let is_near = |obstacle: &Obstacle| {
            matches!(obstacle, Obstacle::Near { .. } | Obstacle::NoWay { .. } | Obstacle::Moves) && counts(obstacle)
        };
        let near = tally.commonest(is_near);
        let limit = tally.commonest(|obstacle| matches!(obstacle, Obstacle::Limit { .. }));
        let any = tally.commonest(counts).or_else(|| tally.commonest(|_| true));
        let (status, obstacle) = match (near, limit, any) {
            (Some(near), _, _) => (Status::Blocked, near),
            (None, Some(limit), _) => (Status::JointLimit, limit),
            (None, None, Some(Obstacle::Reach)) => (Status::Unreachable, &Obstacle::Reach),
            (None, None, Some(other)) => (Status::Blocked, other),
            (None, None, None) => (Status::Unreachable, &Obstacle::Reach),
        };
        let by_flaps = tally.any(|obstacle| obstacle.is_flap_beside(self.contacts.flap));
        let moves_box = tally.any(|obstacle| *obstacle == Obstacle::Moves);
        // Where the arm is caught, ends of other pushes lie no more open, and to find that out takes long.
        let is_caught = tally.any(|obstacle| *obstacle == CAUGHT);
        let at_rad = (!at_start && !is_caught).then_some(angle_rad);
        WhyNot {
            status,
            reason: format!("{place}: {obstacle}"),
            by_flaps,
            is_steep: false,
            at_start,
            at_rad,
            moves_box,
            searched: true,
        }
    }
}

/// A finger of an arm with the gripper closed as far as it goes.
pub fn closed_finger(arm: &Arm) -> Finger {
    let gripper = &arm.gripper;
    let opening_m = gripper.opening_m[0];
    Finger {
        half_m: [gripper.finger_size_m.x / 2.0, opening_m / 2.0 + gripper.finger_size_m.y],
        length_m: gripper.finger_size_m.z,
    }
}

/// So many of them at the most, the first and the last among them.
fn spread(places_m: &[f64]) -> Vec<f64> {
    let last = places_m.len().saturating_sub(1);
    let count = places_m.len().min(ASKED_PLACES);
    (0..count).map(|k| places_m[k * last / (count - 1).max(1)]).collect()
}

const ASKED_PLACES: usize = 5;

pub fn layers_between(from_rad: f64, to_rad: f64, step_rad: f64) -> Vec<f64> {
    let count = ((from_rad - to_rad).abs() / step_rad).ceil().max(1.0) as usize;
    (0..=count).map(|k| from_rad + (to_rad - from_rad) * k as f64 / count as f64).collect()
}

fn mixed(knots: &[([f64; 2], UnitQuaternion<f64>)], weights: &[(usize, f64)]) -> ([f64; 2], UnitQuaternion<f64>) {
    let at = weights.iter().fold([0.0; 2], |at, &(k, w)| [at[0] + w * knots[k].0[0], at[1] + w * knots[k].0[1]]);
    let rotations: Vec<_> = weights.iter().map(|&(k, w)| (knots[k].1, w)).collect();
    (at, blend(&rotations))
}

/// Knots and their weights at a place between them: straight from knot to knot.
fn straight(place: f64, count: usize) -> Vec<(usize, f64)> {
    let knot = (place.floor() as usize).min(count.saturating_sub(2));
    let share = place - knot as f64;
    if share <= 0.0 || count < 2 {
        return vec![(knot, 1.0)];
    }
    vec![(knot, 1.0 - share), (knot + 1, share)]
}

/// The same on a uniform quadratic B-spline (eq. 86), which begins and ends at the outer knots and turns without a corner.
fn smooth(place: f64, count: usize) -> Vec<(usize, f64)> {
    let middle = (place.round() as usize).clamp(0, count - 1);
    if middle == 0 || middle == count - 1 {
        return straight(place, count);
    }
    let share = place - middle as f64 + 0.5;
    let before = (1.0 - share).powi(2) / 2.0;
    let after = share.powi(2) / 2.0;
    vec![(middle - 1, before), (middle, 1.0 - before - after), (middle + 1, after)]
}
