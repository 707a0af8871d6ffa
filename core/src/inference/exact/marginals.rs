use super::ascent::{sweep, upper_bound};
use super::checks::require_finite;
use super::factors::Factors;
use super::settings::ExactSettings;
use super::sum::{Summed, Summer};
use super::symmetry::Symmetries;
use crate::error::{InputError, Result};
use crate::inference::potentials::Potentials;
use crate::model::{FeatureTables, Template, Weights};

/// Each pass of the sums looks into what weighs less than the last by this factor (its logarithm).
const LOG_STEP: f64 = 3.0;
const SWEEPS: usize = 10;

/// Probabilities under P(G) proportional to exp(J(G) / T) (eq. 49).
#[derive(Debug, Clone, PartialEq)]
pub struct Marginals {
    /// Of the reference assignment and its symmetric copies together: the middle of what it can be.
    pub probability: f64,
    /// The true probability is no farther from `probability` than this (eq. 73).
    pub probability_error: f64,
    /// `parts[p][state]`: that part `p` is empty (state 0) or takes segment `state - 1`, each assignment turned to the copy
    /// that agrees most with the reference. Each row sums to 1.
    pub parts: Vec<Vec<f64>>,
    /// No probability in `parts` is farther than this from the true one (eq. 51).
    pub unseen: f64,
    pub nodes: u64,
}

/// Sums over all assignments of the segments that are not `taken`; `reference` is the best one.
///
/// # Errors
/// A temperature that is not above 0, and what `solve` refuses.
pub fn marginals(
    template: &Template,
    weights: &Weights,
    tables: &FeatureTables,
    taken: &[bool],
    reference: &[Option<usize>],
    temperature: f64,
    settings: &ExactSettings,
) -> Result<Marginals> {
    require_finite(template, weights, tables)?;
    if !(temperature.is_finite() && temperature > 0.0) {
        return Err(InputError::new(format!("is {temperature}")).at("temperature").mend("a finite number above 0"));
    }
    let potentials = Potentials::new(template, weights, tables, &vec![true; template.relations.len()]);
    let symmetries = Symmetries::new(&template.symmetries);
    let usable: Vec<bool> = std::iter::once(true).chain(taken.iter().map(|taken| !taken)).collect();
    let reference: Vec<usize> = reference.iter().map(|segment| segment.map_or(0, |s| s + 1)).collect();
    let reference = symmetries.leader(&reference);

    let mut factors = Factors::new(&potentials, &usable);
    let mut column = Vec::new();
    (0..SWEEPS).for_each(|_| sweep(&mut factors, &mut column));
    let highest = (upper_bound(&factors) - potentials.score(&reference)) / temperature;
    factors.scale(1.0 / temperature);
    let summer = Summer { potentials: &potentials, symmetries: &symmetries, factors: &factors, reference, temperature };

    let summed = in_passes(&summer, highest, settings);
    let (total, unseen) = (summed.total, summed.unseen_share());
    let most = summed.reference / total;
    let parts = summed.parts.into_iter().map(|row| row.into_iter().map(|mass| mass / total).collect());
    Ok(Marginals {
        probability: most * (1.0 - 0.5 * unseen),
        probability_error: 0.5 * most * unseen,
        parts: parts.collect(),
        unseen,
        nodes: summed.nodes,
    })
}

/// Looks into ever lighter branches until what is left out is within the tolerance or the budget is spent.
fn in_passes(summer: &Summer, highest: f64, settings: &ExactSettings) -> Summed {
    if settings.sum_tolerance <= 0.0 {
        return summer.run(f64::NEG_INFINITY, settings.max_sum_nodes);
    }
    let mut least = highest.min(0.0) - LOG_STEP;
    let mut best = summer.run(least, settings.max_sum_nodes);
    let mut nodes = best.nodes;
    while best.unseen_share() > settings.sum_tolerance && nodes < settings.max_sum_nodes {
        least -= LOG_STEP;
        let next = summer.run(least, settings.max_sum_nodes - nodes);
        nodes += next.nodes;
        // The smaller share unseen; told by products, for shares near 1 are equal by rounding.
        if next.unseen * best.total < best.unseen * next.total {
            best = next;
        }
    }
    Summed { nodes, ..best }
}
