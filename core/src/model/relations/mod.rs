//! Relations Gamma and gamma: what two segments say of being two parts (eqs. 5-9 of docs/maths.md). One file for each kind.

mod aside;
mod connectivity;
mod hinge;
mod level;
mod location;
mod orientation;
mod parallel;
mod rectangular;
mod width;

pub use aside::Aside;
pub use connectivity::Connectivity;
pub use hinge::Hinge;
pub use level::Level;
pub use location::RelativeLocation;
pub use orientation::RelativeOrientation;
pub use parallel::Parallel;
pub use rectangular::Rectangular;

use super::SegmentSet;

/// A relation kind with its parameters.
#[derive(Debug, Clone, PartialEq)]
pub enum Relation {
    /// Gamma 1.
    Orientation(RelativeOrientation),
    /// Gamma 2.
    Location(RelativeLocation),
    /// Gamma 3.
    Connectivity(Connectivity),
    /// gamma 4.
    Rectangular(Rectangular),
    /// gamma 5.
    Parallel(Parallel),
    /// Gamma 6, as all that follow ours.
    Level(Level),
    /// Gamma 7.
    Hinge(Hinge),
    /// Gamma 8.
    Width,
    /// Gamma 9.
    Aside(Aside),
}

impl Relation {
    /// The paper's name of the kind.
    pub fn symbol(&self) -> &'static str {
        match self {
            Self::Orientation(_) => "Gamma 1",
            Self::Location(_) => "Gamma 2",
            Self::Connectivity(_) => "Gamma 3",
            Self::Rectangular(_) => "gamma 4",
            Self::Parallel(_) => "gamma 5",
            Self::Level(_) => "Gamma 6",
            Self::Hinge(_) => "Gamma 7",
            Self::Width => "Gamma 8",
            Self::Aside(_) => "Gamma 9",
        }
    }

    /// Value for segments `a` and `b` as first and second part of a pair; radians or metres, as the kind says.
    pub fn value(&self, set: &SegmentSet, a: usize, b: usize) -> f64 {
        match self {
            Self::Orientation(relation) => relation.value(set, a, b),
            Self::Location(relation) => relation.value(set, a, b),
            Self::Connectivity(relation) => relation.value(set, a, b),
            Self::Rectangular(relation) => relation.value(set, a, b),
            Self::Parallel(relation) => relation.value(set, a, b),
            Self::Level(relation) => relation.value(set, a, b),
            Self::Hinge(relation) => relation.value(set, a, b),
            Self::Width => width::value(set, a, b),
            Self::Aside(relation) => relation.value(set, a, b),
        }
    }
}
