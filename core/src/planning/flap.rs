use serde::Deserialize;

use crate::geometry::{Rigid, Vec3};

/// What is known of a flap before anything is planned.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Standing {
    /// It was seen, and so where it stands is known.
    Seen,
    /// It may be there; nobody saw it.
    Hidden,
    /// It is not there.
    Absent,
}

/// A board hinged on the top edge of a side. Metres, the robot's base frame; angles as docs/formats.md has them: 0 closed, growing
/// as it opens by the right hand about `axis`.
#[derive(Debug, Clone, PartialEq)]
pub struct Flap {
    pub name: String,
    pub side: String,
    pub standing: Standing,
    /// Start of the hinge edge at mid-board.
    pub hinge: Vec3,
    /// Unit vector along the hinge.
    pub axis: Vec3,
    /// Unit vector from the hinge to the free edge when the flap is closed; square to `axis`.
    pub inward: Vec3,
    /// The outline in the flap's own plane, going round: along the hinge, away from it.
    pub outline: [[f64; 2]; 4],
    /// What hangs on its free edge, in the flap's frame (along, away, outward), stiff at the angle it was seen at.
    pub tucks: Vec<(String, [Vec3; 4])>,
    pub position_rad: f64,
}

/// A flap's frame at some angle: origin at the hinge's start, `along` the hinge, `away` from it in the board, `outward` of the
/// face that is outside when the box is closed. Right-handed in this order.
#[derive(Debug, Clone, Copy)]
pub struct FlapFrame {
    pub origin: Vec3,
    pub along: Vec3,
    pub away: Vec3,
    pub outward: Vec3,
}

impl Flap {
    pub fn frame(&self, angle_rad: f64) -> FlapFrame {
        let (sin, cos) = angle_rad.sin_cos();
        let up = self.axis.cross(&self.inward);
        let away = self.inward * cos + up * sin;
        FlapFrame { origin: self.hinge, along: self.axis, away, outward: self.axis.cross(&away) }
    }

    /// Corners at mid-board, going round from the hinge's start.
    pub fn corners(&self, angle_rad: f64) -> [Vec3; 4] {
        let frame = self.frame(angle_rad);
        self.outline.map(|[u, v]| frame.at(u, v, 0.0))
    }

    /// The corners of what hangs on it, likewise.
    pub fn tuck_corners(&self, angle_rad: f64) -> impl Iterator<Item = (&str, [Vec3; 4])> {
        let frame = self.frame(angle_rad);
        self.tucks.iter().map(move |(name, corners)| (name.as_str(), corners.map(|p| frame.at(p.x, p.y, p.z))))
    }

    pub fn hinge_length_m(&self) -> f64 {
        self.outline[1][0] - self.outline[0][0]
    }

    /// From the hinge to the farthest corner.
    pub fn length_m(&self) -> f64 {
        self.outline.iter().map(|corner| corner[1]).fold(0.0, f64::max)
    }

    /// Where the free edge begins and ends along the hinge.
    pub fn edge_m(&self) -> [f64; 2] {
        [self.outline[3][0], self.outline[2][0]]
    }

    pub fn area_m2(&self) -> f64 {
        let pairs = (0..4).map(|k| (self.outline[k], self.outline[(k + 1) % 4]));
        pairs.map(|(p, q)| p[0] * q[1] - p[1] * q[0]).sum::<f64>().abs() / 2.0
    }

    /// Sides and flaps are numbered round the box; the number at the end of its name.
    pub fn number(&self) -> Option<usize> {
        self.name.rsplit('_').next()?.parse().ok()
    }

    /// Is it called so, or what hangs on it?
    pub fn is_own(&self, name: &str) -> bool {
        self.name == name || self.tucks.iter().any(|(tuck, _)| tuck == name)
    }

    pub fn hinge_middle(&self) -> Vec3 {
        self.hinge + self.axis * ((self.outline[0][0] + self.outline[1][0]) / 2.0)
    }
}

impl FlapFrame {
    /// The point `u` along the hinge, `v` away from it, `w` outward, in the base frame.
    pub fn at(&self, u: f64, v: f64, w: f64) -> Vec3 {
        self.origin + self.along * u + self.away * v + self.outward * w
    }

    /// A point of the base frame as (along, away, outward).
    pub fn coordinates(&self, point: &Vec3) -> Vec3 {
        let from_origin = point - self.origin;
        Vec3::new(from_origin.dot(&self.along), from_origin.dot(&self.away), from_origin.dot(&self.outward))
    }

    /// The direction into the outer face: that in which a finger pushes.
    pub fn push(&self) -> Vec3 {
        -self.outward
    }

    pub fn base_from_flap(&self) -> Rigid {
        Rigid::new(nalgebra::Matrix3::from_columns(&[self.along, self.away, self.outward]), self.origin)
    }
}
