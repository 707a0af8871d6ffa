//! Features phi: what one segment says of being one part (eqs. 2-4 of docs/maths.md). One file for each kind.

mod clearance;
mod existence;
mod fill;
mod location;
mod orientation;
mod share;

pub use clearance::Clearance;
pub use location::{Location, Reference};
pub use orientation::{Direction, Orientation};

use super::SegmentSet;

/// A feature kind with its parameters.
#[derive(Debug, Clone, PartialEq)]
pub enum Feature {
    /// phi 1.
    Orientation(Orientation),
    /// phi 2.
    Location(Location),
    /// phi 3.
    Existence,
    /// phi 4, as all that follow ours.
    Clearance(Clearance),
    /// phi 5.
    Fill,
    /// phi 6.
    Share,
}

impl Feature {
    /// The paper's name of the kind.
    pub fn symbol(&self) -> &'static str {
        match self {
            Self::Orientation(_) => "phi 1",
            Self::Location(_) => "phi 2",
            Self::Existence => "phi 3",
            Self::Clearance(_) => "phi 4",
            Self::Fill => "phi 5",
            Self::Share => "phi 6",
        }
    }

    /// Value for segment `s`; radians, metres or a count, as the kind says.
    pub fn value(&self, set: &SegmentSet, s: usize) -> f64 {
        match self {
            Self::Orientation(orientation) => orientation.value(set, s),
            Self::Location(location) => location.value(set, s),
            Self::Existence => existence::value(),
            Self::Clearance(clearance) => clearance.value(set, s),
            Self::Fill => fill::value(set, s),
            Self::Share => share::value(set, s),
        }
    }
}

/// `tolerance - deviation`, never below `-tolerance`: far beyond the tolerance a worse fit says no more.
pub fn bounded(tolerance: f64, deviation: f64) -> f64 {
    (tolerance - deviation).max(-tolerance)
}
