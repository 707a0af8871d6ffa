//! The paper's staged inference: a candidate list L on the sparse graph, its top c|L| re-ranked with every relation.

use serde::Deserialize;
use serde_json::{Map, Value};

use super::completion::Completer;
use super::graph::SearchPlan;
use super::potentials::Potentials;
use super::queue::CombinationQueue;
use crate::error::{InputError, Result};
use crate::model::{Assignment, FeatureTables, Template, Weights};

/// Settings of the staged search.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct StagedSettings {
    /// The first stage costs at most n to this power; 5 is the paper's bound for the box with every relation in.
    pub max_exponent: usize,
    /// c: the share of the candidate list that is ranked with every relation. The paper: above 1/4 nothing changes.
    pub keep_fraction: f64,
    /// The candidate list is at most this long: with more segments, the least important relations are dropped from the
    /// first stage, which then fixes fewer parts; what is still too much is cut, those with the largest phi first.
    pub max_candidates: usize,
}

impl Default for StagedSettings {
    fn default() -> Self {
        Self { max_exponent: 5, keep_fraction: 0.25, max_candidates: 500_000 }
    }
}

impl StagedSettings {
    /// The defaults with some values replaced by name.
    ///
    /// # Errors
    /// Names a setting that does not exist or a value of the wrong kind.
    pub fn with_overrides(overrides: Map<String, Value>) -> Result<Self> {
        serde_json::from_value(Value::Object(overrides))
            .map_err(|error| InputError::new(error.to_string()).in_source("search settings"))
    }
}

/// An assignment with its score under every relation.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    pub assignment: Assignment,
    /// J(G).
    pub score: f64,
}

/// What the search found, best first, one of each class of symmetric assignments.
#[derive(Debug, Clone, PartialEq)]
pub struct Ranking {
    pub candidates: Vec<Candidate>,
    /// How much more a candidate that was not looked at could score, at most (eq. 18); 0: the first is proven best.
    pub gap: f64,
}

/// Ranks assignments of the segments that are not `taken`; looks for the `most` best.
pub fn rank_staged(
    template: &Template,
    weights: &Weights,
    tables: &FeatureTables,
    plan: &SearchPlan,
    taken: &[bool],
    most: usize,
    settings: &StagedSettings,
) -> Ranking {
    let sparse = Potentials::new(template, weights, tables, &plan.uses_relation);
    let usable: Vec<bool> = std::iter::once(true).chain(taken.iter().map(|taken| !taken)).collect();
    let completer = Completer::new(&sparse, plan, &usable);

    let (list, list_is_complete) = candidate_list(template, &sparse, plan, &completer, &usable, settings);
    let complete = |entry: &(f64, Vec<usize>)| scored(template, weights, tables, &completer.complete(&entry.1).states);
    let (mut candidates, unseen_bound) = if plan.drops_relations() {
        // The list's order is only the sparse graph's: the paper ranks its top c|L| with every relation.
        let keep = (list.len() as f64 * settings.keep_fraction).ceil() as usize;
        let candidates = list.iter().take(keep.max(1)).map(complete).collect();
        (candidates, list.first().map_or(f64::NEG_INFINITY, |(bound, _)| *bound))
    } else {
        best_by_bound(&list, most, complete)
    };
    sort_distinct(template, &mut candidates);

    let gap = match candidates.first() {
        None => 0.0,
        Some(_) if !list_is_complete => f64::INFINITY,
        Some(best) => {
            let reach = unseen_bound + dropped_maximum(template, weights, tables, plan);
            (reach - best.score).max(0.0)
        }
    };
    Ranking { candidates, gap }
}

/// Completes the list from its top until `most` completions score at least what any later one could: those are the best.
/// Also the bound on the scores of what was not completed.
fn best_by_bound(
    list: &[(f64, Vec<usize>)],
    most: usize,
    complete: impl Fn(&(f64, Vec<usize>)) -> Candidate,
) -> (Vec<Candidate>, f64) {
    let mut candidates: Vec<Candidate> = Vec::new();
    // The `most` best scores so far, best first.
    let mut best: Vec<f64> = Vec::new();
    for entry in list {
        if best.len() == most && best.last().is_none_or(|last| *last >= entry.0) {
            return (candidates, entry.0);
        }
        let candidate = complete(entry);
        best.insert(best.partition_point(|score| *score >= candidate.score), candidate.score);
        best.truncate(most);
        candidates.push(candidate);
    }
    (candidates, f64::NEG_INFINITY)
}

/// All combinations of the fixed parts, each with the bound of its completions; sorted by that bound. False: there were
/// too many, and only those with the largest phi are in.
fn candidate_list(
    template: &Template,
    sparse: &Potentials,
    plan: &SearchPlan,
    completer: &Completer,
    usable: &[bool],
    settings: &StagedSettings,
) -> (Vec<(f64, Vec<usize>)>, bool) {
    let lists = plan.fixed.iter().map(|&p| {
        let states = sparse.unary[p].iter().enumerate().filter(|(state, _)| usable[*state]);
        states.map(|(state, &phi)| (phi, state)).collect()
    });
    let turns = symmetries_of_fixed(template, plan);
    let mut values = Vec::new();
    let mut list = Vec::new();
    for states in CombinationQueue::new(lists.collect()) {
        if uses_each_once(&states) && is_first_of_its_class(&states, &turns) {
            if list.len() == settings.max_candidates {
                return (sorted_by_bound(list), false);
            }
            list.push((completer.bound(&states, &mut values), states));
        }
    }
    (sorted_by_bound(list), true)
}

fn sorted_by_bound(mut list: Vec<(f64, Vec<usize>)>) -> Vec<(f64, Vec<usize>)> {
    list.sort_by(|a, b| b.0.total_cmp(&a.0).then_with(|| a.1.cmp(&b.1)));
    list
}

fn uses_each_once(states: &[usize]) -> bool {
    states.iter().enumerate().all(|(k, state)| *state == 0 || !states[..k].contains(state))
}

/// The symmetries that map the fixed parts onto themselves, as permutations of positions in `plan.fixed`.
fn symmetries_of_fixed(template: &Template, plan: &SearchPlan) -> Vec<Vec<usize>> {
    let position = |part: usize| plan.fixed.iter().position(|&p| p == part);
    let turn = |map: &Vec<usize>| plan.fixed.iter().map(|&p| position(map[p])).collect::<Option<Vec<usize>>>();
    template.symmetries.iter().filter_map(turn).collect()
}

fn is_first_of_its_class(states: &[usize], turns: &[Vec<usize>]) -> bool {
    turns.iter().all(|turn| {
        let turned = turn.iter().map(|&k| states[k]);
        states.iter().copied().le(turned)
    })
}

fn scored(template: &Template, weights: &Weights, tables: &FeatureTables, states: &[usize]) -> Candidate {
    let assignment: Assignment = states.iter().map(|state| state.checked_sub(1)).collect();
    let score = weights.score(&tables.feature_vector(template, &assignment));
    Candidate { assignment, score }
}

/// Sorts best first and keeps one of each class of symmetric assignments.
fn sort_distinct(template: &Template, candidates: &mut Vec<Candidate>) {
    for candidate in candidates.iter_mut() {
        candidate.assignment = first_of_class(template, &candidate.assignment);
    }
    candidates.sort_by(|a, b| b.score.total_cmp(&a.score).then_with(|| a.assignment.cmp(&b.assignment)));
    let mut seen = std::collections::BTreeSet::new();
    candidates.retain(|candidate| seen.insert(candidate.assignment.clone()));
}

/// The representative of the assignment's class under the template's symmetries.
fn first_of_class(template: &Template, assignment: &[Option<usize>]) -> Assignment {
    let turned = template.symmetries.iter().map(|map| {
        let mut out = vec![None; assignment.len()];
        for (p, segment) in assignment.iter().enumerate() {
            out[map[p]] = *segment;
        }
        out
    });
    turned.max().unwrap_or_else(|| assignment.to_vec())
}

/// The most that the relations left out of the first stage can add to any score.
fn dropped_maximum(template: &Template, weights: &Weights, tables: &FeatureTables, plan: &SearchPlan) -> f64 {
    let dropped: Vec<bool> = plan.uses_relation.iter().map(|uses| !uses).collect();
    let potentials = Potentials::new(template, weights, tables, &dropped);
    (0..potentials.edges.len()).map(|k| potentials.edge_maximum(k)).sum()
}
