use crate::geometry::{Plane, Rectangle, Vec3};
use crate::perception::{EdgeKind, Scene};

/// The segments that one search may use, and the scene facts that features measure against.
#[derive(Debug, Clone)]
pub struct SegmentSet {
    /// Number of each member in the scene's `Segments`.
    pub scene_index: Vec<usize>,
    pub planes: Vec<Plane>,
    pub rectangles: Vec<Rectangle>,
    pub centers: Vec<Vec3>,
    /// What ends each rectangle at each of its edges.
    pub edges: Vec<[EdgeKind; 4]>,
    /// The share of each rectangle that the segment's hull fills, 1 where the rectangle has no area.
    pub fills: Vec<f64>,
    /// Unit vector away from the support.
    pub up: Vec3,
    /// Whether the planes' normals look at a known viewpoint; if not, their sign means nothing.
    pub oriented: bool,
    /// Area-weighted centre of the members, metres.
    pub center: Vec3,
    /// `center` dropped along `-up` onto the support, or to the lowest corner where no support is known.
    pub foot: Vec3,
}

impl SegmentSet {
    /// The members `indices` of the scene's segments.
    pub fn new(scene: &Scene, indices: &[usize]) -> Self {
        let segments = &scene.segments;
        let rectangles: Vec<Rectangle> = indices.iter().map(|&s| segments.rectangles[s]).collect();
        let centers: Vec<Vec3> = rectangles.iter().map(Rectangle::center).collect();
        let center = area_weighted_center(&rectangles, &centers);
        let foot_height = match &scene.support {
            Some(support) => support.distance * support.normal.dot(&scene.up),
            None => lowest_height(&rectangles, &scene.up),
        };
        Self {
            scene_index: indices.to_vec(),
            planes: indices.iter().map(|&s| segments.planes[s]).collect(),
            edges: indices.iter().map(|&s| segments.edges[s]).collect(),
            fills: indices.iter().map(|&s| fill(&segments.hulls[s], &segments.rectangles[s])).collect(),
            foot: center + scene.up * (foot_height - center.dot(&scene.up)),
            rectangles,
            centers,
            up: scene.up,
            oriented: scene.viewpoint.is_some(),
            center,
        }
    }

    /// One set for each group of the scene (the background is none), in the groups' order.
    pub fn by_group(scene: &Scene) -> Vec<Self> {
        let groups = &scene.segments.group;
        let count = groups.iter().map(|&g| g + 1).max().unwrap_or(0);
        (0..count)
            .map(|g| (0..groups.len()).filter(|&s| groups[s] == g).collect::<Vec<_>>())
            .filter(|indices| !indices.is_empty())
            .map(|indices| Self::new(scene, &indices))
            .collect()
    }

    pub fn len(&self) -> usize {
        self.planes.len()
    }

    pub fn is_empty(&self) -> bool {
        self.planes.is_empty()
    }
}

fn fill(hull: &[Vec3], rectangle: &Rectangle) -> f64 {
    let fans = hull.windows(2).skip(1).map(|edge| (edge[0] - hull[0]).cross(&(edge[1] - hull[0])));
    let area = fans.sum::<Vec3>().norm() / 2.0;
    let of = rectangle.area();
    if of > 0.0 {
        (area / of).min(1.0)
    } else {
        1.0
    }
}

fn area_weighted_center(rectangles: &[Rectangle], centers: &[Vec3]) -> Vec3 {
    // The small constant keeps sets of degenerate rectangles finite.
    let weights: Vec<f64> = rectangles.iter().map(|r| r.area() + 1e-9).collect();
    let total: f64 = weights.iter().sum();
    centers.iter().zip(&weights).map(|(c, w)| c * *w).sum::<Vec3>() / total.max(1e-9)
}

fn lowest_height(rectangles: &[Rectangle], up: &Vec3) -> f64 {
    let heights = rectangles.iter().flat_map(|r| r.corners.iter().map(|c| c.dot(up)));
    let lowest = heights.fold(f64::INFINITY, f64::min);
    if lowest.is_finite() {
        lowest
    } else {
        0.0
    }
}
