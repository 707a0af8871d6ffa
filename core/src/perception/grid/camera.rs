//! The camera's frame, read off an organized cloud.

use super::pose::Pose;
use super::rays::Rays;
use crate::cloud::CloudView;
use crate::geometry::Vec3;
use nalgebra::{Matrix3, SMatrix, SymmetricEigen};
use std::borrow::Cow;

/// Readings in each direction of the image that the axis is read from.
const SAMPLES: usize = 24;
/// Fewer readings say nothing.
const MIN_SAMPLES: usize = 16;
/// The third axis of the input is the optical axis where the one that is read off lies this near.
const SAME_AXIS_COSINE: f64 = 0.9995;

impl<'a> Rays<'a> {
    /// The cloud in its camera's frame. Most clouds are in it already and are not copied.
    ///
    /// The camera stands in the viewpoint, else in the origin; its optical axis is read off the rays: pixel positions are a
    /// projective map of them, `(x, y, 1) ~ H ray`, and the last row of H is the axis (the direct linear transform).
    pub fn new(cloud: &CloudView<'a>) -> Self {
        let origin = cloud.viewpoint.unwrap_or_default();
        let axis = optical_axis(cloud, &origin).unwrap_or_else(Vec3::z);
        let (width, height) = (cloud.width, cloud.height);
        if origin == Vec3::zeros() && axis.z > SAME_AXIS_COSINE {
            let input_from_camera = Pose { rotation: Matrix3::identity(), origin };
            return Self { points: Cow::Borrowed(cloud.points), width, height, input_from_camera };
        }
        let rotation = frame_along(&axis);
        let camera_from_input = rotation.transpose();
        let turned = cloud.points.iter().map(|&[x, y, z]| {
            let p = camera_from_input * (Vec3::new(f64::from(x), f64::from(y), f64::from(z)) - origin);
            [p.x as f32, p.y as f32, p.z as f32]
        });
        let input_from_camera = Pose { rotation, origin };
        Self { points: Cow::Owned(turned.collect()), width, height, input_from_camera }
    }
}

/// Unit vector out of the camera; `None` where there is too little to read it from.
fn optical_axis(cloud: &CloudView, origin: &Vec3) -> Option<Vec3> {
    let (step_x, step_y) = ((cloud.width / SAMPLES).max(1), (cloud.height / SAMPLES).max(1));
    let mut normal_equations = SMatrix::<f64, 9, 9>::zeros();
    let (mut count, mut mean) = (0, Vec3::zeros());
    for y in (step_y / 2..cloud.height).step_by(step_y) {
        for x in (step_x / 2..cloud.width).step_by(step_x) {
            let [px, py, pz] = cloud.points[y * cloud.width + x].map(f64::from);
            let Some(ray) = (Vec3::new(px, py, pz) - origin).try_normalize(1e-6) else { continue };
            if !ray.iter().all(|c| c.is_finite()) {
                continue;
            }
            // About the image's middle, in units of its size: the equations are then well scaled.
            let [u, v] = [x as f64 / cloud.width as f64 - 0.5, y as f64 / cloud.height as f64 - 0.5];
            let [a, b, c] = [ray.x, ray.y, ray.z];
            for row in
                [[a, b, c, 0.0, 0.0, 0.0, -u * a, -u * b, -u * c], [0.0, 0.0, 0.0, a, b, c, -v * a, -v * b, -v * c]]
            {
                let row = SMatrix::<f64, 9, 1>::from(row);
                normal_equations += row * row.transpose();
            }
            mean += ray;
            count += 1;
        }
    }
    if count < MIN_SAMPLES {
        return None;
    }
    let eigen = SymmetricEigen::try_new(normal_equations, 1e-14, 200)?;
    let least = eigen.eigenvalues.imin();
    let solution = eigen.eigenvectors.column(least);
    let axis = Vec3::new(solution[6], solution[7], solution[8]).try_normalize(1e-9)?;
    Some(if axis.dot(&mean) < 0.0 { -axis } else { axis })
}

/// A right-handed frame whose third axis is this one, as columns.
fn frame_along(axis: &Vec3) -> Matrix3<f64> {
    let aside = if axis.x.abs() < 0.7 { Vec3::x() } else { Vec3::y() };
    let second = axis.cross(&aside).normalize();
    Matrix3::from_columns(&[second.cross(axis), second, *axis])
}
