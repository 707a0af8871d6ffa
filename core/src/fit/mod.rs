//! One articulated body fitted to the readings of an assignment's segments (docs/maths.md, "The fitted body").

mod answer;
mod block;
mod body;
mod covariance;
mod factor;
mod forward;
mod known_size;
pub(crate) mod layout;
mod linearized;
mod object;
mod other_view;
mod panel;
mod priors;
mod problem;
mod readings;
mod refusal;
mod rim;
mod roles;
mod row;
mod sensor;
mod settings;
mod sheet;
mod size_warnings;
mod solve;
mod start;
mod wall_lean;

pub use body::{edge_place, FittedBody};
pub use forward::corners;
pub use known_size::{KnownSize, SizeMatch};
pub use object::fit_object;
pub use refusal::NotFitted;
pub use rim::{AtRim, Rim};
pub use roles::Role;
pub use settings::{FitSettings, SigmaScales};
pub use size_warnings::size_warnings;

pub(crate) use answer::fill;
pub(crate) use body::Parameters;
pub(crate) use forward::flap_end;
pub(crate) use known_size::{best_match, best_match_within, share_of_score, with_known_size};
pub(crate) use layout::lean_name;
pub(crate) use object::{canonical_turn, check};
pub(crate) use other_view::{OtherView, PlaceSigma};
pub(crate) use priors::{kept_length, lid_length, lid_length_m, priors, Prior};
pub(crate) use problem::{Problem, Support};
pub(crate) use readings::{FaceReading, PartEnds, PartReadings, PartSegment};
pub(crate) use sensor::Sensor;
pub(crate) use solve::{solve, Solution};
pub(crate) use start::start;
pub(crate) use wall_lean::wall_lean;

#[cfg(test)]
mod derivative_tests;
#[cfg(test)]
mod known_size_tests;
#[cfg(test)]
mod other_view_tests;
#[cfg(test)]
mod recovery_tests;
#[cfg(test)]
mod wall_lean_tests;
