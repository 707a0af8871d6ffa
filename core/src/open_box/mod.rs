//! Open boxes that segments propose and the depth image judges: walls, rim, then flaps, fitted as one body (docs/maths.md,
//! "Whole boxes").

mod answer;
mod assignments;
mod choose;
mod closed;
mod closed_box;
mod crease;
mod edge_on;
mod ends;
mod evidence;
mod features;
mod find;
mod finish;
mod flap_scan;
mod grow;
mod hanging;
mod hidden;
mod hinge_line;
mod judgement;
mod kind;
mod label;
mod labels;
mod lean;
mod lids;
mod next_view;
mod owners;
mod patch;
mod patch_flaps;
mod proposal;
mod recast;
mod refit;
mod refused;
mod rim_lines;
mod rims;
mod same;
mod settle;
mod shape;
mod shell;
mod shells;
mod sight;
mod slots;
mod start;
mod sure;
mod surfaces;
mod trees;
mod unseen;
mod upright;
mod views;
mod yaw;

pub use answer::{answer, PartReadings};
pub use assignments::Assignments;
pub use closed::may_be_closed;
pub use closed_box::find_closed;
pub use features::Features;
pub use find::{find, Found};
pub use grow::FoundBox;
pub use judgement::Judgement;
pub use kind::{closed_boxes, open_boxes, Kinds};
pub use recast::recast;
pub use refused::{Refusal, Refused};
pub use shape::{Shape, SHAPE_FEATURES};
pub use sight::Sight;
pub use views::{fuse, Fused, View};

#[cfg(test)]
mod kind_tests;
