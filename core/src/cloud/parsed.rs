//! What a reader hands over, before units, viewpoint and guards.

use super::text_rows::Body;
use crate::geometry::Vec3;

/// A cloud in the file's own unit.
pub(super) struct Parsed {
    pub body: Body,
    pub width: usize,
    pub height: usize,
    pub pose: HeaderPose,
}

/// Where the file says that the sensor stood. Points are already in the file's frame, so only the position is used;
/// the rotation tells whether that frame can be the camera's own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct HeaderPose {
    /// In the file's own unit.
    pub position: Vec3,
    pub rotated: bool,
}

impl HeaderPose {
    /// The camera's own frame: what a format means that has no place for a viewpoint.
    pub fn origin() -> Self {
        Self { position: Vec3::zeros(), rotated: false }
    }

    pub fn is_origin(&self) -> bool {
        !self.rotated && self.position == Vec3::zeros()
    }
}
