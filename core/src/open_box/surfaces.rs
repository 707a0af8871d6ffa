//! Which panel of a body each reading lies on.

use super::sight::Sight;
use crate::fit::{layout, FittedBody, Rim, Role};
use crate::geometry::{Plane, Vec3};

/// The parts of a body that readings are given to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Present {
    pub flaps: [bool; 4],
    pub tucks: [bool; 4],
}

impl Present {
    /// Of the same box with side `by` as side 0.
    pub fn turned(&self, by: usize) -> Self {
        let turn = |of: &[bool; 4]| std::array::from_fn(|k| of[(k + by) % 4]);
        Self { flaps: turn(&self.flaps), tucks: turn(&self.tucks) }
    }
}

/// The readings of each part of a box, in the image's order.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Labels {
    pub parts: Vec<(Role, Vec<u32>)>,
    /// Every so many columns and rows were asked.
    pub stride: usize,
}

impl Labels {
    pub fn of(&self, role: Role) -> &[u32] {
        self.parts.iter().find(|(r, _)| *r == role).map_or(&[], |(_, points)| points)
    }
}

impl Labels {
    /// Readings of the whole image that a part's stand for.
    pub fn count(&self, points: &[u32]) -> usize {
        points.len() * self.stride * self.stride
    }

    pub fn clear(&mut self, role: Role) {
        self.parts.iter_mut().filter(|(r, _)| *r == role).for_each(|(_, points)| points.clear());
    }
}

/// Roles in the order of places.
pub fn roles(present: &Present) -> Vec<Role> {
    let mut out = vec![Role::Base];
    out.extend((0..4).map(Role::Side));
    out.extend((0..4).filter(|&k| present.flaps[k]).map(Role::Flap));
    out.extend((0..4).filter(|&k| present.tucks[k]).map(Role::Tuck));
    out
}

/// How far beyond its ends a panel still takes readings: edges are ragged, ends not yet known.
const BEYOND_M: f64 = 0.006;
/// Walls end, at the rim and where they meet, by this much.
const WALL_BEYOND_M: f64 = 0.004;

/// Every reading near the body, given to the panel whose face it is nearest to, in units of what it may lie off.
///
/// Of every `stride`-th column and row.
pub fn label(sight: &Sight, body: &FittedBody, present: &Present, model_m: f64, stride: usize) -> Labels {
    let roles = roles(present);
    let mut parts: Vec<(Role, Vec<u32>)> = roles.iter().map(|role| (*role, Vec::new())).collect();
    let Some([left, right, top, bottom]) = bounds(sight, body, present) else { return Labels { parts, stride } };
    let panels: Vec<Surface> = roles.iter().map(|&role| Surface::new(sight, body, role)).collect();
    let (low, high) = object_bounds(body, present);
    let inverse = body.input_from_object.inverse();
    let (turn, shift) = (inverse.rotation.to_rotation_matrix(), inverse.translation.vector);
    for row in (top..=bottom).step_by(stride) {
        for column in (left..=right).step_by(stride) {
            let index = row * sight.width + column;
            let Some(point) = sight.reading(index) else { continue };
            let q = turn * point + shift;
            if (0..3).any(|a| q[a] < low[a] || q[a] > high[a]) {
                continue;
            }
            let ray = point - sight.eye;
            let range = ray.norm();
            let sigma3 = 3.0 * sight.sigma_m(range) / range;
            let most = sigma3 * range + model_m;
            // The support takes what it is nearest to, but for the base upon it.
            let on_support = point.z.abs() / (sigma3 * ray.z.abs() + model_m);
            let mut best = (on_support.min(1.0), usize::MAX);
            for (number, panel) in panels.iter().enumerate() {
                if panel.is_far(&q, most) {
                    continue;
                }
                let Some((off, reach)) = panel.off(&q, &ray) else { continue };
                let share = off.abs() / (sigma3 * reach + model_m);
                if share < best.0 || (panel.role == Role::Base && share < 1.0 && best.1 == usize::MAX) {
                    best = (share, number);
                }
            }
            if best.1 != usize::MAX {
                parts[best.1].1.push(index as u32);
            }
        }
    }
    Labels { parts, stride }
}

/// A panel's face that the camera sees, and its ends.
pub struct Surface {
    role: Role,
    rim: Rim,
    /// Of the base: the rims of all sides.
    rims: [Rim; 4],
    edge_half_m: f64,
    height_m: f64,
    half_board_m: f64,
    board_m: f64,
    /// Half boards off the middle.
    face: f64,
    normal: Vec3,
    bulge_m: f64,
    sin: f64,
    cos: f64,
    length_m: f64,
    width_m: f64,
    offset_m: f64,
    taper_m: f64,
    curl: f64,
    /// Of a tuck flap: its hinge in the rim's frame.
    from: [f64; 2],
    /// The flat panel's plane in the object's frame, and how far off it the face may lie.
    plane: Plane,
    slack_m: f64,
}

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
        let half_board_m = body.get(layout::THICKNESS).max(0.0) / 2.0;
        let (point, bow_m) = match role {
            Role::Base => (Vec3::z() * (2.0 * half_board_m), 0.0),
            Role::Side(_) => (rim.place(0.0, 0.0, 0.0), body.get(layout::bulge(k)).abs()),
            _ => (rim.place(0.0, from[0], from[1]), curl.abs() * (length_m + BEYOND_M).powi(2) / 2.0),
        };
        Self {
            role,
            rim,
            plane: Plane { normal, distance: normal.dot(&point) },
            slack_m: half_board_m + bow_m,
            rims: [0, 1, 2, 3].map(|k| Rim::new(body, k)),
            edge_half_m: body.edge_m(k) / 2.0,
            height_m: body.get(layout::HEIGHT),
            half_board_m,
            board_m: body.get(layout::THICKNESS).max(0.0),
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

    /// Whether a point of the object's frame lies further than `most` off the face, whatever its ends.
    fn is_far(&self, q: &Vec3, most: f64) -> bool {
        self.plane.height_of(q).abs() > most + self.slack_m
    }

    /// How far off the face a point of the object's frame lies, and the ray's share along the normal; `None` beyond its ends.
    fn off(&self, q: &Vec3, ray: &Vec3) -> Option<(f64, f64)> {
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
                if x < -0.002 || x > self.length_m + BEYOND_M || aside > BEYOND_M {
                    return None;
                }
                y - self.curl * x * x / 2.0 - self.face * self.half_board_m
            }
        };
        Some((off, ray.dot(&self.normal).abs()))
    }
}

/// Lowest and highest coordinates that a body reaches in its own frame.
fn object_bounds(body: &FittedBody, present: &Present) -> (Vec3, Vec3) {
    let (l, w, h) = (body.get(layout::LENGTH), body.get(layout::WIDTH), body.get(layout::HEIGHT));
    let rack = body.get(layout::RACK).tan().abs() * w / 2.0;
    let margin = 0.02;
    let mut low = Vec3::new(-l / 2.0 - rack - margin, -w / 2.0 - margin, -margin);
    let mut high = Vec3::new(l / 2.0 + rack + margin, w / 2.0 + margin, h + margin);
    for k in (0..4).filter(|&k| present.flaps[k]) {
        let tuck = if present.tucks[k] { body.get(layout::tuck(k) + layout::TUCK_LENGTH) } else { 0.0 };
        let reach = body.get(layout::flap(k) + layout::FLAP_LENGTH) + tuck + margin;
        let rim = Rim::new(body, k);
        let (along, inward) = rim.directions();
        let angle = body.get(layout::flap(k) + layout::FLAP_ANGLE);
        let free = (inward * angle.cos() + Vec3::z() * angle.sin()) * reach;
        let aside = along * (body.get(layout::flap(k) + layout::FLAP_WIDTH) / 2.0 + margin);
        for side in [-1.0, 1.0] {
            let corner = rim.place(0.0, 0.0, 0.0) + free + aside * side;
            let bow = 0.03 + tuck;
            low = low.zip_map(&(corner - Vec3::repeat(bow)), f64::min);
            high = high.zip_map(&(corner + Vec3::repeat(bow)), f64::max);
        }
    }
    (low, high)
}

/// Of the body in the image: left, right, top, bottom, inclusive.
fn bounds(sight: &Sight, body: &FittedBody, present: &Present) -> Option<[usize; 4]> {
    let (low, high) = object_bounds(body, present);
    let mut bounds = [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY];
    for corner in 0..8 {
        let pick = |a: usize| if corner >> a & 1 == 0 { low[a] } else { high[a] };
        let point = body.to_input(&Vec3::new(pick(0), pick(1), pick(2)));
        let [u, v] = sight.pixel(&point)?;
        bounds = [bounds[0].min(u), bounds[1].max(u), bounds[2].min(v), bounds[3].max(v)];
    }
    let cell = |at: f64, count: usize| at.clamp(0.0, count as f64 - 1.0) as usize;
    let (width, height) = (sight.width, sight.height);
    let is_seen = bounds[1] >= 0.0 && bounds[0] < width as f64 && bounds[3] >= 0.0 && bounds[2] < height as f64;
    is_seen.then(|| [cell(bounds[0], width), cell(bounds[1], width), cell(bounds[2], height), cell(bounds[3], height)])
}
