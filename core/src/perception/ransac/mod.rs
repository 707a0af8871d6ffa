//! The paper's front end: support, Euclidean clusters, sequential RANSAC, for clouds with or without an image grid.

mod base;
mod chain;
pub mod clusters;
pub mod components;
mod crease;
pub mod draws;
pub mod enclosure;
mod footing;
pub mod parting;
mod planes;
mod ring;
pub mod scene_planes;
pub mod sites;
pub mod support;
pub mod surfels;
pub mod voxels;

pub use base::SupportBand;
pub use chain::perceive_by_ransac;
pub use crease::fold;
