//! Boxes one of whose sides shows nothing: it may as well stand where a segment is its flap.

use super::evidence::{Sheet, LEAST_SEEN_PX};
use super::found_box::{FoundBox, FINE_M};
use super::hanging::{put_flap, scan_flap, FINE_SCAN};
use super::labels::{Labels, Present};
use super::patch::Patch;
use super::sight::Sight;
use crate::fit::{edge_place, AtRim, FittedBody, Rim, Role};

/// The sine of the angle between an edge and the plane of a segment that may be its flap.
const MOST_TURN: f64 = 0.2;
/// A plane that leans less than the first off level (the sine) does not tell where it meets the rim's; the ends of a segment that
/// leans less than the second do.
const LEAST_LEAN: f64 = 0.2;
const LEVEL_LEAN: f64 = 0.5;
/// A side is moved by so much, metres, and leaves a box so long.
const MOVES_M: [f64; 2] = [0.008, 0.3];
const EDGES_M: [f64; 2] = [0.05, 0.8];
/// A segment that reaches so far beyond the ends of the edge is no flap's.
const BEYOND_END_M: f64 = 0.04;
/// Of the flap there as many pixels as make a panel seen are no panel's, and this share of what it meets.
const LEAST_FREE_SHARE: f64 = 0.5;
/// So many bodies are told, whose sides stand so far apart.
const MOST: usize = 2;
const APART_M: f64 = 0.01;

/// A body with a side moved and the flap that hangs there, and its parts.
#[derive(Debug)]
pub struct MovedSide {
    pub body: FittedBody,
    pub present: Present,
    /// The side, how far outwards, and pixels of its flap that are no panel's.
    side: usize,
    out_m: f64,
    free_px: f64,
}

/// The body with one of the sides that are asked for moved to where most readings that are no panel's, of it or of `others`, are its
/// flap: best first.
pub fn moved_sides(
    sight: &Sight,
    patches: &[Patch],
    found: &FoundBox,
    others: &[&Labels],
    is_asked: [bool; 4],
) -> Vec<MovedSide> {
    if is_asked.iter().all(|asked| !asked) {
        return Vec::new();
    }
    let mut is_taken = vec![false; sight.points.len()];
    std::iter::once(&found.labels)
        .chain(others.iter().copied())
        .for_each(|labels| labels.mark(sight.width, &mut is_taken));
    let mut moved = Vec::new();
    for side in (0..4).filter(|&side| is_asked[side]) {
        let mut moves: Vec<f64> = patches.iter().flat_map(|patch| moves_m(patch, &found.solution.body, side)).collect();
        moves.sort_unstable_by(f64::total_cmp);
        moves.dedup_by(|a, b| (*a - *b).abs() < FINE_M);
        moved.extend(moves.into_iter().filter_map(|out_m| moved_side(sight, found, side, out_m, &is_taken)));
    }
    moved.sort_by(|a, b| b.free_px.total_cmp(&a.free_px));
    let mut told: Vec<MovedSide> = Vec::new();
    for one in moved {
        let is_new = |other: &MovedSide| other.side != one.side || (other.out_m - one.out_m).abs() > APART_M;
        if told.len() < MOST && told.iter().all(is_new) {
            told.push(one);
        }
    }
    told
}

/// How far outwards side `k` would stand, were the segment its flap, metres.
fn moves_m(patch: &Patch, body: &FittedBody, k: usize) -> Vec<f64> {
    if patch.readings < LEAST_SEEN_PX {
        return Vec::new();
    }
    let rim = Rim::new(body, k);
    let (along, inward) = rim.directions();
    let normal = body.input_from_object.inverse().rotation * patch.normal;
    let (turn, lean) = (normal.dot(&along), normal.dot(&inward));
    let half_m = body.edge_m(k) / 2.0 + BEYOND_END_M;
    let corners: Vec<_> = patch.hull.iter().map(|corner| rim.locate(body.to_object(corner))).collect();
    if turn.abs() > MOST_TURN || corners.iter().any(|corner| corner.along.abs() > half_m) {
        return Vec::new();
    }
    let mut out = Vec::new();
    if lean.abs() > LEAST_LEAN {
        // Where its plane meets the rim's.
        let on_plane = |at: &AtRim| at.inward + (turn * at.along + normal.z * at.above) / lean;
        out.push(-corners.iter().map(on_plane).sum::<f64>() / corners.len() as f64);
    }
    if lean.abs() < LEVEL_LEAN {
        let ends = corners
            .iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| [low.min(at.inward), high.max(at.inward)]);
        out.extend(ends.map(|end| -end));
    }
    let within = |x: f64, [least, most]: [f64; 2]| (least..=most).contains(&x);
    out.retain(|out_m| within(out_m.abs(), MOVES_M) && within(body.edge_m(k + 1) + out_m, EDGES_M));
    out
}

/// The body with that side that much further out and the flap that hangs there; `None` where none does, or one whose readings are
/// other panels'.
fn moved_side(sight: &Sight, found: &FoundBox, side: usize, out_m: f64, is_taken: &[bool]) -> Option<MovedSide> {
    let mut body = found.solution.body.clone();
    let (_, inward) = Rim::new(&body, side).directions();
    body.numbers[edge_place(side + 1)] += out_m;
    body.input_from_object.translation.vector -= body.input_from_object.rotation * inward * (out_m / 2.0);
    let flap = scan_flap(sight, &body, side, FINE_M, FINE_SCAN)?;
    put_flap(&mut body, side, &flap);
    let sheet = Sheet::new(&body, Role::Flap(side), &sight.eye);
    let (met_px, free_px) = sheet.met_and(sight, FINE_M, |index| !is_taken[index]);
    let mut present = found.present;
    (present.flaps[side], present.tucks[side], present.thin[side]) = (true, false, false);
    let is_free = free_px > LEAST_SEEN_PX && free_px > LEAST_FREE_SHARE * met_px;
    is_free.then_some(MovedSide { body, present, side, out_m, free_px })
}

#[cfg(test)]
mod tests {
    use nalgebra::Isometry3;

    use super::*;
    use crate::fit::{layout, Parameters};
    use crate::geometry::Vec3;

    fn body() -> FittedBody {
        let mut numbers = Parameters::zeros();
        let lengths = [(layout::LENGTH, 0.4), (layout::WIDTH, 0.3), (layout::HEIGHT, 0.2)];
        lengths.iter().for_each(|&(place, length_m)| numbers[place] = length_m);
        FittedBody { input_from_object: Isometry3::new(Vec3::new(0.1, 0.2, 0.0), Vec3::z() * 0.4), numbers }
    }

    /// What is seen of a flap on side `k`, were that so much further out: from one way from its hinge to another.
    fn patch(k: usize, out_m: f64, angle_rad: f64, [near_m, far_m]: [f64; 2], readings: f64) -> Patch {
        let (body, rim) = (body(), Rim::new(&body(), k));
        let (sin, cos) = angle_rad.sin_cos();
        let corner = |along: f64, away: f64| body.to_input(&rim.place(along, away * cos - out_m, away * sin));
        let hull = vec![corner(-0.1, near_m), corner(0.1, near_m), corner(0.1, far_m), corner(-0.1, far_m)];
        let normal = (hull[1] - hull[0]).cross(&(hull[3] - hull[0])).normalize();
        Patch { normal, distance_m: normal.dot(&hull[0]), hull, readings }
    }

    #[test]
    fn a_segment_tells_where_the_side_stands_whose_flap_it_is() {
        let mut cases = 0;
        for k in 0..4 {
            for out_m in [-0.09, -0.02, 0.03, 0.15] {
                for angle_deg in [0.0_f64, 4.0, 25.0, 70.0, 110.0, 160.0, 180.0, 220.0] {
                    // Level flaps show where they hang by their ends alone.
                    let near_m = if angle_deg.to_radians().sin().abs() < 0.3 { 0.0 } else { 0.05 };
                    let told = moves_m(&patch(k, out_m, angle_deg.to_radians(), [near_m, 0.12], 900.0), &body(), k);
                    assert!(told.iter().any(|told| (told - out_m).abs() < 1e-3), "{k} {out_m} {angle_deg}: {told:?}");
                    cases += 1;
                }
            }
        }
        assert_eq!(cases, 128);
    }

    #[test]
    fn what_could_be_no_flap_of_it_moves_no_side() {
        let told = |patch: &Patch| moves_m(patch, &body(), 1);
        assert!(!told(&patch(1, 0.05, 1.2, [0.02, 0.1], 900.0)).is_empty());
        for (why, patch) in [
            ("it is small", patch(1, 0.05, 1.2, [0.02, 0.1], 300.0)),
            ("it is where the side stands", patch(1, 0.002, 1.2, [0.02, 0.1], 900.0)),
            ("the box would be too long", patch(1, 0.5, 1.2, [0.02, 0.1], 900.0)),
            ("it runs across", patch(2, 0.05, 1.2, [0.02, 0.1], 900.0)),
        ] {
            assert_eq!(told(&patch), Vec::<f64>::new(), "{why}");
        }
    }
}
