use super::components::UnionFind;
use crate::geometry::Point2;

/// Share of a wall's readings beyond either end that may be strays.
const STRAY_SHARE: f64 = 0.02;

/// Upright segments seen from above: lines that part places on the support.
pub struct Walls {
    lines: Vec<[Point2; 2]>,
}

impl Walls {
    /// One line along each wall's footprint.
    pub fn new(footprints: impl Iterator<Item = Vec<Point2>>) -> Self {
        Self { lines: footprints.filter(|f| !f.is_empty()).map(|f| line_along(&f)).collect() }
    }

    /// Joins patches whose middles no wall parts; each result lists patches in order.
    pub fn join_unparted(&self, patches: &[Vec<Point2>]) -> Vec<Vec<usize>> {
        let middles: Vec<Point2> = patches.iter().map(|p| middle(p)).collect();
        let mut sets = UnionFind::new(patches.len());
        for a in 0..patches.len() {
            for b in 0..a {
                if sets.find(a) != sets.find(b) && !self.part(&middles[a], &middles[b]) {
                    sets.join(a, b);
                }
            }
        }
        let mut joined = vec![Vec::new(); patches.len()];
        (0..patches.len()).for_each(|k| joined[sets.find(k)].push(k));
        joined.retain(|members| !members.is_empty());
        joined
    }

    fn part(&self, a: &Point2, b: &Point2) -> bool {
        self.lines.iter().any(|[c, d]| side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0)
    }
}

/// Twice the signed area of the triangle `a b p`.
fn side(a: &Point2, b: &Point2, p: &Point2) -> f64 {
    (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
}

fn middle(points: &[Point2]) -> Point2 {
    let n = points.len() as f64;
    points.iter().fold([0.0; 2], |sum, p| [sum[0] + p[0] / n, sum[1] + p[1] / n])
}

/// Principal axis of the points, as far as they reach.
fn line_along(points: &[Point2]) -> [Point2; 2] {
    let [mx, my] = middle(points);
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for p in points {
        let (dx, dy) = (p[0] - mx, p[1] - my);
        (xx, xy, yy) = (xx + dx * dx, xy + dx * dy, yy + dy * dy);
    }
    let (s, c) = (0.5 * f64::atan2(2.0 * xy, xx - yy)).sin_cos();
    let mut along: Vec<f64> = points.iter().map(|p| c * (p[0] - mx) + s * (p[1] - my)).collect();
    along.sort_unstable_by(f64::total_cmp);
    let stray = (STRAY_SHARE * along.len() as f64) as usize;
    [along[stray], along[along.len() - 1 - stray]].map(|t| [mx + t * c, my + t * s])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wall_parts_and_its_absence_joins() {
        let patches: Vec<Vec<Point2>> =
            [[0.0, 1.0], [9.0, 10.0], [2.0, 3.0]].map(|xs| xs.map(|x| [x, 0.0]).to_vec()).to_vec();
        let wall: Vec<Point2> = (0..100).map(|k| [5.0, f64::from(k) / 50.0 - 1.0]).collect();
        let parted = Walls::new([wall].into_iter()).join_unparted(&patches);
        assert_eq!(parted, vec![vec![0, 2], vec![1]]);
        let whole = Walls::new(std::iter::empty()).join_unparted(&patches);
        assert_eq!(whole, vec![vec![0, 1, 2]]);
    }
}
