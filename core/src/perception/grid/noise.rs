use super::cells::{Cells, CELL_PX, FULL};
use super::ray_moments::{RayMoments, RayPlane};

/// Side of the squares that the noise is measured on, in cells, and how many of them are needed.
const SQUARE_CELLS: usize = 4;
const MIN_SQUARES: usize = 12;
/// Flat squares are among the smoothest: the others hold edges.
const SMOOTH_QUANTILE: f64 = 0.4;
/// A square counts where it is this full.
const MIN_FULL_SHARE: f64 = 0.9;
/// What disparity sensors of this class have, 1/m; taken where too little is seen, and bounds for what is measured.
const TYPICAL: f64 = 0.0019;
const LEAST: f64 = 0.0003;
const MOST: f64 = 0.006;
/// Of a VGA camera that sees 60 degrees.
const TYPICAL_PITCH: f64 = 0.0019;
/// Variance of the columns and of the rows of a full cell's pixels, added.
const CELL_VARIANCE_PX2: f64 = (FULL - 1.0) / 6.0;
/// Depth errors that vary slowly over the image, as a share of the depth (lens and baseline calibration).
const BIAS_SHARE: f64 = 0.0018;

/// By how much a reading may be of the ray beside its own, pixels: on steep planes that is most of the noise.
const JITTER_PX: f64 = 0.55;

/// How far readings stray from their plane, in inverse depth (eq. 53).
#[derive(Debug, Clone, Copy)]
pub struct Noise {
    /// Standard deviation of a reading on a plane that faces the camera, 1/m.
    pub sigma: f64,
    /// Between the rays `(u, v, 1)` of neighbouring pixels.
    pub pitch: f64,
}

impl Noise {
    /// Measured on the squares of the image that are smoothest.
    pub fn measure(cells: &Cells) -> Self {
        let mut found = Vec::new();
        for row in (1..cells.rows.saturating_sub(SQUARE_CELLS)).step_by(SQUARE_CELLS) {
            for column in (1..cells.columns.saturating_sub(SQUARE_CELLS)).step_by(SQUARE_CELLS) {
                let square = sum_of_square(cells, column, row, SQUARE_CELLS);
                let full = (SQUARE_CELLS * CELL_PX).pow(2) as f64;
                if square.n >= MIN_FULL_SHARE * full {
                    found.extend(square.fit().map(|(_, squares)| (squares / (square.n - 3.0)).sqrt()));
                }
            }
        }
        let pitch = pitch(cells);
        if found.len() < MIN_SQUARES {
            return Self { sigma: TYPICAL, pitch };
        }
        let place = (found.len() as f64 * SMOOTH_QUANTILE) as usize;
        let sigma = *found.select_nth_unstable_by(place, f64::total_cmp).1;
        Self { sigma: sigma.clamp(LEAST, MOST), pitch }
    }

    /// Variance of a reading on this plane, slow errors left out, 1/m^2.
    pub fn variance_on(&self, plane: &RayPlane) -> f64 {
        let step = JITTER_PX * self.pitch;
        self.sigma * self.sigma + step * step * (plane.a * plane.a + plane.b * plane.b)
    }

    /// Variance by slow errors at this inverse depth, 1/m^2.
    pub fn bias_variance(&self, q: f64) -> f64 {
        (BIAS_SHARE * q).powi(2)
    }
}

/// From the spread of the rays in the first full cells.
fn pitch(cells: &Cells) -> f64 {
    const CELLS: usize = 64;
    let variance = |m: &RayMoments| (m.uu + m.vv - (m.u * m.u + m.v * m.v) / m.n) / m.n;
    let mut spreads: Vec<f64> = cells.moments.iter().filter(|m| m.n == FULL).take(CELLS).map(variance).collect();
    spreads.sort_unstable_by(f64::total_cmp);
    spreads.get(spreads.len() / 2).map_or(TYPICAL_PITCH, |v| (v / CELL_VARIANCE_PX2).sqrt())
}

/// Moments of a square of cells.
pub fn sum_of_square(cells: &Cells, column: usize, row: usize, side: usize) -> RayMoments {
    let mut sum = RayMoments::default();
    for y in row..row + side {
        let start = y * cells.columns + column;
        cells.moments[start..start + side].iter().for_each(|m| sum.add(m));
    }
    sum
}
