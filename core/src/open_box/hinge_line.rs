//! Edges that a board may hang on.

use super::sight::Reading;
use crate::fit::{flap_end, layout, FittedBody, Rim};
use crate::geometry::{Plane, Vec3};

/// A reading of the panel may lie so far before its edge, metres.
const BEFORE_EDGE_M: f64 = 0.002;

/// An edge that a board may hang on, in the level frame.
#[derive(Debug, Clone, Copy)]
pub struct HingeLine {
    pub middle: Vec3,
    pub along: Vec3,
    /// Position 0 and position pi/2, unit vectors square to the edge.
    pub closed: Vec3,
    pub up: Vec3,
    /// From the edge into the panel that it belongs to.
    pub parent: Vec3,
    /// Square to that panel.
    off_parent: Vec3,
    pub half_m: f64,
    /// The base's upper face; the support is level.
    base: Plane,
}

impl HingeLine {
    /// Half a board, and what it is uneven by.
    pub const HALF_BOARD_M: f64 = 0.003;

    /// The top edge of side `k`.
    pub fn of_side(body: &FittedBody, k: usize) -> Self {
        let rim = Rim::new(body, k);
        let turn = body.input_from_object.rotation;
        let (along, inward) = rim.directions();
        let (along, parent) = (turn * along, -(turn * Vec3::z()));
        Self {
            middle: body.to_input(&rim.place(0.0, 0.0, 0.0)),
            along,
            closed: turn * inward,
            up: turn * Vec3::z(),
            parent,
            off_parent: parent.cross(&along),
            half_m: body.edge_m(k) / 2.0,
            base: base_plane(body),
        }
    }

    /// The free edge of flap `k`, for its tuck flap.
    pub fn of_flap(body: &FittedBody, k: usize) -> Self {
        let rim = Rim::new(body, k);
        let [inward, above] = flap_end(body, k);
        let turn = body.input_from_object.rotation;
        let (along, across) = rim.directions();
        let (sin, cos) = body.get(layout::flap(k) + layout::FLAP_ANGLE).sin_cos();
        let way = turn * (across * cos + Vec3::z() * sin);
        let along = turn * along;
        Self {
            middle: body.to_input(&rim.place(body.get(layout::flap(k) + layout::FLAP_OFFSET), inward, above)),
            along,
            closed: way,
            // A tuck flap's position grows against its flap's.
            up: turn * (across * sin - Vec3::z() * cos),
            parent: -way,
            off_parent: along.cross(&way),
            half_m: body.get(layout::flap(k) + layout::FLAP_WIDTH) / 2.0
                - body.get(layout::flap(k) + layout::FLAP_TAPER),
            base: base_plane(body),
        }
    }

    /// Where readings are not those of a board on the edge, as planes with their distances: on the panel that the edge belongs to, which is
    /// where they lie above the first and near the second; near the base's upper face, which is the third.
    pub fn others(&self) -> [(Vec3, f64); 3] {
        let Self { middle, parent, off_parent, base, .. } = self;
        [
            (*parent, parent.dot(middle) - BEFORE_EDGE_M),
            (*off_parent, off_parent.dot(middle)),
            (base.normal, base.distance),
        ]
    }

    /// Whether a reading is one of the panel that the edge belongs to, of the base or of the support.
    pub fn is_of_others(&self, eye_z: f64, look: &Reading, model_m: f64) -> bool {
        self.is_on_parent(&look.at(), model_m) || self.is_ground(eye_z, look, model_m)
    }

    fn is_on_parent(&self, reading: &Vec3, model_m: f64) -> bool {
        let from = reading - self.middle;
        self.parent.dot(&from) > -BEFORE_EDGE_M && self.off_parent.dot(&from).abs() < model_m + Self::HALF_BOARD_M
    }

    fn is_ground(&self, eye_z: f64, look: &Reading, model_m: f64) -> bool {
        let reading = look.at();
        let tolerance = look.noise() * (reading.z - eye_z).abs() + model_m;
        reading.z.abs() < tolerance || self.base.height_of(&reading).abs() < tolerance
    }

    /// Angles about those at which the eye lies in the board's plane, so many steps to either side, among those from `least` up to `most`.
    pub fn edge_on_angles(&self, eye: &Vec3, steps: i32, step_rad: f64, [least, most]: [f64; 2]) -> Vec<f64> {
        let to_eye = eye - self.middle;
        let edge_on = self.up.dot(&to_eye).atan2(self.closed.dot(&to_eye));
        let around = (-steps..=steps).map(|i| edge_on + f64::from(i) * step_rad);
        let either_way = around.flat_map(|angle| [angle, angle + std::f64::consts::PI]);
        either_way.filter(|angle| (least..most).contains(angle)).collect()
    }

    /// How high the base's upper face lies, along its normal.
    pub fn base_m(&self) -> f64 {
        self.base.distance
    }

    pub fn directions(&self, angle: f64) -> (Vec3, Vec3) {
        let (sin, cos) = angle.sin_cos();
        (self.closed * cos + self.up * sin, self.up * cos - self.closed * sin)
    }
}

fn base_plane(body: &FittedBody) -> Plane {
    let normal = body.input_from_object.rotation * Vec3::z();
    let distance = normal.dot(&body.input_from_object.translation.vector) + body.get(layout::THICKNESS);
    Plane { normal, distance }
}
