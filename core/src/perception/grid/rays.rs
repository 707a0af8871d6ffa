use super::pose::Pose;
use super::quads::Quad;
use std::borrow::Cow;

/// Nearer than this is no reading of a depth camera, metres.
pub const NEAREST_M: f32 = 0.05;
/// Farther than this, or farther aside, neither.
pub const FARTHEST_M: f32 = 1e4;

/// An organized cloud in its camera's frame: x right, y down (of any roll), z along the optical axis, metres.
pub struct Rays<'a> {
    pub points: Cow<'a, [[f32; 3]]>,
    pub width: usize,
    pub height: usize,
    pub input_from_camera: Pose,
}

impl Rays<'_> {
    /// The pixels `x..` of row `y`; those past the image's right end are no readings.
    pub fn quad(&self, x: usize, y: usize) -> Quad {
        let row = &self.points[y * self.width..][..self.width];
        match row[x..].first_chunk() {
            Some(points) => Quad::new(points),
            None => Quad::cut(row, x, self.width),
        }
    }

    /// What the sensor measured: the ray `(u, v, 1)` and the inverse depth q, 1/m.
    pub fn ray(&self, pixel: usize) -> [f64; 3] {
        let [x, y, z] = self.points[pixel];
        let q = 1.0 / z;
        [f64::from(x * q), f64::from(y * q), f64::from(q)]
    }
}
