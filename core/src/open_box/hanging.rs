//! What hangs on a body's edges: flaps, and tuck flaps on them.

use super::flap_scan::{scan, HingeLine, ScanRange, ScannedFlap};
use super::sight::Sight;
use super::surfaces::Present;
use crate::fit::{layout, FittedBody};

/// Pushed a little into the box, to hanging along its side.
const FLAP_ANGLES_RAD: [f64; 2] = [-0.25, 4.3];

/// No flap is longer than the box is across, but for this share and more.
const LONGEST_SHARE: f64 = 1.06;
const LONGER_M: f64 = 0.02;

/// Angles that are followed, and places along the edge: while boxes compete, and of one that is fitted.
pub const COARSE_SCAN: [usize; 2] = [2, 6];
pub const FINE_SCAN: [usize; 2] = [4, 12];

/// The flap on each of a body's top edges, and none where the readings speak against any.
pub fn scan_flaps(
    sight: &Sight,
    body: &FittedBody,
    model_m: f64,
    [peaks, columns]: [usize; 2],
) -> [Option<ScannedFlap>; 4] {
    std::array::from_fn(|k| {
        let range = ScanRange {
            angles_rad: FLAP_ANGLES_RAD,
            longest_m: LONGEST_SHARE * body.edge_m(k + 1) + LONGER_M,
            model_m,
            peaks,
            columns,
        };
        scan(sight, &HingeLine::of_side(body, k), &range).filter(is_flap)
    })
}

/// Pixels on a flap, and how often more than through it.
const LEAST_MET: f64 = 120.0;
const MET_TO_THROUGH: f64 = 1.5;

fn is_flap(flap: &ScannedFlap) -> bool {
    is_there(flap.met, flap.through)
}

/// Whether so many pixels on a flap, and through it, make it one.
pub fn is_there(met: f64, through: f64) -> bool {
    met > LEAST_MET && met > MET_TO_THROUGH * through
}

/// The body with these flaps.
pub fn with_flaps(body: &FittedBody, flaps: &[Option<ScannedFlap>; 4]) -> (FittedBody, Present) {
    let mut out = body.clone();
    let mut present = Present::default();
    for (k, flap) in flaps.iter().enumerate() {
        let Some(flap) = flap else { continue };
        present.flaps[k] = true;
        out.numbers[layout::flap(k) + layout::FLAP_ANGLE] = flap.angle_rad;
        out.numbers[layout::flap(k) + layout::FLAP_CURL] = flap.curl;
        out.numbers[layout::flap(k) + layout::FLAP_LENGTH] = flap.length_m;
    }
    (out, present)
}

/// The tuck flap on each flap's free edge.
pub fn scan_tucks(sight: &Sight, body: &FittedBody, present: &Present, model_m: f64) -> [Option<ScannedFlap>; 4] {
    std::array::from_fn(|k| {
        if !present.flaps[k] {
            return None;
        }
        let longest_m = (TUCK_SHARE * body.get(layout::flap(k) + layout::FLAP_LENGTH)).min(MOST_TUCK_M);
        let [peaks, columns] = FINE_SCAN;
        let range = ScanRange { angles_rad: TUCK_ANGLES_RAD, longest_m, model_m, peaks, columns };
        scan(sight, &HingeLine::of_flap(body, k), &range).filter(is_flap)
    })
}

pub const TUCK_LESS_THAN_FLAP_M: f64 = 0.01;
/// A tuck flap is at most so long, and this share of its flap.
const MOST_TUCK_M: f64 = 0.12;
const TUCK_SHARE: f64 = 0.45;
const TUCK_ANGLES_RAD: [f64; 2] = [-1.9, 2.2];

/// The body with these tuck flaps.
pub fn with_tucks(body: &FittedBody, present: &Present, tucks: &[Option<ScannedFlap>; 4]) -> (FittedBody, Present) {
    let (mut out, mut present) = (body.clone(), *present);
    for (k, tuck) in tucks.iter().enumerate() {
        let Some(tuck) = tuck else { continue };
        present.tucks[k] = true;
        out.numbers[layout::tuck(k) + layout::TUCK_ANGLE] = tuck.angle_rad;
        out.numbers[layout::tuck(k) + layout::TUCK_LENGTH] = tuck.length_m;
        out.numbers[layout::tuck(k) + layout::TUCK_WIDTH] =
            body.get(layout::flap(k) + layout::FLAP_WIDTH) - TUCK_LESS_THAN_FLAP_M;
    }
    (out, present)
}
