//! The score as tables over shrinking domains, rewritten so that each part's own table bounds what it can add.

use crate::inference::potentials::Potentials;

/// A table between two parts over their domains, row by row: `values[i * domain of second + j]`. No part's segment is the
/// other's: there the table holds minus infinity.
#[derive(Debug, Clone)]
pub struct Pair {
    pub first: usize,
    pub second: usize,
    pub values: Vec<f64>,
}

/// Tables that sum to J(G) for every assignment in the domains (eq. 41).
#[derive(Debug, Clone)]
pub struct Factors {
    /// States that part `p` may still take, ascending; an undecided part may always stay empty: state 0, in place 0.
    pub domains: Vec<Vec<usize>>,
    /// `unary[p][i]`: of `domains[p][i]`.
    pub unary: Vec<Vec<f64>>,
    /// One for each two parts, tied or not: no two of them take the same segment. In the order of `pair_number`.
    pub pairs: Vec<Pair>,
}

/// Where the table of two parts stands.
pub fn pair_number(p: usize, q: usize) -> usize {
    let (first, second) = (p.min(q), p.max(q));
    second * second.saturating_sub(1) / 2 + first
}

impl Factors {
    /// The tables of `potentials` over the states that are `usable`.
    pub fn new(potentials: &Potentials, usable: &[bool]) -> Self {
        let parts = potentials.unary.len();
        let domain: Vec<usize> = (0..potentials.states).filter(|&state| usable[state]).collect();
        let unary = potentials.unary.iter().map(|values| domain.iter().map(|&state| values[state]).collect());
        let mut pairs = Vec::with_capacity(parts * parts.saturating_sub(1) / 2);
        for second in 1..parts {
            for first in 0..second {
                pairs.push(Pair { first, second, values: pair_table(potentials, first, second, &domain) });
            }
        }
        Self { unary: unary.collect(), domains: vec![domain; parts], pairs }
    }

    /// What the choice `place` of `part` adds to each choice `j` of `other`: `values[start + j * step]`.
    pub fn gains(&self, part: usize, place: usize, other: usize) -> (&[f64], usize) {
        let pair = &self.pairs[pair_number(part, other)];
        let width = self.domains[pair.second].len();
        match pair.first == part {
            true => (&pair.values[place * width..], 1),
            false => (&pair.values[place..], width),
        }
    }

    pub fn scale(&mut self, factor: f64) {
        let tables = self.unary.iter_mut().chain(self.pairs.iter_mut().map(|pair| &mut pair.values));
        tables.flatten().for_each(|value| *value *= factor);
    }

    /// Leaves out of each domain what `keeps(part, place)` refuses. True: something went.
    pub fn trim(&mut self, keeps: impl Fn(usize, usize) -> bool) -> bool {
        let kept: Vec<Vec<usize>> =
            (0..self.domains.len()).map(|p| (0..self.domains[p].len()).filter(|&i| keeps(p, i)).collect()).collect();
        if kept.iter().zip(&self.domains).all(|(kept, domain)| kept.len() == domain.len()) {
            return false;
        }
        for pair in &mut self.pairs {
            let (rows, columns) = (&kept[pair.first], &kept[pair.second]);
            let width = self.domains[pair.second].len();
            let rows = rows.iter().map(|&i| &pair.values[i * width..(i + 1) * width]);
            pair.values = rows.flat_map(|row| columns.iter().map(|&j| row[j])).collect();
        }
        for (p, places) in kept.iter().enumerate() {
            self.domains[p] = places.iter().map(|&i| self.domains[p][i]).collect();
            self.unary[p] = places.iter().map(|&i| self.unary[p][i]).collect();
        }
        true
    }
}

fn pair_table(potentials: &Potentials, first: usize, second: usize, domain: &[usize]) -> Vec<f64> {
    let edge = potentials.edges_of[first].iter().copied().find(|&k| potentials.other_end(k, first) == second);
    let mut values = vec![0.0; domain.len() * domain.len()];
    for (row, &a) in values.chunks_exact_mut(domain.len()).zip(domain) {
        if let Some(k) = edge {
            row.iter_mut().zip(domain).for_each(|(value, &b)| *value = potentials.edge_score(k, first, a, b));
        }
    }
    for (place, _) in domain.iter().enumerate().filter(|(_, &state)| state != 0) {
        values[place * domain.len() + place] = f64::NEG_INFINITY;
    }
    values
}
