//! The first layer of a search: contacts that the arm can come to.

use std::f64::consts::TAU;

use super::beam::{Kept, State};
use super::contact::{Grip, Turned};
use super::flap::FlapFrame;
use super::guard::Guard;
use super::layers::Layers;
use super::orientations::OrientationGrid;
use super::reached::Posture;
use super::reason::{Obstacle, Tally};
use crate::arm::{Arm, JointPositions};

/// A place of the flap and a tool orientation, by their numbers.
type PlaceTurned = ([usize; 2], usize);

/// It is this much wider than the others, and so many postures are tried for it for each state that is kept.
const START_WIDTH: usize = 2;
const START_TRIES: usize = 100;

impl<G: Guard> Layers<'_, G> {
    /// The best first states, which the arm can come to.
    pub fn first_layer(
        &self,
        beam: usize,
        starts: &mut dyn FnMut(&JointPositions, &Grip) -> Option<Obstacle>,
        tally: &mut Tally,
    ) -> Vec<State> {
        let mut kept = Kept::new(START_WIDTH * beam, beam);
        let mut tries = 0;
        let frame = self.contacts.flap.frame(self.angles_rad[0]);
        let (grips, turned) = self.grips_by_penalty(&frame, tally);
        for (place, orientation) in grips {
            if kept.is_full() || tries > START_TRIES * beam {
                break;
            }
            let grip = |turned: &Turned| self.contacts.grip_turned(&frame, self.place_m(place), turned);
            let grip = turned[orientation].as_ref().and_then(grip);
            let Some(pose) = grip.and_then(|grip| self.reached_with(0, grip, None, tally)) else { continue };
            for (k, posture) in pose.postures.iter().enumerate() {
                if self.alike_once && is_wound(self.arm, &pose.postures, k) {
                    continue;
                }
                let cost = pose.grip.penalty + posture.limit_penalty;
                let state = posture.state(place, orientation, cost);
                if !kept.has_room(&state) {
                    continue;
                }
                tries += 1;
                let conflict = self.conflict(&state.positions, self.angles_rad[0]);
                match conflict.or_else(|| starts(&state.positions, &pose.grip)) {
                    Some(obstacle) => tally.add(obstacle),
                    None => kept.push(state),
                }
            }
        }
        kept.states
    }

    /// All contacts of the first layer that leave the box where it is, the best first, and the finger in each orientation.
    fn grips_by_penalty(&self, frame: &FlapFrame, tally: &mut Tally) -> (Vec<PlaceTurned>, Vec<Option<Turned>>) {
        let (mut found, mut moving) = (Vec::new(), 0);
        let turned_once = self.alike_once && is_alike_turned(self.arm);
        let orientations = 0..self.contacts.grid.size();
        let all_turned = orientations.map(|orientation| {
            let is_asked = !(turned_once && OrientationGrid::is_half_turned(orientation));
            is_asked.then(|| self.contacts.turned(frame, &self.contacts.rotation(orientation))).flatten()
        });
        let all_turned: Vec<Option<Turned>> = all_turned.collect();
        for (orientation, turned) in all_turned.iter().enumerate() {
            let Some(turned) = turned else { continue };
            for along in 0..self.contacts.along_m.len() {
                for away in 0..self.contacts.away_m.len() {
                    let place = [along, away];
                    match self.contacts.grip_turned(frame, self.place_m(place), turned) {
                        Some(grip) if grip.strain > self.most_strain => moving += 1,
                        Some(grip) => found.push((grip.penalty, place, orientation)),
                        None => {}
                    }
                }
            }
        }
        tally.add_many(Obstacle::Moves, moving);
        found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
        (found.into_iter().map(|(_, place, orientation)| (place, orientation)).collect(), all_turned)
    }
}

/// Can the gripper do turned by half a turn what it can do? The last joint makes a whole turn then, and the tool lies on its axis.
fn is_alike_turned(arm: &Arm) -> bool {
    let turns_whole = arm.joints.last().is_some_and(|joint| joint.upper_rad - joint.lower_rad >= TAU);
    turns_whole && arm.gripper.tool_point_m.xy() == nalgebra::Vector2::zeros()
}

/// Is a posture one of the others but for whole turns of joints, and further from the middle of their limits?
fn is_wound(arm: &Arm, postures: &[Posture], number: usize) -> bool {
    let off_rad = |positions: &JointPositions| -> f64 {
        let joints = arm.joints.iter().zip(positions.iter());
        joints.map(|(joint, &q)| (q - (joint.lower_rad + joint.upper_rad) / 2.0).abs()).sum()
    };
    let own = &postures[number].positions;
    let is_same = |other: &JointPositions| {
        own.iter().zip(other.iter()).all(|(a, b)| ((a - b) / TAU - ((a - b) / TAU).round()).abs() < SAME_TURNS)
    };
    postures.iter().enumerate().any(|(k, other)| {
        let order = off_rad(&other.positions).total_cmp(&off_rad(own)).then(k.cmp(&number));
        k != number && order.is_lt() && is_same(&other.positions)
    })
}

/// Of a whole turn: rounding.
const SAME_TURNS: f64 = 1e-9;

#[cfg(test)]
mod tests {
    use super::*;

    const VIPER: &str = include_str!("../../../src/boxwright/robots/data/viper_s850.toml");

    #[test]
    fn of_postures_that_differ_by_whole_turns_alone_the_one_in_the_middle_is_looked_at() {
        let arm = Arm::from_toml(VIPER).unwrap();
        assert!(is_alike_turned(&arm));
        let aside = VIPER.replace("tool_point_m = [0.0,", "tool_point_m = [0.01,");
        assert!(!is_alike_turned(&Arm::from_toml(&aside).unwrap()));
        let posture = |wrist_rad: f64, last_rad: f64| {
            Posture::new(JointPositions::from_slice(&[0.1, -1.0, 2.0, wrist_rad, 0.5, last_rad]), 0, 0.0)
        };
        let postures =
            [posture(0.2, 5.0), posture(0.2, 5.0 - TAU), posture(0.3, 5.0), posture(0.3, 1.0), posture(0.3, 1.0)];
        let wound: Vec<bool> = (0..postures.len()).map(|k| is_wound(&arm, &postures, k)).collect();
        assert_eq!(wound, [true, false, false, false, true]);
    }
}
