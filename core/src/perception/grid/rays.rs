use std::borrow::Cow;

/// Nearer than this is no reading of a depth camera, metres.
const NEAREST_M: f32 = 0.05;

/// An organized cloud in its camera's frame, and what the sensor measures: inverse depth.
pub struct Rays<'a> {
    /// x right, y down (of any roll), z along the optical axis, metres.
    pub points: Cow<'a, [[f32; 3]]>,
    pub width: usize,
    pub height: usize,
    /// 1/z of each reading, 1/m; 0 for none.
    pub inverse_depth: Vec<f32>,
}

impl<'a> Rays<'a> {
    pub fn new(points: Cow<'a, [[f32; 3]]>, width: usize, height: usize) -> Self {
        let inverse = |p: &[f32; 3]| {
            let seen = p[2] > NEAREST_M && p[2] < f32::INFINITY && (p[0] + p[1]).is_finite();
            if seen {
                1.0 / p[2]
            } else {
                0.0
            }
        };
        let inverse_depth = points.iter().map(inverse).collect();
        Self { points, width, height, inverse_depth }
    }

    /// u, v and q of a reading.
    pub fn ray(&self, pixel: usize) -> [f64; 3] {
        let (q, [x, y, _]) = (self.inverse_depth[pixel], self.points[pixel]);
        [f64::from(x * q), f64::from(y * q), f64::from(q)]
    }

    pub fn is_reading(&self, pixel: usize) -> bool {
        self.inverse_depth[pixel] > 0.0
    }
}
