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

    /// Height of the middle of edge `k` along `up`, metres.
    pub fn edge_height(&self, k: usize, up: &Vec3) -> f64 {
        let (start, end) = self.edge(k);
        (start + end).dot(up) / 2.0
    }

    /// The edge whose middle is highest along `up`; the first of equals.
    pub fn highest_edge(&self, up: &Vec3) -> usize {
        (1..4).fold(0, |best, k| if self.edge_height(k, up) > self.edge_height(best, up) { k } else { best })
    }

    /// The edge whose middle is lowest along `up`; the first of equals.
    pub fn lowest_edge(&self, up: &Vec3) -> usize {
        self.highest_edge(&-up)
    }

    /// Unit normal by the right hand round the corners; `None` where the rectangle has no area.
    pub fn normal(&self) -> Option<Vec3> {
        let [a, b, c, _] = self.corners;
        (b - a).cross(&(c - b)).try_normalize(1e-12)
    }
}
