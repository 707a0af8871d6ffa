use super::super::readings::Readings;
use super::bounds::Bounds;
use super::eigen::principal;
use super::lattice::Lattice;
use super::table::{spread, Table};

/// Sides of the blocks that are looked at, metres, smallest first.
const BLOCKS_M: [f64; 5] = [0.032, 0.064, 0.128, 0.256, 0.512];
/// About so many readings are looked at.
const SAMPLE: usize = 60_000;
/// Readings of a block that tells something, at least.
const MIN_COUNT: f64 = 12.0;
/// A block is flat where the smallest variance is below this share of the middle one.
const FLAT_SHARE: f64 = 0.15;
/// Blocks of a size are good where this share of them is flat, and this share of the readings is in them.
const GOOD_SHARE: f64 = 0.35;
/// The typical flat block: what stands at a border spoils the others.
const TYPICAL: f64 = 0.4;
/// Voxels: smallest and largest side, readings on a face, and standard deviations in a side.
const SIDES_M: [f64; 2] = [0.008, 0.1];
const READINGS_ON_FACE: f64 = 7.0;
const SIGMAS_IN_SIDE: f64 = 3.0;
/// Noise that is reckoned with, metres, and what is taken where no block is flat.
const SIGMAS_M: [f64; 2] = [0.0003, 0.012];
const UNKNOWN_SIGMA_M: f64 = 0.002;

/// How near and how noisy the readings of a cloud are.
#[derive(Debug, Clone, Copy)]
pub struct Spacing {
    /// Standard deviation of a reading from its surface, metres.
    pub sigma_m: f64,
    /// Side of a voxel that suits them, metres.
    pub voxel_m: f64,
}

impl Spacing {
    /// From blocks of space drawn by their place, whole: a choice of single readings would thin them out (eq. 47).
    pub fn measure(points: &[[f32; 3]], bounds: &Bounds) -> Self {
        let mut best = (0.0, Self { sigma_m: UNKNOWN_SIGMA_M, voxel_m: SIDES_M[0] });
        for block_m in BLOCKS_M {
            let (share, spacing) = Self::of_blocks(&sample(points, bounds, block_m));
            if share > best.0 || block_m == BLOCKS_M[0] {
                best = (share, spacing);
            }
            if share >= GOOD_SHARE {
                break;
            }
        }
        best.1
    }

    /// With the share of flat blocks, or 0 where too few readings are in blocks that tell something.
    fn of_blocks((lattice, table): &(Lattice, Table)) -> (f64, Self) {
        let (mut sigmas, mut densities) = (vec![], vec![]);
        let (mut told, mut readings, mut in_told) = (0usize, 0.0, 0.0);
        for (key, sums) in table.keys.iter().zip(&table.sums) {
            let count = f64::from(sums.count);
            readings += count;
            if count < MIN_COUNT {
                continue;
            }
            told += 1;
            in_told += count;
            let [least, middle, most] = principal(&sums.to_moments(lattice, *key).covariance()).variances;
            if least < FLAT_SHARE * middle {
                sigmas.push((least * count / (count - 3.0)).sqrt());
                densities.push(count / (12.0 * (middle * most).sqrt()));
            }
        }
        let share = if in_told < GOOD_SHARE * readings { 0.0 } else { sigmas.len() as f64 / told.max(1) as f64 };
        let sigma_m = typical(&mut sigmas).unwrap_or(UNKNOWN_SIGMA_M).clamp(SIGMAS_M[0], SIGMAS_M[1]);
        let fallback = readings / table.keys.len().max(1) as f64 / lattice.size_m.powi(2);
        let density = typical(&mut densities).unwrap_or(fallback);
        let voxel_m = (READINGS_ON_FACE / density).sqrt().max(SIGMAS_IN_SIDE * sigma_m).clamp(SIDES_M[0], SIDES_M[1]);
        (share, Self { sigma_m, voxel_m })
    }
}

/// The sums of some blocks: all where the cloud is small, else those whose number's hash is low.
fn sample(points: &[[f32; 3]], bounds: &Bounds, block_m: f64) -> (Lattice, Table) {
    let lattice = Lattice::new(bounds, block_m);
    let bits = (bounds.readings / SAMPLE + 1).ilog2();
    let mut table = Table::new();
    for p in points.iter().filter(|p| Readings::is_finite(p)) {
        let (key, at) = lattice.locate(p);
        if bits == 0 || spread(key ^ key >> 17, bits) == 0 {
            table.add(key, at);
        }
    }
    (lattice, table)
}

fn typical(values: &mut [f64]) -> Option<f64> {
    let place = (values.len() as f64 * TYPICAL) as usize;
    (place < values.len()).then(|| *values.select_nth_unstable_by(place, f64::total_cmp).1)
}
