//! Several objects among the same segments: the best one first, then the best of what it left.

use super::exact::{marginals, solve, ExactSettings, Rules, Solution};
use super::graph::SearchPlans;
use super::settings::{SearchMethod, SearchSettings};
use super::staged::{rank_staged, Candidate, StagedSettings};
use crate::error::Result;
use crate::model::{Assignment, FeatureTables, SegmentSet, Template, Weights};

/// A template with weights and the way to search it: what competes for the segments.
#[derive(Debug, Clone, PartialEq)]
pub struct ObjectModel {
    pub template: Template,
    pub weights: Weights,
    pub plans: SearchPlans,
}

impl ObjectModel {
    pub fn new(template: Template, weights: Weights, settings: &StagedSettings) -> Self {
        let plans = SearchPlans::new(&template, &weights, settings.max_exponent);
        Self { template, weights, plans }
    }
}

/// An assignment that passed as an object.
#[derive(Debug, Clone, PartialEq)]
pub struct FoundObject {
    /// Number of the object model that it is an instance of.
    pub model: usize,
    pub candidate: Candidate,
    /// f(G) of eq. 1, in the order of the template's terms.
    pub feature_vector: Vec<f64>,
    pub gap: f64,
    /// Other assignments that were ranked against it.
    pub alternatives: usize,
    /// Of this assignment among all of its template's; none for the staged search, and where no sum was near enough.
    pub probability: Option<f64>,
    /// None for the staged search.
    pub marginals: Option<FoundMarginals>,
}

/// What the sums over all assignments say of a found object.
#[derive(Debug, Clone, PartialEq)]
pub struct FoundMarginals {
    /// Of the assignment, as far as it was summed.
    pub assignment: f64,
    /// For each segment of the set, the marginal of the part that it has; 0 where it has none.
    pub of_segment: Vec<f64>,
    /// No marginal is farther than this from the true one (eq. 51).
    pub unsummed: f64,
}

impl FoundObject {
    /// An assignment that somebody else found: scored, not searched, so nothing is known of better ones.
    pub fn of_assignment(model: &ObjectModel, set: &SegmentSet, assignment: Assignment) -> Self {
        let tables = FeatureTables::new(&model.template, set);
        let feature_vector = tables.feature_vector(&model.template, &assignment);
        let score = feature_vector.iter().zip(&model.weights.values).map(|(value, weight)| value * weight).sum();
        let candidate = Candidate { assignment, score };
        Self {
            model: 0,
            candidate,
            feature_vector,
            gap: f64::INFINITY,
            alternatives: 0,
            probability: None,
            marginals: None,
        }
    }
}

/// Assignments that are ranked for each object: the best may be refused for what it lacks.
const RANKED: usize = 20;

/// The objects of a segment set, best first, and where the search for more ended without a proof.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FoundObjects {
    pub objects: Vec<FoundObject>,
    /// What an object that was not found could score at most; none where it is proven that there is no more.
    pub missed: Option<f64>,
}

/// Takes objects out of the segments, best first, until none reaches its weights' `accept_score`. No segment is used
/// twice; of models that score the same the first one wins.
///
/// # Errors
/// What the exact search refuses: values that are no finite numbers.
pub fn find_objects(models: &[ObjectModel], set: &SegmentSet, settings: &SearchSettings) -> Result<FoundObjects> {
    let tables: Vec<FeatureTables> = models.iter().map(|model| FeatureTables::new(&model.template, set)).collect();
    let mut taken = vec![false; set.len()];
    let mut found = FoundObjects::default();
    loop {
        let (best, missed) = best_object(models, &tables, &taken, settings)?;
        let Some(mut object) = best else {
            found.missed = missed;
            return Ok(found);
        };
        if settings.search == SearchMethod::Exact {
            let number = object.model;
            tell_probabilities(&mut object, &models[number], &tables[number], &taken, &settings.exact)?;
        }
        for segment in object.candidate.assignment.iter().flatten() {
            taken[*segment] = true;
        }
        found.objects.push(object);
    }
}

/// Assignments that may be objects: of each object that `find_objects` takes out, best first, it and those that rank next among the
/// same segments, `most` in all, each with the number of its model. `tables` are the models' own.
///
/// # Errors
/// As of `find_objects`.
pub fn likely_assignments(
    models: &[&ObjectModel],
    tables: &[FeatureTables],
    settings: &ExactSettings,
    most: usize,
) -> Result<Vec<(usize, Candidate)>> {
    let mut taken = vec![false; tables.first().map_or(0, |tables| tables.segment_count)];
    let mut out = Vec::new();
    loop {
        let mut ranked = Vec::new();
        for (number, (model, tables)) in models.iter().zip(tables).enumerate() {
            let solution = accepted(model, tables, &taken, settings)?;
            ranked.extend(solution.candidates.into_iter().map(|candidate| (number, candidate)));
        }
        // A stable sort: of models that score the same the first one wins.
        ranked.sort_by(|a, b| b.1.score.total_cmp(&a.1.score));
        ranked.truncate(most);
        let Some((_, first)) = ranked.first() else { return Ok(out) };
        for segment in first.assignment.iter().flatten() {
            taken[*segment] = true;
        }
        out.extend(ranked);
    }
}

/// The best object of all models; without one, what was perhaps missed.
fn best_object(
    models: &[ObjectModel],
    tables: &[FeatureTables],
    taken: &[bool],
    settings: &SearchSettings,
) -> Result<(Option<FoundObject>, Option<f64>)> {
    let mut best: Option<FoundObject> = None;
    let mut missed: Option<f64> = None;
    for (number, (model, tables)) in models.iter().zip(tables).enumerate() {
        let contender = match settings.search {
            SearchMethod::Staged => staged_contender(model, tables, taken, &settings.staged),
            SearchMethod::Exact => {
                let (contender, unseen) = exact_contender(model, tables, taken, &settings.exact)?;
                missed = [missed, unseen].into_iter().flatten().reduce(f64::max);
                contender
            }
        };
        let Some(Contender { candidate, gap, alternatives }) = contender else { continue };
        if best.as_ref().is_none_or(|best| candidate.score > best.candidate.score) {
            let feature_vector = tables.feature_vector(&model.template, &candidate.assignment);
            best = Some(FoundObject {
                model: number,
                candidate,
                feature_vector,
                gap,
                alternatives,
                probability: None,
                marginals: None,
            });
        }
    }
    if let (Some(best), Some(unseen)) = (&mut best, missed) {
        // Another model's search may have left more open than this one's.
        best.gap = best.gap.max(unseen - best.candidate.score);
    }
    Ok((best, missed))
}

/// A model's best assignment that its template accepts and that scores enough.
struct Contender {
    candidate: Candidate,
    gap: f64,
    alternatives: usize,
}

fn staged_contender(
    model: &ObjectModel,
    tables: &FeatureTables,
    taken: &[bool],
    settings: &StagedSettings,
) -> Option<Contender> {
    let free = taken.iter().filter(|taken| !**taken).count();
    let plan = model.plans.for_size(free, settings.max_candidates);
    let ranking = rank_staged(&model.template, &model.weights, tables, plan, taken, RANKED, settings);
    let alternatives = ranking.candidates.len().saturating_sub(1);
    let mut ranked = ranking.candidates.into_iter().enumerate();
    let (place, candidate) = ranked.find(|(_, c)| model.template.accept.allows(&c.assignment))?;
    // The ranking proves its first only: of each combination of the fixed parts it holds one completion.
    let gap = if place == 0 { ranking.gap } else { f64::INFINITY };
    (candidate.score >= model.weights.accept_score).then_some(Contender { candidate, gap, alternatives })
}

/// With it, what an assignment that the search left unseen could score.
fn exact_contender(
    model: &ObjectModel,
    tables: &FeatureTables,
    taken: &[bool],
    settings: &ExactSettings,
) -> Result<(Option<Contender>, Option<f64>)> {
    let solution = accepted(model, tables, taken, settings)?;
    let (gap, alternatives) = (solution.gap, solution.candidates.len().saturating_sub(1));
    let first = solution.candidates.into_iter().next();
    Ok((first.map(|candidate| Contender { candidate, gap, alternatives }), solution.unseen))
}

/// The best assignments of those that the template accepts and that score enough.
fn accepted(model: &ObjectModel, tables: &FeatureTables, taken: &[bool], settings: &ExactSettings) -> Result<Solution> {
    let (template, weights) = (&model.template, &model.weights);
    let rules = Rules { most: RANKED, floor: weights.accept_score, accept: Some(&template.accept) };
    solve(template, weights, tables, taken, rules, settings)
}

/// The probability of the object's assignment among all of its template, none where the sums leave out too much, and the
/// marginals of its parts with what the sums left out.
fn tell_probabilities(
    object: &mut FoundObject,
    model: &ObjectModel,
    tables: &FeatureTables,
    taken: &[bool],
    settings: &ExactSettings,
) -> Result<()> {
    let (template, weights) = (&model.template, &model.weights);
    let reference = &object.candidate.assignment;
    let sums = marginals(template, weights, tables, taken, reference, weights.temperature, settings)?;
    object.probability = (sums.probability_error <= settings.sum_tolerance).then_some(sums.probability);
    let mut of_segment = vec![0.0; taken.len()];
    for (row, segment) in sums.parts.iter().zip(reference) {
        if let Some(s) = segment {
            of_segment[*s] = row[s + 1];
        }
    }
    object.marginals = Some(FoundMarginals { assignment: sums.probability, of_segment, unsummed: sums.unseen });
    Ok(())
}
