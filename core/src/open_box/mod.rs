//! Open boxes that segments propose and the depth image judges: walls, rim, then flaps, fitted as one body.

mod answer;
mod ends;
mod evidence;
mod find;
mod flap_scan;
mod kind;
mod lean;
mod patch;
mod proposal;
mod recast;
mod refit;
mod shape;
mod shell;
mod sight;
mod surfaces;
mod upright;
mod yaw;

pub use answer::answer;
pub use find::{debug, find, shells, FoundBox, Shell};
pub use kind::{open_boxes, Kinds};
pub use recast::recast;
pub use shape::{Shape, SHAPE_FEATURES};
pub use sight::Sight;

#[cfg(test)]
mod kind_tests;
