//! Before the search: a low bound, good assignments, and domains without what neither of them leaves open.

use super::ascent::{maximum, sweep, upper_bound};
use super::factors::Factors;
use super::incumbents::{climb, dive};
use super::prices::bid;
use super::problem::Problem;
use super::shortlist::Shortlist;

/// Sweeps between two looks for better assignments.
const LOOK_EVERY: usize = 3;
/// A sweep that closes less than this share of what is open is the last.
const LEAST_GAIN: f64 = 0.02;

/// Sweeps until the bound meets the list, or falls no more; trims as it goes.
pub fn tighten(problem: &Problem, factors: &mut Factors, shortlist: &mut Shortlist, max_sweeps: usize) {
    let mut column = Vec::new();
    let mut last_bound = f64::INFINITY;
    for k in 0..max_sweeps {
        sweep(factors, &mut column);
        bid(factors);
        let bound = upper_bound(factors);
        if k % LOOK_EVERY == 0 {
            dive(problem, factors, shortlist);
            climb(problem, factors, shortlist);
        }
        let open = bound - shortlist.threshold();
        let trimmed = trim(factors, open);
        if open <= 0.0 || (!trimmed && last_bound - bound < LEAST_GAIN * open) {
            return;
        }
        last_bound = bound;
    }
}

/// Leaves out what is worse than its part's best by `open` or more: no wanted assignment holds it (eq. 45).
fn trim(factors: &mut Factors, open: f64) -> bool {
    let keeps: Vec<Vec<bool>> = factors
        .unary
        .iter()
        .map(|values| {
            let least = maximum(values) - open;
            values.iter().enumerate().map(|(place, &value)| place == 0 || value > least).collect()
        })
        .collect();
    factors.trim(|p, place| keeps[p][place])
}
