//! Open boxes that segments propose and the depth image judges: walls, rim, then flaps, fitted as one body (docs/maths.md,
//! "Whole boxes").

mod answer;
mod choose;
mod ends;
mod evidence;
mod features;
mod find;
mod flap_scan;
mod grow;
mod hanging;
mod judgement;
mod lean;
mod patch;
mod proposal;
mod refit;
mod shell;
mod shells;
mod sight;
mod start;
mod sure;
mod surfaces;
mod upright;
mod yaw;

pub use answer::answer;
pub use features::Features;
pub use find::find;
pub use grow::FoundBox;
pub use judgement::Judgement;
pub use sight::Sight;
