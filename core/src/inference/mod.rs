//! Search for the best assignments of segments to parts (the paper's section on inference; docs/maths.md, "Inference").
//!
//! States: part `p` is in state 0 where it stays empty, and in state `s + 1` where it takes member `s` of the segment set.

mod completion;
mod exact;
mod exhaustive;
mod graph;
mod objects;
mod potentials;
mod queue;
mod settings;
mod staged;

pub use exact::{marginals, solve, ExactSettings, Marginals, Rules, Solution};
pub use exhaustive::best_exhaustive;
pub use graph::{RelationGraph, SearchPlan, SearchPlans};
pub use objects::{find_objects, likely_assignments, FoundMarginals, FoundObject, FoundObjects, ObjectModel};
pub use potentials::{Edge, Potentials};
pub use settings::{SearchMethod, SearchSettings};
pub use staged::{rank_staged, Candidate, Ranking, StagedSettings};
