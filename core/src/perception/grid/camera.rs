//! The camera's frame, read off an organized cloud.

use super::pose::Pose;
use super::rays::Rays;
use crate::cloud::{CloudView, Projection};
use crate::geometry::Vec3;
use nalgebra::Matrix3;
use std::borrow::Cow;

/// The third axis of the input is the optical axis where the one that is read off lies this near.
const SAME_AXIS_COSINE: f64 = 0.9995;

impl<'a> Rays<'a> {
    /// The cloud in its camera's frame. Most clouds are in it already and are not copied.
    ///
    /// The camera stands in the viewpoint, else in the origin; its optical axis is read off the rays.
    pub fn new(cloud: &CloudView<'a>) -> Self {
        let origin = cloud.viewpoint.unwrap_or_default();
        let axis = Projection::of(cloud).map_or_else(Vec3::z, |p| p.optical_axis());
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

/// A right-handed frame whose third axis is this one, as columns.
fn frame_along(axis: &Vec3) -> Matrix3<f64> {
    let aside = if axis.x.abs() < 0.7 { Vec3::x() } else { Vec3::y() };
    let second = axis.cross(&aside).normalize();
    Matrix3::from_columns(&[second.cross(axis), second, *axis])
}
