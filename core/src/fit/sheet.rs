//! Boards in the plane across their hinge: a flap, bent on a circle, and the tuck flap on its free edge (eq. 77, 78).

use super::layout::{FLAP_ANGLE, FLAP_CURL, FLAP_LENGTH, SLOT_FLAP, SLOT_TUCK, TUCK_ANGLE};
use super::row::Slots;

/// A flap's section: it leaves the hinge at `angle` against the inward direction.
#[derive(Debug, Clone, Copy)]
pub struct FlapSection {
    pub sin: f64,
    pub cos: f64,
    pub length_m: f64,
    pub curl: f64,
}

/// A measure in the section, with its derivatives by inward, above, and the numbers of flap and tuck.
#[derive(Debug, Clone, Copy)]
pub struct Measure {
    pub value: f64,
    pub by_inward: f64,
    pub by_above: f64,
    pub slots: Slots,
}

impl FlapSection {
    pub fn new(angle_rad: f64, length_m: f64, curl: f64) -> Self {
        let (sin, cos) = angle_rad.sin_cos();
        Self { sin, cos, length_m, curl }
    }

    /// Along the tangent at the hinge, and off it: upwards where the flap is closed.
    fn to_tangent(self, inward: f64, above: f64) -> (f64, f64) {
        (self.cos * inward + self.sin * above, self.cos * above - self.sin * inward)
    }

    #[inline(always)]
    fn measure(&self, value: f64, (x, y): (f64, f64), (by_x, by_y): (f64, f64), by_curl: f64) -> Measure {
        let mut slots = [0.0; super::layout::SLOT_COUNT];
        slots[SLOT_FLAP + FLAP_ANGLE] = by_x * y - by_y * x;
        slots[SLOT_FLAP + FLAP_CURL] = by_curl;
        let by_inward = by_x * self.cos - by_y * self.sin;
        Measure { value, by_inward, by_above: by_x * self.sin + by_y * self.cos, slots }
    }

    /// Height over the bent board's middle: the distance from a circle through the hinge, in a form that has no pole where
    /// the board is flat.
    #[inline(always)]
    pub fn height(&self, inward: f64, above: f64) -> Measure {
        let (x, y) = self.to_tangent(inward, above);
        let curl = self.curl;
        let squares = x * x + y * y;
        let root = (1.0 - 2.0 * curl * y + curl * curl * squares).sqrt();
        let height = (2.0 * y - curl * squares) / (1.0 + root);
        let by_curl = (height * height - squares) / (2.0 * root);
        self.measure(height, (x, y), (-curl * x / root, (1.0 - curl * y) / root), by_curl)
    }

    /// Way from the hinge along the board, to third order in the bend.
    pub fn way(&self, inward: f64, above: f64) -> Measure {
        let (x, y) = self.to_tangent(inward, above);
        let bend = self.curl * x;
        let by_x = 1.0 + bend * bend / 2.0;
        self.measure(x * (1.0 + bend * bend / 6.0), (x, y), (by_x, 0.0), bend * x * x / 3.0)
    }

    /// Where the board ends, in the tangent's frame, to the same order.
    pub fn end(&self) -> (f64, f64) {
        let bend = self.curl * self.length_m;
        (self.length_m * (1.0 - bend * bend / 6.0), self.length_m * bend / 2.0)
    }

    /// The free edge in the rim's frame: inward, above.
    pub fn end_at_rim(&self) -> (f64, f64) {
        let (x, y) = self.end();
        (self.cos * x - self.sin * y, self.sin * x + self.cos * y)
    }
}

/// A tuck flap's section: its position turns it from the flap's tangent, against the flap's own sense.
#[derive(Debug, Clone, Copy)]
pub struct TuckSection {
    flap: FlapSection,
    own_sin: f64,
    own_cos: f64,
    pub sin: f64,
    pub cos: f64,
}

impl TuckSection {
    pub fn new(flap: FlapSection, flap_angle_rad: f64, tuck_angle_rad: f64) -> Self {
        let (own_sin, own_cos) = tuck_angle_rad.sin_cos();
        let (sin, cos) = (flap_angle_rad - tuck_angle_rad).sin_cos();
        Self { flap, own_sin, own_cos, sin, cos }
    }

    /// Way from the tuck's hinge along it.
    pub fn way(&self, inward: f64, above: f64) -> Measure {
        self.measure(inward, above, (1.0, 0.0))
    }

    /// Height over its middle.
    pub fn height(&self, inward: f64, above: f64) -> Measure {
        self.measure(inward, above, (0.0, 1.0))
    }

    /// The measure `by.0 * way + by.1 * height`.
    #[inline(always)]
    fn measure(&self, inward: f64, above: f64, by: (f64, f64)) -> Measure {
        let (x0, y0) = (self.cos * inward + self.sin * above, self.cos * above - self.sin * inward);
        let (end_x, end_y) = self.flap.end();
        let (s, c) = (self.own_sin, self.own_cos);
        // A shift of the flap's end moves the tuck's hinge; here in the tuck's own directions.
        let hinge = |x: f64, y: f64| (c * x - s * y, s * x + c * y);
        let (hinge_x, hinge_y) = hinge(end_x, end_y);
        let (x, y) = (x0 - hinge_x, y0 - hinge_y);
        let (length, curl) = (self.flap.length_m, self.flap.curl);
        let bend = curl * length;
        let of = |(dx, dy): (f64, f64)| by.0 * dx + by.1 * dy;
        let mut slots = [0.0; super::layout::SLOT_COUNT];
        slots[SLOT_FLAP + FLAP_ANGLE] = of((y0, -x0));
        slots[SLOT_FLAP + FLAP_LENGTH] = -of(hinge(1.0 - bend * bend / 2.0, bend));
        slots[SLOT_FLAP + FLAP_CURL] = -of(hinge(-bend * length * length / 3.0, length * length / 2.0));
        slots[SLOT_TUCK + TUCK_ANGLE] = of((-y, x));
        let by_inward = by.0 * self.cos - by.1 * self.sin;
        Measure { value: of((x, y)), by_inward, by_above: by.0 * self.sin + by.1 * self.cos, slots }
    }
}

impl Measure {
    /// The measure times a number.
    pub fn scaled(&self, by: f64) -> Self {
        let mut slots = self.slots;
        slots.iter_mut().for_each(|slot| *slot *= by);
        Self { value: self.value * by, by_inward: self.by_inward * by, by_above: self.by_above * by, slots }
    }
}
