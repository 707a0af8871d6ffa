//! What hangs on a body's edges: flaps, and tuck flaps on them.

use super::evidence::Sheet;
use super::flap_scan::{scan, ScanRange, ScannedFlap};
use super::hinge_line::HingeLine;
use super::labels::Present;
use super::sight::{Says, Sight};
use crate::fit::{layout, lid_length_m, FittedBody, Role};

/// Pushed a little into the box, to hanging down.
pub const FLAP_ANGLES_RAD: [f64; 2] = [-0.25, 4.3];
/// Hanging into the box. Nearer to its side's plane it is what shows of a wall a little higher.
const INTO_BOX_RAD: [f64; 2] = [-1.05, -0.2];

/// No flap is longer than the box is across, but for this share and more.
const LONGEST_SHARE: f64 = 1.06;
const LONGER_M: f64 = 0.02;

/// How an edge is scanned for its flap.
#[derive(Debug, Clone, Copy)]
pub struct FlapScan {
    angles_rad: [f64; 2],
    /// Angles that are followed.
    peaks: usize,
    /// Places along the edge.
    columns: usize,
}

/// Of a proposal, and of a body that is fitted.
pub const COARSE_SCAN: FlapScan = FlapScan { angles_rad: FLAP_ANGLES_RAD, peaks: 2, columns: 6 };
pub const FINE_SCAN: FlapScan = FlapScan { angles_rad: FLAP_ANGLES_RAD, peaks: 4, columns: 12 };

/// The flap on each of a body's top edges, and none where the readings speak against any.
pub fn scan_flaps(sight: &Sight, body: &FittedBody, model_m: f64, by: FlapScan) -> [Option<ScannedFlap>; 4] {
    std::array::from_fn(|k| scan_flap(sight, body, k, model_m, by))
}

/// That on the top edge of side `k`.
pub fn scan_flap(sight: &Sight, body: &FittedBody, k: usize, model_m: f64, by: FlapScan) -> Option<ScannedFlap> {
    scan(sight, &HingeLine::of_side(body, k), &flap_range(body, k, model_m, by)).filter(is_flap)
}

/// Of the flap on side `k`.
pub fn flap_range(body: &FittedBody, k: usize, model_m: f64, by: FlapScan) -> ScanRange {
    let FlapScan { angles_rad, peaks, columns } = by;
    let longest_m = longest_flap_m(body, k);
    ScanRange { angles_rad, longest_m, model_m, peaks, columns, over_hidden: false }
}

/// No flap on side `k` is longer.
pub fn longest_flap_m(body: &FittedBody, k: usize) -> f64 {
    LONGEST_SHARE * body.edge_m(k + 1) + LONGER_M
}

/// The flaps on those edges that are asked for that hang into the box.
pub fn scan_flaps_into_box(
    sight: &Sight,
    body: &FittedBody,
    model_m: f64,
    is_asked: [bool; 4],
) -> [Option<ScannedFlap>; 4] {
    let by = FlapScan { angles_rad: INTO_BOX_RAD, ..FINE_SCAN };
    std::array::from_fn(|k| {
        let found =
            is_asked[k].then(|| scan(sight, &HingeLine::of_side(body, k), &flap_range(body, k, model_m, by)))?;
        found.filter(is_flap)
    })
}

/// The flaps on those edges that are asked for, looked for beyond what hides them near their hinges.
pub fn scan_hidden_flaps(
    sight: &Sight,
    body: &FittedBody,
    model_m: f64,
    is_asked: [bool; 4],
) -> [Option<ScannedFlap>; 4] {
    std::array::from_fn(|k| {
        let found = is_asked[k].then(|| scan(sight, &HingeLine::of_side(body, k), &hidden_range(body, k, model_m)))?;
        found.filter(is_flap)
    })
}

/// Of the flap on side `k`, looked for beyond what hides it.
pub fn hidden_range(body: &FittedBody, k: usize, model_m: f64) -> ScanRange {
    ScanRange { over_hidden: true, ..flap_range(body, k, model_m, FINE_SCAN) }
}

/// Pixels on a flap, and how often more than through it.
const LEAST_MET: f64 = 120.0;
const MET_TO_THROUGH: f64 = 1.5;

pub fn is_flap(flap: &ScannedFlap) -> bool {
    is_there(flap.met, flap.through)
}

/// Whether so many pixels on a flap, and through it, make it one.
pub fn is_there(met: f64, through: f64) -> bool {
    met > LEAST_MET && met > MET_TO_THROUGH * through
}

/// A flap on side `k` that is as wide as its edge, in place of what was known of one.
pub fn put_flap(body: &mut FittedBody, k: usize, flap: &ScannedFlap) {
    let numbers = [
        (layout::FLAP_LENGTH, flap.length_m),
        (layout::FLAP_WIDTH, body.edge_m(k)),
        (layout::FLAP_TAPER, 0.0),
        (layout::FLAP_OFFSET, 0.0),
        (layout::FLAP_ANGLE, flap.angle_rad),
        (layout::FLAP_CURL, flap.curl),
    ];
    numbers.into_iter().for_each(|(place, number)| body.numbers[layout::flap(k) + place] = number);
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

/// A tuck flap, and how long its flap is then.
#[derive(Debug, Clone, Copy)]
pub struct ScannedTuck {
    pub tuck: ScannedFlap,
    pub flap_length_m: f64,
}

/// A flap was followed beyond its crease by as much.
const FOLLOWED_TOO_FAR_M: [f64; 6] = [0.0, 0.01, 0.02, 0.03, 0.045, 0.06];

/// The tuck flap on each flap's free edge, where the flap's surface bends before it, or where a lid ends: what tucks in does so at
/// the far side.
///
/// Lids are looked for among the flaps that `may_be_lid`.
pub fn scan_tucks(
    sight: &Sight,
    body: &FittedBody,
    present: &Present,
    may_be_lid: &[bool; 4],
    model_m: f64,
) -> [Option<ScannedTuck>; 4] {
    std::array::from_fn(|k| {
        if !present.flaps[k] {
            return None;
        }
        let of_flap = FOLLOWED_TOO_FAR_M.iter().filter_map(|&less_m| scan_tuck(sight, body, k, less_m, model_m));
        let of_lid = may_be_lid[k].then(|| scan_lid_tuck(sight, body, k, model_m)).flatten();
        let found = of_flap.chain(of_lid);
        let best = found.fold(None, |best: Option<(f64, ScannedTuck)>, one| match best {
            Some(best) if best.0 >= one.0 => Some(best),
            _ => Some(one),
        });
        best.map(|(_, tuck)| tuck)
    })
}

/// The tuck flap of a flap that is shorter than it was fitted, and the readings that both hold more than the flap did.
fn scan_tuck(sight: &Sight, body: &FittedBody, k: usize, less_m: f64, model_m: f64) -> Option<(f64, ScannedTuck)> {
    let length_m = body.get(layout::flap(k) + layout::FLAP_LENGTH);
    let flap_length_m = length_m - less_m;
    if less_m > 0.0 && flap_length_m < (1.0 - TUCK_SHARE) * length_m {
        return None;
    }
    let tuck = tuck_beyond(sight, body, k, flap_length_m, model_m)?;
    let more = tuck.score() - given_up(sight, body, k, flap_length_m, model_m);
    // A flap that is flat on bends nowhere.
    let is_bent = less_m == 0.0 || (tuck.angle_rad.abs() > BENT_RAD && more > LEAST_MET);
    is_bent.then_some((more, ScannedTuck { tuck, flap_length_m }))
}

/// The same of a flap that reaches across the box, however much of it was seen: its tuck flap may hide it, or lie in its plane.
fn scan_lid_tuck(sight: &Sight, body: &FittedBody, k: usize, model_m: f64) -> Option<(f64, ScannedTuck)> {
    let length_m = body.get(layout::flap(k) + layout::FLAP_LENGTH);
    let lid_m = lid_length_m(body, k);
    if length_m < LEAST_LID_SHARE * lid_m {
        return None;
    }
    let tuck = tuck_beyond(sight, body, k, lid_m, model_m)?;
    let mut lid = body.clone();
    lid.numbers[layout::flap(k) + layout::FLAP_LENGTH] = lid_m;
    let sheet = Sheet::new(&lid, Role::Flap(k), &sight.eye);
    let through =
        if lid_m > length_m { sheet.asked_between(sight, [length_m, lid_m], model_m, Says::Through) } else { 0.0 };
    let more = tuck.score() - given_up(sight, body, k, lid_m, model_m) - 2.0 * through;
    // In the lid's plane only what is much shorter than that is no piece of it.
    let is_flat = tuck.angle_rad.abs() < BENT_RAD;
    let is_lid =
        through < tuck.score() && tuck.score() > LEAST_MET && !(is_flat && tuck.length_m > LONGEST_FLAT_SHARE * lid_m);
    is_lid.then_some((more + LID_SHARE * tuck.score(), ScannedTuck { tuck, flap_length_m: lid_m }))
}

/// Of a lid so much is seen, at least; and that a tuck flap hangs where lids end counts for this share of its readings.
const LEAST_LID_SHARE: f64 = 0.4;
const LID_SHARE: f64 = 0.5;
const LONGEST_FLAT_SHARE: f64 = 0.3;

/// The board on the free edge of flap `k`, were that so long.
pub fn tuck_beyond(
    sight: &Sight,
    body: &FittedBody,
    k: usize,
    flap_length_m: f64,
    model_m: f64,
) -> Option<ScannedFlap> {
    let mut so_long = body.clone();
    so_long.numbers[layout::flap(k) + layout::FLAP_LENGTH] = flap_length_m;
    let longest_m = (TUCK_SHARE * flap_length_m).min(MOST_TUCK_M);
    let FlapScan { peaks, columns, .. } = FINE_SCAN;
    let range = ScanRange { angles_rad: TUCK_ANGLES_RAD, longest_m, model_m, peaks, columns, over_hidden: false };
    scan(sight, &HingeLine::of_flap(&so_long, k), &range).filter(is_flap)
}

/// Readings of flap `k` beyond that length.
fn given_up(sight: &Sight, body: &FittedBody, k: usize, flap_length_m: f64, model_m: f64) -> f64 {
    let length_m = body.get(layout::flap(k) + layout::FLAP_LENGTH);
    if flap_length_m >= length_m {
        return 0.0;
    }
    let sheet = Sheet::new(body, Role::Flap(k), &sight.eye);
    sheet.asked_between(sight, [flap_length_m, length_m], model_m, Says::Met)
}

/// A crease before a flap's end bends by more.
const BENT_RAD: f64 = 0.2;

pub const TUCK_LESS_THAN_FLAP_M: f64 = 0.01;
/// A tuck flap is at most so long, and this share of its flap.
const MOST_TUCK_M: f64 = 0.12;
const TUCK_SHARE: f64 = 0.45;
const TUCK_ANGLES_RAD: [f64; 2] = [-1.9, 2.2];

/// The body with these tuck flaps.
pub fn with_tucks(body: &FittedBody, present: &Present, tucks: &[Option<ScannedTuck>; 4]) -> (FittedBody, Present) {
    let (mut out, mut present) = (body.clone(), *present);
    for (k, tuck) in tucks.iter().enumerate() {
        let Some(ScannedTuck { tuck, flap_length_m }) = tuck else { continue };
        present.tucks[k] = true;
        out.numbers[layout::flap(k) + layout::FLAP_LENGTH] = *flap_length_m;
        out.numbers[layout::tuck(k) + layout::TUCK_ANGLE] = tuck.angle_rad;
        out.numbers[layout::tuck(k) + layout::TUCK_LENGTH] = tuck.length_m;
        out.numbers[layout::tuck(k) + layout::TUCK_WIDTH] =
            body.get(layout::flap(k) + layout::FLAP_WIDTH) - TUCK_LESS_THAN_FLAP_M;
    }
    (out, present)
}
