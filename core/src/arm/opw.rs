use crate::geometry::rigid::turn;
use crate::geometry::{Rigid, Vec3};

/// An ortho-parallel arm with a spherical wrist, by its seven lengths (metres), and what its own zero and signs are:
/// theta = sign * q - offset, where at theta = 0 the arm stands straight up and all frames are parallel.
///
/// M. Brandstoetter, A. Angerer, M. Hofbaur, "An Analytical Solution of the Inverse Kinematics Problem of Industrial Serial
/// Manipulators with an Ortho-parallel Basis and a Spherical Wrist", Austrian Robotics Workshop 2014.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Opw {
    pub a1_m: f64,
    pub a2_m: f64,
    pub b_m: f64,
    pub c1_m: f64,
    pub c2_m: f64,
    pub c3_m: f64,
    pub c4_m: f64,
    pub offsets_rad: [f64; 6],
    /// 1 or -1 each.
    pub signs: [f64; 6],
}

impl Opw {
    /// Each joint on its parent at position 0, and its axis there.
    pub fn joints(&self) -> [(Rigid, Vec3); 6] {
        let (x, y, z) = (Vec3::x(), Vec3::y(), Vec3::z());
        let origins = [
            Vec3::zeros(),
            Vec3::new(self.a1_m, 0.0, self.c1_m),
            z * self.c2_m,
            x * self.a2_m + y * self.b_m,
            z * self.c3_m,
            Vec3::zeros(),
        ];
        let axes = [z, y, y, z, y, z];
        std::array::from_fn(|k| (Rigid::new(turn(&axes[k], -self.offsets_rad[k]), origins[k]), axes[k] * self.signs[k]))
    }

    pub fn last_link_from_flange(&self) -> Rigid {
        Rigid::shift(Vec3::z() * self.c4_m)
    }

    /// The arm's own position of a joint whose angle from straight up is `theta_rad`.
    pub fn position_rad(&self, joint: usize, theta_rad: f64) -> f64 {
        (theta_rad + self.offsets_rad[joint]) * self.signs[joint]
    }
}
