//! The structure of a template's relations: what can be searched apart once something is fixed.

use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};

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
    /// the least total importance that bring it down; `None` where not even dropping all of them does.
    pub fn within(template: &Template, weights: &Weights, max_exponent: usize) -> Option<Self> {
        let bundles = bundles_by_cost(template, weights);
        let costs: Vec<f64> = bundles.iter().map(|bundle| bundle.cost).collect();
        for dropped in subsets_by_cost(&costs) {
            let mut uses_relation = vec![true; template.relations.len()];
            for &r in dropped.iter().flat_map(|&k| &bundles[k].relations) {
                uses_relation[r] = false;
            }
            let plan = Self::new(template, uses_relation);
            if plan.exponent() <= max_exponent {
                return Some(plan);
            }
        }
        None
    }

    /// The search visits of the order of n to this power (eq. 10).
    pub fn exponent(&self) -> usize {
        let core = self.fixed.len() + usize::from(!self.independent.is_empty());
        let folded = if self.folds.iter().any(|(_, parent)| parent.is_some()) { 2 } else { 1 };
        core.max(folded)
    }

    /// Combinations of the fixed parts among `segments`, empty parts counted in; saturates.
    fn combinations(&self, segments: usize) -> usize {
        (segments + 1).saturating_pow(self.fixed.len() as u32)
    }

    pub fn drops_relations(&self) -> bool {
        self.uses_relation.iter().any(|uses| !uses)
    }
}

/// Plans for one template, the most thorough first: each cheaper than the one before it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SearchPlans(Vec<SearchPlan>);

impl SearchPlans {
    /// The plans from `max_exponent` downwards.
    pub fn new(template: &Template, weights: &Weights, max_exponent: usize) -> Self {
        let mut plans: Vec<SearchPlan> = Vec::new();
        for exponent in (1..=max_exponent.max(1)).rev() {
            match SearchPlan::within(template, weights, exponent) {
                Some(plan) if plans.last() != Some(&plan) => plans.push(plan),
                Some(_) => {}
                None => break,
            }
        }
        if plans.is_empty() {
            plans.push(SearchPlan::new(template, vec![false; template.relations.len()]));
        }
        Self(plans)
    }

    /// The most thorough plan that makes at most `max_candidates` of `segments`; the cheapest where none does.
    pub fn for_size(&self, segments: usize, max_candidates: usize) -> &SearchPlan {
        let fits = self.0.iter().find(|plan| plan.combinations(segments) <= max_candidates);
        fits.unwrap_or(&self.0[self.0.len() - 1])
    }
}

fn bits(mask: u32) -> Vec<usize> {
    (0..32).filter(|&p| mask >> p & 1 == 1).collect()
}

/// Relations that tie the same pairs of parts: the graph changes only when all of them are dropped.
struct Bundle {
    relations: Vec<usize>,
    /// Their total importance.
    cost: f64,
}

fn bundles_by_cost(template: &Template, weights: &Weights) -> Vec<Bundle> {
    let edges = |r: usize| -> BTreeSet<(usize, usize)> {
        template.relations[r].pairs.iter().map(|&(p, q)| (p.min(q), p.max(q))).collect()
    };
    let importance = &weights.importance[template.features.len()..];
    let mut bundles: Vec<Bundle> = Vec::new();
    for (r, importance) in importance.iter().enumerate() {
        match bundles.iter_mut().find(|bundle| edges(bundle.relations[0]) == edges(r)) {
            Some(bundle) => {
                bundle.relations.push(r);
                bundle.cost += importance;
            }
            None => bundles.push(Bundle { relations: vec![r], cost: *importance }),
        }
    }
    bundles.sort_by(|a, b| a.cost.total_cmp(&b.cost).then(a.relations.cmp(&b.relations)));
    bundles
}

/// All subsets of positions in `costs` (ascending) by ascending total cost, the empty one first.
fn subsets_by_cost(costs: &[f64]) -> impl Iterator<Item = Vec<usize>> + '_ {
    let total = |set: &[usize]| ordered_bits(set.iter().map(|&k| costs[k]).sum());
    let mut heap = BinaryHeap::from([Reverse((0u64, Vec::<usize>::new()))]);
    std::iter::from_fn(move || {
        let Reverse((_, set)) = heap.pop()?;
        // Each set is reached once: by growing, or by moving its last member on.
        let next = set.last().map_or(0, |last| last + 1);
        if next < costs.len() {
            let mut grown = set.clone();
            grown.push(next);
            heap.push(Reverse((total(&grown), grown)));
            if let Some((_, head)) = set.split_last() {
                let mut moved = head.to_vec();
                moved.push(next);
                heap.push(Reverse((total(&moved), moved)));
            }
        }
        Some(set)
    })
}

/// Bits of a non-negative number, in the numbers' own order.
fn ordered_bits(value: f64) -> u64 {
    value.max(0.0).to_bits()
}
