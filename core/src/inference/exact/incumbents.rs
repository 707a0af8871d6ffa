//! Good assignments before the search proper: the better they are, the less there is to search.

use super::factors::Factors;
use super::problem::Problem;
use super::search::{regret, top};
use super::shortlist::Shortlist;

/// Offers what a walk without return finds: the part that would lose most takes its best state, in turn.
pub fn dive(problem: &Problem, factors: &Factors, shortlist: &mut Shortlist) {
    let mut values = factors.unary.clone();
    let mut states = vec![0; values.len()];
    let mut open: Vec<usize> = (0..values.len()).collect();
    while !open.is_empty() {
        let choices = |p: usize| values[p].iter().copied().enumerate();
        let regrets = open.iter().map(|&p| regret(&choices(p).collect::<Vec<_>>()));
        let first = regrets.enumerate().reduce(|a, b| if b.1 > a.1 { b } else { a });
        let Some((at, _)) = first else { return };
        let part = open.remove(at);
        let (_, place) = top(choices(part));
        states[part] = factors.domains[part][place];
        for &p in &open {
            if let Some((gains, step)) = factors.gains(part, place, p) {
                values[p].iter_mut().zip(gains.iter().step_by(step)).for_each(|(value, gain)| *value += gain);
            }
            if let (1.., Ok(taken)) = (states[part], factors.domains[p].binary_search(&states[part])) {
                values[p][taken] = f64::NEG_INFINITY;
            }
        }
    }
    problem.offer(&problem.symmetries.leader(&states), shortlist);
}

/// Offers what a few steps from the best known find: one part changed, or two exchanged, until nothing gets better.
pub fn climb(problem: &Problem, factors: &Factors, shortlist: &mut Shortlist) {
    while let Some((score, states)) = shortlist.best().cloned() {
        let mut trial = states.clone();
        for p in 0..trial.len() {
            for &state in factors.domains[p].iter().filter(|&&state| state != states[p]) {
                let holder = states.iter().position(|&s| s == state && s != 0);
                trial[p] = state;
                if let Some(q) = holder {
                    trial[q] = states[p];
                }
                if problem.potentials.score(&trial) > shortlist.threshold() {
                    problem.offer(&problem.symmetries.leader(&trial), shortlist);
                }
                trial.copy_from_slice(&states);
            }
        }
        if shortlist.best().is_none_or(|(best, _)| *best <= score) {
            return;
        }
    }
}
