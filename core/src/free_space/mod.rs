//! Every ray speaks: what the camera looked through is not there, what lies behind a nearer surface is hidden.

mod facet;
mod look;
mod state;

pub use facet::Facet;
pub use look::{look, Looked};
pub use state::PartState;
