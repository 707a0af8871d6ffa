//! Turns a flap with the fingers astride its free edge. A couple loads the box far less than a push that turns the flap as far (eq. 97):
//! it slides nothing, and tips with less of a lever.

use super::astride::{Astride, Shaped};
use super::contact::Grip;
use super::flap::Flap;
use super::guard::{Guard, Moment};
use super::line::Lines;
use super::load::Fold;
use super::posture::nearest;
use super::push::{layers_between, PushMotion};
use super::reason::{Obstacle, Tally};
use super::searches::comes_and_goes;
use super::settings::PlanningSettings;
use crate::arm::{Arm, JointPositions};
use crate::geometry::Rigid;

/// One flap before one arm.
pub struct Fork<'a, G: Guard> {
    pub arm: &'a Arm,
    pub guard: &'a G,
    pub settings: &'a PlanningSettings,
    pub flap: &'a Flap,
    pub number: usize,
    pub thickness_m: f64,
    pub fold: Fold,
    /// Where all flaps are before it.
    pub before: &'a Moment,
}

/// The fingers at one opening.
struct Held<'a, G: Guard> {
    fork: &'a Fork<'a, G>,
    guard: G,
    shaped: Shaped,
    astride: Astride,
}

impl<G: Guard> Fork<'_, G> {
    /// The first way that turns the flap down from where it stands to where a push can go on, and where it rests then (rad).
    ///
    /// # Errors
    /// What was in the way.
    pub fn plan(&self) -> Result<(PushMotion, f64), Tally> {
        let mut tally = Tally::default();
        self.guard.explain_anew();
        for shaped in Shaped::all(self.arm, self.flap, self.thickness_m, &self.settings.fork) {
            for astride in shaped.places(self.flap, &self.settings.fork) {
                let held = Held { fork: self, guard: self.guard.with_opening(shaped.opening_m), shaped, astride };
                if let Some(found) = held.plan(&mut tally) {
                    return Ok(found);
                }
            }
        }
        Err(tally)
    }

    fn start_rad(&self) -> f64 {
        self.before.angles_rad[self.number]
    }
}

impl<G: Guard> Held<'_, G> {
    fn plan(&self, tally: &mut Tally) -> Option<(PushMotion, f64)> {
        let fork = self.fork;
        let start_rad = fork.start_rad();
        for angle_rad in [start_rad, fork.settings.fork.far_enough_rad] {
            let near = self.guard.tool_conflict(&self.pose(angle_rad), &self.at(angle_rad), self.clearance_m());
            if let Some(obstacle) = near {
                tally.add(obstacle);
                return None;
            }
        }
        for solution in fork.arm.inverse(&self.pose(start_rad)).iter() {
            match self.turned(&solution.positions).and_then(|motion| self.with_ends(motion)) {
                Ok(found) => return Some(found),
                Err(obstacle) => tally.add(obstacle),
            }
        }
        None
    }

    /// Down as far as the arm can follow, first in wide steps.
    fn turned(&self, start: &JointPositions) -> Result<PushMotion, Obstacle> {
        let settings = self.fork.settings;
        let (start_rad, wanted_rad) = (self.fork.start_rad(), settings.fork.wanted_rad);
        let wide = layers_between(start_rad, wanted_rad, settings.layer_rad);
        let (far, why) = self.followed(start, &wide, settings.most_turn_rad);
        let to_rad = wide[far.len().saturating_sub(1)];
        let refused = |why: Option<Obstacle>| Err(why.unwrap_or(Obstacle::Jump));
        if far.is_empty() || to_rad > settings.fork.far_enough_rad {
            return refused(why);
        }
        let close = layers_between(start_rad, to_rad, settings.sample_rad);
        let (push, why) = self.followed(start, &close, settings.most_sample_turn_rad);
        if push.is_empty() || close[push.len() - 1] > settings.fork.far_enough_rad {
            return refused(why);
        }
        let hinge_rad = close[..push.len()].to_vec();
        let (edge_m, half_board_m) = (self.fork.flap.length_m(), self.fork.thickness_m / 2.0);
        let contact = |&angle_rad: &f64| self.fork.flap.frame(angle_rad).at(self.astride.along_m, edge_m, half_board_m);
        Ok(PushMotion {
            contact: hinge_rad.iter().map(contact).collect(),
            push,
            hinge_rad,
            opening_m: self.shaped.opening_m,
            meanwhile_rad: self.fork.before.angles_rad.clone(),
            ..PushMotion::default()
        })
    }

    /// Postures angle by angle, and what ended them.
    fn followed(
        &self,
        start: &JointPositions,
        angles_rad: &[f64],
        most_turn_rad: f64,
    ) -> (Vec<JointPositions>, Option<Obstacle>) {
        let mut found: Vec<JointPositions> = Vec::new();
        for &angle_rad in angles_rad {
            let last = found.last().unwrap_or(start);
            let solutions = self.fork.arm.inverse_near(&self.pose(angle_rad), last);
            let Some((positions, turn)) = nearest(&solutions, last) else { return (found, Some(Obstacle::Reach)) };
            if turn > most_turn_rad {
                return (found, Some(Obstacle::Jump));
            }
            if let Some(obstacle) = self.guard.conflict(&positions, &self.at(angle_rad), self.clearance_m()) {
                return (found, Some(obstacle));
            }
            found.push(positions);
        }
        (found, None)
    }

    /// With the ways to it and away from it; the flap follows the fingers' slack, then springs back.
    fn with_ends(&self, mut motion: PushMotion) -> Result<(PushMotion, f64), Obstacle> {
        let fork = self.fork;
        let lines = Lines { arm: fork.arm, guard: &self.guard, settings: fork.settings };
        let (start_rad, held_rad) = (motion.hinge_rad[0], motion.hinge_rad[motion.hinge_rad.len() - 1]);
        let rest_rad = fork.fold.rest_rad(held_rad + self.shaped.slack_rad);
        let after = fork.before.left(fork.number, rest_rad);
        let frame = |angle_rad: f64| fork.flap.frame(angle_rad);
        let grip = |angle_rad: f64| Grip {
            base_from_tool: self.pose(angle_rad),
            contact: motion.contact[0],
            strain: 0.0,
            penalty: 0.0,
        };
        let (first, last) = (motion.push[0], motion.push[motion.push.len() - 1]);
        let mut approach =
            lines.leave(&first, &grip(start_rad), &frame(start_rad), &self.at(start_rad), fork.before)?;
        approach.reverse();
        let retreat = lines.leave(&last, &grip(held_rad), &frame(held_rad), &self.at(held_rad), &after)?;
        motion = PushMotion { approach, retreat, ..motion };
        if !comes_and_goes(fork.arm, &self.guard, fork.settings, &motion, (fork.before, &after)) {
            return Err(Obstacle::NoWay { to: "to it" });
        }
        Ok((motion, rest_rad))
    }

    fn pose(&self, angle_rad: f64) -> Rigid {
        self.fork.flap.frame(angle_rad).base_from_flap().then(&self.astride.flap_from_tool)
    }

    fn at(&self, angle_rad: f64) -> Moment {
        self.fork.before.pushing(self.fork.number, angle_rad)
    }

    fn clearance_m(&self) -> f64 {
        self.fork.settings.clearance_m + self.fork.settings.search_margin_m
    }
}
