//! Moves score between the tables until each part's own table bounds what it can add (eq. 42).

use super::factors::{Factors, Pair};

/// No assignment in the domains scores more (eq. 42), once every pair was shaken.
pub fn upper_bound(factors: &Factors) -> f64 {
    factors.unary.iter().map(|values| maximum(values)).sum::<f64>() + factors.prices.iter().sum::<f64>()
}

/// One pass over all pairs; lowers the bound or keeps it.
pub fn sweep(factors: &mut Factors, column: &mut Vec<f64>) {
    let Factors { unary, pairs, .. } = factors;
    for pair in pairs {
        // `first` is the smaller number.
        let (low, high) = unary.split_at_mut(pair.second);
        shake(pair, &mut low[pair.first], &mut high[0], column);
    }
}

/// Takes both parts' tables into the pair's, gives each its half, then to each all that can go without making an entry of
/// the pair positive (eq. 43).
fn shake(pair: &mut Pair, first: &mut [f64], second: &mut [f64], column: &mut Vec<f64>) {
    let width = second.len();
    column.clear();
    column.resize(width, f64::NEG_INFINITY);
    for (own, row) in first.iter_mut().zip(pair.values.chunks_exact_mut(width)) {
        let mut most = f64::NEG_INFINITY;
        for (value, other) in row.iter_mut().zip(second.iter()) {
            *value += *own + other;
            most = larger(most, *value);
        }
        *own = 0.5 * most;
        for (value, best) in row.iter().zip(column.iter_mut()) {
            *best = larger(*best, value - *own);
        }
    }
    second.copy_from_slice(column);
    for (own, row) in first.iter_mut().zip(pair.values.chunks_exact_mut(width)) {
        let mut most = f64::NEG_INFINITY;
        for (value, other) in row.iter_mut().zip(second.iter()) {
            *value -= other;
            most = larger(most, *value);
        }
        *own = most;
        for value in row {
            *value -= most;
        }
    }
}

pub fn maximum(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::NEG_INFINITY, larger)
}

/// Without regard to NaN, which no table holds: one instruction.
fn larger(a: f64, b: f64) -> f64 {
    if a > b {
        a
    } else {
        b
    }
}
