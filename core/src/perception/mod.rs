//! From a cloud to planar segments with rectangles. Knows no template: meaning begins in `model`.

pub(crate) mod clock;
mod grid;
mod outline;
mod perceive;
mod ransac;
pub(crate) mod readings;
mod scene;
mod segment;
mod settings;
mod sides;
mod voxel;

pub use perceive::perceive;
pub use scene::{EdgeKind, Scene, Segments, BACKGROUND};
pub use settings::{PerceptionSettings, PlaneFinder};
