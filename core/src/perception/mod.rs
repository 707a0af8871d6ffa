//! From a cloud to planar segments with rectangles. Knows no template: meaning begins in `model`.

mod base;
mod clusters;
mod components;
mod crease;
mod enclosure;
mod footing;
mod outline;
mod parting;
mod perceive;
mod planes;
mod ransac;
mod readings;
mod scene;
mod scene_planes;
mod segment;
mod settings;
mod sites;
mod support;
mod voxels;

pub use perceive::perceive;
pub use scene::{Scene, Segments};
pub use settings::PerceptionSettings;
