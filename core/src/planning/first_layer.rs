//! The first layer of a search: contacts that the arm can come to.

use super::beam::{Kept, State};
use super::contact::Grip;
use super::guard::Guard;
use super::layers::Layers;
use super::reason::{Obstacle, Tally};
use crate::arm::JointPositions;

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
        for (place, orientation) in self.grips_by_penalty() {
            if kept.is_full() || tries > START_TRIES * beam {
                break;
            }
            let Some(pose) = self.reached(0, place, orientation, None, tally) else { continue };
            for posture in &pose.postures {
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

    /// All contacts of the first layer, the best first.
    fn grips_by_penalty(&self) -> Vec<([usize; 2], usize)> {
        let frame = self.contacts.flap.frame(self.angles_rad[0]);
        let mut found = Vec::new();
        for orientation in 0..self.contacts.grid.size() {
            let Some(turned) = self.contacts.turned(&frame, &self.contacts.rotation(orientation)) else { continue };
            for along in 0..self.contacts.along_m.len() {
                for away in 0..self.contacts.away_m.len() {
                    let place = [along, away];
                    if let Some(grip) = self.contacts.grip_turned(&frame, self.place_m(place), &turned) {
                        found.push((grip.penalty, place, orientation));
                    }
                }
            }
        }
        found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
        found.into_iter().map(|(_, place, orientation)| (place, orientation)).collect()
    }
}
