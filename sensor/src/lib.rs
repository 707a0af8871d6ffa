//! A depth camera that looks at triangles: exact depth by ray casting, then a Kinect's errors.
//!
//! Shares no code with `boxwright-core` on purpose: what measures perception must not contain it.
//! Everything is in the camera's optical frame (x right, y down, z forward), in metres and pixels.

mod bvh;
mod camera;
mod cast;
mod clearance;
mod error;
mod field;
mod frustum;
mod kinect;
mod random;
mod shade;
mod vector;

pub use camera::Kinect;
pub use cast::{cast_exact, Hit};
pub use clearance::close_groups;
pub use error::SensorError;
pub use kinect::{simulate, Reading};
pub use shade::Rgb;

/// Three corners in metres.
pub type Triangle = [[f64; 3]; 3];

/// What the rays meet: triangles, each with the id of the surface it is a part of and its colour.
pub struct Scene<'a> {
    pub triangles: &'a [Triangle],
    pub surface_ids: &'a [i32],
    pub colors: &'a [Rgb],
}

impl Scene<'_> {
    /// One id and one colour for each triangle, all coordinates finite.
    ///
    /// # Errors
    /// [`SensorError`] naming the array that does not fit.
    pub fn check(&self) -> Result<(), SensorError> {
        let count = self.triangles.len();
        for (name, len) in [("surface_ids", self.surface_ids.len()), ("colors", self.colors.len())] {
            if len != count {
                return Err(SensorError::new(format!(
                    "{name} has {len} entries: expected one for each of {count} triangles"
                )));
            }
        }
        match self.triangles.iter().position(|t| t.iter().flatten().any(|c| !c.is_finite())) {
            Some(at) => Err(SensorError::new(format!("triangle {at} has a coordinate that is not finite"))),
            None => Ok(()),
        }
    }
}
