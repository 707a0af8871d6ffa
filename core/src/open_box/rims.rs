//! What is seen along a box's rim: of walls of which little else is seen it is what speaks for them.

use super::labels::Present;
use super::sight::{Says, Sight};
use crate::fit::{FittedBody, Rim};
use crate::geometry::Vec3;

/// So far off a rim one looks past it, metres and pixels.
const BESIDE_M: f64 = 0.012;
const BESIDE_PX: f64 = 3.0;
/// The board is as thick as a pixel or two: a reading of it lies this far beside its middle, metres.
const ON_RIM_M: [f64; 3] = [0.0, -0.003, 0.003];
const MODEL_M: f64 = 0.006;
/// So many places of each side's rim are looked at.
const PLACES: usize = 16;
/// Where boxes still compete.
const FEW_PLACES: usize = 8;
/// A rim counts as a stripe so many pixels wide; one that may be a flap's fold as half of it.
const STRIPE_PX: f64 = 6.0;
const OF_FOLDS: f64 = 0.5;

/// Places along one side's rim, counted by what is seen there.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct RimLook {
    /// A reading on the rim, and past it on both sides the camera sees further down.
    pub ridge: f64,
    /// The same, but outside something goes on from the rim: a flap may.
    pub fold: f64,
    /// A reading on the rim, and inside something as high: nothing opens there.
    pub goes_on: f64,
    /// The camera sees through the rim.
    pub through: f64,
}

/// Looks along the rim of side `k` at so many places.
pub fn look_along(sight: &Sight, body: &FittedBody, k: usize, places: usize) -> RimLook {
    let up = body.input_from_object.rotation * Vec3::z();
    let (rim, edge_m) = (Rim::new(body, k), body.edge_m(k));
    let ask = |along: f64, inward: f64| sight.ask(&body.to_input(&rim.place(along, inward, 0.0)), &up, MODEL_M).0;
    let mut out = RimLook::default();
    for i in 0..places {
        let along = ((i as f64 + 0.5) / places as f64 - 0.5) * edge_m;
        let range = (body.to_input(&rim.place(along, 0.0, 0.0)) - sight.eye).norm();
        let beside = BESIDE_M.max(BESIDE_PX * sight.pixel_rad * range);
        let is_free = |inward: f64| matches!(ask(along, inward), Says::Through | Says::Blank);
        let mut is_through = true;
        let is_met = ON_RIM_M.iter().any(|&inward| {
            let says = ask(along, inward);
            is_through &= says == Says::Through;
            says == Says::Met
        });
        if is_met {
            *match is_free(beside).then(|| is_free(-beside)) {
                Some(true) => &mut out.ridge,
                Some(false) => &mut out.fold,
                None => &mut out.goes_on,
            } += 1.0;
        } else if is_through {
            out.through += 1.0;
        }
    }
    out
}

/// Shares of all rims of a box, of what is not hidden: those that stand free, those beside which something goes on that
/// is no flap, and those that the camera sees through.
pub fn shares(sight: &Sight, body: &FittedBody, present: &Present) -> [f64; 3] {
    let (mut free, mut goes_on, mut through) = (0.0, 0.0, 0.0);
    for k in 0..4 {
        let look = look_along(sight, body, k, PLACES);
        free += look.ridge;
        *if present.flaps[k] { &mut free } else { &mut goes_on } += look.fold;
        goes_on += look.goes_on;
        through += look.through;
    }
    [free, goes_on, through].map(|count| count / (free + goes_on + through + 1.0))
}

/// What its rims say of a box (eq. 103).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct OnRims {
    /// Of the image, for the box less those against it.
    pub pixels: f64,
    /// Of all that is not hidden, the share that stands free on the inside: what lies in the opening there is the box's contents.
    pub open: f64,
}

/// More pixels than its rims can say for a body.
pub fn most_px(sight: &Sight, body: &FittedBody) -> f64 {
    (0..4).map(|k| FEW_PLACES as f64 * place_px(sight, body, k) * STRIPE_PX).sum()
}

/// Pixels along the rim of side `k` from place to place.
fn place_px(sight: &Sight, body: &FittedBody, k: usize) -> f64 {
    let range = (body.to_input(&Rim::new(body, k).place(0.0, 0.0, 0.0)) - sight.eye).norm();
    body.edge_m(k) / FEW_PLACES as f64 / (sight.pixel_rad * range)
}

/// Looks along all four rims of a body that still competes.
pub fn of_body(sight: &Sight, body: &FittedBody) -> OnRims {
    let (mut pixels, mut open, mut all) = (0.0, 0.0, 1.0);
    for k in 0..4 {
        let look = look_along(sight, body, k, FEW_PLACES);
        pixels += place_px(sight, body, k) * STRIPE_PX * (look.ridge + OF_FOLDS * look.fold - look.through);
        open += look.ridge + look.fold;
        all += look.ridge + look.fold + look.goes_on + look.through;
    }
    OnRims { pixels, open: open / all }
}
