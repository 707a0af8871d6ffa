//! Brown-Conrady lens distortion and its inverse (D. C. Brown, Decentering distortion of lenses, 1966; as in OpenCV).

/// Newton's steps; a real lens needs four.
const MOST_STEPS: usize = 30;
/// Residual that counts as solved, in image coordinates at unit depth: a millionth of a pixel on any depth camera.
const SOLVED: f64 = 1e-9;

/// k1, k2, p1, p2, k3.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Distortion(pub [f64; 5]);

impl Distortion {
    pub const NONE: Self = Self([0.0; 5]);

    /// Where the lens puts the ray through (x, y, 1).
    pub fn apply(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [k1, k2, p1, p2, k3] = self.0;
        let r2 = x * x + y * y;
        let radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
        [
            x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
            y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y,
        ]
    }

    /// The ray (x, y, 1) that the lens puts at `seen`, by Newton's method from `seen`; `None` where it does not converge.
    pub fn undo(&self, seen: [f64; 2]) -> Option<[f64; 2]> {
        if *self == Self::NONE {
            return Some(seen);
        }
        let [mut x, mut y] = seen;
        for _ in 0..MOST_STEPS {
            let [dx, dy] = self.apply([x, y]);
            let (ex, ey) = (dx - seen[0], dy - seen[1]);
            if ex.abs() < SOLVED && ey.abs() < SOLVED {
                return Some([x, y]);
            }
            let [[xx, xy], [yx, yy]] = self.slope([x, y]);
            let determinant = xx * yy - xy * yx;
            x -= (yy * ex - xy * ey) / determinant;
            y -= (xx * ey - yx * ex) / determinant;
        }
        None
    }

    /// Partial derivatives of `apply`: rows are its outputs, columns x and y.
    fn slope(&self, [x, y]: [f64; 2]) -> [[f64; 2]; 2] {
        let [k1, k2, p1, p2, k3] = self.0;
        let r2 = x * x + y * y;
        let radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
        let growth = 2.0 * (k1 + r2 * (2.0 * k2 + r2 * 3.0 * k3));
        let mixed = x * y * growth + 2.0 * p1 * x + 2.0 * p2 * y;
        [
            [radial + x * x * growth + 2.0 * p1 * y + 6.0 * p2 * x, mixed],
            [mixed, radial + y * y * growth + 6.0 * p1 * y + 2.0 * p2 * x],
        ]
    }
}
