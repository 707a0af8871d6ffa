//! Where a box lies in the image, row by row: rays beside it need not be asked.

/// Readings may lie so many pixels beside where the projection has them.
const MARGIN_PX: f64 = 2.0;
/// Of a box's corners, numbered by bits, those that an edge joins.
const EDGES: [[usize; 2]; 12] =
    [[0, 1], [2, 3], [4, 5], [6, 7], [0, 2], [1, 3], [4, 6], [5, 7], [0, 4], [1, 5], [2, 6], [3, 7]];

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
    lines: [Line; 12],
}

impl Silhouette {
    /// Of corners in pixels; bit `a` of a corner's number is its end along axis `a`.
    fn new(corners: [[f64; 2]; 8]) -> Self {
        Self { corners, lines: EDGES.map(|[a, b]| Line::new(corners[a], corners[b])) }
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
        let (above, below) = (row - MARGIN_PX, row + MARGIN_PX);
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for line in &self.lines {
            if line.to_row < above || line.from[1] > below {
                continue;
            }
            // A level edge lies between the ends of two others.
            for row in [above.max(line.from[1]), below.min(line.to_row)] {
                let column = line.column(row);
                (low, high) = (low.min(column), high.max(column));
            }
        }
        [low - MARGIN_PX, high + MARGIN_PX]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::SplitMix64;

    #[test]
    fn what_lies_between_corners_lies_between_its_columns() {
        let mut random = SplitMix64::new(7);
        let mut cases = 0;
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
                assert!(left <= low + 2.0 * MARGIN_PX && high <= right + 2.0 * MARGIN_PX);
                assert!(top <= v && v <= bottom);
                cases += 1;
            }
            for row in [top - 3.0, bottom + 3.0] {
                let [low, high] = outline.columns(row);
                assert!(low > high);
            }
        }
        assert_eq!(cases, 10_000);
    }
}
