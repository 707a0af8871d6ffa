//! The tool poses that a layer of the search asked for, each looked at once, with the arm's postures for them.

use super::beam::State;
use super::contact::{Contacts, Grip};
use super::guard::Guard;
use super::layers::Layers;
use super::posture::{limit_penalty, out_of_reach};
use super::reason::{Obstacle, Tally};
use crate::arm::JointPositions;

/// A tool pose in which the finger touches the flap, near nothing else, and the arm's postures for it.
pub struct Pose {
    pub grip: Grip,
    pub postures: Vec<Posture>,
}

/// A posture, and the cheapest way to it so far.
pub struct Posture {
    pub positions: JointPositions,
    /// Of the inverse kinematics.
    pub branch: u8,
    pub limit_penalty: f64,
    /// Infinite until a way is known.
    cost: f64,
    before: usize,
}

impl Posture {
    pub fn new(positions: JointPositions, branch: u8, limit_penalty: f64) -> Self {
        Self { positions, branch, limit_penalty, cost: f64::INFINITY, before: 0 }
    }

    pub fn offer(&mut self, cost: f64, before: usize) {
        if cost < self.cost {
            (self.cost, self.before) = (cost, before);
        }
    }

    pub fn state(&self, place: [usize; 2], orientation: usize, cost: f64) -> State {
        State { place, orientation, positions: self.positions, branch: self.branch, cost, before: self.before }
    }
}

/// The poses of one layer, by place and orientation.
pub struct Memory {
    places: [usize; 2],
    /// For each place and orientation: the layer in which it was last asked for, and its number among the poses then.
    slots: Vec<(u32, u32)>,
    layer: u32,
    poses: Vec<([usize; 2], usize, Option<Pose>)>,
}

impl Memory {
    pub fn of(contacts: &Contacts<'_>) -> Self {
        let places = [contacts.along_m.len(), contacts.away_m.len()];
        let slots = vec![(0, 0); places[0] * places[1] * contacts.grid.size()];
        Self { places, slots, layer: 0, poses: Vec::new() }
    }

    /// Another layer begins.
    pub fn forget(&mut self) {
        self.layer += 1;
        self.poses.clear();
    }

    /// What is known of a pose, looked at first where nothing is; None where the finger cannot touch the flap so.
    pub fn of_pose(
        &mut self,
        place: [usize; 2],
        orientation: usize,
        look: impl FnOnce() -> Option<Pose>,
    ) -> Option<&mut Pose> {
        let slot = &mut self.slots[(orientation * self.places[0] + place[0]) * self.places[1] + place[1]];
        if slot.0 != self.layer {
            *slot = (self.layer, self.poses.len() as u32);
            self.poses.push((place, orientation, look()));
        }
        self.poses[slot.1 as usize].2.as_mut()
    }

    /// All states to which there is a way, by cost; ties by place, orientation and posture.
    pub fn cheapest_first(&self) -> impl Iterator<Item = State> + use<'_> {
        let mut found: Vec<(f64, [usize; 2], usize, usize, &Posture)> = Vec::new();
        for (place, orientation, pose) in &self.poses {
            let postures = pose.iter().flat_map(|pose| pose.postures.iter().enumerate());
            let reached = postures.filter(|(_, posture)| posture.cost.is_finite());
            found.extend(reached.map(|(k, posture)| (posture.cost, *place, *orientation, k, posture)));
        }
        found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then_with(|| (a.1, a.2, a.3).cmp(&(b.1, b.2, b.3))));
        found.into_iter().map(|(cost, place, orientation, _, posture)| posture.state(place, orientation, cost))
    }
}

impl<G: Guard> Layers<'_, G> {
    /// The pose of a contact in a layer and the arm's postures for it; None where the finger cannot touch the flap so.
    pub fn reached(
        &self,
        layer: usize,
        place: [usize; 2],
        orientation: usize,
        near: Option<&JointPositions>,
        tally: &mut Tally,
    ) -> Option<Pose> {
        let frame = self.contacts.flap.frame(self.angles_rad[layer]);
        let grip = self.contacts.grip(&frame, self.place_m(place), &self.contacts.rotation(orientation))?;
        self.reached_with(layer, grip, near, tally)
    }

    /// The same of a contact whose tool pose is known.
    pub fn reached_with(
        &self,
        layer: usize,
        grip: Grip,
        near: Option<&JointPositions>,
        tally: &mut Tally,
    ) -> Option<Pose> {
        if grip.strain > self.most_strain {
            tally.add(Obstacle::Moves);
            return None;
        }
        let pose = &grip.base_from_tool;
        if let Some(obstacle) = self.guard.tool_conflict(pose, &self.moments[layer], self.clearance_m()) {
            tally.add(obstacle);
            return None;
        }
        let solutions = match near {
            Some(near) => self.arm.inverse_near(pose, near),
            None => self.arm.inverse(pose),
        };
        if solutions.is_empty() {
            tally.add(out_of_reach(self.arm, pose));
        }
        let postures = solutions.iter().map(|solution| {
            Posture::new(solution.positions, solution.branch, limit_penalty(self.arm, &solution.positions))
        });
        Some(Pose { grip, postures: postures.collect() })
    }
}
