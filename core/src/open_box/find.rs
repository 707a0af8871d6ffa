use rayon::prelude::*;

use super::assignments::Assignments;
use super::features;
use super::finish::Finishing;
use super::flap_scan::ScannedFlap;
use super::grow::{grow, FoundBox, COARSE_M};
use super::hanging::{scan_flaps, COARSE_SCAN};
use super::judgement::Judgement;
use super::last_fits::last_fits;
use super::patch::Patch;
use super::refused::Refused;
use super::shells::{alike, lies, outer_m, overlap, shells, Shell};
use super::sight::Sight;
use super::start::body_of;
use super::told::is_told;
use crate::fit::{best_match, best_match_within, share_of_score, FitSettings, FittedBody, KnownSize};
use crate::perception::clock::Clock;
use crate::perception::Scene;

/// Of proposals that lie upon each other so many are fitted.
const RIVALS_FITTED: usize = 8;
/// The same of proposals of boxes on their side.
const LYING_FITTED: usize = 4;
/// Proposals whose walls are all this near to each other fit alike.
const TWINS_M: f64 = 0.016;
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
    let weighed = |one: FoundBox| {
        let features = features::of_box(sight, assignments, &one, &|role| is_told(&one, role, judgement));
        let probability = judgement.map_or(1.0, |judgement| judgement.box_probability(&features));
        FoundBox { features, probability, size: best_match(&one.solution, sizes), ..one }
    };
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
    let (boxes, refused) = last_fits(found, &finishing);
    clock.lap("last_fits");
    Found { boxes, refused, stage_seconds: clock.laps }
}

/// Without those that lie upon enough better ones.
fn best_of_rivals(shells: &[Shell]) -> Vec<&Shell> {
    let mut out: Vec<&Shell> = Vec::new();
    for shell in shells {
        let is_lying = lies(&shell.proposal);
        let rivals = out.iter().filter(|other| lies(&other.proposal) == is_lying);
        let most = if is_lying { LYING_FITTED } else { RIVALS_FITTED };
        let is_new = out.iter().all(|other| !alike(&other.proposal, &shell.proposal, TWINS_M));
        if is_new && rivals.filter(|other| overlap(&other.proposal, &shell.proposal)).count() < most {
            out.push(shell);
        }
    }
    out
}
