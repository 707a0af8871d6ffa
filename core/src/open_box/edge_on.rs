//! Lids that are seen from their edge: nothing of them shows, and all of the tuck flap at their end.

use super::evidence::Sheet;
use super::hanging::{tuck_beyond, FLAP_ANGLES_RAD, TUCK_LESS_THAN_FLAP_M};
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
    let to_eye = sight.eye - hinge.middle;
    let edge_on = hinge.up.dot(&to_eye).atan2(hinge.closed.dot(&to_eye));
    let around = (-STEPS..=STEPS).map(|i| edge_on + f64::from(i) * STEP_RAD);
    let either_way = around.flat_map(|angle| [angle, angle + std::f64::consts::PI]);
    let [least, most] = FLAP_ANGLES_RAD;
    let tried = either_way.filter(|angle| (least..most).contains(angle)).filter_map(|angle| {
        let mut lid = body.clone();
        let flap = layout::flap(k);
        lid.numbers[flap + layout::FLAP_ANGLE] = angle;
        lid.numbers[flap + layout::FLAP_CURL] = 0.0;
        lid.numbers[flap + layout::FLAP_LENGTH] = lid_length_m(body, k);
        let tuck = tuck_beyond(sight, &lid, k, lid_length_m(body, k), model_m)?;
        let looked = Sheet::new(&lid, Role::Flap(k), &sight.eye).look(sight, model_m);
        let through = looked.through + tuck.through;
        lid.numbers[layout::tuck(k) + layout::TUCK_ANGLE] = tuck.angle_rad;
        lid.numbers[layout::tuck(k) + layout::TUCK_LENGTH] = tuck.length_m;
        lid.numbers[layout::tuck(k) + layout::TUCK_WIDTH] = body.get(flap + layout::FLAP_WIDTH) - TUCK_LESS_THAN_FLAP_M;
        (tuck.met > LEAST_PX && tuck.met > MET_TO_THROUGH * through).then_some((tuck.met - 2.0 * through, lid))
    });
    let best = tried.fold(None, |best: Option<(f64, FittedBody)>, one| match best {
        Some(best) if best.0 >= one.0 => Some(best),
        _ => Some(one),
    });
    best.map(|(_, lid)| lid)
}
