use rayon::prelude::*;

use super::assignments::Assignments;
use super::choose::{choose, Chosen};
use super::features;
use super::finish::Finishing;
use super::flap_scan::ScannedFlap;
use super::grow::{grow, FoundBox, COARSE_M};
use super::hanging::{scan_flaps, COARSE_SCAN};
use super::judgement::{probability, Judgement};
use super::patch::Patch;
use super::refused::{Refusal, Refused};
use super::shells::{lies, outer_m, overlap, shells, Shell};
use super::sight::Sight;
use super::start::body_of;
use crate::fit::{best_match, best_match_within, share_of_score, FitSettings, FittedBody, KnownSize};
use crate::perception::clock::Clock;
use crate::perception::Scene;

/// Of proposals that lie upon each other so many are fitted.
const RIVALS_FITTED: usize = 8;
/// The same of proposals of boxes on their side.
const LYING_FITTED: usize = 4;
/// How well a proposal's lengths are known.
const PROPOSED_SIGMA_M: f64 = 0.01;

/// What was found in one frame.
#[derive(Debug, Default)]
pub struct Found {
    pub boxes: Vec<FoundBox>,
    /// Borne out, but their fit did not end in a box.
    pub refused: Vec<Refused>,
    /// Time by the wall clock, in order.
    pub stage_seconds: Vec<(&'static str, f64)>,
}

/// The boxes that the segments propose and the depth image bears out, best first; none takes another's readings.
///
/// Of rivals those that have one of the given `sizes` win.
pub fn find(
    sight: &Sight,
    scene: &Scene,
    assignments: &Assignments,
    sizes: &[KnownSize],
    settings: &FitSettings,
    judgement: Option<&Judgement>,
) -> Found {
    let mut clock = Clock::start();
    let mut shells = shells(sight, scene);
    clock.lap("proposals");
    // Each by itself, in their order: the same bits on any number of threads.
    shells.par_iter_mut().for_each(|shell| {
        shell.flaps = scan_flaps(sight, &body_of(&shell.proposal), COARSE_M, COARSE_SCAN);
        shell.score = shell.of_walls() + shell.flaps.iter().flatten().map(ScannedFlap::score).sum::<f64>();
        shell.score *= share_of_score(best_match_within(outer_m(&shell.proposal), PROPOSED_SIGMA_M, sizes).as_ref());
    });
    shells.sort_by(|a, b| b.score.total_cmp(&a.score));
    clock.lap("flap_scans");
    let judged = |one: &FoundBox| {
        let odds = |judgement: &Judgement| judgement.of_box(&features::of_box(sight, assignments, one)).0;
        judgement.map_or(1.0, |judgement| probability(odds(judgement)))
    };
    let weighed = |one: FoundBox| FoundBox { probability: judged(&one), size: best_match(&one.solution, sizes), ..one };
    let of_shells = best_of_rivals(&shells).into_par_iter().map(|shell| (body_of(&shell.proposal), shell.flaps));
    let of_assignments = assignments.bodies.par_iter().map(|body| {
        let input_from_object = sight.input_from_level.inverse() * body.input_from_object;
        let body = FittedBody { input_from_object, ..body.clone() };
        let flaps = scan_flaps(sight, &body, COARSE_M, COARSE_SCAN);
        (body, flaps)
    });
    let rivals = of_shells.chain(of_assignments);
    let found = rivals.filter_map(|(body, flaps)| grow(sight, &body, &flaps, settings)).map(weighed).collect();
    clock.lap("rival_fits");
    let patches = Patch::of_things(scene, sight);
    let finishing = Finishing { sight, patches: &patches, assignments, sizes, settings, judgement };
    let (boxes, refused) = finished(found, &finishing);
    clock.lap("last_fits");
    Found { boxes, refused, stage_seconds: clock.laps }
}

/// It is chosen anew so often, at most.
const MOST_AGAIN: usize = 3;

/// Those chosen of the fitted boxes, fitted to all of their readings. Where that does not end in a box, the rest is chosen from anew.
fn finished(mut found: Vec<FoundBox>, finishing: &Finishing) -> (Vec<FoundBox>, Vec<Refused>) {
    let mut done: Vec<(FittedBody, FoundBox)> = Vec::new();
    let mut refused: Vec<Refused> = Vec::new();
    let mut again = 0;
    loop {
        let chosen = choose(&found, finishing.sight.width);
        let bodies: Vec<FittedBody> = chosen.iter().map(|chosen| chosen.one.solution.body.clone()).collect();
        let is_new = |chosen: &Chosen| done.iter().all(|(body, _)| *body != chosen.one.solution.body);
        let new: Vec<Chosen> = chosen.into_iter().filter(is_new).collect();
        let end = |chosen: Chosen| (chosen.one.solution.body.clone(), finishing.best(chosen));
        let mut failed: Vec<FittedBody> = Vec::new();
        for (body, one) in new.into_par_iter().map(end).collect::<Vec<_>>() {
            match one {
                Ok(one) => done.push((body, one)),
                Err(why) => {
                    failed.push(body.clone());
                    refused.push(Refused { body, why: Refusal::NotFitted(why) });
                }
            }
        }
        if failed.is_empty() || again == MOST_AGAIN {
            let of = |body: &FittedBody| done.iter().find(|(other, _)| other == body).map(|(_, one)| one.clone());
            return (bodies.iter().filter_map(of).collect(), refused);
        }
        found.retain(|one| !failed.contains(&one.solution.body));
        again += 1;
    }
}

/// Without those that lie upon enough better ones.
fn best_of_rivals(shells: &[Shell]) -> Vec<&Shell> {
    let mut out: Vec<&Shell> = Vec::new();
    for shell in shells {
        let is_lying = lies(&shell.proposal);
        let rivals = out.iter().filter(|other| lies(&other.proposal) == is_lying);
        let most = if is_lying { LYING_FITTED } else { RIVALS_FITTED };
        if rivals.filter(|other| overlap(&other.proposal, &shell.proposal)).count() < most {
            out.push(shell);
        }
    }
    out
}
