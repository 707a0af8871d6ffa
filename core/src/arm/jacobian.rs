use nalgebra::{ArrayStorage, Matrix, Vector3, U6, U7};

use super::model::Arm;
use crate::geometry::Vec3;

/// Column k: what joint k adds to the tool's velocity for each rad/s; rows x, y, z in m, then the turning about x, y, z. In the base's
/// frame, at the tool point. Columns beyond the arm's axes are zero.
pub type Jacobian = Matrix<f64, U6, U7, ArrayStorage<f64, 6, 7>>;

impl Arm {
    /// The tool's Jacobian at these positions (rad).
    pub fn jacobian(&self, positions: &[f64]) -> Jacobian {
        let frames = self.link_frames(positions);
        let tool = frames[self.axes() + 1].apply(&self.gripper.tool_point_m);
        let mut jacobian = Jacobian::zeros();
        for (k, joint) in self.joints.iter().enumerate() {
            let link = &frames[k + 1];
            // The axis is the same seen from the link, which turns about it.
            let axis: Vec3 = link.rotation * joint.axis;
            let moved: Vector3<f64> = axis.cross(&(tool - link.translation));
            jacobian.fixed_view_mut::<3, 1>(0, k).copy_from(&moved);
            jacobian.fixed_view_mut::<3, 1>(3, k).copy_from(&axis);
        }
        jacobian
    }
}
