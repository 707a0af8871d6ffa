//! Open boxes that segments propose and the depth image judges: walls, rim, then flaps, fitted as one body.

mod answer;
mod ends;
mod evidence;
mod features;
mod find;
mod flap_scan;
mod hidden;
mod judgement;
mod lean;
mod next_view;
mod patch;
mod proposal;
mod refit;
mod shell;
mod sight;
mod surfaces;
mod unseen;
mod upright;
mod yaw;

pub use answer::answer;
pub use features::Features;
pub use judgement::Judgement;
pub use find::{find, shells, FoundBox, Shell};
pub use sight::Sight;
