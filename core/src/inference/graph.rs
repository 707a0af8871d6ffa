//! The structure of a template's relations: what can be searched apart once something is fixed.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::model::{Template, Weights};

/// Which parts are tied by a relation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RelationGraph {
    /// Bit `q` of `neighbours[p]`: some relation ties `p` and `q`.
    pub neighbours: Vec<u32>,
}

impl RelationGraph {
    pub fn new(template: &Template, uses_relation: &[bool]) -> Self {
        let mut neighbours = vec![0u32; template.parts.len()];
        for (term, _) in template.relations.iter().zip(uses_relation).filter(|(_, uses)| **uses) {
            for &(p, q) in &term.pairs {
                neighbours[p] |= 1 << q;
                neighbours[q] |= 1 << p;
            }
        }
        Self { neighbours }
    }

    /// Parts tied to at most one other, taken away one after another: `(part, the part it hangs on)`.
    fn folds(&self) -> (Vec<(usize, Option<usize>)>, u32) {
        let count = self.neighbours.len();
        let mut left: u32 = if count == 32 { u32::MAX } else { (1 << count) - 1 };
        let mut folds = Vec::new();
        // Later parts first: in the templates what hangs on something stands after it.
        while let Some(p) =
            (0..count).rev().find(|&p| left >> p & 1 == 1 && (self.neighbours[p] & left).count_ones() <= 1)
        {
            let rest = self.neighbours[p] & left;
            folds.push((p, (rest != 0).then(|| rest.trailing_zeros() as usize)));
            left &= !(1 << p);
        }
        (folds, left)
    }

    /// The largest set of parts within `among` of which no two are tied; the first in the order of bits among equals.
    fn largest_independent(&self, among: u32) -> u32 {
        let Some(p) = (0..32).find(|&p| among >> p & 1 == 1) else {
            return 0;
        };
        let rest = among & !(1 << p);
        let without = self.largest_independent(rest);
        let with = 1 << p | self.largest_independent(rest & !self.neighbours[p]);
        if with.count_ones() > without.count_ones() {
            with
        } else {
            without
        }
    }
}

/// How the staged search goes about a template: what it fixes, what is then independent, what hangs on what.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SearchPlan {
    /// Which relations the candidate list is made with; the others wait for the re-ranking.
    pub uses_relation: Vec<bool>,
    /// Parts that are fixed together, every combination of segments.
    pub fixed: Vec<usize>,
    /// Parts that are independent of each other once those are fixed.
    pub independent: Vec<usize>,
    /// Parts folded away beforehand with what each hangs on (none: it is tied to nothing), leaves first.
    pub folds: Vec<(usize, Option<usize>)>,
}

impl SearchPlan {
    /// The cheapest plan for the relations that `uses_relation` admits.
    pub fn new(template: &Template, uses_relation: Vec<bool>) -> Self {
        let graph = RelationGraph::new(template, &uses_relation);
        let (folds, core) = graph.folds();
        let independent = graph.largest_independent(core);
        Self { uses_relation, fixed: bits(core & !independent), independent: bits(independent), folds }
    }

    /// The plan with every relation, or, where that costs more than `n^max_exponent`, the one that drops the relations of
    /// the least total importance that bring it down.
    pub fn within(template: &Template, weights: &Weights, max_exponent: usize) -> Self {
        let count = template.relations.len();
        let importance = &weights.importance[template.features.len()..];
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by(|&a, &b| importance[a].total_cmp(&importance[b]).then(a.cmp(&b)));
        for dropped in subsets_by_cost(&order, importance) {
            let plan = Self::new(template, (0..count).map(|r| !dropped.contains(&r)).collect());
            if plan.exponent() <= max_exponent {
                return plan;
            }
        }
        Self::new(template, vec![false; count])
    }

    /// The search visits of the order of n to this power.
    pub fn exponent(&self) -> usize {
        let core = self.fixed.len() + usize::from(!self.independent.is_empty());
        let folded = if self.folds.iter().any(|(_, parent)| parent.is_some()) { 2 } else { 1 };
        core.max(folded)
    }

    pub fn drops_relations(&self) -> bool {
        self.uses_relation.iter().any(|uses| !uses)
    }
}

fn bits(mask: u32) -> Vec<usize> {
    (0..32).filter(|&p| mask >> p & 1 == 1).collect()
}

/// All subsets of `order` (ascending cost) by ascending total cost, smallest first.
fn subsets_by_cost<'a>(order: &'a [usize], cost: &'a [f64]) -> impl Iterator<Item = Vec<usize>> + 'a {
    let total = |set: &[usize]| ordered_bits(set.iter().map(|&k| cost[order[k]].max(0.0)).sum());
    let mut heap = BinaryHeap::from([Reverse((0u64, Vec::<usize>::new()))]);
    std::iter::from_fn(move || {
        let Reverse((_, set)) = heap.pop()?;
        // Each set is reached once: by growing, or by moving its last member on.
        let next = set.last().map_or(0, |last| last + 1);
        if next < order.len() {
            let mut grown = set.clone();
            grown.push(next);
            heap.push(Reverse((total(&grown), grown)));
            if let Some((_, head)) = set.split_last() {
                let mut moved = head.to_vec();
                moved.push(next);
                heap.push(Reverse((total(&moved), moved)));
            }
        }
        Some(set.iter().map(|&k| order[k]).collect())
    })
}

/// Bits of a non-negative number, in the numbers' own order.
fn ordered_bits(value: f64) -> u64 {
    value.max(0.0).to_bits()
}
