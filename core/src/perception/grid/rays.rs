use super::pose::Pose;
use super::quads::{Quad, QUAD};
use std::borrow::Cow;

/// An organized cloud in its camera's frame: x right, y down (of any roll), z along the optical axis, metres.
pub struct Rays<'a> {
    pub points: Cow<'a, [[f32; 3]]>,
    pub width: usize,
    pub height: usize,
    pub input_from_camera: Pose,
}

impl Rays<'_> {
    /// The pixels `x..` of row `y`; those past the image's right end are no readings.
    #[inline]
    pub fn quad(&self, x: usize, y: usize) -> Quad {
        let start = y * self.width + x;
        let coordinates = self.points[start..].as_flattened();
        match coordinates.first_chunk() {
            Some(four) if x + QUAD <= self.width => Quad::new(four),
            _ => Quad::cut(&self.points, start, (y + 1) * self.width),
        }
    }

    /// What the sensor measured: the ray `(u, v, 1)` and the inverse depth q, 1/m.
    pub fn ray(&self, pixel: usize) -> [f64; 3] {
        let [x, y, z] = self.points[pixel];
        let q = 1.0 / z;
        [f64::from(x * q), f64::from(y * q), f64::from(q)]
    }
}
