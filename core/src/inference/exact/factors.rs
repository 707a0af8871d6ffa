//! The score as tables over shrinking domains, rewritten so that each part's own table bounds what it can add.

use crate::inference::potentials::Potentials;

/// A table between two tied parts over their domains, row by row: `values[i * domain of second + j]`. No part's segment is
/// the other's: there the table holds minus infinity.
#[derive(Debug, Clone)]
pub struct Pair {
    pub first: usize,
    pub second: usize,
    pub values: Vec<f64>,
}

/// Tables that, with the prices, sum to J(G) or more for every assignment in the domains (eq. 41, 72).
#[derive(Debug, Clone)]
pub struct Factors {
    /// States that part `p` may still take, ascending; an undecided part may always stay empty: state 0, in place 0.
    pub domains: Vec<Vec<usize>>,
    /// `unary[p][i]`: of `domains[p][i]`.
    pub unary: Vec<Vec<f64>>,
    /// One for each two parts that a relation ties.
    pub pairs: Vec<Pair>,
    /// `numbers[p * parts + q]`: the pair of parts `p` and `q`.
    numbers: Vec<Option<usize>>,
    /// What each state costs whoever takes it; already taken off `unary`.
    pub prices: Vec<f64>,
}

impl Factors {
    /// The tables of `potentials` over the states that are `usable`.
    pub fn new(potentials: &Potentials, usable: &[bool]) -> Self {
        let parts = potentials.unary.len();
        let domain: Vec<usize> = (0..potentials.states).filter(|&state| usable[state]).collect();
        let unary = potentials.unary.iter().map(|values| domain.iter().map(|&state| values[state]).collect());
        let (mut pairs, mut numbers) = (Vec::new(), vec![None; parts * parts]);
        for second in 1..parts {
            for first in 0..second {
                let edge = potentials.edges_of[first].iter().find(|&&k| potentials.other_end(k, first) == second);
                let Some(&edge) = edge else { continue };
                numbers[first * parts + second] = Some(pairs.len());
                numbers[second * parts + first] = Some(pairs.len());
                pairs.push(Pair { first, second, values: pair_table(potentials, edge, first, &domain) });
            }
        }
        let prices = vec![0.0; potentials.states];
        Self { unary: unary.collect(), domains: vec![domain; parts], pairs, numbers, prices }
    }

    pub fn tied(&self, p: usize, q: usize) -> bool {
        self.numbers[p * self.domains.len() + q].is_some()
    }

    /// What the choice `place` of `part` adds to each choice `j` of `other`: `values[start + j * step]`; none where no
    /// relation ties the two.
    pub fn gains(&self, part: usize, place: usize, other: usize) -> Option<(&[f64], usize)> {
        let pair = &self.pairs[self.numbers[part * self.domains.len() + other]?];
        let width = self.domains[pair.second].len();
        Some(match pair.first == part {
            true => (&pair.values[place * width..], 1),
            false => (&pair.values[place..], width),
        })
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
            let (rows, columns, width) = (&kept[pair.first], &kept[pair.second], self.domains[pair.second].len());
            if rows.len() == self.domains[pair.first].len() && columns.len() == width {
                continue;
            }
            // In place: nothing moves towards the end.
            for (i, &row) in rows.iter().enumerate() {
                for (j, &column) in columns.iter().enumerate() {
                    pair.values[i * columns.len() + j] = pair.values[row * width + column];
                }
            }
            pair.values.truncate(rows.len() * columns.len());
        }
        for (p, places) in kept.iter().enumerate() {
            self.domains[p] = places.iter().map(|&i| self.domains[p][i]).collect();
            self.unary[p] = places.iter().map(|&i| self.unary[p][i]).collect();
        }
        true
    }
}

fn pair_table(potentials: &Potentials, edge: usize, first: usize, domain: &[usize]) -> Vec<f64> {
    let mut values = Vec::with_capacity(domain.len() * domain.len());
    let (edge, states) = (&potentials.edges[edge], potentials.states);
    // One step along the second part's states.
    let (row_step, step) = if edge.first == first { (states, 1) } else { (1, states) };
    for &a in domain {
        values.extend(domain.iter().map(|&b| edge.values[a * row_step + b * step]));
    }
    for (place, _) in domain.iter().enumerate().filter(|(_, &state)| state != 0) {
        values[place * domain.len() + place] = f64::NEG_INFINITY;
    }
    values
}
