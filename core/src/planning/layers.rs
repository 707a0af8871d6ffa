//! The layered search: hinge angle by hinge angle, which contact, tool orientation and posture of the arm pushes the flap along.

use super::beam::{trace, Kept, State};
use super::contact::{Contacts, Grip};
use super::guard::{Guard, Moment};
use super::orientations::blend;
use super::posture::{nearest, out_of_reach};
use super::reached::Memory;
use super::reason::{Obstacle, Tally};
use super::settings::PlanningSettings;
use crate::arm::{Arm, JointPositions};

/// What a layer's search needs to know.
#[derive(Clone, Copy)]
pub struct Layers<'a, G: Guard> {
    pub arm: &'a Arm,
    pub guard: &'a G,
    pub contacts: &'a Contacts<'a>,
    pub settings: &'a PlanningSettings,
    pub flap: usize,
    /// Of what moves the box.
    pub most_strain: f64,
    /// Of first postures that differ by whole turns of joints alone, or by half a turn of the gripper, one is looked at.
    pub alike_once: bool,
    /// Where all flaps are; this one moves.
    pub moment: &'a Moment,
    /// Hinge angles, first to last, rad, and where all flaps are then.
    pub angles_rad: &'a [f64],
    pub moments: &'a [Moment],
}

/// How far a search came: whole paths by cost, or the layer at which it ended and what was in the way.
pub enum Found {
    Paths(Vec<Vec<State>>),
    Stuck { layer: usize, tally: Tally },
}

impl Found {
    /// Of a search from the end: its paths from the start.
    pub fn reversed(self) -> Self {
        match self {
            Self::Paths(mut paths) => {
                paths.iter_mut().for_each(|path| path.reverse());
                Self::Paths(paths)
            }
            stuck => stuck,
        }
    }
}

impl<G: Guard> Layers<'_, G> {
    /// Searches with so many states kept in each layer. `starts` and `ends` say whether the arm can come to a first state, and leave
    /// a last one.
    pub fn search(
        &self,
        beam: usize,
        starts: &mut dyn FnMut(&JointPositions, &Grip) -> Option<Obstacle>,
        ends: &mut dyn FnMut(&JointPositions, &Grip) -> Option<Obstacle>,
    ) -> Found {
        let mut tally = Tally::default();
        let mut layers = vec![self.first_layer(beam, starts, &mut tally)];
        let mut memory = Memory::of(self.contacts);
        for layer in 1..self.angles_rad.len() {
            let last = layers.last().map_or(&[][..], |states| states.as_slice());
            if last.is_empty() {
                return Found::Stuck { layer: layer - 1, tally };
            }
            tally = Tally::default();
            let next = self.next_layer(layer, last, beam, &mut memory, &mut tally);
            layers.push(next);
        }
        let last = self.angles_rad.len() - 1;
        let frame = self.contacts.flap.frame(self.angles_rad[last]);
        let leaves = |state: &&usize| {
            let state = &layers[last][**state];
            let rotation = self.contacts.rotation(state.orientation);
            let Some(grip) = self.contacts.grip(&frame, self.place_m(state.place), &rotation) else { return false };
            match ends(&state.positions, &grip) {
                Some(obstacle) => {
                    tally.add(obstacle);
                    false
                }
                None => true,
            }
        };
        let order: Vec<usize> = (0..layers[last].len()).collect();
        let ended: Vec<usize> = order.iter().filter(leaves).take(MOST_PATHS).copied().collect();
        if ended.is_empty() {
            return Found::Stuck { layer: last, tally };
        }
        Found::Paths(ended.into_iter().map(|end| trace(&layers, end)).collect())
    }

    pub fn place_m(&self, place: [usize; 2]) -> [f64; 2] {
        [self.contacts.along_m[place[0]], self.contacts.away_m[place[1]]]
    }

    /// The cheapest states that follow those of the layer before.
    fn next_layer(
        &self,
        layer: usize,
        last: &[State],
        beam: usize,
        memory: &mut Memory,
        tally: &mut Tally,
    ) -> Vec<State> {
        memory.forget();
        for (number, state) in last.iter().enumerate() {
            self.follow(layer, number, state, memory, tally);
        }
        let mut kept = Kept::new(beam, beam);
        for state in memory.cheapest_first() {
            if kept.is_full() {
                break;
            }
            if !kept.has_room(&state) {
                continue;
            }
            let between = || self.between(layer, &last[state.before], &state);
            match self.conflict(&state.positions, self.angles_rad[layer]).or_else(between) {
                Some(obstacle) => tally.add(obstacle),
                None => kept.push(state),
            }
        }
        kept.states
    }

    /// Adds what can follow a state: the same contact with a turned tool, or a contact beside it.
    fn follow(&self, layer: usize, number: usize, state: &State, memory: &mut Memory, tally: &mut Tally) {
        let near = &self.contacts.grid.near[state.orientation];
        let turned = near.iter().map(|&(orientation, angle_rad)| (state.place, orientation, 0.3 * angle_rad));
        let slid = self.places_beside(state.place).map(|place| (place, state.orientation, SLIDE_COST));
        for (place, orientation, change) in turned.chain(slid) {
            let known = memory
                .of_pose(place, orientation, || self.reached(layer, place, orientation, Some(&state.positions), tally));
            let Some(pose) = known else { continue };
            let drag = if place == state.place { 0.0 } else { pose.grip.strain };
            let moved = state.cost + 0.3 * pose.grip.penalty + drag + change;
            let mut follows = false;
            for posture in &mut pose.postures {
                let turns = posture.positions.iter().zip(state.positions.iter()).map(|(a, b)| (a - b).abs());
                let (most, squares) = turns.fold((0f64, 0.0), |(most, sum), turn| (most.max(turn), sum + turn * turn));
                if most > self.settings.most_turn_rad {
                    continue;
                }
                follows = true;
                posture.offer(moved + 0.5 * squares + 0.3 * posture.limit_penalty, number);
            }
            if !follows && !pose.postures.is_empty() {
                tally.add(Obstacle::Jump);
            }
        }
    }

    fn places_beside(&self, [along, away]: [usize; 2]) -> impl Iterator<Item = [usize; 2]> {
        let size = [self.contacts.along_m.len(), self.contacts.away_m.len()];
        let beside =
            [[along.wrapping_sub(1), away], [along + 1, away], [along, away.wrapping_sub(1)], [along, away + 1]];
        beside.into_iter().filter(move |place| place[0] < size[0] && place[1] < size[1])
    }

    /// Half way between two layers.
    fn between(&self, layer: usize, from: &State, to: &State) -> Option<Obstacle> {
        let angle_rad = (self.angles_rad[layer - 1] + self.angles_rad[layer]) / 2.0;
        let (p, q) = (self.place_m(from.place), self.place_m(to.place));
        let at = [(p[0] + q[0]) / 2.0, (p[1] + q[1]) / 2.0];
        let rotation =
            blend(&[(self.contacts.rotation(from.orientation), 0.5), (self.contacts.rotation(to.orientation), 0.5)]);
        let Some(grip) = self.contacts.grip(&self.contacts.flap.frame(angle_rad), at, &rotation) else {
            return Some(Obstacle::Jump);
        };
        let solutions = self.arm.inverse_near(&grip.base_from_tool, &from.positions);
        let Some((positions, turn)) = nearest(&solutions, &from.positions) else {
            return Some(out_of_reach(self.arm, &grip.base_from_tool));
        };
        if turn > self.settings.most_turn_rad {
            return Some(Obstacle::Jump);
        }
        self.conflict(&positions, angle_rad)
    }

    pub fn conflict(&self, positions: &JointPositions, angle_rad: f64) -> Option<Obstacle> {
        self.guard.conflict(positions, &self.moment.pushing(self.flap, angle_rad), self.clearance_m())
    }

    pub fn clearance_m(&self) -> f64 {
        self.settings.clearance_m + self.settings.search_margin_m
    }
}

/// Whole paths handed back, at most.
const MOST_PATHS: usize = 24;
/// What sliding to the contact beside costs, besides the strain there: a finger that slips drags the box with it.
const SLIDE_COST: f64 = 0.15;
