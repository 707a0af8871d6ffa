//! Every assignment, one after another: the oracle of the tests and of the search-cost experiment, not for use.

use super::staged::Candidate;
use crate::model::{Assignment, FeatureTables, Template, Weights};

/// The best of all assignments, and how many there are. Cost n^m: small problems only.
pub fn best_exhaustive(template: &Template, weights: &Weights, tables: &FeatureTables) -> (Candidate, u64) {
    let parts = template.parts.len();
    let mut best = Candidate { assignment: vec![None; parts], score: 0.0 };
    let mut visited = 0;
    let mut assignment = vec![None; parts];
    visit(0, tables.segment_count, &mut assignment, &mut |complete| {
        visited += 1;
        let score = weights.score(&tables.feature_vector(template, complete));
        if score > best.score {
            best = Candidate { assignment: complete.clone(), score };
        }
    });
    (best, visited)
}

fn visit(part: usize, n: usize, assignment: &mut Assignment, each: &mut impl FnMut(&Assignment)) {
    if part == assignment.len() {
        each(assignment);
        return;
    }
    for choice in std::iter::once(None).chain((0..n).map(Some)) {
        if choice.is_some() && assignment[..part].contains(&choice) {
            continue;
        }
        assignment[part] = choice;
        visit(part + 1, n, assignment, each);
    }
    assignment[part] = None;
}
