//! The front end for clouds without an image grid: planes grow on sums over small cubes of space.
//!
//! Readings are added up as whole numbers, and all that follows goes by place: no answer depends on the order of the input.

mod bases;
mod bounds;
mod chain;
mod eigen;
mod faces;
mod fixed;
mod fixed_fit;
mod flatness;
mod folds;
mod ground;
mod groups;
mod labels;
mod lattice;
mod merge;
mod neighbours;
mod outlines;
mod pairs;
mod readings_by_place;
mod segments;
mod spacing;
mod surfaces;
mod table;
mod things;
mod voxels;

pub use chain::perceive_on_voxels;
