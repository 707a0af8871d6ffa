//! One articulated body fitted to the readings of an assignment's segments (docs/maths.md, "The fitted body").

mod answer;
mod body;
mod forward;
mod layout;
mod object;
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
mod solve;
mod start;

pub use object::fit_object;
pub use refusal::NotFitted;
pub use settings::FitSettings;

#[cfg(test)]
mod derivative_tests;
#[cfg(test)]
mod recovery_tests;
