//! From a file's bytes to a cloud: parse, scale to metres, find the viewpoint, guard.

use super::depth::{read_depth, DepthDecode, Intrinsics};
use super::npy::read_npy;
use super::options::{Format, ReadOptions, Unit};
use super::parsed::Parsed;
use super::pcd::read_pcd;
use super::ply::read_ply;
use super::{guards, npy_header, Cloud};
use crate::error::{InputError, Result};
use crate::geometry::Vec3;

/// How each format's files begin; a PCD may begin with any line of its header.
const MAGICS: [(&[u8], &str); 3] =
    [(b"ply", "a PLY file (.ply)"), (npy_header::MAGIC, "a numpy array (.npy)"), (b"\x89PNG", "a PNG image (.png)")];

/// Reads a cloud, in metres, in the input's own frame.
///
/// An organized cloud is seen from the file's viewpoint (a PCD's VIEWPOINT, of which only the position counts: points are
/// in the file's frame already), an unorganized one from nowhere unless `options` says it. Memory stays within a small
/// multiple of `bytes`, whatever the header claims. Fails with the byte, line or field that is wrong, and when a guard is
/// sure that the points are in another unit or frame than `options` says.
pub fn read_cloud(bytes: &[u8], format: Format, options: &ReadOptions) -> Result<Cloud> {
    check_magic(bytes, format)?;
    let parsed = match format {
        Format::Pcd => read_pcd(bytes)?,
        Format::Ply => read_ply(bytes)?,
        Format::Npy => read_npy(bytes)?,
    };
    finish(parsed, options, "they must be millimetres: say --unit mm")
}

/// Reads a 16-bit PNG depth image as an organized cloud in the camera's optical frame, seen from its origin.
///
/// Fails like `read_cloud`. The unit is `camera.depth_unit_m`; `options.unit` must be metres.
pub fn read_depth_png(
    bytes: &[u8],
    camera: &Intrinsics,
    decoding: DepthDecode,
    options: &ReadOptions,
) -> Result<Cloud> {
    if options.unit != Unit::Metre {
        return Err(
            InputError::new("--unit is for clouds; a depth image has a unit of its own").mend("say --depth-unit-m")
        );
    }
    if !bytes.starts_with(b"\x89PNG") {
        return Err(wrong_magic(bytes, "a PNG image"));
    }
    finish(read_depth(bytes, camera, decoding)?, options, "is depth_unit_m (--depth-unit-m) right?")
}

fn check_magic(bytes: &[u8], format: Format) -> Result<()> {
    let (fits, name) = match format {
        Format::Pcd => (!MAGICS.iter().any(|(magic, _)| bytes.starts_with(magic)), "a PCD file"),
        Format::Ply => (bytes.starts_with(b"ply"), "a PLY file"),
        Format::Npy => (bytes.starts_with(npy_header::MAGIC), "a numpy array"),
    };
    if fits && !bytes.is_empty() {
        return Ok(());
    }
    Err(wrong_magic(bytes, name))
}

fn wrong_magic(bytes: &[u8], wanted: &str) -> InputError {
    let error = InputError::new(format!("the file is not {wanted}")).at("byte 0");
    match MAGICS.iter().find(|(magic, _)| bytes.starts_with(magic)) {
        Some((_, name)) => error.mend(format!("it begins like {name}; its suffix must say so")),
        None if bytes.is_empty() => error.mend("it is empty"),
        None => error.mend(format!("it begins with {}", super::lines::quote(&bytes[..bytes.len().min(8)]))),
    }
}

/// `mend_too_far` is what helps when the points are farther than any camera sees.
fn finish(parsed: Parsed, options: &ReadOptions, mend_too_far: &str) -> Result<Cloud> {
    let Parsed { mut body, width, height, pose } = parsed;
    scale(&mut body.points, options.unit);
    let from_file = (height > 1).then_some(pose.position * options.unit.metres());
    let viewpoint = options.viewpoint.or(from_file);
    let in_camera_frame = pose.is_origin() && options.viewpoint.is_none_or(|given| given == Vec3::zeros());
    let cloud = Cloud { points: body.points, width, height, viewpoint, colors: body.colors, labels: body.labels };
    guards::check(&cloud, options, in_camera_frame, mend_too_far)?;
    Ok(cloud)
}

fn scale(points: &mut [[f32; 3]], unit: Unit) {
    if unit != Unit::Metre {
        points.as_flattened_mut().iter_mut().for_each(|c| *c = (f64::from(*c) * unit.metres()) as f32);
    }
}
