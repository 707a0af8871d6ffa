//! What the judgement of a fitted box, and of each of its panels, rests on.

use super::assignments::Assignments;
use super::ends::goes_on;
use super::evidence::{Evidence, Sheet};
use super::feature_names::Features;
use super::found_box::{FoundBox, FINE_M};
use super::lean::lean;
use super::owners::Owners;
use super::rims;
use super::settle::lowest_m;
use super::sight::Sight;
use super::upright::lies;
use crate::fit::{layout, lid_length_m, FittedBody, Role};
use crate::free_space::PartState;

/// A flap that is open further counts as open: flaps that lie closed look like a lid.
const OPEN_RAD: f64 = 0.4;
/// Readings are told in this unit, by the logarithm of one more.
const UNIT: f64 = 400.0;

/// Readings by their logarithm.
pub fn amount(readings: f64) -> f64 {
    (readings.max(0.0) / UNIT).ln_1p()
}

/// Whether there is any, by degrees.
fn some(amount: f64) -> f64 {
    1.0 - (-amount).exp()
}

fn share(part: f64, rest: f64) -> f64 {
    part / (part + rest + 1.0)
}

/// Of the whole box, of which panels are told or not.
pub fn of_box(sight: &Sight, assignments: &Assignments, found: &FoundBox, is_told: &dyn Fn(Role) -> bool) -> Features {
    let body = &found.solution.body;
    let opening = Sheet::of_opening(body, &sight.eye).look(sight, FINE_M);
    let readings = |wanted: &dyn Fn(Role) -> bool| -> f64 {
        let parts = found.labels.parts.iter().filter(|(role, _)| wanted(*role));
        parts.map(|(_, points)| found.labels.count(points) as f64).sum()
    };
    let is_open = |k: usize| body.get(layout::flap(k) + layout::FLAP_ANGLE).abs() > OPEN_RAD;
    let sides = found.evidence.iter().filter(|(role, _)| matches!(role, Role::Side(_)));
    let walls = sides.clone().fold(Evidence::default(), |sum, (_, e)| Evidence {
        met: sum.met + e.met,
        through: sum.through + e.through,
        hidden: sum.hidden + e.hidden,
        ..sum
    });
    let inner: f64 = sides.filter(|(_, e)| e.is_inner).map(|(_, e)| e.met).sum();
    let through: f64 = found.evidence.iter().map(|(_, e)| e.through).sum();
    let met: f64 = found.evidence.iter().map(|(_, e)| e.met).sum();
    let seen = |wanted: &dyn Fn(Role) -> bool| {
        found.labels.parts.iter().filter(|(role, points)| wanted(*role) && !points.is_empty()).count() as f64
    };
    let each = (found.labels.stride * found.labels.stride) as u32;
    // The base's segment is often the floor's.
    let panels = found.labels.parts.iter().filter(|(role, _)| *role != Role::Base);
    let flaps = panels.clone().filter(|(role, points)| matches!(role, Role::Flap(_)) && !points.is_empty());
    let go_on: f64 = flaps.map(|(role, _)| goes_on(sight, body, &found.present, *role)).sum();
    let (l, w, h) = (body.get(layout::LENGTH), body.get(layout::WIDTH), body.get(layout::HEIGHT));
    let on_walls = amount(readings(&|role| matches!(role, Role::Side(_))));
    let on_inner = amount(inner);
    let looked_inside = amount(opening.through);
    let closed_over = share(opening.met, opening.through);
    let on_open = amount(readings(&|role| matches!(role, Role::Flap(k) if is_open(k))));
    let on_closed = amount(readings(&|role| matches!(role, Role::Flap(k) if !is_open(k))));
    let walls_hidden = share(walls.hidden, walls.met + walls.through);
    let flaps_seen = seen(&|role| matches!(role, Role::Flap(_)));
    let sides_seen = seen(&|role| matches!(role, Role::Side(_)));
    let seen_sides = panels.clone().filter(|(role, points)| matches!(role, Role::Side(_)) && !points.is_empty());
    let sides_go_on: f64 = seen_sides.map(|(role, _)| goes_on(sight, body, &found.present, *role)).sum();
    let [rims_free, rims_go_on, rims_through] = rims::shares(sight, body, &found.present);
    let (shorter_edge, height) = (l.min(w).max(0.01).ln(), h.max(0.01).ln());
    let lengths: Vec<f64> = (0..4).filter_map(|k| flap_length(found, k)).collect();
    let of_across = (0..4).filter_map(|k| Some(flap_length(found, k)? / body.edge_m(k + 1)));
    let ratio =
        lengths.iter().fold(0.0, |most, x| x.max(most)) / lengths.iter().fold(f64::INFINITY, |least, x| x.min(least));
    vec![
        ("one", 1.0),
        ("on_walls", on_walls),
        ("on_inner_faces", on_inner),
        ("looked_inside", looked_inside),
        ("closed_over", closed_over),
        ("on_open_flaps", on_open),
        ("on_closed_flaps", on_closed),
        ("looked_through", share(through, met)),
        ("walls_hidden", walls_hidden),
        ("sides_seen", sides_seen),
        ("flaps_seen", flaps_seen),
        ("base_seen", seen(&|role| role == Role::Base)),
        ("shorter_edge", shorter_edge),
        ("height", height),
        ("slimness", (l.max(w) / l.min(w).max(0.01)).ln()),
        ("held", assignments.owners.held(panels.flat_map(|(_, points)| points), each)),
        ("flaps_go_on", go_on / flaps_seen.max(1.0)),
        ("hidden_and_closed", walls_hidden * closed_over),
        ("flaps_and_inside", flaps_seen * some(looked_inside)),
        ("walls_by_height", height * on_walls),
        ("hidden_behind_flaps", walls_hidden * some(on_open)),
        ("hidden_by_size", shorter_edge * walls_hidden),
        ("lid_and_inside", on_closed * some(on_inner)),
        ("rims_free", rims_free),
        ("rims_go_on", rims_go_on),
        ("rims_looked_through", rims_through),
        ("sides_go_on", sides_go_on / sides_seen.max(1.0)),
        ("assignment", assignments.score(found)),
        ("lies", f64::from(u8::from(lies(body)))),
        ("range", range(sight, body)),
        ("off_support", lowest_m(body).abs().min(MOST_OFF_M)),
        ("score", amount(found.score)),
        ("longest_flap", of_across.fold(0.0, f64::max).min(MOST_ACROSS)),
        ("flaps_unlike", if lengths.len() > 1 { ratio.ln() } else { 0.0 }),
        ("side_absent", side_absent(found, is_told)),
    ]
}

/// How probably the side that the rays bear out least is not there: a box has four.
fn side_absent(found: &FoundBox, is_told: &dyn Fn(Role) -> bool) -> f64 {
    let is_untold = |role: &Role| matches!(role, Role::Side(_)) && !is_told(*role);
    let untold = found.evidence.iter().filter(|(role, _)| is_untold(role));
    untold.map(|(_, evidence)| PartState::unseen(&evidence.looked()).absent).fold(0.0, f64::max)
}

/// Of one panel: `readings` are those it was given.
pub fn of_part(
    sight: &Sight,
    owners: &Owners,
    found: &FoundBox,
    role: Role,
    readings: &[u32],
    evidence: &Evidence,
) -> Features {
    let body = &found.solution.body;
    let of = |wanted: bool| f64::from(u8::from(wanted));
    let Evidence { met, through, hidden, .. } = *evidence;
    let length = match role {
        Role::Flap(k) => body.get(layout::flap(k) + layout::FLAP_LENGTH),
        Role::Tuck(k) => body.get(layout::tuck(k) + layout::TUCK_LENGTH),
        _ => 0.1,
    };
    let beyond = |length: f64| (length.max(0.005) / 0.1).ln();
    vec![
        ("one", 1.0),
        ("is_base", of(role == Role::Base)),
        ("is_flap", of(matches!(role, Role::Flap(_)))),
        ("is_tuck", of(matches!(role, Role::Tuck(_)))),
        ("readings", amount(readings.len() as f64)),
        ("lean", lean(sight, body, role, readings).unwrap_or(1.0).min(1.0)),
        ("looked_through", share(through, met)),
        ("hidden", share(hidden, met + through)),
        ("covered", share(readings.len() as f64, met)),
        ("length", beyond(length)),
        ("is_inner", of(evidence.is_inner)),
        ("few_and_hidden", share(hidden, met + through) / (1.0 + readings.len() as f64 / UNIT)),
        ("held", if role == Role::Base { 1.0 } else { owners.held(readings.iter(), 1) }),
        ("goes_on", goes_on(sight, body, &found.present, role)),
        ("off_lid", off_lid(body, role)),
        ("range", range(sight, body)),
        ("angle", angle(body, role)),
        ("unlike", unlike(found, role)),
        ("of_box", amount(found.score)),
    ]
}

/// From the camera to the middle of the base, by its logarithm.
fn range(sight: &Sight, body: &FittedBody) -> f64 {
    (body.input_from_object.translation.vector - sight.eye).norm().max(0.1).ln()
}

/// Higher over the support, or deeper in it, is as good as this.
const MOST_OFF_M: f64 = 0.1;
/// The same of how long a flap is, as a share of the way across.
const MOST_ACROSS: f64 = 2.0;

/// Of a flap that has readings, or whose tuck flap has.
fn flap_length(found: &FoundBox, k: usize) -> Option<f64> {
    let has = |role: Role| !found.labels.of(role).is_empty();
    let length = found.solution.body.get(layout::flap(k) + layout::FLAP_LENGTH);
    (has(Role::Flap(k)) || has(Role::Tuck(k))).then(|| length.max(0.005))
}

/// Of a flap's or tuck flap's hinge; 0 of what has none.
fn angle(body: &FittedBody, role: Role) -> f64 {
    match role {
        Role::Flap(k) => body.get(layout::flap(k) + layout::FLAP_ANGLE),
        Role::Tuck(k) => body.get(layout::tuck(k) + layout::TUCK_ANGLE),
        _ => 0.0,
    }
}

/// How far a flap's length is from that of the other seen flap that comes nearest, by its logarithm: most boxes' flaps come in
/// pairs or fours.
fn unlike(found: &FoundBox, role: Role) -> f64 {
    let Role::Flap(k) = role else { return 0.0 };
    let Some(length) = flap_length(found, k) else { return 0.0 };
    let others = (0..4).filter(|&other| other != k).filter_map(|other| flap_length(found, other));
    let nearest = others.map(|other| (length / other).ln().abs()).fold(f64::INFINITY, f64::min);
    if nearest.is_finite() {
        nearest
    } else {
        0.0
    }
}

/// Of a tuck flap, by what share its flap is longer or shorter than a lid.
fn off_lid(body: &FittedBody, role: Role) -> f64 {
    let Role::Tuck(k) = role else { return 0.0 };
    let lid_m = lid_length_m(body, k).max(0.01);
    ((body.get(layout::flap(k) + layout::FLAP_LENGTH) - lid_m).abs() / lid_m).min(1.0)
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, Isometry3};

    use super::super::labels::{Labels, Present};
    use super::*;
    use crate::fit::{Parameters, Solution};

    #[test]
    fn a_side_that_the_camera_looked_through_is_absent_and_one_that_is_hidden_or_seen_is_not() {
        let looked = |met: f64, through: f64, hidden: f64| Evidence { met, through, hidden, ..Evidence::default() };
        let mut cases = 0;
        for (readings, evidence, is_absent) in [
            (0, looked(0.0, 900.0, 0.0), true),
            (0, looked(60.0, 900.0, 0.0), true),
            (0, looked(0.0, 0.0, 900.0), false),
            (900, looked(900.0, 900.0, 0.0), false),
        ] {
            let body = FittedBody { input_from_object: Isometry3::identity(), numbers: Parameters::zeros() };
            let present = Present::default();
            let parts = vec![(Role::Side(0), vec![0; 900]), (Role::Side(1), vec![0; readings])];
            let evidence = vec![(Role::Side(0), looked(900.0, 0.0, 0.0)), (Role::Side(1), evidence)];
            let solution = Solution { body, covariance: DMatrix::zeros(0, 0).into(), motions: Vec::new() };
            let found = FoundBox::unjudged(solution, present, Labels { parts, stride: 1 }, evidence, 1800.0);
            let is_told = |role: Role| !found.labels.of(role).is_empty();
            assert_eq!(side_absent(&found, &is_told) > 0.9, is_absent, "{readings} {:?}", found.evidence);
            cases += 1;
        }
        assert_eq!(cases, 4);
    }
}
