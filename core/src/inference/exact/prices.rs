//! Prices of segments: several parts that want the same one bid for it (eq. 72).

use super::ascent::maximum;
use super::factors::Factors;

/// One look at every segment that some part wants or that has a price; lowers the bound or keeps it.
pub fn bid(factors: &mut Factors) {
    let mut wanted: Vec<bool> = factors.prices.iter().map(|price| *price > 0.0).collect();
    for (values, domain) in factors.unary.iter().zip(&factors.domains) {
        let top = maximum(values);
        values.iter().zip(domain).filter(|(value, _)| **value == top).for_each(|(_, &state)| wanted[state] = true);
    }
    for state in (1..wanted.len()).filter(|&state| wanted[state]) {
        set_price(factors, state);
    }
}

/// Between what the segment is worth to the part that gains most by it and to the next.
fn set_price(factors: &mut Factors, state: usize) {
    let old = factors.prices[state];
    let (mut most, mut next) = (0.0, 0.0);
    for (values, domain) in factors.unary.iter().zip(&factors.domains) {
        let Ok(place) = domain.binary_search(&state) else { continue };
        let without = f64::max(maximum(&values[..place]), maximum(&values[place + 1..]));
        let gain = values[place] + old - without;
        if gain > most {
            (most, next) = (gain, most);
        } else if gain > next {
            next = gain;
        }
    }
    if most == f64::INFINITY {
        // Some part has nothing else left; nobody bids against it.
        return;
    }
    let price = 0.5 * (most + next);
    factors.prices[state] = price;
    for (values, domain) in factors.unary.iter_mut().zip(&factors.domains) {
        if let Ok(place) = domain.binary_search(&state) {
            values[place] += old - price;
        }
    }
}
