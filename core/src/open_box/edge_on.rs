//! Lids that are seen from their edge: nothing of them shows, and all of the tuck flap at their end.

use super::evidence::Sheet;
use super::hanging::{tuck_beyond, with_tucks, ScannedTuck, FLAP_ANGLES_RAD};
use super::hinge_line::HingeLine;
use super::labels::Present;
use super::sight::Sight;
use crate::fit::{layout, lid_length_m, FittedBody, Role};

/// To either side of the angle at which the eye lies in the lid's plane so many steps are tried.
const STEPS: i32 = 6;
const STEP_RAD: f64 = 0.02;
/// A tuck flap holds so many pixels, and so many for each that one sees through lid and tuck flap.
const LEAST_PX: f64 = 350.0;
const MET_TO_THROUGH: f64 = 5.0;

/// The body with lids and their tuck flaps on sides that have no flap; `None` where none is found.
pub fn with_edge_on_lids(
    sight: &Sight,
    body: &FittedBody,
    present: &Present,
    model_m: f64,
) -> Option<(FittedBody, Present)> {
    let (mut out, mut now) = (body.clone(), *present);
    for k in (0..4).filter(|&k| !present.flaps[k]) {
        if let Some(lid) = edge_on_lid(sight, body, k, model_m) {
            let places = [
                layout::flap(k)..layout::flap(k) + layout::FLAP_COUNT,
                layout::tuck(k)..layout::tuck(k) + layout::TUCK_COUNT,
            ];
            places.into_iter().flatten().for_each(|place| out.numbers[place] = lid.numbers[place]);
            (now.flaps[k], now.tucks[k]) = (true, true);
        }
    }
    (now != *present).then_some((out, now))
}

/// The body with a lid on side `k` whose tuck flap holds most.
fn edge_on_lid(sight: &Sight, body: &FittedBody, k: usize, model_m: f64) -> Option<FittedBody> {
    let hinge = HingeLine::of_side(body, k);
    let lid_m = lid_length_m(body, k);
    let angles = hinge.edge_on_angles(&sight.eye, STEPS, STEP_RAD, FLAP_ANGLES_RAD);
    let tried = angles.into_iter().filter_map(|angle| {
        let mut lid = body.clone();
        let flap = layout::flap(k);
        lid.numbers[flap + layout::FLAP_ANGLE] = angle;
        lid.numbers[flap + layout::FLAP_CURL] = 0.0;
        lid.numbers[flap + layout::FLAP_LENGTH] = lid_m;
        let tuck = tuck_beyond(sight, &lid, k, lid_m, model_m)?;
        let through = Sheet::new(&lid, Role::Flap(k), &sight.eye).look(sight, model_m).through + tuck.through;
        let mut tucks = [None; 4];
        tucks[k] = Some(ScannedTuck { tuck, flap_length_m: lid_m });
        let (lid, _) = with_tucks(&lid, &Present::default(), &tucks);
        (tuck.met > LEAST_PX && tuck.met > MET_TO_THROUGH * through).then_some((tuck.met - 2.0 * through, lid))
    });
    let best = tried.fold(None, |best: Option<(f64, FittedBody)>, one| match best {
        Some(best) if best.0 >= one.0 => Some(best),
        _ => Some(one),
    });
    best.map(|(_, lid)| lid)
}
