use nalgebra::{Isometry3, SVector, Translation3, UnitQuaternion};

use super::layout::{self, PARAMETER_COUNT, POSE_COUNT};
use crate::geometry::Vec3;

pub type Parameters = SVector<f64, PARAMETER_COUNT>;

/// An articulated box: where it stands, and the numbers of its shape. Entries 0 to 5 of `numbers` stay 0: the pose is kept
/// apart, so that a turn never runs into a singularity.
#[derive(Debug, Clone, PartialEq)]
pub struct FittedBody {
    pub input_from_object: Isometry3<f64>,
    pub numbers: Parameters,
}

impl FittedBody {
    pub fn get(&self, place: usize) -> f64 {
        self.numbers[place]
    }

    /// Thickness of the board as it is told: where walls are seen from one side alone, noise may make it negative.
    pub fn board_m(&self) -> f64 {
        self.get(layout::THICKNESS).max(0.0)
    }

    /// The body moved by `step`: the pose by a turn and a shift in the object's frame, the shape by addition (eq. 74).
    pub fn moved(&self, step: &Parameters) -> Self {
        let turn = UnitQuaternion::from_scaled_axis(Vec3::new(step[0], step[1], step[2]));
        let shift = Translation3::new(step[3], step[4], step[5]);
        let mut numbers = self.numbers + step;
        numbers.fixed_rows_mut::<POSE_COUNT>(0).fill(0.0);
        let mut input_from_object = self.input_from_object * Isometry3::from_parts(shift, turn);
        input_from_object.rotation.renormalize();
        Self { input_from_object, numbers }
    }

    /// Length of the edge that side `k` stands on, between mid-surfaces.
    pub fn edge_m(&self, k: usize) -> f64 {
        self.get(edge_place(k))
    }

    pub fn to_object(&self, p: &Vec3) -> Vec3 {
        self.input_from_object.inverse_transform_point(&(*p).into()).coords
    }

    pub fn to_input(&self, q: &Vec3) -> Vec3 {
        self.input_from_object.transform_point(&(*q).into()).coords
    }

    /// The same body with side `by` as side 0.
    pub fn turned(&self, by: usize) -> Self {
        (0..by % 4).fold(self.clone(), |body, _| body.turned_once())
    }

    fn turned_once(&self) -> Self {
        // The new x runs along the old width, which leans off the old y by the rack.
        let turn =
            UnitQuaternion::from_axis_angle(&Vec3::z_axis(), std::f64::consts::FRAC_PI_2 - self.get(layout::RACK));
        let mut out = self.clone();
        out.input_from_object.rotation *= turn;
        out.numbers[layout::LENGTH] = self.get(layout::WIDTH);
        out.numbers[layout::WIDTH] = self.get(layout::LENGTH);
        out.numbers[layout::RACK] = -self.get(layout::RACK);
        for k in 0..4 {
            let from = (k + 1) % 4;
            out.numbers[layout::bulge(k)] = self.get(layout::bulge(from));
            for (to, from, count) in [
                (layout::flap(k), layout::flap(from), layout::FLAP_COUNT),
                (layout::tuck(k), layout::tuck(from), layout::TUCK_COUNT),
            ] {
                (0..count).for_each(|i| out.numbers[to + i] = self.get(from + i));
            }
        }
        out
    }
}

/// The parameter that is the length of side `k`'s edge.
pub const fn edge_place(k: usize) -> usize {
    [layout::LENGTH, layout::WIDTH, layout::LENGTH, layout::WIDTH][k % 4]
}
