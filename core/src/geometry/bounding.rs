use super::{convex_hull, Point2};

/// A rectangle in a plane: corners counter-clockwise, metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rectangle2 {
    pub corners: [Point2; 4],
}

impl Rectangle2 {
    /// Lengths of edges 0 and 1, metres.
    pub fn size(&self) -> [f64; 2] {
        let [a, b, c, _] = self.corners;
        [(b[0] - a[0]).hypot(b[1] - a[1]), (c[0] - b[0]).hypot(c[1] - b[1])]
    }

    pub fn area(&self) -> f64 {
        let [a, b] = self.size();
        a * b
    }
}

/// The rectangle of least area around the points (eq. 31), by rotating calipers over their hull (Toussaint 1983).
///
/// One of its edges lies along an edge of the hull (Freeman and Shapira 1975), so every hull edge is tried; the three other
/// touching corners only move forward. Of equal areas the first edge's is taken. Fewer than three distinct directions
/// give a flat rectangle, no points give `None`. Coordinates must be finite.
pub fn minimum_rectangle(points: &[Point2]) -> Option<Rectangle2> {
    let first = *points.first()?;
    // Near the origin: far-off coordinates would spend their digits on the offset.
    let local: Vec<Point2> = points.iter().map(|p| [p[0] - first[0], p[1] - first[1]]).collect();
    let hull = convex_hull(&local);
    let corners = match hull.len() {
        1 => [hull[0]; 4],
        2 => [hull[0], hull[1], hull[1], hull[0]],
        _ => best_over_edges(&hull),
    };
    Some(Rectangle2 { corners: corners.map(|c| [c[0] + first[0], c[1] + first[1]]) })
}

fn best_over_edges(hull: &[Point2]) -> [Point2; 4] {
    let n = hull.len();
    let mut best_area = f64::INFINITY;
    let mut best = [[0.0; 2]; 4];
    // The corners that reach farthest along the edge, away from it, and back along it.
    let (mut ahead, mut across, mut behind) = (1, 1, 1);
    for k in 0..n {
        let (a, b) = (hull[k], hull[(k + 1) % n]);
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let along = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
        let away = [-along[1], along[0]];
        let back = [-along[0], -along[1]];
        ahead = climb(hull, ahead.max(k + 1), &along);
        across = climb(hull, across.max(ahead), &away);
        behind = climb(hull, behind.max(across), &back);
        let (hi, lo) = (dot(&hull[ahead % n], &along), dot(&hull[behind % n], &along));
        let (base, top) = (dot(&a, &away), dot(&hull[across % n], &away));
        let area = (hi - lo) * (top - base);
        if area < best_area {
            best_area = area;
            let corner = |s: f64, t: f64| [s * along[0] + t * away[0], s * along[1] + t * away[1]];
            best = [corner(lo, base), corner(hi, base), corner(hi, top), corner(lo, top)];
        }
    }
    best
}

/// Moves on from corner `start` while the next corner lies no less far along the direction; not more than once round.
fn climb(hull: &[Point2], start: usize, direction: &Point2) -> usize {
    let n = hull.len();
    let mut at = start;
    while at < start + n && dot(&hull[(at + 1) % n], direction) >= dot(&hull[at % n], direction) {
        at += 1;
    }
    at
}

fn dot(p: &Point2, direction: &Point2) -> f64 {
    p[0] * direction[0] + p[1] * direction[1]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::SplitMix64;

    /// Area of the bounding rectangle with an edge along `angle`: the definition, over all points.
    fn area_at(points: &[Point2], angle: f64) -> f64 {
        let (s, c) = angle.sin_cos();
        let extent = |d: Point2| {
            let all = points.iter().map(|p| p[0] * d[0] + p[1] * d[1]);
            all.clone().fold(f64::NEG_INFINITY, f64::max) - all.fold(f64::INFINITY, f64::min)
        };
        extent([c, s]) * extent([-s, c])
    }

    /// Least area over a fine set of angles and over the direction of every pair of points that could be a hull edge.
    fn brute_force_area(points: &[Point2]) -> f64 {
        let fine = (0..720).map(|k| f64::from(k) * std::f64::consts::FRAC_PI_2 / 720.0);
        let pairs = points.iter().flat_map(|a| points.iter().map(move |b| (b[1] - a[1]).atan2(b[0] - a[0])));
        fine.chain(pairs).map(|angle| area_at(points, angle)).fold(f64::INFINITY, f64::min)
    }

    fn random_set(rng: &mut SplitMix64, kind: usize) -> Vec<Point2> {
        let n = 1 + rng.below(24);
        let (scale, shift) = ([1.0, 1e-3, 1e5][rng.below(3)], [0.0, 1e6][rng.below(2)]);
        let turn = rng.unit() * 6.3;
        (0..n)
            .map(|k| {
                let (x, y) = match kind {
                    0 => (rng.unit(), rng.unit()),
                    1 => (rng.unit(), 0.0),
                    2 => (rng.unit(), 1e-9 * rng.unit()),
                    3 => ((rng.unit() * 3.0).floor(), (rng.unit() * 3.0).floor()),
                    4 => ((k as f64).cos(), (k as f64).sin()),
                    _ => (0.5, 0.5),
                };
                let (s, c) = turn.sin_cos();
                [scale * (c * x - s * y) + shift, scale * (s * x + c * y) - shift]
            })
            .collect()
    }

    #[test]
    fn is_minimal_and_holds_every_point() {
        let mut rng = SplitMix64::new(2011);
        let mut cases = 0;
        for round in 0..6000 {
            let points = random_set(&mut rng, round % 6);
            let rect = minimum_rectangle(&points).unwrap();
            let size = points.iter().flatten().fold(0.0f64, |m, c| m.max(c.abs())).max(1e-12);
            let spread = points.iter().fold(0.0f64, |m, p| m.max((p[0] - points[0][0]).hypot(p[1] - points[0][1])));
            let tolerance = 1e-9 * spread * spread + 1e-13 * size * spread;
            let best = brute_force_area(&points);
            assert!(
                (rect.area() - best).abs() <= tolerance.max(4e-10 * spread * size),
                "{} against {best}: {points:?}",
                rect.area()
            );
            let slack = 1e-9 * spread + 1e-15 * size * 4.0;
            for k in 0..4 {
                let (a, b) = (rect.corners[k], rect.corners[(k + 1) % 4]);
                let length = (b[0] - a[0]).hypot(b[1] - a[1]);
                for p in points.iter().filter(|_| length > slack) {
                    let inside = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
                    assert!(
                        inside >= -slack * length * (1.0 + 1e-6) - 1e-15 * size * spread * 8.0,
                        "{p:?} outside {rect:?}"
                    );
                }
            }
            cases += 1;
        }
        assert_eq!(cases, 6000);
    }

    #[test]
    fn no_points_no_rectangle() {
        assert!(minimum_rectangle(&[]).is_none());
        assert_eq!(minimum_rectangle(&[[1.0, 2.0]]).unwrap().area(), 0.0);
    }
}
