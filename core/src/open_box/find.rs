use rayon::prelude::*;

use super::assignments::Assignments;
use super::features;
use super::finish::Finishing;
use super::flap_scan::ScannedFlap;
use super::found_box::{FoundBox, COARSE_M};
use super::grow::{grow, IsHopeful};
use super::hanging::{scan_flaps, COARSE_SCAN};
use super::judgement::Judgement;
use super::last_fits::last_fits;
use super::patch::Patch;
use super::proposed::outer_m;
use super::refused::Refused;
use super::rivals::{best_of_rivals, fitted_in_turn};
use super::second_look::{more_to_fit, with_second};
use super::shared_scans::scan_flaps_of_all;
use super::shells::{shells, Shell};
use super::sight::Sight;
use super::start::body_of;
use super::told::is_told;
use crate::fit::{best_match, best_match_within, share_of_score, FitSettings, FittedBody, KnownSize};
use crate::perception::clock::Clock;
use crate::perception::Scene;

/// How well a proposal's lengths are known.
const PROPOSED_SIGMA_M: f64 = 0.01;

/// Of some 5000 boxes that were so improbable once fitted, half of all, six came to 0.3 with the second fit.
const HOPELESS_ONCE_FITTED: f64 = 0.001;

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
    let bodies: Vec<FittedBody> = shells.iter().map(|shell| body_of(&shell.proposal)).collect();
    let flaps = scan_flaps_of_all(sight, &bodies, COARSE_M, COARSE_SCAN);
    shells.iter_mut().zip(flaps).for_each(|(shell, flaps)| {
        shell.flaps = flaps;
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
    let rivals = best_of_rivals(&shells);
    let is_probable = |once: FoundBox| weighed(once).probability >= HOPELESS_ONCE_FITTED;
    // Nobody says what is hopeless where nobody judges.
    let is_hopeful = judgement.is_some().then_some(&is_probable as IsHopeful);
    let fit = |shell: &Shell| grow(sight, &body_of(&shell.proposal), &shell.flaps, settings, is_hopeful).map(weighed);
    // Nobody says that one is surely a box where nobody judges.
    let of_shells: Vec<Option<FoundBox>> = match judgement {
        Some(_) => fitted_in_turn(&rivals, fit),
        None => rivals.par_iter().map(|shell| fit(shell)).collect(),
    };
    let of_assignments = assignments.bodies.par_iter().map(|body| {
        let input_from_object = sight.input_from_level.inverse() * body.input_from_object;
        let body = FittedBody { input_from_object, ..body.clone() };
        let flaps = scan_flaps(sight, &body, COARSE_M, COARSE_SCAN);
        grow(sight, &body, &flaps, settings, is_hopeful).map(weighed)
    });
    let of_assignments: Vec<Option<FoundBox>> = of_assignments.collect();
    let found = of_shells.into_iter().chain(of_assignments).flatten().collect();
    clock.lap("rival_fits");
    let patches = Patch::of_things(scene, sight);
    let finishing = Finishing { sight, patches: &patches, assignments, sizes, settings, judgement };
    let (mut boxes, mut refused) = last_fits(found, &finishing, false);
    if judgement.is_some() {
        let is_fitted = |shell: &Shell| rivals.iter().any(|other| std::ptr::eq(*other, shell));
        let more = more_to_fit(&shells, is_fitted, &boxes, &refused, judgement);
        let grown = |shell: &&Shell| grow(sight, &body_of(&shell.proposal), &shell.flaps, settings, None);
        let second: Vec<Option<FoundBox>> = more.par_iter().map(|shell| grown(shell).map(weighed)).collect();
        let (all, more_refused) = with_second(boxes, second.into_iter().flatten().collect(), &finishing);
        boxes = all;
        refused.extend(more_refused);
    }
    clock.lap("last_fits");
    Found { boxes, refused, stage_seconds: clock.laps }
}
