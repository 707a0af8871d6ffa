//! Depth images to organized clouds in the camera's optical frame (x right, y down, z forward).

use super::depth_png::{decode, DepthImage};
use super::distortion::Distortion;
use super::parsed::{HeaderPose, Parsed};
use super::text_rows::Body;
use crate::error::{InputError, Result};

/// Pinhole camera of a depth image, pixels; integer pixel coordinates are pixel centres.
#[derive(Debug, Clone, PartialEq)]
pub struct Intrinsics {
    pub fx: f64,
    pub fy: f64,
    pub cx: f64,
    pub cy: f64,
    /// Columns and rows of the image these numbers are for; `None` where nobody says.
    pub size: Option<(usize, usize)>,
    /// k1, k2, p1, p2, k3 of the Brown-Conrady model, as OpenCV and ROS ("plumb_bob") use them.
    pub distortion: Distortion,
    /// Metres of one step of the image's values.
    pub depth_unit_m: f64,
}

/// How an image's 16 bits hold the depth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DepthDecode {
    Plain,
    /// The bits are turned by three, as the RealSense F200's tools wrote them: (raw >> 3) | (raw << 13).
    Rotate3,
}

impl DepthDecode {
    fn steps(self, raw: u16) -> u16 {
        match self {
            Self::Plain => raw,
            Self::Rotate3 => raw.rotate_right(3),
        }
    }
}

impl Intrinsics {
    /// Refuses what no camera has.
    pub fn check(&self) -> Result<()> {
        let positive = [("fx", self.fx), ("fy", self.fy), ("depth_unit_m", self.depth_unit_m)];
        if let Some((name, value)) = positive.into_iter().find(|(_, v)| !(v.is_finite() && *v > 0.0)) {
            return Err(InputError::new(format!("is {value}")).at(name).mend("must be a positive number"));
        }
        let distortion = self.distortion.0.map(|value| ("distortion", value));
        match [("cx", self.cx), ("cy", self.cy)].iter().chain(&distortion).find(|(_, v)| !v.is_finite()) {
            None => Ok(()),
            Some((name, value)) => Err(InputError::new(format!("is {value}")).at(*name).mend("must be finite")),
        }
    }
}

/// Reads a depth image; value 0 is no reading, and lens distortion is undone.
pub(super) fn read_depth(bytes: &[u8], camera: &Intrinsics, decoding: DepthDecode) -> Result<Parsed> {
    camera.check()?;
    let image = decode(bytes, camera.size)?;
    let points = back_project(&image, camera, decoding)?;
    let body = Body { points, colors: None, labels: None };
    Ok(Parsed { body, width: image.width, height: image.height, pose: HeaderPose::origin() })
}

fn back_project(image: &DepthImage, camera: &Intrinsics, decoding: DepthDecode) -> Result<Vec<[f32; 3]>> {
    let mut points = Vec::with_capacity(image.values.len());
    for (k, &raw) in image.values.iter().enumerate() {
        let steps = decoding.steps(raw);
        points.push(match steps {
            0 => [f32::NAN; 3],
            _ => point_of_pixel(k % image.width, k / image.width, f64::from(steps) * camera.depth_unit_m, camera)?,
        });
    }
    Ok(points)
}

fn point_of_pixel(u: usize, v: usize, z_m: f64, camera: &Intrinsics) -> Result<[f32; 3]> {
    let seen = [(u as f64 - camera.cx) / camera.fx, (v as f64 - camera.cy) / camera.fy];
    let [x, y] = camera.distortion.undo(seen).ok_or_else(|| {
        InputError::new("the distortion cannot be undone")
            .at(format!("pixel {u}, {v}"))
            .mend("are the intrinsics this image's?")
    })?;
    Ok([(x * z_m) as f32, (y * z_m) as f32, z_m as f32])
}
