use super::Vec3;

/// A rectangle in space: four corners going round, metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rectangle {
    pub corners: [Vec3; 4],
}

impl Rectangle {
    pub fn center(&self) -> Vec3 {
        self.corners.iter().sum::<Vec3>() / 4.0
    }

    /// Edge `k` runs from corner `k` to corner `k + 1`.
    pub fn edge(&self, k: usize) -> (Vec3, Vec3) {
        (self.corners[k % 4], self.corners[(k + 1) % 4])
    }

    /// Lengths of edges 0 and 1, metres.
    pub fn size(&self) -> [f64; 2] {
        [(self.corners[1] - self.corners[0]).norm(), (self.corners[2] - self.corners[1]).norm()]
    }

    pub fn area(&self) -> f64 {
        let [a, b] = self.size();
        a * b
    }

    /// Unit normal by the right hand round the corners; `None` where the rectangle has no area.
    pub fn normal(&self) -> Option<Vec3> {
        let [a, b, c, _] = self.corners;
        (b - a).cross(&(c - b)).try_normalize(1e-12)
    }
}
