use arrayvec::ArrayVec;
use nalgebra::Matrix3;

use super::oriented_box::OrientedBox;
use super::solid::{Capsule, Solid};
use super::world::Ball;
use crate::arm::{Arm, Shape};
use crate::geometry::{Rigid, Vec3};

/// Pieces of an arm and its gripper, at most.
pub const MAX_PIECES: usize = 48;

/// The shapes of an arm with its fingers at one opening, the tool's first: what moves most runs into things first.
#[derive(Debug, Clone, PartialEq)]
pub struct ArmPieces {
    pub(super) shapes: Vec<BodyPiece>,
    /// Numbers of pieces that are held against each other.
    pub(super) pairs: Vec<(usize, usize)>,
}

/// A piece on its body, and a ball around it there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct BodyPiece {
    pub body: usize,
    /// Index of its body's frame.
    frame: usize,
    shape: Shape,
    radius_m: f64,
    /// A box whose axes are its body's: most are.
    upright: bool,
}

/// A piece where it is at given joint positions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placed {
    pub body: usize,
    pub solid: Solid,
    pub ball: Ball,
}

impl ArmPieces {
    pub fn new(arm: &Arm, opening_m: f64) -> Self {
        let mut shapes: Vec<(usize, Shape)> = Vec::new();
        shapes.extend(arm.gripper.fingers(opening_m).map(|finger| (arm.fingers_body(), finger)));
        shapes.push((arm.gripper_body(), arm.gripper.body()));
        for (body, link) in arm.links.iter().enumerate().rev() {
            shapes.extend(link.shapes.iter().map(|&shape| (body, shape)));
        }
        shapes.truncate(MAX_PIECES);
        let all = (0..shapes.len()).flat_map(|i| (i + 1..shapes.len()).map(move |j| (i, j)));
        let pairs = all.filter(|&(i, j)| may_meet(arm, shapes[i].0, shapes[j].0)).collect();
        Self { shapes: shapes.into_iter().map(|(body, shape)| BodyPiece::new(arm, body, shape)).collect(), pairs }
    }

    /// Every piece where it is at these positions (rad), in the base's frame.
    pub fn place(&self, arm: &Arm, positions: &[f64]) -> ArrayVec<Placed, MAX_PIECES> {
        let frames = arm.link_frames(positions);
        self.shapes.iter().map(|piece| piece.place(&frames)).collect()
    }
}

impl BodyPiece {
    fn new(arm: &Arm, body: usize, shape: Shape) -> Self {
        let (radius_m, upright) = match shape {
            Shape::Capsule { from_m, to_m, radius_m } => ((to_m - from_m).norm() / 2.0 + radius_m, false),
            Shape::Box { body_from_box, half_m } => (half_m.norm(), body_from_box.rotation == Matrix3::identity()),
        };
        Self { body, frame: body.min(arm.axes() + 1), shape, radius_m, upright }
    }

    pub(super) fn place(&self, base_from_frames: &[Rigid]) -> Placed {
        let base_from_body = &base_from_frames[self.frame];
        let (solid, centre) = match &self.shape {
            Shape::Capsule { from_m, to_m, radius_m } => {
                let (from, to) = (base_from_body.apply(from_m), base_from_body.apply(to_m));
                (Solid::Capsule(Capsule { from, to, radius_m: *radius_m }), (from + to) / 2.0)
            }
            Shape::Box { body_from_box, half_m } => {
                let centre: Vec3 = base_from_body.apply(&body_from_box.translation);
                let own = &base_from_body.rotation;
                let rotation = if self.upright { *own } else { own * body_from_box.rotation };
                (Solid::Box(OrientedBox::new(Rigid::new(rotation, centre), *half_m)), centre)
            }
        };
        Placed { body: self.body, solid, ball: Ball { centre, radius_m: self.radius_m } }
    }
}

/// Neighbours overlap where they join; the gripper and its fingers are fixed to the last link.
fn may_meet(arm: &Arm, a: usize, b: usize) -> bool {
    let chain = |body: usize| body.min(arm.axes() + 1);
    let named = |pair: &(usize, usize)| *pair == (a, b) || *pair == (b, a);
    chain(a).abs_diff(chain(b)) > 1 && !arm.may_touch.iter().any(named)
}
