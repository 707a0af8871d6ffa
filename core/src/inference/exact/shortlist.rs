//! The best assignments so far.

use super::rules::Rules;

/// At most `most` assignments, best first; of equal scores the earlier in the order of states first.
#[derive(Debug)]
pub struct Shortlist {
    entries: Vec<(f64, Vec<usize>)>,
    most: usize,
    /// Nothing that scores less is wanted.
    floor: f64,
    /// Scores nearer than this are told apart by rounding alone.
    tolerance: f64,
}

impl Shortlist {
    pub fn new(rules: &Rules, tolerance: f64) -> Self {
        Self { entries: Vec::new(), most: rules.most.max(1), floor: rules.floor, tolerance }
    }

    /// What cannot score more than this needs no look.
    pub fn threshold(&self) -> f64 {
        let last = match self.entries.len() == self.most {
            true => self.entries[self.most - 1].0,
            false => f64::NEG_INFINITY,
        };
        // A score that equals the floor is wanted, one that equals the last on the list is not.
        (last + self.tolerance).max(self.floor - self.tolerance)
    }

    pub fn offer(&mut self, score: f64, states: &[usize]) {
        if score < self.floor || (self.entries.len() == self.most && score <= self.entries[self.most - 1].0) {
            return;
        }
        if self.entries.iter().any(|(_, known)| known == states) {
            return;
        }
        let place = self.entries.partition_point(|(s, known)| (*s, states) > (score, known.as_slice()));
        self.entries.insert(place, (score, states.to_vec()));
        self.entries.truncate(self.most);
    }

    pub fn best(&self) -> Option<&(f64, Vec<usize>)> {
        self.entries.first()
    }

    pub fn into_entries(self) -> Vec<(f64, Vec<usize>)> {
        self.entries
    }
}
