//! The paper's planner (Section VI): intermediate rotating planes of the flap, points sampled on each, and brute force for a path
//! through them with an inverse kinematics that leaves the turn about the finger free. The finger stands square on each plane.
//!
//! What the paper leaves open is chosen plainly: the angle between planes, the grid of samples, the turns that are tried. It takes the
//! first path it finds, straight from plane to plane, and pushes to closed.

use nalgebra::{Matrix3, Rotation3, UnitQuaternion};

use super::contact::Grip;
use super::guard::Guard;
use super::line::Lines;
use super::posture::nearest;
use super::push::{layers_between, PushMotion, Pusher};
use super::reason::{Obstacle, Tally, WhyNot};
use super::settings::PlanningSettings;
use crate::arm::JointPositions;
use crate::geometry::Vec3;

/// Between two planes, rad.
const PLANE_RAD: f64 = 0.262;
/// Samples along and across each plane, and turns about the finger.
const SAMPLES: usize = 5;
const TURNS: usize = 8;

/// Searches one flap's push.
pub struct PlanesSearch<'a, 'b, G: Guard> {
    pub pusher: &'a Pusher<'b, G>,
    pub settings: &'a PlanningSettings,
}

/// A sample in reach: its place in the plane, the finger's turn, the posture.
#[derive(Clone, Copy)]
struct Sample {
    at: [f64; 2],
    turn_rad: f64,
    positions: JointPositions,
}

impl<G: Guard> PlanesSearch<'_, '_, G> {
    /// # Errors
    /// The status and the reason why there is no path.
    pub fn plan(&self) -> Result<PushMotion, WhyNot> {
        let pusher = self.pusher;
        let planes = layers_between(pusher.moment.angles_rad[pusher.flap], pusher.hold_rad, PLANE_RAD);
        let mut reached: Vec<Vec<Sample>> = Vec::new();
        for (k, &angle_rad) in planes.iter().enumerate() {
            let mut tally = Tally::default();
            let samples = self.samples(angle_rad, &mut tally);
            if samples.is_empty() {
                return Err(pusher.why_stuck(angle_rad, k == 0, &tally));
            }
            reached.push(samples);
        }
        let mut dead = reached.iter().map(|samples| vec![false; samples.len()]).collect::<Vec<_>>();
        for first in 0..reached[0].len() {
            let mut path = vec![first];
            if !self.extend(&planes, &reached, &mut dead, &mut path) {
                continue;
            }
            let chosen: Vec<Sample> = path.iter().enumerate().map(|(k, &number)| reached[k][number]).collect();
            if let Ok(motion) = self.motion(&planes, &chosen) {
                return Ok(motion);
            }
        }
        let mut tally = Tally::default();
        tally.add(Obstacle::Jump);
        Err(pusher.why_stuck(pusher.hold_rad, false, &tally))
    }

    /// Every sample of a plane that some posture reaches clear of everything, in order.
    fn samples(&self, angle_rad: f64, tally: &mut Tally) -> Vec<Sample> {
        let contacts = &self.pusher.contacts;
        let moment = self.pusher.pressed().pushing(self.pusher.flap, angle_rad);
        let inset_m = self.settings.contact_inset_m;
        let share = |k: usize| k as f64 / (SAMPLES - 1) as f64;
        let mut found = Vec::new();
        for v in (0..SAMPLES).rev() {
            for u in 0..SAMPLES {
                let along_m = inset_m + share(u) * (contacts.flap.hinge_length_m() - 2.0 * inset_m);
                let away_m = contacts.flap.length_m() * (0.4 + 0.55 * share(v));
                for turn in 0..TURNS {
                    let turn_rad = std::f64::consts::TAU * turn as f64 / TURNS as f64;
                    let at = [along_m, away_m];
                    let Some(grip) = self.grip(angle_rad, at, turn_rad) else { continue };
                    for solution in self.pusher.arm.inverse(&grip.base_from_tool) {
                        match self.pusher.guard.conflict(&solution.positions, &moment, self.settings.clearance_m) {
                            Some(obstacle) => tally.add(obstacle),
                            None => found.push(Sample { at, turn_rad, positions: solution.positions }),
                        }
                    }
                }
            }
        }
        found
    }

    /// The finger square on the plane.
    fn grip(&self, angle_rad: f64, at: [f64; 2], turn_rad: f64) -> Option<Grip> {
        let frame = self.pusher.contacts.flap.frame(angle_rad);
        let upright = Matrix3::from_columns(&[frame.along, -frame.away, frame.push()]);
        let turned = upright * Rotation3::from_axis_angle(&Vec3::z_axis(), turn_rad).matrix();
        let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(turned));
        self.pusher.contacts.grip(&frame, at, &rotation)
    }

    /// Depth first through the planes; samples from which nothing leads on are not tried again.
    fn extend(&self, planes: &[f64], reached: &[Vec<Sample>], dead: &mut [Vec<bool>], path: &mut Vec<usize>) -> bool {
        let layer = path.len();
        if layer == planes.len() {
            return true;
        }
        let from = reached[layer - 1][path[layer - 1]];
        for (number, to) in reached[layer].iter().enumerate() {
            let turns = from.positions.iter().zip(to.positions.iter()).map(|(a, b)| (a - b).abs());
            if dead[layer][number] || turns.fold(0.0, f64::max) > self.settings.most_turn_rad {
                continue;
            }
            path.push(number);
            if self.follows(planes, layer, &from, to) && self.extend(planes, reached, dead, path) {
                return true;
            }
            path.pop();
        }
        dead[layer - 1][path[layer - 1]] = true;
        false
    }

    fn follows(&self, planes: &[f64], layer: usize, from: &Sample, to: &Sample) -> bool {
        self.between(planes[layer - 1], planes[layer], from, to).is_ok()
    }

    /// Postures and contacts from one plane to the next, the second's included.
    fn between(
        &self,
        from_rad: f64,
        to_rad: f64,
        from: &Sample,
        to: &Sample,
    ) -> Result<Vec<(f64, JointPositions, Vec3)>, Obstacle> {
        let steps = ((from_rad - to_rad).abs() / self.settings.sample_rad).ceil().max(1.0) as usize;
        let pressed = self.pusher.pressed();
        let mut last = from.positions;
        let mut found = Vec::new();
        for step in 1..=steps {
            let share = step as f64 / steps as f64;
            let mix = |a: f64, b: f64| a + (b - a) * share;
            let angle_rad = mix(from_rad, to_rad);
            let at = [mix(from.at[0], to.at[0]), mix(from.at[1], to.at[1])];
            let grip = self.grip(angle_rad, at, mix(from.turn_rad, to.turn_rad)).ok_or(Obstacle::Jump)?;
            let solutions = self.pusher.arm.inverse_near(&grip.base_from_tool, &last);
            let (positions, turn) = nearest(&solutions, &last).ok_or(Obstacle::Reach)?;
            if turn > self.settings.most_sample_turn_rad {
                return Err(Obstacle::Jump);
            }
            let moment = pressed.pushing(self.pusher.flap, angle_rad);
            if let Some(obstacle) = self.pusher.guard.conflict(&positions, &moment, self.settings.clearance_m) {
                return Err(obstacle);
            }
            found.push((angle_rad, positions, grip.contact));
            last = positions;
        }
        Ok(found)
    }

    /// The path with its samples, the way to it and the way from it.
    fn motion(&self, planes: &[f64], chosen: &[Sample]) -> Result<PushMotion, Obstacle> {
        let pusher = self.pusher;
        let first = self.grip(planes[0], chosen[0].at, chosen[0].turn_rad).ok_or(Obstacle::Jump)?;
        let mut rows = vec![(planes[0], chosen[0].positions, first.contact)];
        for k in 1..chosen.len() {
            rows.extend(self.between(planes[k - 1], planes[k], &chosen[k - 1], &chosen[k])?);
        }
        let lines = Lines { arm: pusher.arm, guard: pusher.guard, settings: self.settings };
        let pressed = pusher.pressed();
        let last = chosen[chosen.len() - 1];
        let end = self.grip(pusher.hold_rad, last.at, last.turn_rad).ok_or(Obstacle::Jump)?;
        let frame = |angle_rad: f64| pusher.contacts.flap.frame(angle_rad);
        let touching = pressed.pushing(pusher.flap, planes[0]);
        let mut approach = lines.leave(&rows[0].1, &first, &frame(planes[0]), &touching, &pusher.moment)?;
        approach.reverse();
        let held = pressed.pushing(pusher.flap, pusher.hold_rad);
        let after = pressed.left(pusher.flap, pusher.rest_rad);
        let retreat = lines.leave(&rows[rows.len() - 1].1, &end, &frame(pusher.hold_rad), &held, &after)?;
        Ok(PushMotion {
            approach,
            hinge_rad: rows.iter().map(|row| row.0).collect(),
            contact: rows.iter().map(|row| row.2).collect(),
            push: rows.into_iter().map(|row| row.1).collect(),
            retreat,
            meanwhile_rad: pressed.angles_rad,
            opening_m: pusher.arm.gripper.opening_m[0],
            first: Vec::new(),
        })
    }
}
