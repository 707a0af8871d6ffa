use std::collections::BTreeSet;

use super::grow::FoundBox;
use super::shells::LEAST_SCORE;
use crate::fit::share_of_score;

/// Readings are shared by cells of so many pixels: boxes were not asked at the same ones.
const COARSE_CELL: usize = 4;

/// Takes the best, and of the rest those that leave its readings alone.
pub fn choose(mut found: Vec<FoundBox>, width: usize) -> Vec<FoundBox> {
    let rank = |one: &FoundBox| one.score * share_of_score(one.size.as_ref()) * one.probability;
    found.sort_by(|a, b| rank(b).total_cmp(&rank(a)));
    let mut out: Vec<FoundBox> = Vec::new();
    let mut taken = BTreeSet::new();
    for candidate in found {
        let coarse = |index: &u32| {
            let (column, row) = (*index as usize % width / COARSE_CELL, *index as usize / width / COARSE_CELL);
            (row * width + column) as u32
        };
        let mut points: Vec<u32> = candidate.labels.parts.iter().flat_map(|(_, points)| points).map(coarse).collect();
        points.sort_unstable();
        points.dedup();
        let shared = points.iter().filter(|point| taken.contains(*point)).count();
        if candidate.score > LEAST_SCORE && 4 * shared <= points.len() {
            taken.extend(points);
            out.push(candidate);
        }
    }
    out
}
