//! How an arm closes a box: which flaps in which order, pushed how, and why not.
//!
//! Geometry of flaps and fingers (`flap`, `touch`, `contact`), the layered search of one push (`layers`, `push`), the ways to it and
//! between flaps (`line`, `transit`), the order (`boards`, `ends`, `rims`, `order`, `closing`), times (`timing`); beside them the planner of 2011 (`planes`)
//! and brute force (`exhaustive`), which tables hold the planner against. Metres, radians, the robot's base frame.

mod answer;
mod astride;
mod beam;
mod boards;
mod closing;
mod contact;
mod effort;
mod ends;
mod exhaustive;
mod first_layer;
mod flap;
mod fork;
mod guard;
mod hold;
mod known;
mod layers;
mod line;
mod load;
mod order;
mod orientations;
mod piece;
mod planes;
mod posture;
mod problem;
mod push;
mod pushes;
mod reached;
mod reason;
mod request;
mod rims;
#[cfg(test)]
mod sample_box;
mod searches;
mod settings;
mod stages;
mod surroundings;
mod timing;
mod touch;
mod transit;

pub use answer::{Answer, Conflict, FlapAnswer, Segment};
pub use boards::quads_cross;
pub use closing::{Closer, Closing, Outcome};
pub use contact::{Contacts, Grip};
pub use flap::{Flap, FlapFrame, Standing};
pub use guard::{Guard, Moment};
pub use known::Margins;
pub use load::{Assumed, Fold, Load, Stand};
pub use piece::{Kind, Piece};
pub use problem::{Board, BoxProblem, MeasuredBox, MeasuredFlap};
pub use push::{closed_finger, PushMotion, Pusher};
pub use reason::{Obstacle, Status, WhyNot};
pub use request::{Method, Request, SceneBox};
pub use settings::PlanningSettings;
pub use surroundings::Surroundings;
pub use timing::{time, Bounds, Timed};
pub use touch::Finger;
