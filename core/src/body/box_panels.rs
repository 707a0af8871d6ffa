//! Panels and hinges of an open box: seen ones from their rectangles, unseen ones from the box that the sides imply.

use super::box_frame::BoxFrame;
use super::hinge::{corners_from_hinge, corners_leaving, hinge_angle_rad, leaving_direction, HingeEdge};
use super::ring::BoxSegments;
use crate::geometry::Vec3;
use crate::model::SegmentSet;

/// A panel's corners in the order of docs/formats.md, and whether a segment showed it.
pub struct Panel {
    pub corners: [Vec3; 4],
    pub observed: bool,
}

/// A hinge as measured.
pub struct Hinge {
    pub origin: Vec3,
    pub axis: Vec3,
    pub position_rad: f64,
}

pub fn base_panel(frame: &BoxFrame, segments: &BoxSegments, set: &SegmentSet) -> Panel {
    let implied = frame.base_corners();
    match segments.base {
        None => Panel { corners: implied, observed: false },
        Some(s) => {
            let first_side = HingeEdge { start: implied[0], end: implied[1] };
            Panel { corners: corners_from_hinge(&set.rectangles[s], &first_side), observed: true }
        }
    }
}

pub fn side_panel(frame: &BoxFrame, segments: &BoxSegments, set: &SegmentSet, k: usize) -> Panel {
    match segments.sides[k] {
        None => Panel { corners: frame.side_corners(k), observed: false },
        Some(s) => {
            Panel { corners: corners_from_hinge(&set.rectangles[s], &top_edge(frame, set, s, k)), observed: true }
        }
    }
}

/// The higher of the rectangle's two edges that run along side `k`, directed from the side's start to its end.
fn top_edge(frame: &BoxFrame, set: &SegmentSet, s: usize, k: usize) -> HingeEdge {
    let along = frame.z.cross(&frame.outward(k));
    let rectangle = &set.rectangles[s];
    let run = |edge: usize| {
        let (a, b) = rectangle.edge(edge);
        (b - a).try_normalize(1e-9).map_or(0.0, |d| d.dot(&along).abs())
    };
    let first = usize::from(run(1) > run(0));
    let height = |edge: usize| (rectangle.edge(edge).0 + rectangle.edge(edge).1).dot(&frame.z);
    let top = if height(first) >= height(first + 2) { first } else { first + 2 };
    let (a, b) = rectangle.edge(top);
    if (b - a).dot(&along) >= 0.0 {
        HingeEdge { start: a, end: b }
    } else {
        HingeEdge { start: b, end: a }
    }
}

/// The flap's panel and hinge: the hinge is its side's top edge where that was seen, else its own edge nearest to the rim.
pub fn flap_panel(frame: &BoxFrame, segments: &BoxSegments, set: &SegmentSet, k: usize) -> Option<(Panel, Hinge)> {
    let s = segments.flaps[k]?;
    let rim = frame.rim_edge(k);
    let side_top = segments.sides[k].map(|side| top_edge(frame, set, side, k));
    let own_edge = || {
        let [start, end, ..] = corners_from_hinge(&set.rectangles[s], &rim);
        HingeEdge { start, end }
    };
    let edge = side_top.unwrap_or_else(own_edge);
    let axis = edge.axis(&rim.axis(&frame.x));
    let closed = frame.z.cross(&axis).try_normalize(1e-9)?;
    // A side's top may be too high (it ran on into a flap), the rim of all sides seldom is: it tells up from down.
    let direction = leaving_direction(&set.planes[s].normal, &set.centers[s], &rim.middle(), &axis)?;
    let corners = corners_leaving(&set.rectangles[s], &axis, &direction);
    let run = panel_run(&corners, &axis)?;
    let hinge = Hinge { origin: edge.middle(), axis, position_rad: hinge_angle_rad(&closed, &run, &axis) };
    Some((Panel { corners, observed: true }, hinge))
}

/// The tuck flap's panel and hinge, the free edge of its flap. Its axis runs against the flap's, so that folding towards
/// the inside of the closed box grows the position.
pub fn tuck_panel(flap: &Panel, segments: &BoxSegments, set: &SegmentSet, k: usize) -> Option<(Panel, Hinge)> {
    let s = segments.tucks[k]?;
    let [start, end, free_end, free_start] = flap.corners;
    let edge = HingeEdge { start: free_start, end: free_end };
    let axis = -(end - start).try_normalize(1e-9)?;
    let continued = panel_run(&flap.corners, &axis)?;
    let direction = leaving_direction(&set.planes[s].normal, &set.centers[s], &edge.middle(), &axis)?;
    // Its hinge edge runs along its flap's, against its own axis.
    let corners = corners_leaving(&set.rectangles[s], &-axis, &direction);
    let run = panel_run(&corners, &axis)?;
    let hinge = Hinge { origin: edge.middle(), axis, position_rad: hinge_angle_rad(&continued, &run, &axis) };
    Some((Panel { corners, observed: true }, hinge))
}

/// Unit vector from a panel's hinge edge to its free edge, square to `axis`: what turns with the joint.
fn panel_run(corners: &[Vec3; 4], axis: &Vec3) -> Option<Vec3> {
    let [start, end, free_end, free_start] = corners;
    let run = free_start + free_end - start - end;
    (run - axis * run.dot(axis)).try_normalize(1e-9)
}
