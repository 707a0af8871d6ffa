//! The eight ways in which an ortho-parallel arm with a spherical wrist can hold its flange somewhere, limits aside.

use std::f64::consts::PI;

use arrayvec::ArrayVec;
use nalgebra::Matrix3;

use super::opw::Opw;
use crate::geometry::{Rigid, Vec3};

/// Near which singularities a solution stands: there, small motions of the tool want large ones of joints.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Singular {
    /// The wrist's centre is on the axis of joint 1.
    pub shoulder: bool,
    /// The arm is stretched or folded.
    pub elbow: bool,
    /// The axes of joints 4 and 6 are in line.
    pub wrist: bool,
}

impl Singular {
    pub fn any(&self) -> bool {
        self.shoulder || self.elbow || self.wrist
    }
}

/// One way to hold the flange somewhere: angles of all six joints, limits and wraps aside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Branch {
    /// 0..8: 4 if the arm reaches back over its shoulder, plus 2 for the other elbow, plus 1 for the turned wrist.
    pub number: u8,
    /// The arm's own joint positions, each some turn of it, rad.
    pub angles_rad: [f64; 6],
    pub singular: Singular,
}

pub type Branches = ArrayVec<Branch, 8>;

/// How near is near: the sine of the wrist's and the elbow's bend, and how far the wrist's centre is from joint 1's axis.
const NEAR_WRIST: f64 = 0.01;
const NEAR_ELBOW: f64 = 0.01;
const NEAR_SHOULDER_M: f64 = 0.005;
/// A wrist centre this far out of reach, relatively, is at the end of the reach: what rounding does to a stretched arm.
const ROUNDING: f64 = 1e-12;
/// In line to rounding: joint 4 is then left at its zero, and joint 6 turns.
const IN_LINE: f64 = 1e-12;

impl Opw {
    /// All branches that reach a flange pose, by number; none where it is out of reach.
    pub fn branches(&self, base_from_flange: &Rigid) -> Branches {
        let mut found = Branches::new();
        let rotation = &base_from_flange.rotation;
        let wrist = base_from_flange.translation - rotation.column(2) * self.c4_m;
        for (s, (theta1, radial_m)) in self.shoulders(&wrist).into_iter().enumerate() {
            let near_shoulder = radial_m.hypot(self.b_m) - self.b_m.abs() < NEAR_SHOULDER_M;
            for (e, (theta2, theta3, bend)) in
                self.elbows(radial_m - self.a1_m, wrist.z - self.c1_m).into_iter().enumerate()
            {
                let arm = forearm(theta1, theta2 + theta3);
                for (w, theta456) in wrists(&arm.tr_mul(rotation)).into_iter().enumerate() {
                    let theta = [theta1, theta2, theta3, theta456[0], theta456[1], theta456[2]];
                    found.push(Branch {
                        number: (4 * s + 2 * e + w) as u8,
                        angles_rad: std::array::from_fn(|k| self.position_rad(k, theta[k])),
                        singular: Singular {
                            shoulder: near_shoulder,
                            elbow: bend.sin().abs() < NEAR_ELBOW,
                            wrist: theta[4].sin().abs() < NEAR_WRIST,
                        },
                    });
                }
            }
        }
        found
    }

    /// Joint 1 facing the wrist's centre, then turned away from it; and how far ahead of joint 1's axis the centre is then.
    fn shoulders(&self, wrist: &Vec3) -> ArrayVec<(f64, f64), 2> {
        let radial_sq = wrist.x * wrist.x + wrist.y * wrist.y - self.b_m * self.b_m;
        if radial_sq < -ROUNDING {
            return ArrayVec::new();
        }
        let radial_m = radial_sq.max(0.0).sqrt();
        let bearing = wrist.y.atan2(wrist.x);
        let aside = self.b_m.atan2(radial_m);
        ArrayVec::from([(bearing - aside, radial_m), (bearing + aside - PI, -radial_m)])
    }

    /// Joints 2 and 3 that put the wrist's centre at (x, z) from the shoulder, in the arm's plane; and the bend between upper arm and
    /// the line from elbow to wrist.
    fn elbows(&self, x_m: f64, z_m: f64) -> ArrayVec<(f64, f64, f64), 2> {
        let (upper, fore) = (self.c2_m, self.a2_m.hypot(self.c3_m));
        let cos = (x_m * x_m + z_m * z_m - upper * upper - fore * fore) / (2.0 * upper * fore);
        if cos.abs() > 1.0 + ROUNDING {
            return ArrayVec::new();
        }
        let bend = cos.clamp(-1.0, 1.0).acos();
        // theta2 follows from the bend as it was rounded: a stretched arm's errors then cancel at the wrist.
        let one = |bend: f64| {
            let lean = (fore * bend.sin()).atan2(upper + fore * bend.cos());
            (x_m.atan2(z_m) - lean, bend - self.a2_m.atan2(self.c3_m), bend)
        };
        ArrayVec::from([one(bend), one(-bend)])
    }
}

/// base_from_forearm: Rz(theta1) Ry(theta23).
fn forearm(theta1: f64, theta23: f64) -> Matrix3<f64> {
    let ((s1, c1), (s, c)) = (theta1.sin_cos(), theta23.sin_cos());
    Matrix3::new(c1 * c, -s1, c1 * s, s1 * c, c1, s1 * s, -s, 0.0, c)
}

/// Both ways of a wrist, joints 4 to 6, to turn by `forearm_from_flange` = Rz Ry Rz.
fn wrists(forearm_from_flange: &Matrix3<f64>) -> [[f64; 3]; 2] {
    let m = forearm_from_flange;
    let aside = m.m13.hypot(m.m23);
    let (sin, cos) = if aside < IN_LINE { (0.0, 1.0) } else { (m.m23 / aside, m.m13 / aside) };
    [(sin, cos), (-sin, -cos)].map(|(sin, cos)| {
        // The rest is read after joint 4 is undone, so that it makes up for joint 4 near the singularity.
        let theta5 = (cos * m.m13 + sin * m.m23).atan2(m.m33);
        let theta6 = (cos * m.m21 - sin * m.m11).atan2(cos * m.m22 - sin * m.m12);
        [sin.atan2(cos), theta5, theta6]
    })
}
