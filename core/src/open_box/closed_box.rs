//! Boxes that are closed: what looks from outside like a box with a top on it. They are asked for where a template is one.

use super::evidence::{Evidence, Sheet};
use super::found_box::{FoundBox, COARSE_M, COARSE_STRIDE, FINE_M};
use super::grow::{competing, sound};
use super::label::label;
use super::labels::{roles, Present};
use super::patch::Patch;
use super::proposal::{proposals, Proposal};
use super::proposed::overlap;
use super::refit::refit;
use super::shell::Rays;
use super::sight::Sight;
use super::start::body_of;
use super::sure::drop_unsure;
use super::told::few_panels;
use super::yaw::yaws;
use crate::fit::{canonical_turn, layout, FitSettings, FittedBody, Role};
use crate::geometry::Vec3;
use crate::perception::Scene;

/// So many pixels for a closed box more than against it.
const LEAST_SCORE: f64 = 1200.0;
/// Of proposals that lie upon each other so many are fitted.
const RIVALS_FITTED: usize = 4;
const MOST_FITTED: usize = 24;
/// A top that is not level with the rim is a lid.
const MOST_LID_RAD: f64 = 0.05;
/// It reaches from wall to wall, within this share.
const TOP_SHARE: f64 = 0.12;
/// Of what is looked at of its panels that are seen the share that is met.
const LEAST_MET: f64 = 0.85;
/// Smaller things are no cartons, metres.
const LEAST_M: [(usize, f64); 3] = [(layout::LENGTH, 0.1), (layout::WIDTH, 0.1), (layout::HEIGHT, 0.03)];
/// A box shares at most this much of its readings with a better one.
const MOST_SHARED: f64 = 0.1;

const TOP: usize = 0;
const PRESENT: Present = Present { flaps: [true, false, false, false], tucks: [false; 4], thin: [false; 4] };

/// The closed boxes among the readings that are not `taken`, best first.
pub fn find_closed(sight: &Sight, scene: &Scene, taken: &[bool], settings: &FitSettings) -> Vec<FoundBox> {
    let mut scored = scored_proposals(sight, scene);
    scored.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut fitted: Vec<&Proposal> = Vec::new();
    for (_, proposal) in &scored {
        let rivals = fitted.iter().filter(|other| overlap(other, proposal)).count();
        if rivals < RIVALS_FITTED && fitted.len() < MOST_FITTED {
            fitted.push(proposal);
        }
    }
    let mut found: Vec<FoundBox> =
        fitted.into_iter().filter_map(|proposal| closed(sight, proposal, settings)).collect();
    found.sort_by(|a, b| b.score.total_cmp(&a.score));
    let mut taken = taken.to_vec();
    found.retain(|one| {
        let points = || one.labels.parts.iter().flat_map(|(_, points)| points);
        let shared = points().filter(|&&point| taken[point as usize]).count();
        let is_free = shared as f64 <= MOST_SHARED * points().count() as f64;
        if is_free {
            points().for_each(|&point| taken[point as usize] = true);
        }
        is_free
    });
    found
}

fn scored_proposals(sight: &Sight, scene: &Scene) -> Vec<(f64, Proposal)> {
    let patches = Patch::of_things(scene, sight);
    let rays = Rays::new(sight);
    let frame = [Vec3::x(), Vec3::y(), Vec3::z()];
    let mut out = Vec::new();
    for yaw in yaws(&patches, &frame) {
        let of_yaw = proposals(&patches, &[], &frame, yaw);
        let Some(first) = of_yaw.first() else { continue };
        let along = rays.along(sight, first);
        let scored = of_yaw.iter().filter_map(|proposal| {
            let score = rays.look_at_closed(sight, proposal, &along)?;
            (score >= LEAST_SCORE).then(|| (score, proposal.clone()))
        });
        out.extend(scored);
    }
    out
}

/// Fitted as a box whose flap 0, shut, is as large as the opening; `None` of what is no such box.
fn closed(sight: &Sight, proposal: &Proposal, settings: &FitSettings) -> Option<FoundBox> {
    let few = competing(settings);
    let body = with_top(&body_of(proposal));
    let labels = label(sight, &body, &PRESENT, COARSE_M, COARSE_STRIDE);
    let body = refit(sight, &body, &PRESENT, &labels, &few).ok()?.body;
    let body = body.turned(canonical_turn(&body, Some(sight.eye)));
    let labels = label(sight, &with_top(&body), &PRESENT, FINE_M, 1);
    let solution = refit(sight, &with_top(&body), &PRESENT, &labels, settings).ok()?;
    sound(&solution.body).ok()?;
    if !has_top(&solution.body) {
        return None;
    }
    let mut labels = label(sight, &solution.body, &PRESENT, FINE_M, 1);
    drop_unsure(sight, &solution.body, &mut labels);
    // Nothing inside is seen: what lies near an inner face is of another panel's edge.
    let is_inner = |role: Role| role == Role::Base || Sheet::new(&solution.body, role, &sight.eye).is_inner();
    roles(&PRESENT).into_iter().filter(|role| is_inner(*role)).for_each(|role| labels.clear(role));
    let look = |role: Role| (role, Sheet::new(&solution.body, role, &sight.eye).look(sight, FINE_M));
    let evidence: Vec<(Role, Evidence)> = roles(&PRESENT).into_iter().map(look).collect();
    let outer = evidence.iter().filter(|(role, _)| !is_inner(*role));
    let (met, through) = outer.fold((0.0, 0.0), |(met, through), (_, e)| (met + e.met, through + e.through));
    let seen = labels.parts.iter().filter(|(_, points)| !points.is_empty()).count();
    let is_box = few_panels(seen).is_none()
        && !labels.of(Role::Flap(TOP)).is_empty()
        && met > LEAST_MET * (met + through)
        && LEAST_M.iter().all(|&(place, least_m)| solution.body.get(place) > least_m);
    let score = met - 2.0 * through;
    is_box.then(|| FoundBox::unjudged(solution, PRESENT, labels, evidence, score))
}

/// With flap 0 shut, from wall to wall.
fn with_top(body: &FittedBody) -> FittedBody {
    let mut out = body.clone();
    let flap = layout::flap(TOP);
    out.numbers[flap + layout::FLAP_LENGTH] = body.edge_m(TOP + 1);
    out.numbers[flap + layout::FLAP_WIDTH] = body.edge_m(TOP);
    for place in [layout::FLAP_ANGLE, layout::FLAP_CURL, layout::FLAP_TAPER, layout::FLAP_OFFSET] {
        out.numbers[flap + place] = 0.0;
    }
    out
}

fn has_top(body: &FittedBody) -> bool {
    let flap = |place: usize| body.get(layout::flap(TOP) + place);
    let (length_m, width_m) = (body.edge_m(TOP + 1), body.edge_m(TOP));
    flap(layout::FLAP_ANGLE).abs() < MOST_LID_RAD
        && (flap(layout::FLAP_LENGTH) - length_m).abs() < TOP_SHARE * length_m
        && (flap(layout::FLAP_WIDTH) - width_m).abs() < TOP_SHARE * width_m
}
