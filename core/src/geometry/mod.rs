//! Planes, convex hulls and minimum bounding rectangles.

pub mod angles;
mod plane;
mod rectangle;

pub use plane::Plane;
pub use rectangle::Rectangle;

/// A vector or point in metres (or a unit direction), in double precision.
pub type Vec3 = nalgebra::Vector3<f64>;
