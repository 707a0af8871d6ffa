//! The open fingers astride a flap's free edge: where they are on it, and how wide.

use nalgebra::Matrix3;

use super::flap::Flap;
use super::settings::ForkSettings;
use crate::arm::{Arm, Shape};
use crate::collision::{signed_distance_m, OrientedBox, Solid};
use crate::geometry::{Rigid, Vec3};

/// How the fingers go over the edge, whatever place along it.
#[derive(Debug, Clone, Copy)]
pub struct Shaped {
    /// Rotation flap_from_tool.
    rotation: Matrix3<f64>,
    /// From the pivot, where the tool's axis passes through the board, to the tool point.
    tip_m: f64,
    /// How far the pivot is from the free edge.
    inset_m: f64,
    pub opening_m: f64,
    /// How far the flap turns between the fingers.
    pub slack_rad: f64,
}

/// A tool's frame told in the flap's.
#[derive(Debug, Clone, Copy)]
pub struct Astride {
    pub flap_from_tool: Rigid,
    /// Where the outer finger meets the free edge: along the hinge.
    pub along_m: f64,
}

impl Shaped {
    /// All ways of going over a flap's edge, the likeliest first: tilted ahead of the flap as it closes, so that the outer finger pushes
    /// its edge in and the tip of the inner one holds against it, nearer to the hinge.
    pub fn all(arm: &Arm, flap: &Flap, thickness_m: f64, settings: &ForkSettings) -> Vec<Self> {
        let mut found = Vec::new();
        for share in settings.depths {
            for &tilt_rad in &settings.tilts_rad {
                for &yaw_rad in &settings.yaws_rad {
                    let reach_m = (flap.length_m() - settings.least_tip_m) / yaw_rad.cos();
                    let depth_m = reach_m.min(settings.most_depth_m) * share;
                    if depth_m < settings.least_depth_m {
                        continue;
                    }
                    let flips = [1.0, -1.0].map(|side| rotation(yaw_rad, tilt_rad, side));
                    found.extend(flips.into_iter().filter_map(|rotation| {
                        let (tip_m, inset_m) = (depth_m / 2.0, depth_m / 2.0 * yaw_rad.cos());
                        let slack_rad = 2.0 * settings.gap_m / depth_m;
                        let closed = Self { rotation, tip_m, inset_m, opening_m: 0.0, slack_rad };
                        let opening_m = closed.least_opening_m(arm, flap, thickness_m, settings.gap_m)?;
                        Some(Self { opening_m, ..closed })
                    }));
                }
            }
        }
        found
    }

    /// The places along the free edge, its middle first.
    pub fn places(&self, flap: &Flap, settings: &ForkSettings) -> Vec<Astride> {
        let [low, high] = flap.edge_m();
        let (middle_m, half_m) = ((low + high) / 2.0, (high - low) / 2.0 - settings.inset_m);
        let count = settings.places as i32;
        let steps = (1..=count).flat_map(|k| [k, -k]).map(|k| f64::from(k) / f64::from(count));
        let shares = std::iter::once(0.0).chain(steps.filter(|_| half_m > 0.0));
        shares.map(|share| self.at(flap, middle_m + share * half_m)).collect()
    }

    fn at(&self, flap: &Flap, along_m: f64) -> Astride {
        let pivot = Vec3::new(along_m, flap.length_m() - self.inset_m, 0.0);
        let axis = Vec3::from(self.rotation.column(2));
        Astride { flap_from_tool: Rigid::new(self.rotation, pivot + axis * self.tip_m), along_m }
    }

    /// The least opening at which both fingers keep a gap to the board; None where the gripper does not open so far.
    fn least_opening_m(&self, arm: &Arm, flap: &Flap, thickness_m: f64, gap_m: f64) -> Option<f64> {
        let frame = flap.frame(0.0).base_from_flap();
        let board = OrientedBox::of_panel(&flap.corners(0.0), thickness_m)?;
        let [low, high] = flap.edge_m();
        let base_from_tool = frame.then(&self.at(flap, (low + high) / 2.0).flap_from_tool);
        let tool_from_flange = arm.gripper.flange_from_tool().inverse();
        let is_clear = |opening_m: f64| {
            arm.gripper.fingers(opening_m).iter().all(|finger| match finger {
                Shape::Box { body_from_box, half_m } => {
                    let placed = OrientedBox::new(base_from_tool.then(&tool_from_flange).then(body_from_box), *half_m);
                    signed_distance_m(&Solid::Box(placed), &Solid::Box(board)) >= gap_m
                }
                Shape::Capsule { .. } => true,
            })
        };
        let [mut low_m, mut high_m] = arm.gripper.opening_m;
        if !is_clear(high_m) {
            return None;
        }
        for _ in 0..HALVINGS {
            let middle_m = (low_m + high_m) / 2.0;
            if is_clear(middle_m) {
                high_m = middle_m;
            } else {
                low_m = middle_m;
            }
        }
        Some(high_m)
    }
}

/// Of the range of openings, down to micrometres.
const HALVINGS: usize = 16;

/// Tool z from the free edge towards the hinge, turned by `yaw_rad` in the board and by `tilt_rad` out of it, so that the tool's rear goes
/// ahead of the flap as it closes; the fingers, along y, on the board's two sides.
fn rotation(yaw_rad: f64, tilt_rad: f64, side: f64) -> Matrix3<f64> {
    let toward = Vec3::new(yaw_rad.sin(), -yaw_rad.cos(), 0.0);
    let z = toward * tilt_rad.cos() + Vec3::z() * tilt_rad.sin();
    let y = (Vec3::z() * tilt_rad.cos() - toward * tilt_rad.sin()) * side;
    Matrix3::from_columns(&[y.cross(&z), y, z])
}
