//! The exact search: the best of all assignments, every relation in, with a proof or with the gap that is left
//! (docs/maths.md, "Exact inference").

mod ascent;
mod checks;
mod factors;
mod incumbents;
mod marginals;
mod prices;
mod problem;
mod rules;
mod search;
mod settings;
mod shortlist;
mod solve;
mod sum;
mod symmetry;
mod tighten;

pub use marginals::{marginals, Marginals};
pub use rules::Rules;
pub use settings::ExactSettings;
pub use solve::{solve, Solution};
