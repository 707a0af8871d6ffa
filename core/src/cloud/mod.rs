//! Point clouds, organized or not, and the files they come in.

use crate::geometry::Vec3;

mod depth;
mod depth_png;
mod distortion;
mod fields;
mod guards;
mod lines;
mod lzf;
mod npy;
mod npy_header;
mod options;
mod parsed;
mod pcd;
mod pcd_header;
mod ply;
mod ply_header;
mod ply_walk;
mod projection;
mod read;
mod records;
mod scalar;
mod text_rows;

pub use depth::{DepthDecode, Intrinsics};
pub use distortion::Distortion;
pub use options::{Format, Frame, ReadOptions, Unit};
pub use projection::Projection;
pub use read::{read_cloud, read_depth_png};

/// A cloud as it was read: the input's own frame, metres; a point with any non-finite coordinate is no reading.
#[derive(Debug, Clone, PartialEq)]
pub struct Cloud {
    pub points: Vec<[f32; 3]>,
    /// Organized: columns; unorganized: the number of points.
    pub width: usize,
    /// Organized: rows; unorganized: 1.
    pub height: usize,
    /// Where the sensor stood, input's frame; `None` for an unorganized cloud unless the user says it.
    pub viewpoint: Option<Vec3>,
    /// Red, green, blue for each point.
    pub colors: Option<Vec<[u8; 3]>>,
    /// The file's own field `label`, one for each point.
    pub labels: Option<Vec<u32>>,
}

impl Cloud {
    pub fn is_organized(&self) -> bool {
        self.height > 1
    }

    pub fn view(&self) -> CloudView<'_> {
        CloudView { points: &self.points, width: self.width, height: self.height, viewpoint: self.viewpoint }
    }
}

/// What perception reads of a cloud, borrowed (from a `Cloud` or from a numpy array).
#[derive(Debug, Clone, Copy)]
pub struct CloudView<'a> {
    pub points: &'a [[f32; 3]],
    pub width: usize,
    pub height: usize,
    pub viewpoint: Option<Vec3>,
}

impl CloudView<'_> {
    pub fn is_organized(&self) -> bool {
        self.height > 1
    }
}
