//! Two boxes: separating axes where they meet, edges against the other box where they do not.

use nalgebra::Matrix3;

use super::oriented_box::{OrientedBox, EDGES};
use super::segment_box;
use crate::geometry::Vec3;

/// Edges nearer to parallel than this (sine) give no axis of their own: the faces' stand for it.
const PARALLEL: f64 = 1e-9;

/// The largest gap along the fifteen separating axes: where it is below 0 it is the signed distance, else a bound from below.
pub fn widest_gap_m(a: &OrientedBox, b: &OrientedBox) -> f64 {
    // b's axes and centre, told in a.
    let turn: Matrix3<f64> = a.base_from_box.rotation.tr_mul(&b.base_from_box.rotation);
    let centre: Vec3 = a.base_from_box.rotation.tr_mul(&(b.centre() - a.centre()));
    let across = turn.abs();
    let faces_a = centre.abs() - a.half_m - across * b.half_m;
    let faces_b = turn.tr_mul(&centre).abs() - b.half_m - across.tr_mul(&a.half_m);
    let mut widest = faces_a.max().max(faces_b.max());
    for i in 0..3 {
        let (i1, i2) = ((i + 1) % 3, (i + 2) % 3);
        for j in 0..3 {
            let (j1, j2) = ((j + 1) % 3, (j + 2) % 3);
            // The axis is a's i crossed with b's j; its length is the sine between them.
            let sine = turn[(i1, j)].hypot(turn[(i2, j)]);
            if sine > PARALLEL {
                let gap = (centre[i2] * turn[(i1, j)] - centre[i1] * turn[(i2, j)]).abs();
                let of_a = a.half_m[i1] * across[(i2, j)] + a.half_m[i2] * across[(i1, j)];
                let of_b = b.half_m[j1] * across[(i, j2)] + b.half_m[j2] * across[(i, j1)];
                widest = widest.max((gap - of_a - of_b) / sine);
            }
        }
    }
    widest
}

pub fn signed_distance_m(a: &OrientedBox, b: &OrientedBox) -> f64 {
    distance_unless_above_m(a, b, f64::INFINITY)
}

/// The signed distance where it is below `bound_m`, else something that is no less.
pub fn distance_unless_above_m(a: &OrientedBox, b: &OrientedBox, bound_m: f64) -> f64 {
    let gap = widest_gap_m(a, b);
    if gap <= 0.0 || gap >= bound_m {
        return gap;
    }
    edges_distance_m(a, b).min(edges_distance_m(b, a))
}

/// At least `clearance_m` apart; cheaper than the distance.
pub fn clear_by(a: &OrientedBox, b: &OrientedBox, clearance_m: f64) -> bool {
    let gap = widest_gap_m(a, b);
    if gap >= clearance_m {
        return true;
    }
    gap > 0.0 && edges_distance_m(a, b) >= clearance_m && edges_distance_m(b, a) >= clearance_m
}

/// From the nearest of a's edges to the box b. Two boxes that are apart are nearest at an edge of one of them.
fn edges_distance_m(a: &OrientedBox, b: &OrientedBox) -> f64 {
    let corners = a.corners().map(|corner| b.base_from_box.apply_inverse(&corner));
    EDGES
        .iter()
        .map(|&(i, j)| segment_box::distance_m(&corners[i], &corners[j], &b.half_m))
        .fold(f64::INFINITY, f64::min)
}
