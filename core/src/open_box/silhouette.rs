//! Where a box lies in the image, row by row: rays beside it need not be asked.

const AXES: usize = 3;
const EDGES: usize = 12;

fn next(axis: usize) -> usize {
    (axis + 1) % AXES
}

/// An edge in the image, its upper end first.
#[derive(Debug, Clone, Copy)]
struct Line {
    from: [f64; 2],
    to_row: f64,
    columns_per_row: f64,
}

impl Line {
    fn new(a: [f64; 2], b: [f64; 2]) -> Self {
        let (from, to) = if a[1] <= b[1] { (a, b) } else { (b, a) };
        Self { from, to_row: to[1], columns_per_row: (to[0] - from[0]) / (to[1] - from[1]) }
    }

    fn column(&self, row: f64) -> f64 {
        self.from[0] + self.columns_per_row * (row - self.from[1])
    }
}

/// A box's outline in the image: what its eight corners span.
pub struct Silhouette {
    corners: [[f64; 2]; 8],
    lines: [Line; EDGES],
    /// Of the lines, those at which a face that is seen meets one that is not: no other bounds the outline.
    count: usize,
}

impl Silhouette {
    /// Readings may lie so many pixels beside where the projection has them.
    pub const MARGIN_PX: f64 = 2.0;

    /// Of corners in pixels; bit `a` of a corner's number is its end along axis `a`.
    fn new(corners: [[f64; 2]; 8]) -> Self {
        // The face at an axis' lower end shows one way round, that at its upper end the other, or else its back.
        let is_seen: [[bool; 2]; AXES] = std::array::from_fn(|axis| {
            let turn = |end: usize| {
                let from = end << axis;
                let [a, b, c] = [from, from | 1 << next(axis), from | 1 << next(next(axis))].map(|n| corners[n]);
                (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
            };
            [turn(0) > 0.0, turn(1) < 0.0]
        });
        let mut out = Self { corners, lines: [Line::new(corners[0], corners[0]); EDGES], count: 0 };
        for axis in 0..AXES {
            let (b, c) = (next(axis), next(next(axis)));
            for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                if is_seen[b][i] != is_seen[c][j] {
                    let from = i << b | j << c;
                    out.lines[out.count] = Line::new(corners[from], corners[from | 1 << axis]);
                    out.count += 1;
                }
            }
        }
        out
    }

    /// Of the pixels that see the corners, told by their ends along the axes; `None` where one of them lies behind the camera.
    pub fn of(pixel: impl Fn([usize; 3]) -> Option<[f64; 2]>) -> Option<Self> {
        let mut corners = [[0.0; 2]; 8];
        for (number, corner) in corners.iter_mut().enumerate() {
            *corner = pixel([number & 1, number >> 1 & 1, number >> 2])?;
        }
        Some(Self::new(corners))
    }

    /// Left, right, top, bottom.
    pub fn bounds(&self) -> [f64; 4] {
        let from = [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY];
        self.corners
            .iter()
            .fold(from, |[left, right, top, bottom], [u, v]| [left.min(*u), right.max(*u), top.min(*v), bottom.max(*v)])
    }

    /// Least and most column that it reaches in a row, the margin included; the first is the greater where it does not reach.
    pub fn columns(&self, row: f64) -> [f64; 2] {
        let (above, below) = (row - Silhouette::MARGIN_PX, row + Silhouette::MARGIN_PX);
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for line in &self.lines[..self.count] {
            if line.to_row < above || line.from[1] > below {
                continue;
            }
            // A level edge lies between the ends of two others.
            for row in [higher(above, line.from[1]), lower(below, line.to_row)] {
                let column = line.column(row);
                (low, high) = (lower(low, column), higher(high, column));
            }
        }
        [low - Silhouette::MARGIN_PX, high + Silhouette::MARGIN_PX]
    }
}

/// Of numbers: the library's ask whether they are.
#[inline(always)]
fn lower(a: f64, b: f64) -> f64 {
    if a < b {
        a
    } else {
        b
    }
}

#[inline(always)]
fn higher(a: f64, b: f64) -> f64 {
    if a > b {
        a
    } else {
        b
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::SplitMix64;

    #[test]
    fn what_lies_between_corners_lies_between_its_columns() {
        let mut random = SplitMix64::new(7);
        let (mut cases, mut of_edges) = (0, 0);
        for turn in 0..200 {
            let mut draw = |low: f64, high: f64| low + random.unit() * (high - low);
            // A box before a pinhole camera, sometimes level with the rows.
            let yaw: f64 = if turn % 4 == 0 { 0.0 } else { draw(0.0, 6.3) };
            let half = [draw(0.02, 0.4), draw(0.02, 0.4), draw(0.01, 0.4)];
            let middle = [draw(-0.5, 0.5), draw(-0.5, 0.5), draw(1.0, 2.0)];
            let pixel = |shares: [f64; 3]| {
                let [x, y, z] = [0, 1, 2].map(|a| shares[a] * half[a]);
                let (sin, cos) = yaw.sin_cos();
                let place = [x * cos - z * sin + middle[0], y + middle[1], x * sin + z * cos + middle[2]];
                [320.0 + 525.0 * place[0] / place[2], 240.0 + 525.0 * place[1] / place[2]]
            };
            let corner = |number: usize| [0, 1, 2].map(|a| if number >> a & 1 == 0 { -1.0 } else { 1.0 });
            let outline = Silhouette::new(std::array::from_fn(|number| pixel(corner(number))));
            let [left, right, top, bottom] = outline.bounds();
            for _ in 0..50 {
                let [u, v] = pixel([draw(-1.0, 1.0), draw(-1.0, 1.0), draw(-1.0, 1.0)]);
                let [low, high] = outline.columns(v.round());
                assert!(low <= u && u <= high, "{low} {u} {high}");
                assert!(left <= low + 2.0 * Silhouette::MARGIN_PX && high <= right + 2.0 * Silhouette::MARGIN_PX);
                assert!(top <= v && v <= bottom);
                cases += 1;
            }
            // The other edges lie within.
            assert!(outline.count <= 6);
            let ends = || (0..8).flat_map(|from| [0, 1, 2].map(|axis| [from, from | 1 << axis]));
            let all = ends().filter(|[from, to]| from != to).map(|ends| ends.map(|number| outline.corners[number]));
            for [[u, v], [x, y]] in all {
                for share in [0.0, 0.3, 0.7, 1.0] {
                    let (at, row) = (u + share * (x - u), v + share * (y - v));
                    let [low, high] = outline.columns(row);
                    assert!(
                        low + Silhouette::MARGIN_PX <= at + 1e-6 && at <= high - Silhouette::MARGIN_PX + 1e-6,
                        "{low} {at} {high}"
                    );
                    of_edges += 1;
                }
            }
            for row in [top - 3.0, bottom + 3.0] {
                let [low, high] = outline.columns(row);
                assert!(low > high);
            }
        }
        assert_eq!((cases, of_edges), (10_000, 9600));
    }
}
