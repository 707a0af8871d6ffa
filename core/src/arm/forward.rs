use arrayvec::ArrayVec;

use super::model::Arm;
use super::positions::MAX_AXES;
use crate::geometry::Rigid;

impl Arm {
    /// base_from_link of the base and every link, then of the flange, at these positions (rad).
    pub fn link_frames(&self, positions: &[f64]) -> ArrayVec<Rigid, { MAX_AXES + 2 }> {
        let mut frames = ArrayVec::new();
        let mut base_from_link = Rigid::identity();
        frames.push(base_from_link);
        for (joint, &position_rad) in self.joints.iter().zip(positions) {
            base_from_link = base_from_link.then(&joint.parent_from_link(position_rad));
            frames.push(base_from_link);
        }
        frames.push(base_from_link.then(&self.last_link_from_flange));
        frames
    }

    /// base_from_flange at these positions (rad).
    pub fn flange(&self, positions: &[f64]) -> Rigid {
        self.link_frames(positions)[self.axes() + 1]
    }

    /// base_from_tool at these positions (rad).
    pub fn forward(&self, positions: &[f64]) -> Rigid {
        self.flange(positions).then(&self.gripper.flange_from_tool())
    }
}
