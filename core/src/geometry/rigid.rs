use nalgebra::Matrix3;

use super::Vec3;

/// A rigid motion `a_from_b`: maps coordinates in b to coordinates in a (metres). Kept as a matrix, since it is applied far more
/// often than it is composed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rigid {
    pub rotation: Matrix3<f64>,
    pub translation: Vec3,
}

impl Rigid {
    pub fn identity() -> Self {
        Self { rotation: Matrix3::identity(), translation: Vec3::zeros() }
    }

    pub fn new(rotation: Matrix3<f64>, translation: Vec3) -> Self {
        Self { rotation, translation }
    }

    pub fn shift(translation: Vec3) -> Self {
        Self { rotation: Matrix3::identity(), translation }
    }

    /// Rotation by fixed-axis angles as URDF has them, Rz(yaw) Ry(pitch) Rx(roll), after which comes the translation.
    pub fn from_xyz_rpy(xyz: Vec3, rpy_rad: Vec3) -> Self {
        let about = |axis, angle_rad| turn(&axis, angle_rad);
        let rotation = about(Vec3::z(), rpy_rad.z) * about(Vec3::y(), rpy_rad.y) * about(Vec3::x(), rpy_rad.x);
        Self { rotation, translation: xyz }
    }

    /// c's frame in a, of this a_from_b and b_from_c.
    pub fn then(&self, b_from_c: &Self) -> Self {
        Self { rotation: self.rotation * b_from_c.rotation, translation: self.apply(&b_from_c.translation) }
    }

    /// b_from_a of a_from_b.
    pub fn inverse(&self) -> Self {
        let rotation = self.rotation.transpose();
        Self { rotation, translation: -(rotation * self.translation) }
    }

    /// A point in b, told in a.
    pub fn apply(&self, point_b: &Vec3) -> Vec3 {
        self.rotation * point_b + self.translation
    }

    /// A point in a, told in b.
    pub fn apply_inverse(&self, point_a: &Vec3) -> Vec3 {
        self.rotation.tr_mul(&(point_a - self.translation))
    }
}

/// The rotation by the right hand about a unit axis (docs/maths.md, eq. 34).
pub fn turn(axis: &Vec3, angle_rad: f64) -> Matrix3<f64> {
    let (sin, cos) = angle_rad.sin_cos();
    Matrix3::identity() * cos + axis.cross_matrix() * sin + axis * axis.transpose() * (1.0 - cos)
}

/// The rotation's axis times its angle in 0..pi, rad: `turn` undone.
pub fn rotation_vector(rotation: &Matrix3<f64>) -> Vec3 {
    nalgebra::UnitQuaternion::from_rotation_matrix(&nalgebra::Rotation3::from_matrix_unchecked(*rotation)).scaled_axis()
}
