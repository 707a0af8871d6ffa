//! Bodies of which nothing is known beyond the joints: parts as seen, hinges where two rectangles meet.

use super::hinge::{corners_from_hinge, hinge_angle_rad, leaving_direction, HingeEdge};
use crate::geometry::{Rectangle, Vec3};

/// A hinge between two seen panels; `position_rad` is 0 where they lie on each other and pi where they are one plane.
pub struct FreeHinge {
    pub origin: Vec3,
    pub axis: Vec3,
    pub position_rad: f64,
}

/// The hinge on the parent's edge that lies nearest to an edge of the child.
pub fn hinge_between(parent: &Rectangle, child: &Rectangle) -> Option<FreeHinge> {
    let edge = (0..4)
        .map(|k| {
            let (start, end) = parent.edge(k);
            HingeEdge { start, end }
        })
        .min_by(|a, b| distance_m(a, child).total_cmp(&distance_m(b, child)))?;
    let axis = (edge.end - edge.start).try_normalize(1e-9)?;
    let leaving = |panel: &Rectangle| leaving_direction(&panel.normal()?, &panel.center(), &edge.middle(), &axis);
    let (closed, direction) = (leaving(parent)?, leaving(child)?);
    let angle = hinge_angle_rad(&closed, &direction, &axis);
    // Opening counts up: turn the axis where the child opened the other way.
    let (axis, position_rad) = if angle < 0.0 { (-axis, -angle) } else { (axis, angle) };
    Some(FreeHinge { origin: edge.middle(), axis, position_rad })
}

/// How far the child's nearest edge is from the edge, metres.
fn distance_m(edge: &HingeEdge, child: &Rectangle) -> f64 {
    let [start, end, ..] = corners_from_hinge(child, edge);
    (start - edge.start).norm() + (end - edge.end).norm()
}
