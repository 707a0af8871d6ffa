//! Sums exp(J / T) over all assignments, depth first; what weighs too little is left out and counted (eq. 50).

use super::factors::Factors;
use super::symmetry::{Symmetries, UNDECIDED};
use crate::inference::potentials::Potentials;

/// What is summed. The tables of `factors` are in units of the temperature.
pub struct Summer<'a> {
    pub potentials: &'a Potentials,
    pub symmetries: &'a Symmetries,
    pub factors: &'a Factors,
    /// The best assignment: weights are told in units of its own.
    pub reference: Vec<usize>,
    pub temperature: f64,
}

/// Sums so far; the reference's own weight, without its copies, is 1.
#[derive(Debug, Clone)]
pub struct Summed {
    pub total: f64,
    /// Of the reference and its copies.
    pub reference: f64,
    /// `parts[p][state]`.
    pub parts: Vec<Vec<f64>>,
    /// What was left out weighs no more.
    pub unseen: f64,
    pub nodes: u64,
}

impl Summed {
    /// The share that was left out, at most.
    pub fn unseen_share(&self) -> f64 {
        match self.unseen.is_finite() {
            true => self.unseen / (self.total + self.unseen),
            false => 1.0,
        }
    }
}

/// One run of a `Summer`.
struct Run<'a> {
    summer: &'a Summer<'a>,
    states: Vec<usize>,
    summed: Summed,
    /// Branches whose logarithm is no more are left out.
    least: f64,
    budget: u64,
    /// Added to a branch's logarithm: every symmetric copy in, the reference's weight out.
    offset: f64,
}

/// Undecided parts with what each place of their domains weighs, as logarithms.
type Open = Vec<(usize, Vec<(usize, f64)>)>;

impl Summer<'_> {
    /// Leaves out branches whose weight's logarithm is at most `least`, and what is open after `budget` nodes.
    pub fn run(&self, least: f64, budget: u64) -> Summed {
        let states = self.potentials.states;
        let parts = vec![vec![0.0; states]; self.reference.len()];
        let mut run = Run {
            summer: self,
            states: vec![UNDECIDED; self.reference.len()],
            summed: Summed { total: 0.0, reference: 0.0, parts, unseen: 0.0, nodes: 0 },
            least,
            budget,
            offset: (self.symmetries.count() as f64).ln() - self.potentials.score(&self.reference) / self.temperature,
        };
        // The reference is always in, so that nothing is divided by 0.
        run.add(&self.reference);
        let choices = self.factors.unary.iter().map(|values| values.iter().copied().enumerate().collect());
        run.descend(0.0, &choices.enumerate().collect());
        run.summed
    }
}

impl Run<'_> {
    fn descend(&mut self, decided: f64, open: &Open) {
        self.summed.nodes += 1;
        let sums: Vec<(f64, f64)> = open.iter().map(|(_, choices)| log_sum(choices)).collect();
        let bound = decided + self.offset + sums.iter().map(|(_, sum)| sum).sum::<f64>();
        if bound <= self.least || self.summed.nodes > self.budget {
            self.summed.unseen += bound.exp();
            return;
        }
        // The part whose best choice holds most of its sum.
        let spread = sums.iter().map(|(top, sum)| sum - top).enumerate();
        let Some((at, _)) = spread.reduce(|a, b| if b.1 < a.1 { b } else { a }) else {
            return self.leaf();
        };
        let (part, choices) = &open[at];
        for &(place, value) in choices {
            let state = self.summer.factors.domains[*part][place];
            self.states[*part] = state;
            if self.summer.symmetries.may_lead(&self.states) {
                let rest = open.iter().enumerate().filter(|(k, _)| *k != at).map(|(_, (p, choices))| {
                    let domain = &self.summer.factors.domains[*p];
                    let free = choices.iter().filter(|(j, _)| state == 0 || domain[*j] != state);
                    match self.summer.factors.gains(*part, place, *p) {
                        Some((gains, step)) => (*p, free.map(|&(j, value)| (j, value + gains[j * step])).collect()),
                        None => (*p, free.copied().collect()),
                    }
                });
                self.descend(decided + value, &rest.collect());
            }
            self.states[*part] = UNDECIDED;
        }
    }

    fn leaf(&mut self) {
        if self.states != self.summer.reference {
            let states = std::mem::take(&mut self.states);
            self.add(&states);
            self.states = states;
        }
    }

    fn add(&mut self, states: &[usize]) {
        let Summer { potentials, symmetries, reference, temperature, .. } = self.summer;
        let score = potentials.score(states) - potentials.score(reference);
        let weight = (score / temperature).exp() * symmetries.copies(states) as f64;
        self.summed.total += weight;
        if states == reference {
            self.summed.reference += weight;
        }
        for (row, state) in self.summed.parts.iter_mut().zip(symmetries.folded(states, reference)) {
            row[state] += weight;
        }
    }
}

/// The largest logarithm, and that of the sum.
fn log_sum(choices: &[(usize, f64)]) -> (f64, f64) {
    let top = choices.iter().fold(f64::NEG_INFINITY, |top, choice| top.max(choice.1));
    (top, top + choices.iter().map(|(_, value)| (value - top).exp()).sum::<f64>().ln())
}
