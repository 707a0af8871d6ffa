//! The arm's shapes against a world of convex pieces, and against one another: is it clear, how far is it, what is nearest.
//! Signed distances in metres: below 0 is the least shift that parts two pieces. No query allocates.

mod boxes;
mod capsules;
mod checker;
mod nearest;
mod oriented_box;
mod pair;
mod pieces;
mod rules;
mod segment_box;
mod solid;
mod world;

pub use checker::Checker;
pub use nearest::{Nearest, Other};
pub use oriented_box::OrientedBox;
pub use pair::{clear_by, signed_distance_m};
pub use pieces::{ArmPieces, Placed, MAX_PIECES};
pub use rules::{Rules, IGNORED};
pub use solid::{Capsule, HalfSpace, Solid};
pub use world::{Obstacle, World};
