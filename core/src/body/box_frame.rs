//! The square box that the seen sides imply.

use super::hinge::HingeEdge;
use super::ring::{outward, BoxSegments};
use crate::geometry::{Plane, Vec3};
use crate::model::SegmentSet;

/// An upright box: axes, and the position of its six faces along them.
#[derive(Debug, Clone, PartialEq)]
pub struct BoxFrame {
    pub x: Vec3,
    pub y: Vec3,
    pub z: Vec3,
    /// Low and high end along x, y and z, metres, in the input's frame.
    pub low: [f64; 3],
    pub high: [f64; 3],
}

/// Below this no box is measured, metres: keeps every dimension positive.
const LEAST_SIZE_M: f64 = 1e-3;
/// Sides that end further above the support than this stand on something else, metres.
const STANDS_ON_SUPPORT_M: f64 = 0.05;

/// The z axis: up, turned towards what sides and base say. A support that is known weighs as much as this share of them.
const UP_PRIOR_SHARE: f64 = 0.2;

/// Unit vector out of the opening: least squares over "square to every side, along the base's normal, near up" (eq. 19).
pub fn opening_direction(segments: &BoxSegments, set: &SegmentSet) -> Vec3 {
    let up = set.up;
    let sides = || segments.seen_sides().map(|(_, s)| (set.planes[s].normal, set.rectangles[s].area()));
    let total_area: f64 = sides().map(|(_, area)| area).sum();
    // z = up + d with d square to up; minimise sum area (n . z)^2 + prior |d|^2 + base area |d - base|^2.
    let mut matrix = nalgebra::Matrix3::identity() * (UP_PRIOR_SHARE * total_area + 1e-9);
    let mut rhs = Vec3::zeros();
    for (normal, area) in sides() {
        matrix += normal * normal.transpose() * area;
        rhs -= normal * (normal.dot(&up) * area);
    }
    if let Some(base) = segments.base {
        let normal = set.planes[base].normal;
        let upward = if normal.dot(&up) < 0.0 { -normal } else { normal };
        let area = set.rectangles[base].area();
        matrix += nalgebra::Matrix3::identity() * area;
        rhs += (upward - up) * area;
    }
    let shift = matrix.lu().solve(&rhs).unwrap_or_else(Vec3::zeros);
    (up + shift).try_normalize(1e-9).unwrap_or(up)
}

impl BoxFrame {
    /// The box that `segments` (ordered counter-clockwise, at least two sides seen) imply.
    pub fn new(segments: &BoxSegments, set: &SegmentSet, support: Option<&Plane>, x: Vec3, z: Vec3) -> Self {
        let y = z.cross(&x);
        let mut frame = Self { x, y, z, low: [0.0; 3], high: [0.0; 3] };
        (frame.low[0], frame.high[0]) = frame.extent(segments, set, 0);
        (frame.low[1], frame.high[1]) = frame.extent(segments, set, 1);
        frame.high[2] = frame.rim_height(segments, set);
        frame.low[2] = frame.bottom_height(segments, set, support);
        for axis in 0..3 {
            if frame.high[axis] - frame.low[axis] < LEAST_SIZE_M {
                frame.high[axis] = frame.low[axis] + LEAST_SIZE_M;
            }
        }
        frame
    }

    fn axis(&self, axis: usize) -> Vec3 {
        [self.x, self.y, self.z][axis]
    }

    /// Where the two walls across `axis` stand: from the wall itself, else from where its neighbours end.
    fn extent(&self, segments: &BoxSegments, set: &SegmentSet, axis: usize) -> (f64, f64) {
        let direction = self.axis(axis);
        // Side 1 and 3 stand across x, side 2 and 0 across y: high end first.
        let (high_wall, low_wall) = if axis == 0 { (1, 3) } else { (2, 0) };
        let along = |p: &Vec3| p.dot(&direction);
        let neighbours = [(high_wall + 1) % 4, (high_wall + 3) % 4].into_iter().filter_map(|k| segments.sides[k]);
        let ends: Vec<f64> =
            neighbours.flat_map(|s| set.rectangles[s].corners.iter().map(along).collect::<Vec<_>>()).collect();
        let wall = |k: usize| segments.sides[k].map(|s| along(&set.centers[s]));
        let low = wall(low_wall).unwrap_or_else(|| ends.iter().copied().fold(f64::INFINITY, f64::min));
        let high = wall(high_wall).unwrap_or_else(|| ends.iter().copied().fold(f64::NEG_INFINITY, f64::max));
        (low.min(high), high.max(low))
    }

    /// The lower median of the sides' tops (eq. 22): a side that runs on into an upright flap ends too high, never too low.
    fn rim_height(&self, segments: &BoxSegments, set: &SegmentSet) -> f64 {
        let mut tops: Vec<f64> = segments.seen_sides().map(|(_, s)| self.highest(set, s)).collect();
        tops.sort_by(f64::total_cmp);
        tops[(tops.len() - 1) / 2]
    }

    fn highest(&self, set: &SegmentSet, s: usize) -> f64 {
        let mut heights = set.rectangles[s].corners.map(|c| c.dot(&self.z));
        heights.sort_by(f64::total_cmp);
        (heights[2] + heights[3]) / 2.0
    }

    fn lowest(&self, set: &SegmentSet, s: usize) -> f64 {
        let mut heights = set.rectangles[s].corners.map(|c| c.dot(&self.z));
        heights.sort_by(f64::total_cmp);
        (heights[0] + heights[1]) / 2.0
    }

    fn bottom_height(&self, segments: &BoxSegments, set: &SegmentSet, support: Option<&Plane>) -> f64 {
        if let Some(base) = segments.base {
            return set.centers[base].dot(&self.z);
        }
        let lowest = segments.seen_sides().map(|(_, s)| self.lowest(set, s)).fold(f64::INFINITY, f64::min);
        let middle = self.point(0.5, 0.5, lowest);
        match support {
            Some(plane) if plane.height_of(&middle) < STANDS_ON_SUPPORT_M => lowest - plane.height_of(&middle),
            _ => lowest,
        }
    }

    /// The point at shares `u` and `v` of the length and width, at height `h` along z.
    fn point(&self, u: f64, v: f64, h: f64) -> Vec3 {
        let at = |axis: usize, share: f64| self.low[axis] + share * (self.high[axis] - self.low[axis]);
        self.x * at(0, u) + self.y * at(1, v) + self.z * h
    }

    /// Length, width, height, metres.
    pub fn dimensions(&self) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.high[axis] - self.low[axis])
    }

    /// Centre of the base.
    pub fn origin(&self) -> Vec3 {
        self.point(0.5, 0.5, self.low[2])
    }

    /// The starts of side 0 to side 3, at height `h` along z.
    fn ring_corners(&self, h: f64) -> [Vec3; 4] {
        [self.point(0.0, 0.0, h), self.point(1.0, 0.0, h), self.point(1.0, 1.0, h), self.point(0.0, 1.0, h)]
    }

    pub fn base_corners(&self) -> [Vec3; 4] {
        self.ring_corners(self.low[2])
    }

    /// Side `k`: top edge from start to end, then down.
    pub fn side_corners(&self, k: usize) -> [Vec3; 4] {
        let (top, bottom) = (self.ring_corners(self.high[2]), self.ring_corners(self.low[2]));
        let next = (k + 1) % 4;
        [top[k], top[next], bottom[next], bottom[k]]
    }

    pub fn rim_edge(&self, k: usize) -> HingeEdge {
        let corners = self.side_corners(k);
        HingeEdge { start: corners[0], end: corners[1] }
    }

    /// The rotation that makes side 0 the longer side nearest the camera.
    pub fn canonical_turn(&self, viewpoint: Option<&Vec3>) -> usize {
        let [length, width, _] = self.dimensions();
        let eye = viewpoint.copied().unwrap_or_else(Vec3::zeros);
        let distance = |k: usize| {
            let edge = self.rim_edge(k);
            (edge.middle() - eye).norm()
        };
        let longer = if length >= width { [0, 2] } else { [1, 3] };
        if distance(longer[0]) <= distance(longer[1]) {
            longer[0]
        } else {
            longer[1]
        }
    }

    /// The same box with side `by` as side 0.
    pub fn turned(&self, by: usize) -> Self {
        let mut out = self.clone();
        for _ in 0..by % 4 {
            // Side 1 runs along y: the new x is y, the new y is -x.
            let (low, high) = (out.low, out.high);
            (out.x, out.y) = (out.y, -out.x);
            out.low = [low[1], -high[0], low[2]];
            out.high = [high[1], -low[0], high[2]];
        }
        out
    }

    /// Unit vector outward of side `k`.
    pub fn outward(&self, k: usize) -> Vec3 {
        outward(k, &self.x, &self.z)
    }
}
