use super::super::readings::Readings;
use super::bounds::Bounds;
use super::table::spread;

/// Sides of the blocks of space that are read one after another, metres: the sums of one fit into a fast memory.
const BLOCK_M: f64 = 0.15;
/// Blocks along one axis, at most.
const MAX_BLOCKS: f64 = 65_000.0;
const BUCKET_BITS: u32 = 9;

/// The readings of a cloud, those of one block of space together, so that whatever is kept for a place is near at hand.
pub struct ReadingsByPlace {
    pub points: Vec<[f32; 3]>,
    /// Index of each in the cloud.
    pub index: Vec<u32>,
}

impl ReadingsByPlace {
    pub fn new(points: &[[f32; 3]], bounds: &Bounds) -> Self {
        let blocks_per_m = (1.0 / BLOCK_M).min(MAX_BLOCKS / bounds.extent_m().max(BLOCK_M)) as f32;
        let low = bounds.low.map(|c| c as f32);
        let bucket_of = |p: &[f32; 3]| {
            let along = |k: usize| ((p[k] - low[k]) * blocks_per_m) as u32;
            let number = u64::from(along(0)) << 40 | u64::from(along(1)) << 20 | u64::from(along(2));
            spread(number, BUCKET_BITS)
        };
        let readings = || points.iter().enumerate().filter(|(_, p)| Readings::is_finite(p));
        let mut starts = vec![0u32; (1 << BUCKET_BITS) + 1];
        let mut buckets = Vec::with_capacity(bounds.readings);
        readings().for_each(|(_, p)| {
            let bucket = bucket_of(p);
            buckets.push(bucket as u16);
            starts[bucket + 1] += 1;
        });
        for k in 1..starts.len() {
            starts[k] += starts[k - 1];
        }
        let mut placed = Self { points: vec![[0.0; 3]; bounds.readings], index: vec![0; bounds.readings] };
        for ((i, p), &bucket) in readings().zip(&buckets) {
            let place = &mut starts[bucket as usize];
            placed.points[*place as usize] = *p;
            placed.index[*place as usize] = i as u32;
            *place += 1;
        }
        placed
    }
}
