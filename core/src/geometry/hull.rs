/// A point in a plane, metres.
pub type Point2 = [f64; 2];

/// Twice the signed area of the triangle `o a b`, positive where it turns left.
fn turn(o: &Point2, a: &Point2, b: &Point2) -> f64 {
    (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])
}

/// Corners of the convex hull, counter-clockwise, without collinear ones (Andrew's monotone chain, 1979).
///
/// One corner for coincident points, two for collinear ones, none for none. Coordinates must be finite.
pub fn convex_hull(points: &[Point2]) -> Vec<Point2> {
    let mut sorted = points.to_vec();
    sorted.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    sorted.dedup();
    convex_hull_of_sorted(&sorted)
}

/// The same for distinct points that are sorted by their first coordinate, then by their second.
pub fn convex_hull_of_sorted(sorted: &[Point2]) -> Vec<Point2> {
    if sorted.len() < 3 {
        return sorted.to_vec();
    }
    let mut hull = half_hull(sorted.iter());
    hull.pop();
    let mut upper = half_hull(sorted.iter().rev());
    upper.pop();
    hull.append(&mut upper);
    hull
}

fn half_hull<'a>(points: impl Iterator<Item = &'a Point2>) -> Vec<Point2> {
    let mut chain: Vec<Point2> = Vec::new();
    for p in points {
        while chain.len() >= 2 && turn(&chain[chain.len() - 2], &chain[chain.len() - 1], p) <= 0.0 {
            chain.pop();
        }
        chain.push(*p);
    }
    chain
}

/// Whether `p` lies inside the counter-clockwise hull, at least `margin_m` from every edge (negative: outside by as much).
pub fn hull_contains(hull: &[Point2], p: &Point2, margin_m: f64) -> bool {
    hull.len() >= 3
        && (0..hull.len()).all(|k| {
            let (a, b) = (&hull[k], &hull[(k + 1) % hull.len()]);
            turn(a, b, p) >= margin_m * (b[0] - a[0]).hypot(b[1] - a[1])
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::SplitMix64;

    #[test]
    fn holds_every_point_and_turns_left() {
        let mut rng = SplitMix64::new(1);
        let mut cases = 0;
        for n in (1..200).cycle().take(2000) {
            let points: Vec<Point2> = (0..n).map(|_| [rng.unit(), (rng.unit() * 5.0).floor()]).collect();
            let hull = convex_hull(&points);
            let h = hull.len();
            assert!(hull.iter().all(|c| points.contains(c)));
            if h >= 3 {
                assert!(points.iter().all(|p| hull_contains(&hull, p, -1e-12)));
                assert!((0..h).all(|k| turn(&hull[k], &hull[(k + 1) % h], &hull[(k + 2) % h]) > 0.0));
            }
            cases += 1;
        }
        assert_eq!(cases, 2000);
    }

    #[test]
    fn degenerate_sets() {
        assert!(convex_hull(&[]).is_empty());
        assert_eq!(convex_hull(&[[1.0, 2.0]; 9]), vec![[1.0, 2.0]]);
        let line: Vec<Point2> = (0..10).map(|k| [f64::from(k), 2.0 * f64::from(k)]).collect();
        assert_eq!(convex_hull(&line), vec![[0.0, 0.0], [9.0, 18.0]]);
    }
}
