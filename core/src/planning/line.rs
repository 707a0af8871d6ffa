//! Straight lines of the tool: off a flap, and then out of its way.

use super::contact::Grip;
use super::flap::FlapFrame;
use super::guard::{Guard, Moment};
use super::posture::nearest;
use super::reason::Obstacle;
use super::settings::PlanningSettings;
use crate::arm::{Arm, JointPositions};
use crate::geometry::{Rigid, Vec3};

/// Follows lines of the tool with an arm.
pub struct Lines<'a, G: Guard> {
    pub arm: &'a Arm,
    pub guard: &'a G,
    pub settings: &'a PlanningSettings,
}

/// A flap that follows the finger as it springs back is given this many times the stand-off, one after the other.
const STAND_OFFS: [f64; 4] = [1.0, 2.0, 4.0, 6.0];
/// How far a way that slides off a flap leans off its face.
const LEAN_OFF: f64 = 0.3;
/// Less of a way out is none, of `withdraw_m`.
const LEAST_WAY_OUT: f64 = 0.25;

/// Against the tool's axis, unit vector, base frame.
fn back_along_itself(grip: &Grip) -> Vec3 {
    -Vec3::from(grip.base_from_tool.rotation.column(2))
}

impl<G: Guard> Lines<'_, G> {
    /// Postures from a touch to a place where nothing is near: off the face, then out along the first direction that is clear.
    /// `touching` is the moment of the touch, `free` that after it.
    ///
    /// # Errors
    /// What was in the way of the last direction tried.
    pub fn leave(
        &self,
        from: &JointPositions,
        grip: &Grip,
        frame: &FlapFrame,
        touching: &Moment,
        free: &Moment,
    ) -> Result<Vec<JointPositions>, Obstacle> {
        let off = self.settings.stand_off_m;
        let lifts = STAND_OFFS.map(|factor| frame.outward * (factor * off));
        let mut why = Obstacle::NoWay { to: "off the flap" };
        for way in lifts.into_iter().chain(self.slides(grip, frame)) {
            match self.way_off(from, &grip.base_from_tool, &way, frame, touching, free) {
                Ok(line) => return Ok(line),
                Err(obstacle) => why = obstacle,
            }
        }
        Err(why)
    }

    /// The same of fingers astride a flap: straight back along themselves, where a way that leans would catch on the board's edge.
    ///
    /// # Errors
    /// What was in the way.
    pub fn draw_off(
        &self,
        from: &JointPositions,
        grip: &Grip,
        frame: &FlapFrame,
        touching: &Moment,
        free: &Moment,
    ) -> Result<Vec<JointPositions>, Obstacle> {
        let back = back_along_itself(grip) * self.settings.slide_off_m;
        self.way_off(from, &grip.base_from_tool, &back, frame, touching, free)
    }

    /// Where there is no room to lift the finger off the face it slides out: along itself, past the flap's ends or its free edge.
    fn slides(&self, grip: &Grip, frame: &FlapFrame) -> impl Iterator<Item = Vec3> {
        let back = back_along_itself(grip);
        let (slide_m, outward) = (self.settings.slide_off_m, frame.outward);
        let ways = [back, frame.along, -frame.along, frame.away];
        // Rather a little off the board than along it.
        let leaning = ways.map(|way| way + outward * LEAN_OFF);
        leaning.into_iter().chain(ways).map(move |way| way.normalize() * slide_m)
    }

    /// Along a way while the finger may touch, until nothing is near, and from there out.
    fn way_off(
        &self,
        from: &JointPositions,
        pose: &Rigid,
        way: &Vec3,
        frame: &FlapFrame,
        touching: &Moment,
        free: &Moment,
    ) -> Result<Vec<JointPositions>, Obstacle> {
        let (mut first, ended) = self.line(from, pose, way, touching);
        let steps = self.steps(way);
        let mut why = ended.unwrap_or(Obstacle::NoWay { to: "off the flap" });
        // The first place where nothing is near: of a short way its end.
        let Some(stood) = (1..first.len()).find(|&k| self.conflict(&first[k], free).is_none()) else { return Err(why) };
        first.truncate(stood + 1);
        let pose = moved(pose, &(way * (stood as f64 / steps as f64)));
        match self.way_out(&first[stood], &pose, frame, free) {
            Ok(second) => return Ok([&first[..], &second[1..]].concat()),
            Err(obstacle) => why = obstacle,
        }
        Err(why)
    }

    /// The first of the lines out that is clear to its end, else the longest of those that lead far enough.
    fn way_out(
        &self,
        from: &JointPositions,
        pose: &Rigid,
        frame: &FlapFrame,
        free: &Moment,
    ) -> Result<Vec<JointPositions>, Obstacle> {
        let back = -Vec3::from(pose.rotation.column(2));
        let directions = [back, (back + frame.outward).normalize(), frame.outward, Vec3::z()];
        let least = (LEAST_WAY_OUT * self.settings.withdraw_m / self.settings.line_step_m).floor() as usize;
        let mut found = Err(Obstacle::NoWay { to: "off the flap" });
        for direction in directions {
            let (line, obstacle) = self.line(from, pose, &(direction * self.settings.withdraw_m), free);
            let Some(obstacle) = obstacle else { return Ok(line) };
            let longest = found.as_ref().map_or(least, Vec::len);
            if line.len() > longest {
                found = Ok(line);
            } else if found.is_err() {
                found = Err(obstacle);
            }
        }
        found
    }

    /// Postures along a straight line of the tool as far as it is clear, and what ended it.
    fn line(
        &self,
        from: &JointPositions,
        pose: &Rigid,
        way: &Vec3,
        moment: &Moment,
    ) -> (Vec<JointPositions>, Option<Obstacle>) {
        let steps = self.steps(way);
        let mut line = vec![*from];
        for step in 1..=steps {
            let target = moved(pose, &(way * (step as f64 / steps as f64)));
            let last = line[line.len() - 1];
            let solutions = self.arm.inverse_near(&target, &last);
            let Some((positions, turn)) = nearest(&solutions, &last) else {
                return (line, Some(Obstacle::Reach));
            };
            if turn > self.settings.most_sample_turn_rad {
                return (line, Some(Obstacle::Jump));
            }
            if let Some(obstacle) = self.conflict(&positions, moment) {
                return (line, Some(obstacle));
            }
            line.push(positions);
        }
        (line, None)
    }

    fn steps(&self, way: &Vec3) -> usize {
        (way.norm() / self.settings.line_step_m).ceil().max(1.0) as usize
    }

    fn conflict(&self, positions: &JointPositions, moment: &Moment) -> Option<Obstacle> {
        self.guard.conflict(positions, moment, self.settings.clearance_m + self.settings.search_margin_m)
    }
}

fn moved(pose: &Rigid, way: &Vec3) -> Rigid {
    Rigid::new(pose.rotation, pose.translation + way)
}
