use super::settings::FitSettings;
use crate::cloud::CloudView;
use crate::geometry::Vec3;

/// Range taken where nobody knows the viewpoint, metres.
const UNKNOWN_RANGE_M: f64 = 0.8;
/// Neighbouring readings that the pixel's size is measured on, at most.
const PAIRS: usize = 200;
/// Edges that run almost at the sensor would have no end of blur.
const LEAST_SLANT: f64 = 0.2;

/// The readings, and how well the sensor knows them.
#[derive(Debug, Clone, Copy)]
pub struct Sensor<'a> {
    points: &'a [[f32; 3]],
    pub viewpoint: Option<Vec3>,
    pixel_rad: f64,
}

impl<'a> Sensor<'a> {
    /// `sample`: indices, in the cloud's order, of readings that lie side by side on one surface.
    pub fn new(cloud: &CloudView<'a>, sample: &[u32], settings: &FitSettings) -> Self {
        let mut out = Self { points: cloud.points, viewpoint: cloud.viewpoint, pixel_rad: settings.pixel_rad };
        if cloud.is_organized() {
            out.pixel_rad = out.angle_between_neighbours(sample).unwrap_or(settings.pixel_rad);
        }
        out
    }

    pub fn point(&self, index: u32) -> Vec3 {
        Vec3::from(self.points[index as usize].map(f64::from))
    }

    fn angle_between_neighbours(&self, sample: &[u32]) -> Option<f64> {
        let viewpoint = self.viewpoint?;
        let step = sample.len() / PAIRS + 1;
        let neighbours = sample.windows(2).step_by(step).filter(|pair| pair[1] == pair[0] + 1);
        let ray = |index: u32| (self.point(index) - viewpoint).normalize();
        let mut angles: Vec<f64> = neighbours.map(|pair| (ray(pair[0]) - ray(pair[1])).norm()).collect();
        angles.sort_unstable_by(f64::total_cmp);
        angles.get(angles.len() / 2).copied()
    }

    fn ray(&self, p: &Vec3) -> Option<(f64, Vec3)> {
        let ray = p - self.viewpoint?;
        let range = ray.norm();
        Some((range, ray.try_normalize(1e-9)?))
    }

    /// Standard deviation of the reading off a plane of that normal (eq. 80).
    pub fn sigma_m(&self, p: &Vec3, normal: &Vec3, settings: &FitSettings) -> f64 {
        let (range, cos) = self.ray(p).map_or((UNKNOWN_RANGE_M, 1.0), |(range, ray)| (range, ray.dot(normal).abs()));
        let in_depth = settings.inverse_depth_sigma * range * cos;
        let in_ray = settings.ray_sigma_px * self.pixel_rad * (1.0 - cos * cos).max(0.0).sqrt();
        range * in_depth.hypot(in_ray)
    }

    /// How far a pixel reaches along a direction on a surface there, metres.
    pub fn pixel_m(&self, p: &Vec3, direction: &Vec3) -> f64 {
        let (range, slant) = self.ray(p).map_or((UNKNOWN_RANGE_M, 1.0), |(range, ray)| {
            (range, (direction - ray * ray.dot(direction)).norm().max(LEAST_SLANT))
        });
        self.pixel_rad * range / slant
    }
}
