use super::reason::Obstacle;
use crate::geometry::Rigid;

/// Where the flaps are at a moment, and which of them the fingers may touch.
#[derive(Debug, Clone, PartialEq)]
pub struct Moment {
    /// Each flap's angle, rad, in the problem's order.
    pub angles_rad: Vec<f64>,
    /// The flap that is being pushed: the fingers need no distance to it.
    pub pushed: Option<usize>,
}

impl Moment {
    pub fn resting(angles_rad: &[f64]) -> Self {
        Self { angles_rad: angles_rad.to_vec(), pushed: None }
    }

    /// The same with one flap moved to an angle by the fingers.
    pub fn pushing(&self, flap: usize, angle_rad: f64) -> Self {
        let mut moment = Self { angles_rad: self.angles_rad.clone(), pushed: Some(flap) };
        moment.angles_rad[flap] = angle_rad;
        moment
    }

    /// The same with one flap at an angle and nothing touched.
    pub fn left(&self, flap: usize, angle_rad: f64) -> Self {
        Self { pushed: None, ..self.pushing(flap, angle_rad) }
    }
}

/// Knows what an arm's posture comes too near to.
pub trait Guard {
    /// The first thing that a posture comes nearer to than `clearance_m`, or None.
    fn conflict(&self, positions_rad: &[f64], moment: &Moment, clearance_m: f64) -> Option<Obstacle>;

    /// The same of the gripper and its fingers alone, wherever the arm is that holds them: quick, and mostly enough to say no.
    fn tool_conflict(&self, base_from_tool: &Rigid, moment: &Moment, clearance_m: f64) -> Option<Obstacle>;

    /// The same of the arm with its fingers so far open.
    fn with_opening(&self, opening_m: f64) -> Self
    where
        Self: Sized;

    /// Does the flap that is pushed meet the arm's own base, which stands still?
    fn base_conflict(&self, _moment: &Moment) -> Option<Obstacle> {
        None
    }

    /// A new question begins: what comes too near to what is told again.
    fn explain_anew(&self) {}
}
