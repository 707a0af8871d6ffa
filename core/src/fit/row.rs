use super::layout::{SHIFT, SLOT_COUNT, TURN};
use crate::geometry::Vec3;

pub type Slots = [f64; SLOT_COUNT];

/// A measure of one point against the body, metres, with its derivatives by the slots of its part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    pub value: f64,
    pub slots: Slots,
}

impl Row {
    /// `gradient` is the derivative by the point in the object's frame; a motion of the object moves the point the other
    /// way, q x turn - shift, so the pose's derivatives follow from it (eq. 74).
    #[inline(always)]
    pub fn new(value: f64, point: &Vec3, gradient: &Vec3, mut slots: Slots) -> Self {
        let turn = gradient.cross(point);
        for axis in 0..3 {
            slots[TURN + axis] = turn[axis];
            slots[SHIFT + axis] = -gradient[axis];
        }
        Self { value, slots }
    }
}
