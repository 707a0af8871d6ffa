//! Of several views the one that sees a flap best tells of it, and all say whether it is there.

use super::super::evidence::look_from_all;
use super::super::hanging::{is_there, scan_flaps, scan_tucks, with_flaps, with_tucks, FINE_SCAN};
use super::super::labels::Present;
use super::super::sight::Sight;
use crate::fit::{layout, FittedBody, Role};

/// A guess beats what a body has by this much and more pixels.
const BETTER: f64 = 1.1;
const BETTER_PX: f64 = 60.0;

/// The body with those flaps that most rays of all views bear out (eq. 101): its own, those of `others`, numbered alike, and those that
/// each view's scan of the edges finds.
pub fn best_flaps(
    sights: &[Sight],
    body: &FittedBody,
    present: &Present,
    others: &[(FittedBody, Present)],
    model_m: f64,
) -> (FittedBody, Present) {
    let scanned = sights.iter().map(|sight| with_flaps(body, &scan_flaps(sight, body, model_m, FINE_SCAN)));
    let guesses: Vec<(FittedBody, Present)> = others.iter().cloned().chain(scanned).collect();
    let (mut out, mut has) = (body.clone(), *present);
    for k in 0..4 {
        let guessed = guesses.iter().filter(|(_, present)| present.flaps[k]).map(|(guess, _)| guess);
        has.flaps[k] = take_best(sights, &mut out, present.flaps[k], Role::Flap(k), guessed, model_m);
        has.tucks[k] &= has.flaps[k];
    }
    (out, has)
}

/// The same of the flaps on its flaps.
pub fn best_tucks(
    sights: &[Sight],
    body: &FittedBody,
    present: &Present,
    others: &[(FittedBody, Present)],
    model_m: f64,
) -> (FittedBody, Present) {
    let scanned = sights
        .iter()
        .map(|sight| with_tucks(body, present, &scan_tucks(sight, body, present, &present.flaps, model_m)));
    let guesses: Vec<(FittedBody, Present)> = others.iter().cloned().chain(scanned).collect();
    let (mut out, mut has) = (body.clone(), *present);
    for k in (0..4).filter(|&k| present.flaps[k]) {
        let guessed = guesses.iter().filter(|(_, present)| present.tucks[k]).map(|(guess, _)| guess);
        has.tucks[k] = take_best(sights, &mut out, present.tucks[k], Role::Tuck(k), guessed, model_m);
    }
    (out, has)
}

/// Gives the body the best guess at one part, its own where none is better; whether it has the part then.
fn take_best<'a>(
    sights: &[Sight],
    body: &mut FittedBody,
    has_own: bool,
    role: Role,
    guesses: impl Iterator<Item = &'a FittedBody>,
    model_m: f64,
) -> bool {
    let look = |body: &FittedBody| look_from_all(sights, body, role, model_m);
    let score = |body: &FittedBody| {
        let evidence = look(body);
        evidence.met - 2.0 * evidence.through
    };
    let mut best = if has_own { BETTER * score(body).max(0.0) + BETTER_PX } else { 0.0 };
    let start = body.clone();
    for guess in guesses {
        let mut tried = start.clone();
        let (place, count) = numbers_of(role);
        (place..place + count).for_each(|i| tried.numbers[i] = guess.get(i));
        let found = score(&tried);
        if found > best {
            (best, *body) = (found, tried);
        }
    }
    let evidence = look(body);
    is_there(evidence.met, evidence.through)
}

fn numbers_of(role: Role) -> (usize, usize) {
    match role {
        Role::Tuck(k) => (layout::tuck(k), layout::TUCK_COUNT),
        _ => (layout::flap(role.side()), layout::FLAP_COUNT),
    }
}
