//! Planes, convex hulls, minimum bounding rectangles, rigid motions.

pub mod angles;
mod bounding;
mod hull;
mod moments;
mod plane;
mod plane_frame;
mod rectangle;
pub mod rigid;
mod rng;

pub use bounding::{minimum_rectangle, Rectangle2};
pub use hull::{convex_hull, convex_hull_of_sorted, hull_contains, Point2};
pub use moments::Moments;
pub use plane::Plane;
pub use plane_frame::PlaneFrame;
pub use rectangle::Rectangle;
pub use rigid::Rigid;
pub use rng::SplitMix64;

/// A vector or point in metres (or a unit direction), in double precision.
pub type Vec3 = nalgebra::Vector3<f64>;
