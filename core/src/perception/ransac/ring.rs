use crate::geometry::Point2;

/// Integer coordinates of a footprint cell.
pub type Cell2 = [i32; 2];
/// Cells around a footprint that belong to its ring.
const REACH: i32 = 2;

/// The cells within two of a footprint, the footprint itself left out. It must be bounded: memory is as its bounds.
pub fn ring(footprint: &[Point2], cell_m: f64) -> Vec<Cell2> {
    let cells: Vec<Cell2> = footprint.iter().map(|p| to_cell(p, cell_m)).collect();
    let bound = |k: usize, pick: fn(i32, i32) -> i32| cells.iter().map(|c| c[k]).reduce(pick).unwrap_or_default();
    let low = [0, 1].map(|k| bound(k, i32::min) - REACH);
    let size = [0, 1].map(|k| (bound(k, i32::max) + REACH - low[k]) as usize + 1);
    let mut covered = vec![false; size[0] * size[1]];
    for c in &cells {
        covered[(c[0] - low[0]) as usize + (c[1] - low[1]) as usize * size[0]] = true;
    }
    // A square grows along one axis, then along the other.
    let wide = grown(&covered, 1, size[0]);
    let whole = grown(&wide, size[0], size[1]);
    let is_ring = |k: &usize| whole[*k] && !covered[*k];
    let cell = |k: usize| [low[0] + (k % size[0]) as i32, low[1] + (k / size[0]) as i32];
    (0..covered.len()).filter(is_ring).map(cell).collect()
}

/// Each set cell spread by the reach along an axis of `count` cells that are `step` apart. The margin of the bounds is
/// empty, so that nothing comes round from the next row.
fn grown(set: &[bool], step: usize, count: usize) -> Vec<bool> {
    let reach = REACH as usize;
    let mut out = vec![false; set.len()];
    for (k, _) in set.iter().enumerate().filter(|(_, &is_set)| is_set) {
        let along = k / step % count;
        for shift in along.saturating_sub(reach)..=(along + reach).min(count - 1) {
            out[k + shift * step - along * step] = true;
        }
    }
    out
}

pub fn to_cell(p: &Point2, cell_m: f64) -> Cell2 {
    [(p[0] / cell_m).floor() as i32, (p[1] / cell_m).floor() as i32]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn the_ring_is_what_lies_within_two_cells() {
        let points: Vec<Point2> = (0..40).map(|k| [f64::from(k * k % 31) - 9.5, f64::from(k * 7 % 23) - 4.5]).collect();
        let cells: BTreeSet<Cell2> = points.iter().map(|p| to_cell(p, 1.0)).collect();
        let around = |c: &Cell2| (0..25).map(|k| [c[0] + k % 5 - 2, c[1] + k / 5 - 2]).collect::<Vec<_>>();
        let expected: BTreeSet<Cell2> = cells.iter().flat_map(around).filter(|c| !cells.contains(c)).collect();
        let found = ring(&points, 1.0);
        assert_eq!(found.len(), expected.len());
        assert_eq!(found.into_iter().collect::<BTreeSet<_>>(), expected);
    }
}
