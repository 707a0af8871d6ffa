//! Which way round the four sides stand: yaw, and counter-clockwise order seen from above.

use std::f64::consts::FRAC_PI_2;

use crate::geometry::Vec3;
use crate::model::{OpenBoxRoles, SegmentSet};

/// The segments of an open box by role; `sides`, `flaps` and `tucks` go round together.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BoxSegments {
    pub base: Option<usize>,
    pub sides: [Option<usize>; 4],
    pub flaps: [Option<usize>; 4],
    pub tucks: [Option<usize>; 4],
}

impl BoxSegments {
    pub fn new(roles: &OpenBoxRoles, assignment: &[Option<usize>]) -> Self {
        let of = |role: Option<usize>| role.and_then(|p| assignment[p]);
        Self {
            base: assignment[roles.base],
            sides: roles.sides.map(|p| assignment[p]),
            flaps: roles.flaps.map(of),
            tucks: roles.tucks.map(of),
        }
    }

    pub fn seen_sides(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.sides.iter().enumerate().filter_map(|(k, s)| Some((k, (*s)?)))
    }

    /// Seen from the other side: side 1 and side 3 change places, with what hangs on them.
    fn mirrored(&self) -> Self {
        let swap = |list: [Option<usize>; 4]| [list[0], list[3], list[2], list[1]];
        Self { base: self.base, sides: swap(self.sides), flaps: swap(self.flaps), tucks: swap(self.tucks) }
    }

    /// Side `by` becomes side 0.
    pub fn rotated(&self, by: usize) -> Self {
        let turn = |list: [Option<usize>; 4]| [0, 1, 2, 3].map(|k| list[(k + by) % 4]);
        Self { base: self.base, sides: turn(self.sides), flaps: turn(self.flaps), tucks: turn(self.tucks) }
    }
}

/// Direction in which side `k` looks outward, given x along side 0 and z up: -y, +x, +y, -x.
pub fn outward(k: usize, x: &Vec3, z: &Vec3) -> Vec3 {
    let y = z.cross(x);
    match k % 4 {
        0 => -y,
        1 => *x,
        2 => y,
        _ => -x,
    }
}

/// Orders the sides counter-clockwise and finds x, the direction of side 0, square to `z`.
pub fn order_ring(segments: &BoxSegments, set: &SegmentSet, z: &Vec3) -> (BoxSegments, Vec3) {
    let first_x = yaw_direction(segments, set, z);
    let mirrored = segments.mirrored();
    let mut best = (segments.clone(), first_x, f64::NEG_INFINITY);
    for order in [segments, &mirrored] {
        for quarter in 0..4 {
            let (sin, cos) = (FRAC_PI_2 * f64::from(quarter)).sin_cos();
            let x = first_x * cos + z.cross(&first_x) * sin;
            let agreement = agreement_m(order, set, &x, z);
            if agreement > best.2 {
                best = (order.clone(), x, agreement);
            }
        }
    }
    (best.0, best.1)
}

/// A horizontal direction along which one pair of sides runs: the area-weighted mean of all sides' directions modulo a
/// quarter turn (eq. 20: the fourfold angle has no jump there).
fn yaw_direction(segments: &BoxSegments, set: &SegmentSet, z: &Vec3) -> Vec3 {
    let e1 = any_perpendicular(z);
    let e2 = z.cross(&e1);
    let (mut sin4, mut cos4) = (0.0, 0.0);
    for (_, s) in segments.seen_sides() {
        let normal = &set.planes[s].normal;
        let angle4 = 4.0 * normal.dot(&e2).atan2(normal.dot(&e1));
        sin4 += set.rectangles[s].area() * angle4.sin();
        cos4 += set.rectangles[s].area() * angle4.cos();
    }
    let (sin, cos) = (sin4.atan2(cos4) / 4.0).sin_cos();
    e1 * cos + e2 * sin
}

fn any_perpendicular(z: &Vec3) -> Vec3 {
    let thinnest = if z.x.abs() < 0.6 { Vec3::x() } else { Vec3::y() };
    z.cross(&thinnest).normalize()
}

/// How far the parts lie where their numbers say (eq. 21), metres: sides against each other, flaps (less) against the sides.
fn agreement_m(order: &BoxSegments, set: &SegmentSet, x: &Vec3, z: &Vec3) -> f64 {
    let sides: Vec<(usize, usize)> = order.seen_sides().collect();
    let mut total = 0.0;
    for (at, &(i, a)) in sides.iter().enumerate() {
        for &(j, b) in &sides[..at] {
            total += (set.centers[a] - set.centers[b]).dot(&(outward(i, x, z) - outward(j, x, z)));
        }
    }
    let middle = sides.iter().map(|&(_, s)| set.centers[s]).sum::<Vec3>() / sides.len().max(1) as f64;
    for (k, flap) in order.flaps.iter().enumerate() {
        if let Some(s) = flap {
            // A flap may hang inward, so it only breaks ties.
            total += 0.1 * (set.centers[*s] - middle).dot(&outward(k, x, z));
        }
    }
    total
}
