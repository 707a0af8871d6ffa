use super::super::readings::Readings;
use crate::error::Result;
use crate::geometry::Vec3;

/// Where the readings of a cloud are.
#[derive(Debug, Clone, Copy)]
pub struct Bounds {
    pub low: Vec3,
    pub high: Vec3,
    pub readings: usize,
}

impl Bounds {
    /// # Errors
    /// `InputError` where the cloud has no reading.
    pub fn of(points: &[[f32; 3]]) -> Result<Self> {
        let (mut low, mut high, mut readings) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3], 0);
        for p in points.iter().filter(|p| Readings::is_finite(p)) {
            readings += 1;
            for k in 0..3 {
                low[k] = low[k].min(p[k]);
                high[k] = high[k].max(p[k]);
            }
        }
        if readings == 0 {
            return Err(Readings::none_among(points.len()));
        }
        Ok(Self { low: Vec3::from(low.map(f64::from)), high: Vec3::from(high.map(f64::from)), readings })
    }

    /// Longest side, metres.
    pub fn extent_m(&self) -> f64 {
        (self.high - self.low).max()
    }
}
