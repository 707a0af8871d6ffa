use arrayvec::ArrayVec;

use super::oriented_box::OrientedBox;
use super::solid::{Capsule, Solid};
use super::world::{ball, Ball};
use crate::arm::{Arm, Shape};
use crate::geometry::{Rigid, Vec3};

/// Pieces of an arm and its gripper, at most.
pub const MAX_PIECES: usize = 48;

/// The shapes of an arm with its fingers at one opening, the tool's first: what moves most runs into things first.
#[derive(Debug, Clone, PartialEq)]
pub struct ArmPieces {
    shapes: Vec<(usize, Shape)>,
    /// Numbers of pieces that are held against each other.
    pub(super) pairs: Vec<(usize, usize)>,
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
        Self { shapes, pairs }
    }

    /// Every piece where it is at these positions (rad), in the base's frame.
    pub fn place(&self, arm: &Arm, positions: &[f64]) -> ArrayVec<Placed, MAX_PIECES> {
        let frames = arm.link_frames(positions);
        let flange = arm.axes() + 1;
        let placed = self.shapes.iter().map(|&(body, shape)| {
            let solid = solid(&frames[body.min(flange)], &shape);
            Placed { body, solid, ball: ball(&solid) }
        });
        placed.collect()
    }
}

/// Neighbours overlap where they join; the gripper and its fingers are fixed to the last link.
fn may_meet(arm: &Arm, a: usize, b: usize) -> bool {
    let chain = |body: usize| body.min(arm.axes() + 1);
    let named = |pair: &(usize, usize)| *pair == (a, b) || *pair == (b, a);
    chain(a).abs_diff(chain(b)) > 1 && !arm.may_touch.iter().any(named)
}

fn solid(base_from_body: &Rigid, shape: &Shape) -> Solid {
    match shape {
        Shape::Capsule { from_m, to_m, radius_m } => {
            let at = |point: &Vec3| base_from_body.apply(point);
            Solid::Capsule(Capsule { from: at(from_m), to: at(to_m), radius_m: *radius_m })
        }
        Shape::Box { body_from_box, half_m } => Solid::Box(OrientedBox::new(base_from_body.then(body_from_box), *half_m)),
    }
}
