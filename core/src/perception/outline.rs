use super::readings::Readings;
use super::scene::{EdgeKind, Segments};
use super::segment::Segment;
use crate::geometry::{convex_hull, minimum_rectangle, Plane, PlaneFrame, Point2, Rectangle};

/// Adds a segment of a group with its hull and minimum bounding rectangle, its normal turned to the viewpoint.
pub fn push_segment(segments: &mut Segments, readings: &Readings, segment: &Segment, group: i32) {
    let plane = facing(readings, segment);
    let frame = PlaneFrame::new(&plane, &readings.point(segment.points[0]));
    let flat: Vec<Point2> = segment.points.iter().map(|&i| frame.to_plane(&readings.point(i))).collect();
    let hull = convex_hull(&flat);
    let Some(rectangle) = minimum_rectangle(&hull) else { return };
    if segments.point_starts.is_empty() {
        segments.point_starts.push(0);
    }
    segments.planes.push(plane);
    segments.rectangles.push(Rectangle { corners: rectangle.corners.map(|c| frame.to_space(&c)) });
    segments.hulls.push(hull.iter().map(|c| frame.to_space(c)).collect());
    segments.rms.push(segment.rms_m);
    segments.edges.push([EdgeKind::Edge; 4]);
    segments.group.push(group);
    segments.point_indices.extend(&segment.points);
    segments.point_starts.push(segments.point_indices.len() as u32);
}

fn facing(readings: &Readings, segment: &Segment) -> Plane {
    match readings.viewpoint {
        Some(viewpoint) if segment.plane.height_of(&viewpoint) < 0.0 => segment.plane.flipped(),
        _ => segment.plane,
    }
}
