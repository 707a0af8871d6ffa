//! Combinations of states by descending sum of features: the paper's priority queue over phi.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Yields one choice from each list, the largest total first; ties in the order of positions.
pub struct CombinationQueue {
    /// For each part to fix: `(score, state)`, descending.
    lists: Vec<Vec<(f64, usize)>>,
    heap: BinaryHeap<Entry>,
}

struct Entry {
    total: f64,
    positions: Vec<u16>,
    /// Positions before this one stay: so that each combination is reached once.
    moves_from: usize,
}

impl CombinationQueue {
    pub fn new(mut lists: Vec<Vec<(f64, usize)>>) -> Self {
        for list in &mut lists {
            list.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        }
        let mut queue = Self { heap: BinaryHeap::new(), lists };
        if queue.lists.iter().all(|list| !list.is_empty()) {
            let positions = vec![0; queue.lists.len()];
            let total = queue.total(&positions);
            queue.heap.push(Entry { total, positions, moves_from: 0 });
        }
        queue
    }

    fn total(&self, positions: &[u16]) -> f64 {
        positions.iter().zip(&self.lists).map(|(&k, list)| list[k as usize].0).sum()
    }
}

impl Iterator for CombinationQueue {
    type Item = Vec<usize>;

    fn next(&mut self) -> Option<Vec<usize>> {
        let entry = self.heap.pop()?;
        for list in entry.moves_from..self.lists.len() {
            if (entry.positions[list] as usize) + 1 < self.lists[list].len() {
                let mut positions = entry.positions.clone();
                positions[list] += 1;
                let total = self.total(&positions);
                self.heap.push(Entry { total, positions, moves_from: list });
            }
        }
        Some(entry.positions.iter().zip(&self.lists).map(|(&k, list)| list[k as usize].1).collect())
    }
}

impl PartialEq for Entry {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Entry {}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        self.total.total_cmp(&other.total).then_with(|| other.positions.cmp(&self.positions))
    }
}
