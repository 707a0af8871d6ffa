use std::fmt;

/// Why a body could not be fitted.
#[derive(Debug, Clone, PartialEq)]
pub enum NotFitted {
    /// The template's body is no open box, or too few sides were seen for one.
    NoBox,
    Singular,
    StepsSpent(usize),
    NoStepBetters,
    /// It reaches into what it stands on.
    Sunk,
    /// A number of the body that no box has.
    Absurd {
        name: &'static str,
        value: f64,
    },
}

impl fmt::Display for NotFitted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoBox => write!(f, "there is no open box to fit"),
            Self::Singular => write!(f, "the readings leave the body undetermined"),
            Self::StepsSpent(steps) => write!(f, "it had not converged after {steps} steps"),
            Self::NoStepBetters => write!(f, "no step bettered it before it had converged"),
            Self::Sunk => write!(f, "it reaches into what it stands on"),
            Self::Absurd { name, value } => write!(f, "its {name} came out as {value:.4}"),
        }
    }
}
