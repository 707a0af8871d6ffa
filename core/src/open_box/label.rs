//! Which panel of a body each reading lies on.

use super::labels::{roles, Labels, Present};
use super::sight::{Sight, Turn};
use super::silhouette::Silhouette;
use super::surfaces::Surface;
use crate::fit::{layout, FittedBody, Rim, Role};
use crate::geometry::Vec3;

/// Every reading near the body, given to the panel whose face it is nearest to, in units of what it may lie off.
///
/// Of every `stride`-th column and row.
pub fn label(sight: &Sight, body: &FittedBody, present: &Present, model_m: f64, stride: usize) -> Labels {
    let roles = roles(present);
    let mut parts: Vec<(Role, Vec<u32>)> = roles.iter().map(|role| (*role, Vec::new())).collect();
    let (low, high) = object_bounds(body, present);
    let Some((outline, [left, right, top, bottom])) = bounds(sight, body, &low, &high) else {
        return Labels { parts, stride };
    };
    let panels: Vec<Surface> =
        roles.iter().map(|&role| Surface::new(sight, body, role).seen_from_edge(present.is_thin(role))).collect();
    let planes = Planes::of(&panels);
    let inverse = body.input_from_object.inverse();
    let (turn, shift) = (Turn::of(inverse.rotation.to_rotation_matrix().matrix()), inverse.translation.vector);
    for row in (top..=bottom).step_by(stride) {
        let [first, last] = outline.columns(row as f64);
        let skipped = ((first - left as f64) / stride as f64).ceil().clamp(0.0, sight.width as f64);
        let first = left + skipped as usize * stride;
        let last = last.clamp(0.0, right as f64) as usize;
        for column in (first..last + 1).step_by(stride) {
            let index = row * sight.width + column;
            let Some(look) = sight.look(index) else { continue };
            let point = look.at();
            let q = turn.times(&point) + shift;
            if (0..3).any(|a| q[a] < low[a] || q[a] > high[a]) {
                continue;
            }
            let ray = point - sight.eye;
            let sigma3 = look.noise();
            let most = sigma3 * ray.norm() + model_m;
            let mut near = planes.near(&q, most);
            if near == 0 {
                continue;
            }
            // The support takes what it is nearest to, but for the base upon it.
            let on_support = point.z.abs() / (sigma3 * ray.z.abs() + model_m);
            let mut best = (on_support.min(1.0), usize::MAX);
            while near != 0 {
                let number = near.trailing_zeros() as usize;
                near &= near - 1;
                let panel = &panels[number];
                let Some((off, reach)) = panel.off(&q, &ray) else { continue };
                let share = off.abs() / (sigma3 * reach + model_m);
                if share < best.0 || (panel.role() == Role::Base && share < 1.0 && best.1 == usize::MAX) {
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

/// More panels than a box has.
const LANES: usize = 16;
const BITS: [u32; LANES] = {
    let mut bits = [0; LANES];
    let mut lane = 0;
    while lane < LANES {
        bits[lane] = 1 << lane;
        lane += 1;
    }
    bits
};
/// What single precision may be off, metres.
const SINGLE_M: f32 = 1e-5;

/// The planes of a body's panels side by side: a reading is near two or three of them.
struct Planes {
    normal: [[f32; LANES]; 3],
    distance: [f32; LANES],
    slack_m: [f32; LANES],
}

impl Planes {
    fn of(panels: &[Surface]) -> Self {
        let mut out = Self { normal: [[0.0; LANES]; 3], distance: [f32::INFINITY; LANES], slack_m: [SINGLE_M; LANES] };
        for (number, panel) in panels.iter().enumerate() {
            let (plane, slack_m) = panel.plane();
            (0..3).for_each(|axis| out.normal[axis][number] = plane.normal[axis] as f32);
            out.distance[number] = plane.distance as f32;
            out.slack_m[number] += slack_m as f32;
        }
        out
    }

    /// The panels, by bits, whose planes a point of the object's frame lies no further than `most` off.
    fn near(&self, q: &Vec3, most: f64) -> u32 {
        let ([x, y, z], most) = ([q.x as f32, q.y as f32, q.z as f32], most as f32);
        let mut bits = 0;
        for (lane, bit) in BITS.iter().enumerate() {
            let along = self.normal[0][lane] * x + self.normal[1][lane] * y + self.normal[2][lane] * z;
            let off = (along - self.distance[lane]).abs();
            // No shift: lanes differ in it, which keeps them from being worked out side by side.
            bits |= bit & 0_u32.wrapping_sub(u32::from(off <= most + self.slack_m[lane]));
        }
        bits
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

/// Of what lies between two corners of the object's frame: its outline in the image, and left, right, top, bottom, inclusive.
fn bounds(sight: &Sight, body: &FittedBody, low: &Vec3, high: &Vec3) -> Option<(Silhouette, [usize; 4])> {
    let ends = [low, high];
    let corner = |[i, j, k]: [usize; 3]| Vec3::new(ends[i].x, ends[j].y, ends[k].z);
    let outline = Silhouette::of(|of| sight.pixel(&body.to_input(&corner(of))))?;
    let bounds = outline.bounds();
    let cell = |at: f64, count: usize| at.clamp(0.0, count as f64 - 1.0) as usize;
    let (width, height) = (sight.width, sight.height);
    let is_seen = bounds[1] >= 0.0 && bounds[0] < width as f64 && bounds[3] >= 0.0 && bounds[2] < height as f64;
    let cells = [cell(bounds[0], width), cell(bounds[1], width), cell(bounds[2], height), cell(bounds[3], height)];
    is_seen.then_some((outline, cells))
}
