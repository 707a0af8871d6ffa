//! The faces of a body's panels, as readings lie on them.

use super::sight::Sight;
use crate::fit::{layout, FittedBody, Rim, Role};
use crate::geometry::Vec3;

/// How far beyond its ends a panel still takes readings: edges are ragged, ends not yet known.
pub const BEYOND_M: f64 = 0.006;
/// Walls end, at the rim and where they meet, by this much.
pub const WALL_BEYOND_M: f64 = 0.004;
/// The same of flaps before their hinges.
pub const BEHIND_M: f64 = 0.002;

/// A panel's face that the camera sees, and its ends.
pub struct Surface {
    pub(super) role: Role,
    pub(super) rim: Rim,
    /// Of the base: the rims of all sides.
    pub(super) rims: [Rim; 4],
    pub(super) edge_half_m: f64,
    pub(super) height_m: f64,
    pub(super) half_board_m: f64,
    pub(super) board_m: f64,
    /// Half boards off the middle.
    pub(super) face: f64,
    /// The sine of the angle between a flat panel and the way that its hinge is seen from.
    seen_at_sin: f64,
    /// Whether readings lie anywhere in its board, on its edge as on its face.
    is_from_edge: bool,
    pub(super) normal: Vec3,
    pub(super) bulge_m: f64,
    pub(super) sin: f64,
    pub(super) cos: f64,
    pub(super) length_m: f64,
    pub(super) width_m: f64,
    pub(super) offset_m: f64,
    pub(super) taper_m: f64,
    pub(super) curl: f64,
    /// Of a tuck flap: its hinge in the rim's frame.
    pub(super) from: [f64; 2],
}

/// A flap that is seen at less than this angle, which is as good as its sine, is seen from its edge: beyond, it shows more of its face.
pub const FROM_EDGE_RAD: f64 = 0.14;

impl Surface {
    pub fn new(sight: &Sight, body: &FittedBody, role: Role) -> Self {
        let k = role.side();
        let rim = Rim::new(body, k);
        let flap = |place: usize| body.get(layout::flap(k) + place);
        let tuck = |place: usize| body.get(layout::tuck(k) + place);
        let (angle, length_m, width_m, curl, taper_m) = match role {
            Role::Tuck(_) => (
                flap(layout::FLAP_ANGLE) - tuck(layout::TUCK_ANGLE),
                tuck(layout::TUCK_LENGTH),
                tuck(layout::TUCK_WIDTH),
                0.0,
                0.0,
            ),
            _ => (
                flap(layout::FLAP_ANGLE),
                flap(layout::FLAP_LENGTH),
                flap(layout::FLAP_WIDTH),
                flap(layout::FLAP_CURL),
                flap(layout::FLAP_TAPER),
            ),
        };
        let (sin, cos) = angle.sin_cos();
        let (_, inward) = rim.directions();
        let turn = body.input_from_object.rotation;
        let mut from = [0.0; 2];
        if let Role::Tuck(_) = role {
            from = crate::fit::flap_end(body, k);
        }
        let normal = match role {
            Role::Base => Vec3::z(),
            Role::Side(_) => -inward,
            _ => Vec3::z() * cos - inward * sin,
        };
        let eye = body.to_object(&sight.eye);
        let at = rim.locate(eye);
        let height = match role {
            Role::Base => 1.0,
            Role::Side(_) => -at.inward,
            _ => cos * (at.above - from[1]) - sin * (at.inward - from[0]),
        };
        let half_board_m = body.board_m() / 2.0;
        let point = match role {
            Role::Base => Vec3::z() * (2.0 * half_board_m),
            Role::Side(_) => rim.place(0.0, 0.0, 0.0),
            _ => rim.place(0.0, from[0], from[1]),
        };
        Self {
            role,
            rim,
            rims: [0, 1, 2, 3].map(|k| Rim::new(body, k)),
            edge_half_m: body.edge_m(k) / 2.0,
            height_m: body.get(layout::HEIGHT),
            half_board_m,
            board_m: body.board_m(),
            seen_at_sin: height.abs() / (eye - point).norm(),
            is_from_edge: false,
            face: height.signum(),
            normal: turn * normal,
            bulge_m: body.get(layout::bulge(k)),
            sin,
            cos,
            length_m,
            width_m,
            offset_m: flap(layout::FLAP_OFFSET),
            taper_m,
            curl,
            from,
        }
    }

    /// The same of a flap that was found from its edge, where that is how it is seen.
    pub fn seen_from_edge(self, is_thin: bool) -> Self {
        Self { is_from_edge: is_thin && self.seen_at_sin < FROM_EDGE_RAD, ..self }
    }

    pub fn is_from_edge(&self) -> bool {
        self.is_from_edge
    }

    /// Of a point of the object's frame: along the hinge or rim, away from it, off the face.
    pub fn place(&self, q: &Vec3) -> Option<[f64; 3]> {
        let off = self.off(q, &Vec3::z())?.0;
        let at = self.rim.locate(*q);
        let away = match self.role {
            Role::Base => at.inward,
            Role::Side(_) => -at.above,
            _ => self.cos * (at.inward - self.from[0]) + self.sin * (at.above - self.from[1]),
        };
        Some([at.along, away, off])
    }

    pub fn role(&self) -> Role {
        self.role
    }

    /// A corner of what holds all readings that it may take, no further than `most_m` off its face: by its ends along the hinge, away from
    /// it and off the face. Object's frame.
    pub fn corner(&self, ends: [usize; 3], most_m: f64) -> Vec3 {
        let [side, away, off] = ends.map(|end| [-1.0, 1.0][end]);
        match self.role {
            Role::Base => {
                let rim = if away < 0.0 { &self.rims[0] } else { &self.rims[2] };
                let above = self.board_m + off * most_m - self.height_m;
                rim.place(-side * away * self.edge_half_m, 0.0, above)
            }
            Role::Side(_) => {
                let along = side * (self.edge_half_m + self.half_board_m + WALL_BEYOND_M);
                let above = if away < 0.0 { WALL_BEYOND_M } else { -self.height_m - WALL_BEYOND_M };
                let bulge = (off * self.bulge_m).max(0.0) * off;
                self.rim.place(along, -(self.face * self.half_board_m + bulge + off * most_m), above)
            }
            Role::Flap(_) | Role::Tuck(_) => {
                let along = self.offset_m + side * (self.width_m / 2.0 + (-self.taper_m).max(0.0) + BEYOND_M);
                let far = self.length_m + BEYOND_M;
                let x = if away < 0.0 { -BEHIND_M } else { far };
                let bow = (off * self.curl).max(0.0) * off * far * far / 2.0;
                let y = bow + off * (self.half_board_m + most_m);
                let (inward, above) = (self.cos * x - self.sin * y, self.sin * x + self.cos * y);
                self.rim.place(along, self.from[0] + inward, self.from[1] + above)
            }
        }
    }

    /// How far off the face a point of the object's frame lies, and the ray's share along the normal; `None` beyond its ends.
    #[inline]
    pub fn off(&self, q: &Vec3, ray: &Vec3) -> Option<(f64, f64)> {
        let off = match self.role {
            Role::Base => {
                let inside = self.rims.iter().all(|rim| rim.locate(*q).inward > self.half_board_m);
                inside.then_some(q.z - self.board_m)?
            }
            Role::Side(_) => {
                let at = self.rim.locate(*q);
                let ends = at.above > WALL_BEYOND_M
                    || at.above < -self.height_m - WALL_BEYOND_M
                    || at.along.abs() > self.edge_half_m + self.half_board_m + WALL_BEYOND_M;
                if ends {
                    return None;
                }
                let (u, v) = (at.along / self.edge_half_m, -at.above / self.height_m);
                let bulge = self.bulge_m * (1.0 - u * u).max(0.0) * (4.0 * v * (1.0 - v)).max(0.0);
                -at.inward - bulge - self.face * self.half_board_m
            }
            Role::Flap(_) | Role::Tuck(_) => {
                let at = self.rim.locate(*q);
                let (b, c) = (at.inward - self.from[0], at.above - self.from[1]);
                let (x, y) = (self.cos * b + self.sin * c, self.cos * c - self.sin * b);
                let way = x.max(0.0) / self.length_m.max(1e-3);
                let aside = (at.along - self.offset_m).abs() - self.width_m / 2.0 + self.taper_m * way.min(1.0);
                if x < -BEHIND_M || x > self.length_m + BEYOND_M || aside > BEYOND_M {
                    return None;
                }
                let y = y - self.curl * x * x / 2.0;
                if self.is_from_edge {
                    (y.abs() - self.half_board_m).max(0.0)
                } else {
                    y - self.face * self.half_board_m
                }
            }
        };
        Some((off, ray.dot(&self.normal).abs()))
    }
}
