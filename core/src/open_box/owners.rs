//! Which segment each reading belongs to: a panel holds all of its segment, what is carved out of something larger holds a piece.

use crate::perception::{Scene, BACKGROUND};

/// Segments of things, by reading.
pub struct Owners {
    /// `NONE` of readings in no segment, and of the room's.
    segment_of: Vec<u16>,
    readings_of: Vec<u32>,
}

const NONE: u16 = u16::MAX;

impl Owners {
    pub fn new(scene: &Scene, point_count: usize) -> Self {
        let segments = &scene.segments;
        let mut segment_of = vec![NONE; point_count];
        for s in (0..segments.len().min(usize::from(NONE))).filter(|&s| segments.group[s] != BACKGROUND) {
            segments.points_of(s).iter().for_each(|&point| segment_of[point as usize] = s as u16);
        }
        let readings_of = (0..segments.len()).map(|s| segments.points_of(s).len() as u32).collect();
        Self { segment_of, readings_of }
    }

    /// Of the segments that these readings belong to, the share that they hold, each standing for `each`; weighed by
    /// readings, 1 where they belong to none.
    pub fn held<'a>(&self, readings: impl Iterator<Item = &'a u32>, each: u32) -> f64 {
        let counts = self.counts(readings, each);
        let total: u32 = counts.iter().sum();
        let share =
            |(count, all): (&u32, &u32)| f64::from(*count) * f64::from((*count).min(*all)) / f64::from((*all).max(1));
        let held: f64 = counts.iter().zip(&self.readings_of).map(share).sum();
        if total == 0 {
            1.0
        } else {
            held / f64::from(total)
        }
    }

    /// The segment that most of these readings belong to, the first of equals, and how many do.
    pub fn most_held<'a>(&self, readings: impl Iterator<Item = &'a u32>) -> Option<(usize, u32)> {
        let counts = self.counts(readings, 1);
        let most = counts.iter().copied().max().filter(|&count| count > 0)?;
        Some((counts.iter().position(|&count| count == most)?, most))
    }

    /// For each segment how many of these readings belong to it, each standing for `each`.
    fn counts<'a>(&self, readings: impl Iterator<Item = &'a u32>, each: u32) -> Vec<u32> {
        let mut counts = vec![0_u32; self.readings_of.len()];
        for &reading in readings {
            if let Some(count) = counts.get_mut(usize::from(self.segment_of[reading as usize])) {
                *count += each;
            }
        }
        counts
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_carved_out_of_something_larger_holds_a_piece() {
        // Four readings of segment 0, ten of segment 1, two of none.
        let segment_of = [vec![0; 4], vec![1; 10], vec![NONE; 2]].concat();
        let owners = Owners { segment_of, readings_of: vec![4, 10] };
        let held = |readings: &[u32], each: u32| owners.held(readings.iter(), each);
        assert_eq!(held(&[0, 1, 2, 3], 1), 1.0);
        assert_eq!(held(&[4, 5], 1), 0.2);
        assert!((held(&[0, 1, 2, 3, 4, 5], 1) - (4.0 + 2.0 * 0.2) / 6.0).abs() < 1e-12);
        // Two that each stand for two are all of four; more than all is all.
        assert_eq!(held(&[0, 1], 2), 1.0);
        assert_eq!(held(&[0, 1], 9), 1.0);
        assert_eq!(held(&[14, 15], 1), 1.0);
        assert_eq!(held(&[], 1), 1.0);
    }
}
