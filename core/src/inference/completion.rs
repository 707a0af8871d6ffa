//! Given the fixed parts, the best segments for all others, each segment used once: exact, by branch and bound.

use super::graph::SearchPlan;
use super::potentials::Potentials;

/// Tables that are the same for every combination of the fixed parts.
pub struct Completer<'a> {
    potentials: &'a Potentials,
    plan: &'a SearchPlan,
    /// `folded[p][state]`: the part's own score plus the best of what hangs on it.
    folded: Vec<Vec<f64>>,
    /// `messages[p][state of the part it hangs on]`: the best that a folded part and what hangs on it can give (eq. 16).
    messages: Vec<Vec<f64>>,
    /// The edge between a folded part and the one it hangs on.
    hanging_edge: Vec<Option<usize>>,
    /// Order in which a completion decides the parts: independent ones, then folded ones, what bears before what hangs.
    order: Vec<usize>,
    bearer: Vec<Option<usize>>,
    hangers: Vec<Vec<usize>>,
}

/// A complete vector of states with its score under the plan's relations.
pub struct Completed {
    pub states: Vec<usize>,
    pub score: f64,
}

impl<'a> Completer<'a> {
    /// `usable[state]` false: that segment is taken by another object.
    pub fn new(potentials: &'a Potentials, plan: &'a SearchPlan, usable: &[bool]) -> Self {
        let count = potentials.unary.len();
        let mut completer = Self {
            potentials,
            plan,
            folded: potentials.unary.clone(),
            messages: vec![Vec::new(); count],
            hanging_edge: vec![None; count],
            order: plan.independent.iter().copied().chain(plan.folds.iter().rev().map(|&(p, _)| p)).collect(),
            bearer: vec![None; count],
            hangers: vec![Vec::new(); count],
        };
        for values in &mut completer.folded {
            for (value, _) in values.iter_mut().zip(usable).filter(|(_, usable)| !**usable) {
                *value = f64::NEG_INFINITY;
            }
        }
        for &(part, bearer) in &plan.folds {
            completer.fold(part, bearer);
        }
        completer
    }

    fn fold(&mut self, part: usize, bearer: Option<usize>) {
        let Some(bearer) = bearer else { return };
        let edges = &self.potentials.edges_of[part];
        let edge = edges.iter().copied().find(|&k| self.potentials.other_end(k, part) == bearer);
        self.hanging_edge[part] = edge;
        self.bearer[part] = Some(bearer);
        self.hangers[bearer].push(part);
        let message: Vec<f64> = (0..self.potentials.states)
            .map(|state| {
                let others = (0..self.potentials.states).filter(|&s| s == 0 || s != state);
                others.map(|s| self.folded[part][s] + self.hanging_score(part, s, state)).fold(0.0, f64::max)
            })
            .collect();
        for (value, gain) in self.folded[bearer].iter_mut().zip(&message) {
            *value += gain;
        }
        self.messages[part] = message;
    }

    fn hanging_score(&self, part: usize, state: usize, bearer_state: usize) -> f64 {
        self.hanging_edge[part].map_or(0.0, |k| self.potentials.edge_score(k, part, state, bearer_state))
    }

    /// An upper bound on the score of any completion of `fixed_states` (aligned with `plan.fixed`), eq. 17.
    pub fn bound(&self, fixed_states: &[usize], values: &mut Vec<f64>) -> f64 {
        let mut total = self.fixed_score(fixed_states);
        for &part in &self.plan.independent {
            self.independent_values(part, fixed_states, values);
            total += values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        }
        total + self.loose_score()
    }

    /// Score of the fixed parts with what hangs on them, and of the relations between them.
    fn fixed_score(&self, fixed_states: &[usize]) -> f64 {
        let own: f64 = self.plan.fixed.iter().zip(fixed_states).map(|(&p, &state)| self.folded[p][state]).sum();
        let mut pair = 0.0;
        for (k, (&p, &state)) in self.plan.fixed.iter().zip(fixed_states).enumerate() {
            for (&q, &other) in self.plan.fixed[..k].iter().zip(fixed_states) {
                pair += self.pair_score(p, state, q, other);
            }
        }
        own + pair
    }

    fn pair_score(&self, p: usize, state: usize, q: usize, other: usize) -> f64 {
        let edges = &self.potentials.edges_of[p];
        let between = edges.iter().filter(|&&k| self.potentials.other_end(k, p) == q);
        between.map(|&k| self.potentials.edge_score(k, p, state, other)).sum()
    }

    /// Folded parts that hang on nothing are free of everything.
    fn loose_score(&self) -> f64 {
        let loose = self.plan.folds.iter().filter(|(_, bearer)| bearer.is_none());
        loose.map(|&(p, _)| self.folded[p].iter().copied().fold(0.0, f64::max)).sum()
    }

    /// Value of each state of an independent part, given the fixed ones; segments that those use are left out.
    fn independent_values(&self, part: usize, fixed_states: &[usize], values: &mut Vec<f64>) {
        values.clear();
        values.extend_from_slice(&self.folded[part]);
        for &k in &self.potentials.edges_of[part] {
            let other = self.potentials.other_end(k, part);
            if let Some(at) = self.plan.fixed.iter().position(|&p| p == other) {
                for (state, value) in values.iter_mut().enumerate() {
                    *value += self.potentials.edge_score(k, part, state, fixed_states[at]);
                }
            }
        }
        for &state in fixed_states.iter().filter(|&&state| state != 0) {
            values[state] = f64::NEG_INFINITY;
        }
    }

    /// The best completion of `fixed_states`.
    pub fn complete(&self, fixed_states: &[usize]) -> Completed {
        let mut search = Search {
            completer: self,
            fixed_states,
            states: vec![0; self.potentials.unary.len()],
            used: vec![false; self.potentials.states],
            best: Completed { states: Vec::new(), score: f64::NEG_INFINITY },
            bound: self.bound(fixed_states, &mut Vec::new()),
        };
        for (&p, &state) in self.plan.fixed.iter().zip(fixed_states) {
            search.states[p] = state;
            search.used[state] = state != 0;
        }
        search.descend(0, search.bound);
        search.best
    }

    /// What the part can add in each state, best first: `(value with what hangs on it, state)`.
    fn options(&self, part: usize, search: &Search) -> Vec<(f64, usize)> {
        let mut values = Vec::new();
        match self.bearer[part] {
            Some(bearer) => {
                let bearer_state = search.states[bearer];
                let states = self.folded[part].iter().enumerate();
                values.extend(states.map(|(s, value)| value + self.hanging_score(part, s, bearer_state)));
            }
            None => self.independent_values(part, search.fixed_states, &mut values),
        }
        let free = values.into_iter().enumerate().filter(|&(s, value)| !search.used[s] && value.is_finite());
        let mut options: Vec<(f64, usize)> = free.map(|(s, value)| (value, s)).collect();
        options.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        options
    }

    /// What was counted for the part before its state was chosen.
    fn counted(&self, part: usize, search: &Search) -> f64 {
        match self.bearer[part] {
            Some(bearer) => self.messages[part][search.states[bearer]],
            None if self.plan.independent.contains(&part) => {
                let mut values = Vec::new();
                self.independent_values(part, search.fixed_states, &mut values);
                values.into_iter().fold(f64::NEG_INFINITY, f64::max)
            }
            None => self.folded[part].iter().copied().fold(0.0, f64::max),
        }
    }
}

struct Search<'a> {
    completer: &'a Completer<'a>,
    fixed_states: &'a [usize],
    states: Vec<usize>,
    used: Vec<bool>,
    best: Completed,
    /// No completion can exceed this.
    bound: f64,
}

impl Search<'_> {
    /// Decides the part at `depth` of the order; `bound` is what the decided and the open ones can still reach together.
    fn descend(&mut self, depth: usize, bound: f64) {
        let Some(&part) = self.completer.order.get(depth) else {
            self.best = Completed { states: self.states.clone(), score: bound };
            return;
        };
        let counted = self.completer.counted(part, self);
        for (value, state) in self.completer.options(part, self) {
            let reachable = bound - counted + value;
            if reachable <= self.best.score {
                return;
            }
            self.states[part] = state;
            self.used[state] = state != 0;
            self.descend(depth + 1, reachable);
            self.used[state] = false;
            self.states[part] = 0;
            if self.best.score >= self.bound {
                return;
            }
        }
    }
}
