//! From all fitted boxes of a scene to those that are told: chosen, fitted to all of their readings, and chosen anew where that fails.

use rayon::prelude::*;

use super::choose::{choose, excludes, Chosen};
use super::finish::Finishing;
use super::found_box::FoundBox;
use super::judgement::Judgement;
use super::labels::Labels;
use super::refused::{Refusal, Refused};
use super::told::refusal;
use crate::fit::FittedBody;

/// It is chosen anew so often, at most.
const MOST_AGAIN: usize = 3;

/// A share of what is told: of some hundred boxes so improbable none came, with all of its readings, to a tenth of what is.
const HOPELESS: f64 = 0.03;

/// What takes the place of one that is not told must be likelier than not: it is the best of several.
const EVEN: f64 = 0.5;

/// Those chosen of the fitted boxes, fitted to all of their readings, best first. Where that does not end in a box that is told, it is
/// chosen anew from the rest; where all that failed are boxes that are not told, from what is probable enough to be told. Those that
/// nothing replaces come last.
///
/// A second choice is told where it is likelier than not; those found may be such from the start.
pub fn last_fits(mut found: Vec<FoundBox>, finishing: &Finishing, are_second: bool) -> (Vec<FoundBox>, Vec<Refused>) {
    let (mut told, mut doubtful): (Vec<Done>, Vec<FoundBox>) = (Vec::new(), Vec::new());
    let mut refused: Vec<Refused> = Vec::new();
    let mut is_second_choice = are_second;
    let mut bodies: Vec<FittedBody> = Vec::new();
    for _ in 0..=MOST_AGAIN {
        let chosen = choose(&found, finishing.sight.width);
        bodies = chosen.iter().map(|chosen| chosen.one.solution.body.clone()).collect();
        let is_new = |chosen: &Chosen| told.iter().all(|done| done.chosen != chosen.one.solution.body);
        let new: Vec<Chosen> = chosen.into_iter().filter(is_new).collect();
        let (new, hopeless): (Vec<Chosen>, Vec<Chosen>) =
            new.into_iter().partition(|chosen| !is_hopeless(&chosen.one, finishing.judgement));
        let is_likely = |one: &FoundBox| one.probability >= EVEN;
        let held: Vec<Option<Labels>> =
            new.iter().map(|chosen| is_likely(&chosen.one).then(|| chosen.one.labels.clone())).collect();
        let end = |(number, chosen): (usize, Chosen)| {
            let beside =
                held.iter().enumerate().filter(|(other, _)| *other != number).filter_map(|(_, held)| held.as_ref());
            let others: Vec<&Labels> = beside.chain(told.iter().map(|done| &done.one.labels)).collect();
            (chosen.one.solution.body.clone(), finishing.best(chosen, &others))
        };
        let is_unlikely = |one: &FoundBox| is_second_choice && finished_probability(one, finishing.judgement) < EVEN;
        let (mut failed, mut all_fitted) = (Vec::new(), true);
        let ended = new.into_par_iter().enumerate().map(end).collect::<Vec<_>>();
        for (chosen, one) in ended {
            match one {
                Ok(one) if is_unlikely(&one) => {
                    let why = Refusal::Improbable {
                        probability: finished_probability(&one, finishing.judgement),
                        least: EVEN,
                    };
                    refused.push(Refused { body: one.solution.body, why });
                }
                Ok(one) if refusal(&one, finishing.judgement).is_none() => {
                    told.push(Done { chosen, one });
                    continue;
                }
                Ok(one) => doubtful.push(one),
                Err(why) => {
                    all_fitted = false;
                    refused.push(Refused { body: chosen.clone(), why: Refusal::NotFitted(why) });
                }
            }
            failed.push(chosen);
        }
        for Chosen { one, .. } in hopeless {
            let least = least_told(&one, finishing.judgement);
            let why = Refusal::Improbable { probability: one.probability, least };
            failed.push(one.solution.body.clone());
            refused.push(Refused { body: one.solution.body, why });
        }
        if failed.is_empty() {
            break;
        }
        is_second_choice = are_second || all_fitted;
        let is_told = |one: &FoundBox| told.iter().any(|done| done.chosen == one.solution.body);
        let is_failed = |one: &FoundBox| failed.contains(&one.solution.body);
        found.retain(|one| is_told(one) || (!is_failed(one) && (!all_fitted || is_probable(one, finishing.judgement))));
    }
    let of = |body: &FittedBody| told.iter().find(|done| done.chosen == *body).map(|done| done.one.clone());
    let mut boxes: Vec<FoundBox> = bodies.iter().filter_map(of).collect();
    for one in doubtful {
        if boxes.iter().all(|other| !excludes(other, &one, finishing.sight.width)) {
            boxes.push(one);
        }
    }
    (boxes, refused)
}

/// A finished box that is told, and the body that was chosen.
struct Done {
    chosen: FittedBody,
    one: FoundBox,
}

/// Whether no last fit would make it a box that is told.
fn is_hopeless(one: &FoundBox, judgement: Option<&Judgement>) -> bool {
    one.probability < HOPELESS * least_at_best(one, judgement)
}

/// Whether it would be told if its last fit changed nothing but what speaks for doubt: that needs all of its readings.
fn is_probable(one: &FoundBox, judgement: Option<&Judgement>) -> bool {
    one.probability >= least_at_best(one, judgement)
}

fn least_at_best(one: &FoundBox, judgement: Option<&Judgement>) -> f64 {
    judgement.map_or(0.0, |judgement| judgement.box_told_from_at_best(&one.features))
}

/// The probability of a finished box.
fn finished_probability(one: &FoundBox, judgement: Option<&Judgement>) -> f64 {
    judgement.map_or(1.0, |judgement| judgement.box_probability(&one.features))
}

/// The probability from which on it is told.
fn least_told(one: &FoundBox, judgement: Option<&Judgement>) -> f64 {
    judgement.map_or(0.0, |judgement| judgement.box_told_from(&one.features))
}
