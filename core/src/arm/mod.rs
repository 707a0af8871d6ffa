//! Arms as data, where their links are at given joint positions, and which joint positions put the tool somewhere.
//! The constant [`Arm`] is apart from its state, [`JointPositions`]. Metres, radians, the base's frame (docs/robots.md).

mod branches;
mod check;
mod file;
mod forward;
mod gripper;
mod inverse;
mod jacobian;
mod joint;
mod model;
mod numeric;
mod numeric_settings;
mod opw;
mod positions;
mod read;
mod shape;
mod wraps;

pub use branches::{Branch, Branches, Singular};
pub use gripper::Gripper;
pub use inverse::{Solution, Solutions, MAX_SOLUTIONS};
pub use jacobian::Jacobian;
pub use joint::{Joint, Limits};
pub use model::{Arm, Link, FINGERS};
pub use numeric_settings::NumericSettings;
pub use opw::Opw;
pub use positions::{JointPositions, MAX_AXES};
pub use shape::Shape;
