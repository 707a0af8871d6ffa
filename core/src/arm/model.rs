use super::gripper::Gripper;
use super::joint::Joint;
use super::numeric_settings::NumericSettings;
use super::opw::Opw;
use super::positions::JointPositions;
use super::shape::Shape;
use crate::error::{InputError, Result};
use crate::geometry::Rigid;

/// A rigid body of the arm and what encloses it, in its joint's frame; the base is the first.
#[derive(Debug, Clone, PartialEq)]
pub struct Link {
    pub name: String,
    pub mass_kg: f64,
    pub shapes: Vec<Shape>,
}

/// An arm with its gripper: all that is constant about it.
#[derive(Debug, Clone, PartialEq)]
pub struct Arm {
    pub name: String,
    pub joints: Vec<Joint>,
    pub last_link_from_flange: Rigid,
    /// Where the arm is of that kind: its inverse is then a closed form.
    pub opw: Option<Opw>,
    /// The base, then one for each joint.
    pub links: Vec<Link>,
    pub gripper: Gripper,
    /// Pairs of bodies, beside neighbours, that are not held against each other.
    pub may_touch: Vec<(usize, usize)>,
    pub ready: JointPositions,
    /// How the inverse is sought where it is no closed form.
    pub numeric: NumericSettings,
}

/// The fingers' name as a body; the gripper's is `gripper`.
pub const FINGERS: &str = "fingers";
pub const GRIPPER: &str = "gripper";

impl Arm {
    pub fn axes(&self) -> usize {
        self.joints.len()
    }

    /// Bodies are the base, the links, the gripper and, as one, the fingers.
    pub fn body_count(&self) -> usize {
        self.links.len() + 2
    }

    pub fn gripper_body(&self) -> usize {
        self.links.len()
    }

    pub fn fingers_body(&self) -> usize {
        self.links.len() + 1
    }

    pub fn body_name(&self, body: usize) -> &str {
        match self.links.get(body) {
            Some(link) => &link.name,
            None if body == self.gripper_body() => GRIPPER,
            None => FINGERS,
        }
    }

    /// # Errors
    /// Names the bodies that there are.
    pub fn body_index(&self, name: &str) -> Result<usize> {
        let names: Vec<&str> = (0..self.body_count()).map(|body| self.body_name(body)).collect();
        let found = names.iter().position(|&other| other == name);
        found.ok_or_else(|| InputError::new(format!("no body {name}")).mend(format!("bodies are {}", names.join(", "))))
    }

    /// The first joint that is outside its limits, and by how much, rad.
    pub fn limit_violation(&self, positions: &[f64]) -> Option<(usize, f64)> {
        let beyond = |joint: &Joint, q: f64| (joint.lower_rad - q).max(q - joint.upper_rad);
        let all = self.joints.iter().zip(positions).enumerate();
        all.map(|(k, (joint, &q))| (k, beyond(joint, q))).find(|&(_, over_rad)| over_rad > 0.0)
    }
}
