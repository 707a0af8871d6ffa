//! What the judgement of a fitted box, and of each of its panels, rests on.

use super::evidence::{Evidence, Sheet};
use super::grow::{FoundBox, FINE_M};
use super::lean::lean;
use super::sight::Sight;
use crate::fit::{layout, FittedBody, Role};

/// Named values, always in the same order.
pub type Features = Vec<(&'static str, f64)>;

/// Their names, in order.
pub const BOX_FEATURES: [&str; 15] = [
    "one",
    "on_walls",
    "on_inner_faces",
    "looked_inside",
    "closed_over",
    "on_open_flaps",
    "on_closed_flaps",
    "looked_through",
    "walls_hidden",
    "sides_seen",
    "flaps_seen",
    "base_seen",
    "shorter_edge",
    "height",
    "slimness",
];
pub const PART_FEATURES: [&str; 12] = [
    "one",
    "is_base",
    "is_flap",
    "is_tuck",
    "readings",
    "lean",
    "looked_through",
    "hidden",
    "covered",
    "length",
    "is_inner",
    "few_and_hidden",
];

/// A flap that is open further counts as open: flaps that lie closed look like a lid.
const OPEN_RAD: f64 = 0.4;
/// Readings are told in this unit, by the logarithm of one more.
const UNIT: f64 = 400.0;

fn amount(readings: f64) -> f64 {
    (readings.max(0.0) / UNIT).ln_1p()
}

fn share(part: f64, rest: f64) -> f64 {
    part / (part + rest + 1.0)
}

/// Of the whole box.
pub fn of_box(sight: &Sight, found: &FoundBox) -> Features {
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
    let (l, w, h) = (body.get(layout::LENGTH), body.get(layout::WIDTH), body.get(layout::HEIGHT));
    vec![
        ("one", 1.0),
        ("on_walls", amount(readings(&|role| matches!(role, Role::Side(_))))),
        ("on_inner_faces", amount(inner)),
        ("looked_inside", amount(opening.through)),
        ("closed_over", share(opening.met, opening.through)),
        ("on_open_flaps", amount(readings(&|role| matches!(role, Role::Flap(k) if is_open(k))))),
        ("on_closed_flaps", amount(readings(&|role| matches!(role, Role::Flap(k) if !is_open(k))))),
        ("looked_through", share(through, met)),
        ("walls_hidden", share(walls.hidden, walls.met + walls.through)),
        ("sides_seen", seen(&|role| matches!(role, Role::Side(_)))),
        ("flaps_seen", seen(&|role| matches!(role, Role::Flap(_)))),
        ("base_seen", seen(&|role| role == Role::Base)),
        ("shorter_edge", l.min(w).max(0.01).ln()),
        ("height", h.max(0.01).ln()),
        ("slimness", (l.max(w) / l.min(w).max(0.01)).ln()),
    ]
}

/// Of one panel: `readings` are those it was given.
pub fn of_part(sight: &Sight, body: &FittedBody, role: Role, readings: &[u32], evidence: &Evidence) -> Features {
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
    ]
}
