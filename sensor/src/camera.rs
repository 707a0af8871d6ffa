//! The camera and the parameters of its errors.

use crate::SensorError;

/// Camera and error model; the defaults are a Kinect at VGA.
#[derive(Clone, Debug)]
pub struct Kinect {
    pub width: usize,
    pub height: usize,
    pub fx: f64,
    pub fy: f64,
    pub cx: f64,
    pub cy: f64,
    /// From the camera to the projector on its left, metres.
    pub baseline_m: f64,
    pub min_depth_m: f64,
    pub max_depth_m: f64,
    pub disparity_step_px: f64,
    /// Standard deviations of the disparity's noise, pixels: for each pixel alone, in patches, in slow ripples.
    pub white_px: f64,
    pub patchy_px: f64,
    pub ripple_px: f64,
    /// Half the width of a ray's random place in its pixel.
    pub ray_jitter_px: f64,
    /// Share of the readings beside a depth edge that mix both sides, and of those that take a neighbour's.
    pub flying_share: f64,
    pub edge_swap_share: f64,
    /// Readings begin to be lost at the first angle of incidence and are all lost at the second, degrees.
    pub grazing_from_deg: f64,
    pub grazing_all_deg: f64,
}

impl Default for Kinect {
    fn default() -> Self {
        Self {
            width: 640,
            height: 480,
            fx: 575.8,
            fy: 575.8,
            cx: 319.5,
            cy: 239.5,
            baseline_m: 0.075,
            min_depth_m: 0.45,
            max_depth_m: 4.5,
            disparity_step_px: 0.125,
            white_px: 0.045,
            patchy_px: 0.055,
            ripple_px: 0.030,
            ray_jitter_px: 0.5,
            flying_share: 0.12,
            edge_swap_share: 0.35,
            grazing_from_deg: 72.0,
            grazing_all_deg: 89.0,
        }
    }
}

impl Kinect {
    /// The same camera with so many times the noise.
    pub fn with_noise(self, times: f64) -> Self {
        let (white_px, patchy_px, ripple_px) = (self.white_px, self.patchy_px, self.ripple_px);
        Self { white_px: times * white_px, patchy_px: times * patchy_px, ripple_px: times * ripple_px, ..self }
    }

    /// # Errors
    /// [`SensorError`] naming the parameter that cannot be.
    pub fn check(&self) -> Result<(), SensorError> {
        let positive = [
            ("fx", self.fx),
            ("fy", self.fy),
            ("baseline_m", self.baseline_m),
            ("disparity_step_px", self.disparity_step_px),
        ];
        if let Some((name, value)) = positive.into_iter().find(|(_, v)| !(*v > 0.0 && v.is_finite())) {
            return Err(SensorError::new(format!("{name} is {value}: expected a positive number")));
        }
        let (w, h) = (self.width, self.height);
        if w == 0 || h == 0 || w > 1 << 14 || h > 1 << 14 {
            return Err(SensorError::new(format!("image of {w} x {h} pixels: expected 1 to 16384 each way")));
        }
        if !(0.0 < self.min_depth_m && self.min_depth_m < self.max_depth_m) {
            return Err(SensorError::new(format!(
                "range {} to {} m: expected 0 < min < max",
                self.min_depth_m, self.max_depth_m
            )));
        }
        let noise = [("white_px", self.white_px), ("patchy_px", self.patchy_px), ("ripple_px", self.ripple_px)];
        if let Some((name, value)) = noise.into_iter().find(|(_, v)| !(*v >= 0.0 && v.is_finite())) {
            return Err(SensorError::new(format!("{name} is {value}: expected 0 or more")));
        }
        if self.grazing_from_deg.partial_cmp(&self.grazing_all_deg) != Some(std::cmp::Ordering::Less) {
            return Err(SensorError::new("grazing_from_deg must lie below grazing_all_deg"));
        }
        Ok(())
    }

    pub(crate) fn disparity_px(&self, depth_m: f64) -> f64 {
        self.fx * self.baseline_m / depth_m
    }
}
