//! What ends a segment at each side of its rectangle: its own edge, another segment, what hides it, or the frame.

mod ending;
mod exits;
mod hulls;
mod ruler;
mod votes;

use super::readings::Readings;
use super::scene::{EdgeKind, Segments};
use crate::cloud::CloudView;
use crate::geometry::{Plane, Rectangle};
use ending::Beyond;
use exits::for_each_exit;
use ruler::SideRuler;
use votes::Votes;

/// An organized cloud with the segment of each pixel, -1 for none; pixel (u, v) is entry `v * width + u`.
#[derive(Debug, Clone, Copy)]
pub struct SegmentImage<'a> {
    pub labels: &'a [i32],
    pub width: usize,
    pub height: usize,
}

/// The kinds of the sides of all rectangles of an organized cloud that says where it was seen from.
///
/// Each pixel at a segment's boundary looks outwards (`Beyond`) and votes for the side that it lies at; the majority of a
/// side's votes is its kind (eq. 39, 40). Where nobody votes the side is an edge. `planes` and `rectangles` are the
/// segments', by their numbers in the image; `support` is the plane of what no segment may hold.
pub fn side_kinds(
    readings: &Readings,
    image: &SegmentImage,
    planes: &[Plane],
    rectangles: &[Rectangle],
    support: Option<&Plane>,
) -> Vec<[EdgeKind; 4]> {
    let mut votes = vec![Votes::default(); planes.len()];
    let beyond = if image.labels.is_empty() { None } else { Beyond::new(readings, image, planes, support) };
    if let Some(beyond) = beyond {
        let rulers: Vec<SideRuler> = rectangles.iter().map(SideRuler::new).collect();
        for_each_exit(image, |exit| {
            let Some(side) = rulers[exit.segment].side_of(&readings.point(exit.pixel as u32)) else { return };
            if let Some(kind) = beyond.kind(&exit) {
                votes[exit.segment].add(side, kind);
            }
        });
    }
    votes.iter().map(Votes::winners).collect()
}

/// Fills in the kinds of all sides of a cloud's segments; `labels` are theirs, where they are at hand.
pub fn tell_sides(
    segments: &mut Segments,
    readings: &Readings,
    cloud: &CloudView,
    support: Option<&Plane>,
    labels: Option<Vec<i32>>,
) {
    segments.edges = if cloud.is_organized() && cloud.viewpoint.is_some() {
        let labels = labels.unwrap_or_else(|| segments.labels(cloud.points.len()));
        let image = SegmentImage { labels: &labels, width: cloud.width, height: cloud.height };
        side_kinds(readings, &image, &segments.planes, &segments.rectangles, support)
    } else {
        hulls::side_kinds(segments, support, readings.cluster_gap_m())
    };
}

#[cfg(test)]
mod tests;
