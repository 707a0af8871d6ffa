use super::body::{edge_place, FittedBody};
use super::layout::{HEIGHT, LENGTH, RACK, SLOT_COUNT, WIDTH};
use super::row::{Row, Slots};
use crate::geometry::Vec3;

/// The frame of side `k` at its top edge, mid-board (eq. 75): `along` the edge from its middle, `inward` off the side's
/// mid-surface, `above` the rim.
#[derive(Debug, Clone, Copy)]
pub struct Rim {
    pub k: usize,
    /// 1 for sides 0 and 1; 2 and 3 are those seen from the other end.
    sign: f64,
    sin_rack: f64,
    cos_rack: f64,
    /// Of the edges across: twice the distance from the middle of the base to this side's.
    across_m: f64,
    height_m: f64,
}

/// A point in a rim's frame, metres.
#[derive(Debug, Clone, Copy)]
pub struct AtRim {
    pub point: Vec3,
    pub along: f64,
    pub inward: f64,
    pub above: f64,
}

impl Rim {
    pub fn new(body: &FittedBody, k: usize) -> Self {
        let (sin_rack, cos_rack) = body.get(RACK).sin_cos();
        let sign = if k < 2 { 1.0 } else { -1.0 };
        Self { k, sign, sin_rack, cos_rack, across_m: body.edge_m(k + 1), height_m: body.get(HEIGHT) }
    }

    /// Sides 0 and 2 run along the length, 1 and 3 along the width.
    fn is_along_length(&self) -> bool {
        edge_place(self.k) == LENGTH
    }

    /// Of a point in the object's frame.
    #[inline(always)]
    pub fn locate(&self, point: Vec3) -> AtRim {
        let (x, y, half) = (self.sign * point.x, self.sign * point.y, self.across_m / 2.0);
        let (s, c) = (self.sin_rack, self.cos_rack);
        let (along, inward) = if self.is_along_length() {
            (x + half * s, y + half * c)
        } else {
            (s * x + c * y - half * s, s * y - c * x + half * c)
        };
        AtRim { point, along, inward, above: point.z - self.height_m }
    }

    /// The point there, in the object's frame: the inverse of `locate`.
    pub fn place(&self, along: f64, inward: f64, above: f64) -> Vec3 {
        let (s, c, half) = (self.sin_rack, self.cos_rack, self.across_m / 2.0);
        let (x, y) = if self.is_along_length() {
            (along - half * s, inward - half * c)
        } else {
            (s * along - c * inward + half, c * along + s * inward)
        };
        Vec3::new(self.sign * x, self.sign * y, above + self.height_m)
    }

    /// The edge's direction and the direction inward, object's frame.
    pub fn directions(&self) -> (Vec3, Vec3) {
        let (s, c) = (self.sin_rack, self.cos_rack);
        let (along, inward) =
            if self.is_along_length() { (Vec3::x(), Vec3::y()) } else { (Vec3::new(s, c, 0.0), Vec3::new(-c, s, 0.0)) };
        (along * self.sign, inward * self.sign)
    }

    /// The row of a measure with these derivatives by `along`, `inward` and `above`, and by the slots of its own; the
    /// dimensions that move the frame are added here.
    #[inline(always)]
    pub fn row(&self, value: f64, at: &AtRim, by: [f64; 3], mut slots: Slots) -> Row {
        let [by_along, by_inward, by_above] = by;
        let (s, c, half) = (self.sin_rack, self.cos_rack, self.across_m / 2.0);
        let (x, y) = (self.sign * at.point.x, self.sign * at.point.y);
        let (along, inward) = self.directions();
        let (across, turned) = if self.is_along_length() {
            ([s / 2.0, c / 2.0], [half * c, -half * s])
        } else {
            ([-s / 2.0, c / 2.0], [c * x - s * y - half * c, s * x + c * y - half * s])
        };
        let across_place = if self.is_along_length() { WIDTH } else { LENGTH };
        slots[across_place] += by_along * across[0] + by_inward * across[1];
        slots[RACK] += by_along * turned[0] + by_inward * turned[1];
        slots[HEIGHT] -= by_above;
        let gradient = along * by_along + inward * by_inward + Vec3::z() * by_above;
        Row::new(value, &at.point, &gradient, slots)
    }
}

pub const NO_SLOTS: Slots = [0.0; SLOT_COUNT];
