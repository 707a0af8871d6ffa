//! Several objects among the same segments: the best one first, then the best of what it left.

use super::graph::SearchPlans;
use super::staged::{rank_staged, Candidate, StagedSettings};
use crate::model::{FeatureTables, SegmentSet, Template, Weights};

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
}

/// Assignments that are ranked for each object: the best may be refused for what it lacks.
const RANKED: usize = 20;

/// Takes objects out of the segments, best first, until none reaches its weights' `accept_score`. No segment is used
/// twice; of models that score the same the first one wins.
pub fn find_objects(models: &[ObjectModel], set: &SegmentSet, settings: &StagedSettings) -> Vec<FoundObject> {
    let tables: Vec<FeatureTables> = models.iter().map(|model| FeatureTables::new(&model.template, set)).collect();
    let mut taken = vec![false; set.len()];
    let mut found = Vec::new();
    while let Some(object) = best_object(models, &tables, &taken, settings) {
        for segment in object.candidate.assignment.iter().flatten() {
            taken[*segment] = true;
        }
        found.push(object);
    }
    found
}

fn best_object(
    models: &[ObjectModel],
    tables: &[FeatureTables],
    taken: &[bool],
    settings: &StagedSettings,
) -> Option<FoundObject> {
    let contenders = models.iter().zip(tables).enumerate().filter_map(|(number, (model, tables))| {
        let free = taken.iter().filter(|taken| !**taken).count();
        let plan = model.plans.for_size(free, settings.max_candidates);
        let ranking = rank_staged(&model.template, &model.weights, tables, plan, taken, RANKED, settings);
        let alternatives = ranking.candidates.len().saturating_sub(1);
        let mut ranked = ranking.candidates.into_iter().enumerate();
        let (place, candidate) = ranked.find(|(_, c)| model.template.accept.allows(&c.assignment))?;
        // The ranking proves its first only: of each combination of the fixed parts it holds one completion.
        let gap = if place == 0 { ranking.gap } else { f64::INFINITY };
        let passes = candidate.score >= model.weights.accept_score;
        let feature_vector = tables.feature_vector(&model.template, &candidate.assignment);
        passes.then_some(FoundObject { model: number, candidate, feature_vector, gap, alternatives })
    });
    contenders.reduce(|best, next| if next.candidate.score > best.candidate.score { next } else { best })
}
