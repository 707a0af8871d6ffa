use super::PerceptionSettings;
use crate::cloud::CloudView;
use crate::error::{InputError, Result};
use crate::geometry::Vec3;

/// Coordinates beyond this are no reading of a depth sensor, metres.
const FARTHEST_COORDINATE_M: f32 = 1e4;

/// Range taken for every reading where nobody knows the viewpoint, metres.
const UNKNOWN_RANGE_M: f64 = 0.8;

/// The finite readings of a cloud, and how well each is known.
#[derive(Debug, Clone, Copy)]
pub struct Readings<'a> {
    pub points: &'a [[f32; 3]],
    pub viewpoint: Option<Vec3>,
    settings: &'a PerceptionSettings,
    /// How much noisier the readings are than the settings say, at least 1.
    noise_scale: f64,
}

impl<'a> Readings<'a> {
    pub fn new(cloud: &CloudView<'a>, settings: &'a PerceptionSettings) -> Self {
        Self { points: cloud.points, viewpoint: cloud.viewpoint, settings, noise_scale: 1.0 }
    }

    /// Other readings, of which as much is known.
    pub fn of_other_points<'b>(&self, cloud: &CloudView<'b>) -> Readings<'b>
    where
        'a: 'b,
    {
        Readings {
            points: cloud.points,
            viewpoint: cloud.viewpoint,
            settings: self.settings,
            noise_scale: self.noise_scale,
        }
    }

    /// Indices of the readings, in input order.
    ///
    /// # Errors
    /// `InputError` where there is none.
    pub fn finite_indices(&self) -> Result<Vec<u32>> {
        let indices: Vec<u32> = (0..self.points.len() as u32).filter(|&i| self.is_reading(i)).collect();
        if indices.is_empty() {
            return Err(Self::none_among(self.points.len()));
        }
        Ok(indices)
    }

    pub fn is_reading(&self, index: u32) -> bool {
        Self::is_finite(&self.points[index as usize])
    }

    #[inline]
    pub fn is_finite(p: &[f32; 3]) -> bool {
        p.iter().all(|c| c.abs() < FARTHEST_COORDINATE_M)
    }

    /// The error for a cloud without a reading.
    pub fn none_among(points: usize) -> InputError {
        let problem = format!("no finite readings among {points} points");
        InputError::new(problem).mend("a point needs three finite coordinates in metres")
    }

    pub fn point(&self, index: u32) -> Vec3 {
        let [x, y, z] = self.points[index as usize];
        Vec3::new(f64::from(x), f64::from(y), f64::from(z))
    }

    /// Distance from the sensor, metres.
    pub fn range_m(&self, p: &Vec3) -> f64 {
        self.viewpoint.map_or(UNKNOWN_RANGE_M, |v| (p - v).norm())
    }

    pub fn tolerance_m(&self, p: &Vec3) -> f64 {
        self.settings.tolerance_m(self.sigma_m(p))
    }

    /// Readings nearer than this to each other belong to one thing, before the noise is counted.
    pub fn cluster_gap_m(&self) -> f64 {
        self.settings.cluster_gap_m
    }

    /// Standard deviation of the reading, metres.
    pub fn sigma_m(&self, p: &Vec3) -> f64 {
        self.sigma_at_range_m(self.range_m(p))
    }

    /// The same for a reading at that distance from the sensor.
    pub fn sigma_at_range_m(&self, range_m: f64) -> f64 {
        self.noise_scale * self.settings.sigma_m(range_m)
    }

    /// Takes the readings to be this many times noisier than the settings say.
    pub fn scale_noise(&mut self, noise_scale: f64) {
        self.noise_scale = noise_scale;
    }
}
