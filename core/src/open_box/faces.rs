//! The panel that each of several readings lies on, at once and in single precision: where it is plain.

use wide::f32x4;

use super::sight::{side_by_side, Reading, Sight, LANES};
use super::surfaces::{Surface, BEHIND_M, BEYOND_M, WALL_BEYOND_M};
use crate::fit::{FittedBody, Rim, Role};
use crate::geometry::Vec3;

/// What single precision tells of a reading.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum On {
    Nothing,
    /// The panel of that number.
    Panel(usize),
    /// Two are as near, or it lies at an end: double precision tells.
    Unsure,
}

const NOTHING: f32 = -1.0;
/// What is nearer to an end, metres, or as near to two faces, in units of what it may lie off, is unsure: single precision errs by a
/// hundredth of it.
const SURE_M: f32 = 5e-5;
const SURE_SHARE: f32 = 5e-3;

/// The faces of a body's panels, and where its frame lies.
pub struct Faces {
    faces: Vec<Face>,
    /// From the level frame to the object's.
    turn: [Linear; 3],
    eye: [f32; 3],
    low: [f32; 3],
    high: [f32; 3],
    model_m: f32,
}

/// A number that is linear in a point: its derivatives, and at the origin.
#[derive(Debug, Clone, Copy)]
struct Linear([f32; 4]);

impl Linear {
    fn of(number: impl Fn(&Vec3) -> f64) -> Self {
        let at_origin = number(&Vec3::zeros());
        let by = [Vec3::x(), Vec3::y(), Vec3::z()].map(|axis| number(&axis) - at_origin);
        Self([by[0] as f32, by[1] as f32, by[2] as f32, at_origin as f32])
    }

    #[inline(always)]
    fn at(&self, [x, y, z]: &[f32x4; 3]) -> f32x4 {
        let [a, b, c, d] = self.0.map(f32x4::splat);
        a * *x + b * *y + c * *z + d
    }
}

/// A panel's face.
struct Face {
    kind: Kind,
    /// In the level frame.
    normal: [f32; 3],
}

enum Kind {
    Base {
        inward: [Linear; 4],
        off: Linear,
    },
    Side {
        along: Linear,
        above: Linear,
        inward: Linear,
        half_m: f32,
        height_m: f32,
        most_along_m: f32,
        bulge_m: f32,
        face_m: f32,
    },
    Board {
        along: Linear,
        away: Linear,
        off: Linear,
        length_m: f32,
        half_m: f32,
        taper_m: f32,
        bend: f32,
        /// Off the middle; half a board of one whose readings lie anywhere in it.
        face_m: f32,
        is_from_edge: bool,
    },
}

impl Faces {
    /// Of a body that reaches in its own frame from `low` to `high`.
    pub fn of(sight: &Sight, body: &FittedBody, panels: &[Surface], [low, high]: [&Vec3; 2], model_m: f64) -> Self {
        let single = |v: &Vec3| [v.x as f32, v.y as f32, v.z as f32];
        Self {
            faces: panels.iter().map(Face::of).collect(),
            turn: [0, 1, 2].map(|axis| Linear::of(|point| body.to_object(point)[axis])),
            eye: single(&sight.eye),
            low: single(low),
            high: single(high),
            model_m: model_m as f32,
        }
    }

    /// On which of the panels, by bits, readings lie; on nothing what is no reading.
    pub fn nearest(&self, readings: [&Reading; LANES], mut panels: u32) -> [On; LANES] {
        let (zero, one) = (f32x4::ZERO, f32x4::splat(1.0));
        let [x, y, z, noise] = side_by_side(readings);
        let point = [x, y, z];
        let model = f32x4::splat(self.model_m);
        let q = [self.turn[0].at(&point), self.turn[1].at(&point), self.turn[2].at(&point)];
        let ray = [0, 1, 2].map(|axis| point[axis] - f32x4::splat(self.eye[axis]));
        let mut within = f32x4::splat(f32::INFINITY);
        for (q, (low, high)) in q.iter().zip(self.low.iter().zip(&self.high)) {
            within = within.fast_min(*q - f32x4::splat(*low)).fast_min(f32x4::splat(*high) - *q);
        }
        // The support takes what it is nearest to, but for the base upon it.
        let on_support = point[2].abs() / (noise * ray[2].abs() + model);
        let (mut best, mut next) = (on_support.fast_min(one), f32x4::splat(f32::INFINITY));
        let mut on = f32x4::splat(NOTHING);
        let mut unsure = zero;
        while panels != 0 {
            let number = panels.trailing_zeros();
            panels &= panels - 1;
            let face = &self.faces[number as usize];
            let (off, ends) = face.off(&q);
            let ends = ends.fast_min(within);
            let [x, y, z] = face.normal.map(f32x4::splat);
            let reach = (x * ray[0] + y * ray[1] + z * ray[2]).abs();
            let share = off.abs() / (noise * reach + model);
            let may_be = share.simd_lt(one + f32x4::splat(SURE_SHARE));
            unsure |= may_be & ends.abs().simd_lt(f32x4::splat(SURE_M));
            let is_on = may_be & ends.simd_gt(zero);
            let share = is_on.bitselect(share, f32x4::splat(f32::INFINITY));
            if let Kind::Base { .. } = face.kind {
                unsure |= (share - one).abs().simd_lt(f32x4::splat(SURE_SHARE));
                let takes = share.simd_lt(one);
                best = takes.bitselect(share, best);
                on = takes.bitselect(zero, on);
            } else {
                let takes = share.simd_lt(best);
                next = next.fast_min(takes.bitselect(best, share));
                best = takes.bitselect(share, best);
                on = takes.bitselect(f32x4::splat(number as f32), on);
            }
        }
        unsure |= (next - best).simd_lt(f32x4::splat(SURE_SHARE));
        let (unsure, on) = (unsure.to_bitmask(), on.to_array());
        std::array::from_fn(|lane| match on[lane] {
            _ if unsure >> lane & 1 == 1 => On::Unsure,
            NOTHING => On::Nothing,
            number => On::Panel(number as i32 as usize),
        })
    }
}

impl Face {
    fn of(panel: &Surface) -> Self {
        let rim = panel.rim;
        let half_board_m = panel.half_board_m;
        let inward_of = |rim: Rim| Linear::of(|q| rim.locate(*q).inward - half_board_m);
        let along = Linear::of(|q| rim.locate(*q).along);
        let above = Linear::of(|q| rim.locate(*q).above);
        let kind = match panel.role {
            Role::Base => Kind::Base { inward: panel.rims.map(inward_of), off: Linear::of(|q| q.z - panel.board_m) },
            Role::Side(_) => Kind::Side {
                along,
                above,
                inward: Linear::of(|q| rim.locate(*q).inward),
                half_m: panel.edge_half_m as f32,
                height_m: panel.height_m as f32,
                most_along_m: (panel.edge_half_m + half_board_m + WALL_BEYOND_M) as f32,
                bulge_m: panel.bulge_m as f32,
                face_m: (panel.face * half_board_m) as f32,
            },
            Role::Flap(_) | Role::Tuck(_) => {
                let (sin, cos, [from_inward, from_above]) = (panel.sin, panel.cos, panel.from);
                let section = |q: &Vec3| {
                    let at = rim.locate(*q);
                    (at.inward - from_inward, at.above - from_above)
                };
                Kind::Board {
                    along: Linear::of(|q| rim.locate(*q).along - panel.offset_m),
                    away: Linear::of(|q| cos * section(q).0 + sin * section(q).1),
                    off: Linear::of(|q| cos * section(q).1 - sin * section(q).0),
                    length_m: panel.length_m as f32,
                    half_m: (panel.width_m / 2.0) as f32,
                    taper_m: panel.taper_m as f32,
                    bend: (panel.curl / 2.0) as f32,
                    face_m: if panel.is_from_edge() { half_board_m } else { panel.face * half_board_m } as f32,
                    is_from_edge: panel.is_from_edge(),
                }
            }
        };
        Self { kind, normal: [0, 1, 2].map(|axis| panel.normal[axis] as f32) }
    }

    /// How far off it points of the object's frame lie, and how far within its ends.
    #[inline(always)]
    fn off(&self, q: &[f32x4; 3]) -> (f32x4, f32x4) {
        let (zero, one, splat) = (f32x4::ZERO, f32x4::splat(1.0), f32x4::splat);
        match &self.kind {
            Kind::Base { inward, off } => {
                let [a, b, c, d] = [0, 1, 2, 3].map(|k| inward[k].at(q));
                (off.at(q), a.fast_min(b).fast_min(c.fast_min(d)))
            }
            Kind::Side { along, above, inward, half_m, height_m, most_along_m, bulge_m, face_m } => {
                let (along, above, beyond) = (along.at(q), above.at(q), splat(WALL_BEYOND_M as f32));
                let ends = (beyond - above).fast_min(above + splat(*height_m) + beyond);
                let ends = ends.fast_min(splat(*most_along_m) - along.abs());
                let (u, v) = (along * splat(1.0 / half_m), above * splat(-1.0 / height_m));
                let across = (one - u * u).fast_max(zero);
                let bulge = splat(*bulge_m) * across * (splat(4.0) * v * (one - v)).fast_max(zero);
                (-inward.at(q) - bulge - splat(*face_m), ends)
            }
            Kind::Board { along, away, off, length_m, half_m, taper_m, bend, face_m, is_from_edge } => {
                let (x, y) = (away.at(q), off.at(q));
                let way = (x.fast_max(zero) * splat(1.0 / length_m.max(1e-3))).fast_min(one);
                let aside = along.at(q).abs() - splat(*half_m) + splat(*taper_m) * way;
                let beyond = splat(BEYOND_M as f32);
                let ends =
                    (x + splat(BEHIND_M as f32)).fast_min(splat(*length_m) + beyond - x).fast_min(beyond - aside);
                let y = y - splat(*bend) * x * x;
                let off = if *is_from_edge { (y.abs() - splat(*face_m)).fast_max(zero) } else { y - splat(*face_m) };
                (off, ends)
            }
        }
    }
}
