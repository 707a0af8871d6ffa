//! Boxes that were found and are not told.

use std::fmt;

use nalgebra::Isometry3;

use crate::fit::{layout, FittedBody, NotFitted};

/// A candidate, in the level frame, and why it is no object.
#[derive(Debug, Clone)]
pub struct Refused {
    pub body: FittedBody,
    pub why: Refusal,
}

#[derive(Debug, Clone, PartialEq)]
pub enum Refusal {
    /// Its last fit did not end in a box.
    NotFitted(NotFitted),
    /// So many of its panels were seen, fewer than these.
    FewPanels { seen: usize, least: usize },
    /// Nothing that was seen of it tells it from a closed box.
    MayBeClosed,
    /// Its probability, and the least that is told.
    Improbable { probability: f64, least: f64 },
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFitted(why) => write!(f, "{why}"),
            Self::FewPanels { seen, least } => write!(f, "{seen} of its panels were seen; a box needs {least}"),
            Self::MayBeClosed => write!(f, "all that was seen of it could be the outside of a closed box"),
            Self::Improbable { probability, least } => {
                write!(f, "that it is a box has probability {probability:.2}; told are those of {least} and more")
            }
        }
    }
}

impl Refused {
    /// One line: which candidate, by its size and where its base's middle is, and why.
    pub fn line(&self, input_from_level: &Isometry3<f64>) -> String {
        let [l, w, h] = [layout::LENGTH, layout::WIDTH, layout::HEIGHT].map(|place| 1000.0 * self.body.get(place));
        let at = (input_from_level * self.body.input_from_object).translation.vector;
        format!("no object at ({:.2}, {:.2}, {:.2}) m, {l:.0} x {w:.0} x {h:.0} mm: {}", at.x, at.y, at.z, self.why)
    }
}
