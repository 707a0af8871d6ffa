use super::{Plane, Point2, Vec3};

/// An orthonormal frame in a plane: `point = origin + a * u + b * v + height * normal`, `u x v = normal`.
#[derive(Debug, Clone, Copy)]
pub struct PlaneFrame {
    pub origin: Vec3,
    pub u: Vec3,
    pub v: Vec3,
    pub normal: Vec3,
}

impl PlaneFrame {
    /// The frame whose origin is the foot of `near` on the plane; `u` depends on the normal alone.
    pub fn new(plane: &Plane, near: &Vec3) -> Self {
        let n = plane.normal;
        let smallest = if n.x.abs() <= n.y.abs() && n.x.abs() <= n.z.abs() {
            Vec3::x()
        } else if n.y.abs() <= n.z.abs() {
            Vec3::y()
        } else {
            Vec3::z()
        };
        let u = smallest.cross(&n).normalize();
        Self { origin: near - n * plane.height_of(near), u, v: n.cross(&u), normal: n }
    }

    /// Coordinates in the plane, metres; the height over it is dropped.
    pub fn to_plane(&self, p: &Vec3) -> Point2 {
        let d = p - self.origin;
        [d.dot(&self.u), d.dot(&self.v)]
    }

    pub fn to_space(&self, q: &Point2) -> Vec3 {
        self.origin + self.u * q[0] + self.v * q[1]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::SplitMix64;

    #[test]
    fn there_and_back() {
        let mut rng = SplitMix64::new(11);
        for _ in 0..200 {
            let mut v = || Vec3::new(rng.unit() - 0.5, rng.unit() - 0.5, rng.unit() - 0.5);
            let (normal, near, q) = (v().normalize(), v(), v());
            let frame = PlaneFrame::new(&Plane { normal, distance: 0.3 }, &near);
            let back = frame.to_plane(&frame.to_space(&[q.x, q.y]));
            assert!((back[0] - q.x).abs() < 1e-12 && (back[1] - q.y).abs() < 1e-12);
            assert!((frame.u.cross(&frame.v) - normal).norm() < 1e-12);
            assert!((frame.normal.dot(&frame.to_space(&[q.x, q.y])) - 0.3).abs() < 1e-12);
        }
    }
}
