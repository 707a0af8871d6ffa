use crate::geometry::{Rectangle, Vec3};

/// Share of a rectangle's extent within which a reading lies at a side; farther in it lies at none.
const BAND_SHARE: f64 = 0.15;
/// Readings this near to a side lie at it however small the rectangle is, metres.
const MIN_BAND_M: f64 = 0.006;

/// Tells which side of a rectangle a point of its plane lies at.
#[derive(Debug, Clone, Copy)]
pub struct SideRuler {
    corner: Vec3,
    /// Along edge 0 and along edge 1.
    axes: [Vec3; 2],
    size_m: [f64; 2],
    band_m: [f64; 2],
}

impl SideRuler {
    pub fn new(rectangle: &Rectangle) -> Self {
        let [a, b, c, _] = rectangle.corners;
        let axis = |edge: Vec3| edge.try_normalize(0.0).unwrap_or_else(Vec3::zeros);
        let size_m = rectangle.size();
        let band_m = size_m.map(|extent| (BAND_SHARE * extent).max(MIN_BAND_M));
        Self { corner: a, axes: [axis(b - a), axis(c - b)], size_m, band_m }
    }

    /// The side nearest to a point, `None` for one that lies within the rectangle, apart from all four.
    pub fn side_of(&self, p: &Vec3) -> Option<usize> {
        let from_corner = p - self.corner;
        let [x, y] = self.axes.map(|axis| from_corner.dot(&axis));
        // In units of the band: side 0 is at y = 0, side 1 at the far x, side 2 at the far y, side 3 at x = 0.
        let [wide, high] = self.size_m;
        let [band_x, band_y] = self.band_m;
        let away = [y.abs() / band_y, (wide - x).abs() / band_x, (high - y).abs() / band_y, x.abs() / band_x];
        let nearest = (1..4).fold(0, |best, k| if away[k] < away[best] { k } else { best });
        (away[nearest] <= 1.0).then_some(nearest)
    }
}
