use crate::model::{FeatureTables, Template, Weights};

/// One relation table between two parts: `values[state_first * states + state_second]`, 0 where either is empty.
#[derive(Debug, Clone)]
pub struct Edge {
    pub first: usize,
    pub second: usize,
    pub values: Vec<f64>,
}

/// The weighted score of a set of relations as tables over states; state 0 is "empty" and scores 0.
#[derive(Debug, Clone)]
pub struct Potentials {
    pub states: usize,
    /// `unary[p][state]`.
    pub unary: Vec<Vec<f64>>,
    pub edges: Vec<Edge>,
    /// Numbers of the edges at each part.
    pub edges_of: Vec<Vec<usize>>,
}

impl Potentials {
    /// Sums weight times value over the relations that `uses_relation` admits; all features count.
    pub fn new(template: &Template, weights: &Weights, tables: &FeatureTables, uses_relation: &[bool]) -> Self {
        let states = tables.segment_count + 1;
        let mut unary = vec![vec![0.0; states]; template.parts.len()];
        for ((term, values), weight) in template.features.iter().zip(&tables.unary).zip(&weights.values) {
            for &p in &term.parts {
                for (total, value) in unary[p][1..].iter_mut().zip(values) {
                    *total += weight * value;
                }
            }
        }
        let mut edges: Vec<Edge> = Vec::new();
        let relation_weights = &weights.values[template.features.len()..];
        for (r, term) in template.relations.iter().enumerate().filter(|(r, _)| uses_relation[*r]) {
            for &(first, second) in &term.pairs {
                let edge = edge_between(&mut edges, first, second, states);
                add_relation(edge, first, &tables.pair[r], relation_weights[r], states);
            }
        }
        let mut edges_of = vec![Vec::new(); template.parts.len()];
        for (k, edge) in edges.iter().enumerate() {
            edges_of[edge.first].push(k);
            edges_of[edge.second].push(k);
        }
        Self { states, unary, edges, edges_of }
    }

    /// Score of edge `k` where part `part` (one of its ends) is in `state` and the other end in `other_state`.
    pub fn edge_score(&self, k: usize, part: usize, state: usize, other_state: usize) -> f64 {
        let edge = &self.edges[k];
        if edge.first == part {
            edge.values[state * self.states + other_state]
        } else {
            edge.values[other_state * self.states + state]
        }
    }

    /// J(G) of a complete vector of states, under the relations that are in.
    pub fn score(&self, states: &[usize]) -> f64 {
        let own: f64 = self.unary.iter().zip(states).map(|(values, &state)| values[state]).sum();
        let tied = self.edges.iter().map(|e| e.values[states[e.first] * self.states + states[e.second]]);
        own + tied.sum::<f64>()
    }

    /// The largest size of any entry, at least 1: what rounding is measured against.
    pub fn magnitude(&self) -> f64 {
        let values = self.unary.iter().chain(self.edges.iter().map(|edge| &edge.values)).flatten();
        values.fold(1.0, |most, value| f64::max(most, value.abs()))
    }

    /// The part at the other end of edge `k`.
    pub fn other_end(&self, k: usize, part: usize) -> usize {
        let edge = &self.edges[k];
        if edge.first == part {
            edge.second
        } else {
            edge.first
        }
    }

    /// The largest score that edge `k` can give.
    pub fn edge_maximum(&self, k: usize) -> f64 {
        self.edges[k].values.iter().copied().fold(0.0, f64::max)
    }
}

fn edge_between(edges: &mut Vec<Edge>, a: usize, b: usize, states: usize) -> &mut Edge {
    let position = edges.iter().position(|e| (e.first, e.second) == (a, b) || (e.first, e.second) == (b, a));
    let k = position.unwrap_or_else(|| {
        edges.push(Edge { first: a, second: b, values: vec![0.0; states * states] });
        edges.len() - 1
    });
    &mut edges[k]
}

fn add_relation(edge: &mut Edge, first: usize, values: &[f64], weight: f64, states: usize) {
    let n = states - 1;
    let swapped = edge.first != first;
    for a in 0..n {
        for b in 0..n {
            let (row, column) = if swapped { (b, a) } else { (a, b) };
            edge.values[(row + 1) * states + column + 1] += weight * values[a * n + b];
        }
    }
}
