use super::checks::require_finite;
use super::factors::Factors;
use super::problem::{assignment, Problem};
use super::rules::Rules;
use super::search::Search;
use super::settings::ExactSettings;
use super::shortlist::Shortlist;
use super::symmetry::Symmetries;
use super::tighten::tighten;
use crate::error::Result;
use crate::inference::potentials::Potentials;
use crate::inference::staged::Candidate;
use crate::model::{FeatureTables, Template, Weights};

/// Scores nearer than this share of the largest table entry differ by rounding alone.
const TOLERANCE: f64 = 1e-12;

/// What the exact search found.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// Best first, distinct up to the template's symmetries; of equal scores the last in the order of segments first.
    pub candidates: Vec<Candidate>,
    /// Proven: these are the best. False: the node budget ended the search.
    pub is_optimal: bool,
    /// No wanted assignment that is not listed scores more than the first of the list plus this; 0 where optimal, infinite
    /// where nothing was found in time.
    pub gap: f64,
    /// No wanted assignment that the search left unseen scores more; none where it left none.
    pub unseen: Option<f64>,
    /// Nodes visited.
    pub nodes: u64,
}

/// The best assignments of the segments that are not `taken`, as `rules` wants them.
///
/// # Errors
/// Names a feature, relation or weight that is not a finite number.
pub fn solve(
    template: &Template,
    weights: &Weights,
    tables: &FeatureTables,
    taken: &[bool],
    rules: Rules,
    settings: &ExactSettings,
) -> Result<Solution> {
    require_finite(template, weights, tables)?;
    let potentials = Potentials::new(template, weights, tables, &vec![true; template.relations.len()]);
    let symmetries = Symmetries::new(&template.symmetries);
    let usable: Vec<bool> = std::iter::once(true).chain(taken.iter().map(|taken| !taken)).collect();
    let segments = taken.iter().filter(|taken| !**taken).count();
    let problem = Problem { potentials: &potentials, symmetries: &symmetries, segments, rules };

    let mut factors = Factors::new(&potentials, &usable);
    let mut shortlist = Shortlist::new(&rules, potentials.magnitude() * TOLERANCE);
    problem.offer(&vec![0; template.parts.len()], &mut shortlist);
    tighten(&problem, &mut factors, &mut shortlist, settings.max_sweeps);
    let (nodes, unseen) = Search::new(&problem, &factors).run(settings.max_nodes, &mut shortlist);

    let entries = shortlist.into_entries().into_iter();
    let candidates: Vec<Candidate> =
        entries.map(|(score, states)| Candidate { assignment: assignment(&states), score }).collect();
    let is_optimal = unseen == f64::NEG_INFINITY;
    let best = candidates.first().map_or(f64::NEG_INFINITY, |c| c.score);
    let gap = if is_optimal { 0.0 } else { (unseen - best).max(0.0) };
    Ok(Solution { candidates, is_optimal, gap, unseen: (!is_optimal).then_some(unseen), nodes })
}
