//! The body to start from: what the rectangles say (docs/maths.md, "Body").

use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};

use super::body::{edge_place, FittedBody, Parameters};
use super::layout::{self, FLAP_ANGLE, FLAP_LENGTH, FLAP_WIDTH, HEIGHT, LENGTH, THICKNESS, WIDTH};
use super::layout::{TUCK_ANGLE, TUCK_LENGTH, TUCK_WIDTH};
use super::roles::Role;
use crate::body::ObjectAnswer;
use crate::geometry::Vec3;

const THICKNESS_M: f64 = 0.0035;
/// Flaps and tuck flaps that were not seen, and the least that a seen one starts with.
const UNSEEN_FLAP_M: f64 = 0.1;
const UNSEEN_TUCK_M: f64 = 0.04;
const LEAST_M: f64 = 0.01;

/// The start of an object with a pose; `roles` are the parts of its template.
pub fn start(object: &ObjectAnswer, roles: &[(usize, Role)]) -> Option<FittedBody> {
    let (pose, [length, width, height]) = (object.pose.as_ref()?, object.dimensions?);
    let [i, j, k, w] = pose.orientation;
    let rotation = UnitQuaternion::from_quaternion(Quaternion::new(w, i, j, k));
    let mut numbers = Parameters::zeros();
    (numbers[LENGTH], numbers[WIDTH], numbers[HEIGHT]) = (length, width, height);
    numbers[THICKNESS] = THICKNESS_M;
    for k in 0..4 {
        numbers[layout::flap(k) + FLAP_LENGTH] = UNSEEN_FLAP_M;
        numbers[layout::flap(k) + FLAP_ANGLE] = std::f64::consts::PI;
        numbers[layout::flap(k) + FLAP_WIDTH] = numbers[edge_place(k)];
        numbers[layout::tuck(k) + TUCK_LENGTH] = UNSEEN_TUCK_M;
        numbers[layout::tuck(k) + TUCK_WIDTH] = numbers[edge_place(k)];
    }
    for &(part, role) in roles {
        let Some((length, width)) = object.parts[part].corners.map(|corners| size(&corners)) else { continue };
        let name = &object.parts[part].name;
        let position = object.joints.iter().find(|joint| joint.child == *name).map(|joint| joint.position);
        match (role, position) {
            (Role::Flap(k), Some(position)) => {
                numbers[layout::flap(k) + FLAP_ANGLE] = position;
                numbers[layout::flap(k) + FLAP_LENGTH] = length;
                numbers[layout::flap(k) + FLAP_WIDTH] = width;
            }
            (Role::Tuck(k), Some(position)) => {
                numbers[layout::tuck(k) + TUCK_ANGLE] = position;
                numbers[layout::tuck(k) + TUCK_LENGTH] = length;
                numbers[layout::tuck(k) + TUCK_WIDTH] = width;
            }
            _ => {}
        }
    }
    let input_from_object = Isometry3::from_parts(Translation3::from(Vec3::from(pose.position)), rotation);
    Some(FittedBody { input_from_object, numbers })
}

/// From the hinge edge to the free edge, and along the hinge, metres.
fn size(corners: &[[f64; 3]; 4]) -> (f64, f64) {
    let [start, end, free_end, free_start] = corners.map(Vec3::from);
    let length = (free_start + free_end - start - end).norm() / 2.0;
    (length.max(LEAST_M), (end - start).norm().max(LEAST_M))
}
