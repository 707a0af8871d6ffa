use super::body::{edge_place, FittedBody};
use super::layout::{self, FLAP_LENGTH, FLAP_OFFSET, FLAP_TAPER, FLAP_WIDTH, HEIGHT, SLOT_BULGE, SLOT_FLAP, SLOT_TUCK};
use super::layout::{FLAP_ANGLE, FLAP_CURL, THICKNESS, TUCK_ANGLE, TUCK_LENGTH, TUCK_WIDTH};
use super::rim::{AtRim, Rim, NO_SLOTS};
use super::roles::Role;
use super::row::Row;
use super::sheet::{FlapSection, Measure, TuckSection};
use crate::geometry::Vec3;

/// Ends of a side, flap or tuck flap: 0 where its side starts, 1 where that ends, 2 at its hinge or rim, 3 across from it. Of
/// the base end `k` is the one at side `k`.
const AT_END: usize = 1;
pub const NEAR: usize = 2;
const FAR: usize = 3;

/// For each end the coordinate of `Panel::flat` that it bounds, and which way.
pub fn outward_coordinate(role: Role, end: usize) -> (usize, f64) {
    match role {
        Role::Base => [(1, -1.0), (0, 1.0), (1, 1.0), (0, -1.0)][end],
        _ => [(0, -1.0), (0, 1.0), (1, -1.0), (1, 1.0)][end],
    }
}

/// One panel of a body, ready to be held against points in the object's frame.
#[derive(Debug, Clone, Copy)]
pub struct Panel<'a> {
    pub role: Role,
    body: &'a FittedBody,
    rims: [Rim; 4],
    flap: FlapSection,
    tuck: TuckSection,
}

impl<'a> Panel<'a> {
    pub fn new(body: &'a FittedBody, role: Role) -> Self {
        let k = role.side();
        let flap_angle = body.get(layout::flap(k) + FLAP_ANGLE);
        let length = body.get(layout::flap(k) + FLAP_LENGTH);
        let flap = FlapSection::new(flap_angle, length, body.get(layout::flap(k) + FLAP_CURL));
        let tuck = TuckSection::new(flap, flap_angle, body.get(layout::tuck(k) + TUCK_ANGLE));
        Self { role, body, rims: [0, 1, 2, 3].map(|k| Rim::new(body, k)), flap, tuck }
    }

    fn rim(&self) -> &Rim {
        &self.rims[self.role.side()]
    }

    fn flap_number(&self, place: usize) -> f64 {
        self.body.get(layout::flap(self.role.side()) + place)
    }

    fn tuck_number(&self, place: usize) -> f64 {
        self.body.get(layout::tuck(self.role.side()) + place)
    }

    /// Coordinates in the panel: along its side, and away from its hinge or rim; of the base x and y.
    pub fn flat(&self, q: &Vec3) -> [f64; 2] {
        let at = self.rim().locate(*q);
        match self.role {
            Role::Base => [q.x, q.y],
            Role::Side(_) => [at.along, -at.above],
            Role::Flap(_) => [at.along, self.flap.way(at.inward, at.above).value],
            Role::Tuck(_) => [at.along, self.tuck.way(at.inward, at.above).value],
        }
    }

    /// Directions of those coordinates at the hinge, object's frame.
    pub fn axes(&self) -> [Vec3; 2] {
        let (along, inward) = self.rim().directions();
        match self.role {
            Role::Base => [Vec3::x(), Vec3::y()],
            Role::Side(_) => [along, -Vec3::z()],
            Role::Flap(_) => [along, inward * self.flap.cos + Vec3::z() * self.flap.sin],
            Role::Tuck(_) => [along, inward * self.tuck.cos + Vec3::z() * self.tuck.sin],
        }
    }

    /// Unit vector off the panel at its hinge: outwards of a side, upwards of the base and of what is closed.
    pub fn normal(&self) -> Vec3 {
        let (_, inward) = self.rim().directions();
        match self.role {
            Role::Base => Vec3::z(),
            Role::Side(_) => -inward,
            Role::Flap(_) => Vec3::z() * self.flap.cos - inward * self.flap.sin,
            Role::Tuck(_) => Vec3::z() * self.tuck.cos - inward * self.tuck.sin,
        }
    }

    /// Distance from the face that is `face` half boards off the middle (eq. 76): outwards of a side, upwards of the base
    /// and of what is closed. The base's upper face is all that anyone sees of it.
    #[inline]
    pub fn face(&self, q: &Vec3, face: f64) -> Row {
        if self.role == Role::Base {
            let mut slots = NO_SLOTS;
            slots[THICKNESS] = -1.0;
            return Row::new(q.z - self.body.get(THICKNESS), q, &Vec3::z(), slots);
        }
        let at = self.rim().locate(*q);
        let half_board = face * self.body.get(THICKNESS) / 2.0;
        let mut row = match self.role {
            Role::Flap(_) => self.section_row(&at, 0.0, &self.flap.height(at.inward, at.above)),
            Role::Tuck(_) => self.section_row(&at, 0.0, &self.tuck.height(at.inward, at.above)),
            Role::Side(_) | Role::Base => self.side_row(&at),
        };
        row.value -= half_board;
        row.slots[THICKNESS] -= face / 2.0;
        row
    }

    /// How far beyond the panel's end the point lies, in the panel (eq. 79); `face` as for `face`.
    pub fn beyond(&self, q: &Vec3, end: usize, face: f64) -> Row {
        match self.role {
            Role::Base => self.beyond_base(q, end),
            Role::Side(k) => self.beyond_side(q, k, end, face),
            Role::Flap(_) => self.beyond_flap(q, end),
            Role::Tuck(_) => self.beyond_tuck(q, end),
        }
    }

    /// The base ends at the sides' inner faces.
    fn beyond_base(&self, q: &Vec3, end: usize) -> Row {
        let at = self.rims[end].locate(*q);
        let mut slots = NO_SLOTS;
        slots[THICKNESS] = 0.5;
        self.rims[end].row(self.body.get(THICKNESS) / 2.0 - at.inward, &at, [0.0, -1.0, 0.0], slots)
    }

    fn beyond_side(&self, q: &Vec3, k: usize, end: usize, face: f64) -> Row {
        let at = self.rim().locate(*q);
        let mut slots = NO_SLOTS;
        match end {
            NEAR => self.rim().row(at.above, &at, [0.0, 0.0, 1.0], slots),
            FAR => {
                // The inner face ends on the base, the outer on the support.
                let inner = (1.0 - face) / 2.0;
                slots[THICKNESS] = inner;
                slots[HEIGHT] = -1.0;
                let height = self.body.get(HEIGHT);
                let value = inner * self.body.get(THICKNESS) - height - at.above;
                self.rim().row(value, &at, [0.0, 0.0, -1.0], slots)
            }
            _ => {
                let sign = if end == AT_END { 1.0 } else { -1.0 };
                slots[edge_place(k)] = -0.5;
                slots[THICKNESS] = -face / 2.0;
                let reach = (self.body.edge_m(k) + face * self.body.get(THICKNESS)) / 2.0;
                self.rim().row(sign * at.along - reach, &at, [sign, 0.0, 0.0], slots)
            }
        }
    }

    fn beyond_flap(&self, q: &Vec3, end: usize) -> Row {
        let at = self.rim().locate(*q);
        let mut way = self.flap.way(at.inward, at.above);
        match end {
            NEAR => self.section_row(&at, 0.0, &way.scaled(-1.0)),
            FAR => {
                way.value -= self.flap.length_m;
                way.slots[SLOT_FLAP + FLAP_LENGTH] -= 1.0;
                self.section_row(&at, 0.0, &way)
            }
            _ => {
                let sign = if end == AT_END { 1.0 } else { -1.0 };
                let (length, taper) = (self.flap.length_m, self.flap_number(FLAP_TAPER));
                let drawn_in = way.value / length;
                let mut out = way.scaled(taper / length);
                out.value += sign * (at.along - self.flap_number(FLAP_OFFSET)) - self.flap_number(FLAP_WIDTH) / 2.0;
                out.slots[SLOT_FLAP + FLAP_TAPER] += drawn_in;
                out.slots[SLOT_FLAP + FLAP_LENGTH] -= taper * drawn_in / length;
                out.slots[SLOT_FLAP + FLAP_OFFSET] -= sign;
                out.slots[SLOT_FLAP + FLAP_WIDTH] -= 0.5;
                self.section_row(&at, sign, &out)
            }
        }
    }

    fn beyond_tuck(&self, q: &Vec3, end: usize) -> Row {
        let at = self.rim().locate(*q);
        let mut way = self.tuck.way(at.inward, at.above);
        match end {
            NEAR => self.section_row(&at, 0.0, &way.scaled(-1.0)),
            FAR => {
                way.value -= self.tuck_number(TUCK_LENGTH);
                way.slots[SLOT_TUCK + TUCK_LENGTH] -= 1.0;
                self.section_row(&at, 0.0, &way)
            }
            _ => {
                let sign = if end == AT_END { 1.0 } else { -1.0 };
                let mut out = way.scaled(0.0);
                out.value = sign * (at.along - self.flap_number(FLAP_OFFSET)) - self.tuck_number(TUCK_WIDTH) / 2.0;
                out.slots[SLOT_FLAP + FLAP_OFFSET] -= sign;
                out.slots[SLOT_TUCK + TUCK_WIDTH] -= 0.5;
                self.section_row(&at, sign, &out)
            }
        }
    }

    #[inline(always)]
    fn section_row(&self, at: &AtRim, by_along: f64, measure: &Measure) -> Row {
        self.rim().row(measure.value, at, [by_along, measure.by_inward, measure.by_above], measure.slots)
    }

    /// Distance outwards from a side's middle, which stands out by the bulge in its middle and not at all where it ends.
    #[inline(always)]
    fn side_row(&self, at: &AtRim) -> Row {
        let k = self.role.side();
        let (edge, height) = (self.body.edge_m(k), self.body.get(HEIGHT));
        let (u, v) = (at.along / edge, -at.above / height);
        let bulge = self.body.get(layout::bulge(k));
        let mut slots = NO_SLOTS;
        let (across, down) = (1.0 - 4.0 * u * u, 4.0 * v * (1.0 - v));
        if across <= 0.0 || down <= 0.0 {
            return self.rim().row(-at.inward, at, [0.0, -1.0, 0.0], slots);
        }
        let (by_u, by_v) = (-8.0 * u * down, across * 4.0 * (1.0 - 2.0 * v));
        slots[SLOT_BULGE] = -across * down;
        slots[edge_place(k)] += bulge * by_u * u / edge;
        slots[HEIGHT] += bulge * by_v * v / height;
        let value = -at.inward - bulge * across * down;
        self.rim().row(value, at, [-bulge * by_u / edge, -1.0, bulge * by_v / height], slots)
    }
}
