//! Relations Gamma and gamma: what two segments say of being two parts (eqs. 5-9 of docs/maths.md). One file for each kind.

mod connectivity;
mod location;
mod orientation;
mod parallel;
mod rectangular;

pub use connectivity::Connectivity;
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
        }
    }
}
