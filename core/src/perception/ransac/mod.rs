//! The paper's front end: support, Euclidean clusters, sequential RANSAC, for clouds with or without an image grid.

mod base;
mod chain;
mod clusters;
mod components;
mod crease;
mod draws;
mod enclosure;
mod footing;
mod parting;
mod planes;
mod scene_planes;
mod sites;
mod support;
mod voxels;

pub use chain::perceive_by_ransac;
