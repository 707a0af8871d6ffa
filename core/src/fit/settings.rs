/// What the fit takes for granted; every default of it is here and nowhere else. Metres, radians.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FitSettings {
    /// Readings of one part that are held against its face, at most.
    pub face_samples: usize,
    /// Strips across one end of a part, each of which shows where the part ends there, at most.
    pub end_strips: usize,
    /// Standard deviation of inverse depth, 1/m, and of the ray in pixels: as of `grid`'s noise for sensors of this class.
    pub inverse_depth_sigma: f64,
    pub ray_sigma_px: f64,
    /// Angle between neighbouring pixels where the cloud does not tell: VGA over 60 degrees.
    pub pixel_rad: f64,
    /// Readings that share one error: the sensor's matching window. And what a face says at most, however many there are: slow
    /// errors of the sensor and boards that are not quite flat stay.
    pub readings_that_agree: f64,
    pub most_face_information: f64,
    pub most_end_information: f64,
    /// How far ends are blurred besides the pixel's size: cut edges, and where two boards meet in a fold.
    pub edge_sigma_m: f64,
    pub crease_sigma_m: f64,
    /// By how much a panel reaches beyond its last reading, pixels.
    pub last_pixel: f64,
    /// How well a box stands on its support, and how far above it a box stands on something else.
    pub support_sigma_m: f64,
    pub support_sigma_rad: f64,
    pub stands_on_support_m: f64,
    /// How well a further view's place among the others is known: an arm with a calibrated camera.
    pub place_sigma_m: f64,
    pub place_sigma_rad: f64,
    /// Residuals beyond this many standard deviations lose their say (Cauchy), at first and at last.
    pub coarse_cuts: &'static [f64],
    pub last_cut: f64,
    pub max_steps: usize,
    /// A step that would better the sum of squares by less is the last.
    pub least_gain: f64,
    /// Standard deviations are the curvature's times these: of what was seen, and of what follows from it.
    pub seen_scale: SigmaScales,
    pub unseen_scale: SigmaScales,
}

/// By how much more than the curvature says the fit errs, by what is told (`benchmarks/coverage.py` learns them).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SigmaScales {
    /// Of all sizes and shapes.
    pub dimension: f64,
    /// Of a hinge: its origin, its axis, its position.
    pub origin: f64,
    pub axis: f64,
    pub position: f64,
}

impl Default for FitSettings {
    fn default() -> Self {
        Self {
            face_samples: 100,
            end_strips: 24,
            inverse_depth_sigma: 0.0019,
            ray_sigma_px: 0.55,
            pixel_rad: 0.0019,
            readings_that_agree: 25.0,
            most_face_information: 25.0,
            most_end_information: 8.0,
            edge_sigma_m: 0.0015,
            crease_sigma_m: 0.006,
            last_pixel: 0.5,
            support_sigma_m: 0.003,
            support_sigma_rad: 0.01,
            stands_on_support_m: 0.05,
            place_sigma_m: 0.002,
            place_sigma_rad: 0.0035,
            coarse_cuts: &[12.0, 6.0],
            last_cut: 3.0,
            max_steps: 60,
            least_gain: 1e-4,
            seen_scale: SigmaScales { dimension: 2.57, origin: 2.39, axis: 1.35, position: 1.68 },
            unseen_scale: SigmaScales { dimension: 3.3, origin: 2.29, axis: 1.25, position: 1.65 },
        }
    }
}
