//! Refusals of clouds that must be in another unit or frame than the user said: an answer from such a cloud would look
//! right and be wrong.

use super::options::{Frame, ReadOptions, Unit};
use super::Cloud;
use crate::error::{InputError, Result};
use crate::geometry::Vec3;

/// No depth camera reads this far, and none of these programs' objects is this large: structured light ends at 5 m, time of
/// flight at 10 m, stereo at 40 m. A cloud in millimetres has 200 and more here, even that of a hand-sized box.
const FARTHEST_M: f64 = 60.0;
/// No depth camera reads this near (the nearest, short-range stereo, begin at 70 mm), and an open box is larger. A cloud in
/// metres that is called millimetres has less than 0.01 here.
const NEAREST_M: f64 = 0.03;
/// Readings that are looked at: enough that their median is sure to a per cent.
const SAMPLE: usize = 16384;
/// Fewer readings than this have no extent worth a verdict.
const FEWEST_FOR_EXTENT: usize = 16;
/// Points that are so far, were they millimetres, may well be some: cameras of this class see nothing nearer, but others do.
const NEAR_M: f64 = 0.2;
/// How far a camera's image and its directions are alike: 1 of one that is seen whole, -1 of a mirrored one. Images with few readings,
/// or all in a line, are in between and tell nothing.
const MIRRORED: f64 = -0.5;
const FEWEST_FOR_HANDEDNESS: usize = 64;

/// Refuses the wrong unit and the wrong frame. Points and viewpoint are in metres by the unit that the user gave;
/// `mend_too_far` helps when that puts them farther than any camera sees.
/// `in_camera_frame`: the input's frame is the camera's own (its origin is the viewpoint, nothing is rotated).
pub(super) fn check(cloud: &Cloud, options: &ReadOptions, in_camera_frame: bool, mend_too_far: &str) -> Result<()> {
    let readings = sample(&cloud.points);
    check_unit(&readings, cloud.viewpoint, options.unit, mend_too_far)?;
    if cloud.is_organized() && in_camera_frame {
        check_frame(&readings, options.frame)?;
        check_handedness(cloud, options.frame)?;
    }
    Ok(())
}

/// Every k-th finite point.
fn sample(points: &[[f32; 3]]) -> Vec<Vec3> {
    let step = points.len() / SAMPLE + 1;
    let finite = points.iter().filter(|p| p.iter().all(|c| c.is_finite()));
    finite.step_by(step).map(|p| Vec3::new(p[0].into(), p[1].into(), p[2].into())).collect()
}

/// With a viewpoint the median distance from it is judged; without one (fused clouds, in any frame) only the extent is.
fn check_unit(readings: &[Vec3], viewpoint: Option<Vec3>, unit: Unit, mend_too_far: &str) -> Result<()> {
    let (what, size_m) = match viewpoint {
        Some(viewpoint) => ("median distance from the viewpoint", median_distance(readings, viewpoint)),
        None => ("extent", extent(readings)),
    };
    match (size_m, unit) {
        (Some(size), Unit::Metre) if size > FARTHEST_M => {
            let is_doubtful = size / 1000.0 < NEAR_M && !is_of_depth_image(mend_too_far);
            let mend = if is_doubtful { DOUBTFUL } else { mend_too_far };
            Err(wrong(format!("the readings' {what} is {size:.0} m, beyond any depth camera"), mend))
        }
        (Some(size), Unit::Metre) if size < NEAREST_M && readings.len() >= FEWEST_FOR_EXTENT => {
            let text = format!("the readings' {what} is {:.3} mm, nearer than any depth camera reads", size * 1e3);
            Err(wrong(text, if is_of_depth_image(mend_too_far) { mend_too_far } else { NEITHER }))
        }
        (Some(size), Unit::Millimetre) if size < NEAREST_M => {
            let text = format!("the readings' {what} is {:.2} mm, so they must be in metres", size * 1e3);
            Err(wrong(text, "leave out --unit mm"))
        }
        (Some(size), Unit::Millimetre) if size > FARTHEST_M => {
            Err(wrong(format!("the readings' {what} is {size:.0} m even in millimetres"), "write the points in metres"))
        }
        _ => Ok(()),
    }
}

/// What helps where no unit that can be told fits, or where one hardly does.
const NEITHER: &str = "they are in neither metres nor millimetres: write the points in metres";
const DOUBTFUL: &str = "if they are millimetres, say --unit mm; else write the points in metres";

/// A depth image's unit is told by itself, and may be too small as well as too large.
fn is_of_depth_image(mend_too_far: &str) -> bool {
    mend_too_far.contains("depth_unit_m")
}

/// In the optical frame z is forward: what a camera sees has z > 0. In OpenGL's frame it looks along -z.
fn check_frame(readings: &[Vec3], frame: Frame) -> Result<()> {
    let behind = readings.iter().filter(|p| p.z < 0.0).count();
    let before = readings.iter().filter(|p| p.z > 0.0).count();
    match frame {
        Frame::Optical if behind > before => Err(wrong(
            "most readings of the organized cloud have z < 0".into(),
            "if its z points backwards, say --frame opengl",
        )),
        Frame::OpenGl if before > behind => {
            Err(wrong("most readings of the organized cloud have z > 0".into(), "leave out --frame opengl"))
        }
        _ => Ok(()),
    }
}

/// Refuses the image of a mirrored scene, as of a cloud whose y alone was turned round: its boxes would be answered as if left were
/// right. An image that is turned, however far, is none.
fn check_handedness(cloud: &Cloud, frame: Frame) -> Result<()> {
    let Some(alike) = handedness(cloud) else { return Ok(()) };
    let (alike, forward) = match frame {
        Frame::Optical => (alike, "z points forwards"),
        Frame::OpenGl => (-alike, "z points backwards"),
    };
    if alike > MIRRORED {
        return Ok(());
    }
    Err(wrong(
        format!("the organized cloud is mirrored: {forward}, but x or y grows against its image's columns or rows"),
        "turn the sign of that one round: in the optical frame x grows with the columns and y with the rows",
    ))
}

/// Share in which columns and rows, and x / z and y / z, are alike as areas: the determinant of how they vary together, over what each
/// varies by itself. `None` where too few readings tell.
fn handedness(cloud: &Cloud) -> Option<f64> {
    let step = cloud.points.len() / SAMPLE + 1;
    let seen = |(i, p): (usize, &[f32; 3])| {
        let [x, y, z] = p.map(f64::from);
        let place = [(i % cloud.width) as f64, (i / cloud.width) as f64, x / z, y / z];
        place.iter().all(|value| value.is_finite()).then_some(place)
    };
    let places: Vec<[f64; 4]> = cloud.points.iter().enumerate().step_by(step).filter_map(seen).collect();
    if places.len() < FEWEST_FOR_HANDEDNESS {
        return None;
    }
    let count = places.len() as f64;
    let mean: [f64; 4] = std::array::from_fn(|a| places.iter().map(|place| place[a]).sum::<f64>() / count);
    let together = |a: usize, b: usize| places.iter().map(|p| (p[a] - mean[a]) * (p[b] - mean[b])).sum::<f64>() / count;
    let area = |rows: [usize; 2], columns: [usize; 2]| {
        together(rows[0], columns[0]) * together(rows[1], columns[1])
            - together(rows[0], columns[1]) * together(rows[1], columns[0])
    };
    let scale = (area([0, 1], [0, 1]) * area([2, 3], [2, 3])).sqrt();
    (scale > 0.0).then(|| area([0, 1], [2, 3]) / scale)
}

fn median_distance(readings: &[Vec3], viewpoint: Vec3) -> Option<f64> {
    let mut distances: Vec<f64> = readings.iter().map(|p| (p - viewpoint).norm()).collect();
    let middle = distances.len() / 2;
    (!distances.is_empty()).then(|| *distances.select_nth_unstable_by(middle, f64::total_cmp).1)
}

/// Largest of the three spans from the 5th to the 95th percentile; `None` when there are few readings or all are one point.
fn extent(readings: &[Vec3]) -> Option<f64> {
    if readings.len() < FEWEST_FOR_EXTENT {
        return None;
    }
    let span = |axis: usize| {
        let mut values: Vec<f64> = readings.iter().map(|p| p[axis]).collect();
        values.sort_unstable_by(f64::total_cmp);
        values[values.len() * 95 / 100] - values[values.len() * 5 / 100]
    };
    Some(span(0).max(span(1)).max(span(2))).filter(|&extent| extent > 0.0)
}

fn wrong(problem: String, mend: &str) -> InputError {
    InputError::new(problem).mend(mend)
}
