//! The arm's way in pieces, each for one purpose.

use crate::arm::JointPositions;
use crate::geometry::Vec3;

/// What a piece of the arm's way is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    Transit,
    Approach,
    Push,
    Retreat,
}

/// A piece of the way without times: postures with clear lines between them.
#[derive(Debug, Clone)]
pub struct Piece {
    pub kind: Kind,
    /// None in transit.
    pub flap: Option<usize>,
    pub positions: Vec<JointPositions>,
    /// In a push: of each posture the hinge's angle, rad, and the point of touch, base frame.
    pub hinge_rad: Vec<f64>,
    pub contact: Vec<Vec3>,
    /// Where all flaps are meanwhile, rad; in a push the pushed one moves.
    pub angles_rad: Vec<f64>,
    /// The free gap between the fingers.
    pub opening_m: f64,
}

impl Piece {
    pub fn new(
        kind: Kind,
        flap: Option<usize>,
        positions: Vec<JointPositions>,
        angles_rad: Vec<f64>,
        opening_m: f64,
    ) -> Self {
        Self { kind, flap, positions, hinge_rad: Vec::new(), contact: Vec::new(), angles_rad, opening_m }
    }
}

impl Kind {
    pub fn name(self) -> &'static str {
        match self {
            Self::Transit => "transit",
            Self::Approach => "approach",
            Self::Push => "push",
            Self::Retreat => "retreat",
        }
    }
}
