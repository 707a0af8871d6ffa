use super::super::scene::{EdgeKind, Segments};
use crate::geometry::{hull_contains, Plane, PlaneFrame, Point2, Vec3};

/// Places along a side at which its neighbours are looked for.
const PLACES: usize = 9;

/// The sides of a cloud that is no image: crease where another segment's hull comes within `gap_m` of at least half of the
/// places that the segment itself reaches, edge elsewhere.
pub fn side_kinds(segments: &Segments, support: Option<&Plane>, gap_m: f64) -> Vec<[EdgeKind; 4]> {
    let surfaces: Vec<Surface> = (0..segments.len()).map(|s| Surface::new(segments, s)).collect();
    let kind = |s: usize, k: usize| {
        let (start, end) = segments.rectangles[s].edge(k);
        let place = |i: usize| start + (end - start) * ((i as f64 + 0.5) / PLACES as f64);
        let (mut reached, mut joined) = (0, 0);
        for p in (0..PLACES).map(place).filter(|p| surfaces[s].comes_near(p, gap_m)) {
            let others = surfaces.iter().enumerate().filter(|&(other, _)| other != s);
            let on_support = support.is_some_and(|plane| plane.height_of(&p).abs() <= gap_m);
            reached += 1;
            joined += usize::from(on_support || others.into_iter().any(|(_, other)| other.comes_near(&p, gap_m)));
        }
        if reached > 0 && 2 * joined >= reached {
            EdgeKind::Crease
        } else {
            EdgeKind::Edge
        }
    };
    (0..segments.len()).map(|s| [0, 1, 2, 3].map(|k| kind(s, k))).collect()
}

/// A segment's hull in its plane.
struct Surface {
    plane: Plane,
    frame: PlaneFrame,
    hull: Vec<Point2>,
}

impl Surface {
    fn new(segments: &Segments, s: usize) -> Self {
        let plane = segments.planes[s];
        let frame = PlaneFrame::new(&plane, &segments.rectangles[s].corners[0]);
        let mut hull: Vec<Point2> = segments.hulls[s].iter().map(|p| frame.to_plane(p)).collect();
        let edges = (0..hull.len()).map(|k| (hull[k], hull[(k + 1) % hull.len()]));
        if edges.map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>() < 0.0 {
            hull.reverse();
        }
        Self { plane, frame, hull }
    }

    fn comes_near(&self, p: &Vec3, gap_m: f64) -> bool {
        self.plane.height_of(p).abs() <= gap_m && hull_contains(&self.hull, &self.frame.to_plane(p), -gap_m)
    }
}
