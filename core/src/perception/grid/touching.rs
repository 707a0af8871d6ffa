//! Which pieces touch in space, read off the image's runs.

use super::runs::Runs;
use crate::perception::ransac::components::UnionFind;
use crate::perception::readings::Readings;

/// Pieces that end in one row within this many pixels of each other may touch: a shadow may lie between.
const ACROSS_PX: u32 = 12;
/// So may pieces in rows this far apart.
const DOWN_PX: [usize; 3] = [1, 4, 8];
/// Places where two pieces must touch.
const MIN_CONTACTS: u32 = 4;

/// Joins the pieces that touch within `gap_m` in enough places. `piece_of` gives the piece of a label, if it is a thing's.
pub fn touching(
    readings: &Readings,
    runs: &Runs,
    pieces: usize,
    piece_of: impl Fn(u16) -> Option<usize>,
    gap_m: f64,
) -> UnionFind {
    let mut contacts = vec![0u32; pieces * pieces];
    let mut meet = |a: (usize, u32), b: (usize, u32)| {
        if a.0 != b.0 && (readings.point(a.1) - readings.point(b.1)).norm() < gap_m {
            contacts[a.0.min(b.0) * pieces + a.0.max(b.0)] += 1;
        }
    };
    for row in 0..runs.rows() {
        let line = &runs.runs[runs.of_row(row)];
        for pair in line.windows(2).filter(|p| p[1].start - p[0].end < ACROSS_PX) {
            if let (Some(a), Some(b)) = (piece_of(pair[0].label), piece_of(pair[1].label)) {
                meet((a, pair[0].end - 1), (b, pair[1].start));
            }
        }
        for down in DOWN_PX.into_iter().filter(|d| row + d < runs.rows()) {
            runs.for_shared(row, row + down, |above, below, shared| {
                let (one, other) = (runs.runs[above], runs.runs[below]);
                if let (Some(a), Some(b)) = (piece_of(one.label), piece_of(other.label)) {
                    let step = down as u32 * runs.width;
                    let middle = (one.start + step).max(other.start) + shared / 2;
                    meet((a, middle - step), (b, middle));
                }
            });
        }
    }
    let mut sets = UnionFind::new(pieces);
    for a in 0..pieces {
        for b in a + 1..pieces {
            if contacts[a * pieces + b] >= MIN_CONTACTS {
                sets.join(a, b);
            }
        }
    }
    sets
}
