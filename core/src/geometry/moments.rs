use super::{Plane, Vec3};
use nalgebra::{Matrix3, SymmetricEigen};

/// Weight, first and second moments of a set of points: enough for its least-squares plane, and sets add.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moments {
    pub weight: f64,
    sum: Vec3,
    /// Sums of xx, xy, xz, yy, yz, zz.
    outer: [f64; 6],
}

impl Default for Moments {
    fn default() -> Self {
        Self { weight: 0.0, sum: Vec3::zeros(), outer: [0.0; 6] }
    }
}

impl Moments {
    /// From the sums over points: of 1, of p, and of xx, xy, xz, yy, yz, zz.
    pub fn from_sums(weight: f64, sum: Vec3, outer: [f64; 6]) -> Self {
        Self { weight, sum, outer }
    }

    pub fn add_point(&mut self, p: &Vec3) {
        self.weight += 1.0;
        self.sum += p;
        let products = [p.x * p.x, p.x * p.y, p.x * p.z, p.y * p.y, p.y * p.z, p.z * p.z];
        for (total, product) in self.outer.iter_mut().zip(products) {
            *total += product;
        }
    }

    pub fn add(&mut self, other: &Moments) {
        self.weight += other.weight;
        self.sum += other.sum;
        for (total, more) in self.outer.iter_mut().zip(other.outer) {
            *total += more;
        }
    }

    /// Metres; NaN for an empty set.
    pub fn mean(&self) -> Vec3 {
        self.sum / self.weight
    }

    /// xx, xy, xz, yy, yz, zz about the mean, square metres; NaN for an empty set.
    pub fn covariance(&self) -> [f64; 6] {
        let (m, [xx, xy, xz, yy, yz, zz]) = (self.mean(), self.outer.map(|s| s / self.weight));
        [xx - m.x * m.x, xy - m.x * m.y, xz - m.x * m.z, yy - m.y * m.y, yz - m.y * m.z, zz - m.z * m.z]
    }

    /// Sum of the points' squared `normal . p - distance`; the normal need not have unit length.
    pub fn squares_about(&self, normal: &Vec3, distance: f64) -> f64 {
        let (n, [xx, xy, xz, yy, yz, zz]) = (normal, self.outer);
        let of_products =
            n.x * (n.x * xx + 2.0 * (n.y * xy + n.z * xz)) + n.y * (n.y * yy + 2.0 * n.z * yz) + n.z * n.z * zz;
        (of_products - 2.0 * distance * n.dot(&self.sum) + distance * distance * self.weight).max(0.0)
    }

    /// Variances along the principal directions, square metres, smallest first, with unit directions.
    ///
    /// `None` below three points.
    pub fn principal(&self) -> Option<([f64; 3], [Vec3; 3])> {
        if self.weight < 3.0 {
            return None;
        }
        let (m, w) = (self.mean(), self.weight);
        let [xx, xy, xz, yy, yz, zz] = self.outer.map(|s| s / w);
        let cov = Matrix3::new(
            xx - m.x * m.x,
            xy - m.x * m.y,
            xz - m.x * m.z,
            xy - m.x * m.y,
            yy - m.y * m.y,
            yz - m.y * m.z,
            xz - m.x * m.z,
            yz - m.y * m.z,
            zz - m.z * m.z,
        );
        let eigen = SymmetricEigen::try_new(cov, 1e-14, 60)?;
        let mut order = [0, 1, 2];
        order.sort_by(|&a, &b| eigen.eigenvalues[a].total_cmp(&eigen.eigenvalues[b]));
        let values = order.map(|k| eigen.eigenvalues[k].max(0.0));
        let directions = order.map(|k| eigen.eigenvectors.column(k).normalize());
        Some((values, directions))
    }

    /// Least-squares plane (eq. 29) and the root mean square distance from it in metres; `None` where the points span no plane.
    pub fn fit_plane(&self) -> Option<(Plane, f64)> {
        let (variances, directions) = self.principal()?;
        if variances[1] <= 1e-12 * variances[2].max(1e-12) || !directions[0].iter().all(|c| c.is_finite()) {
            return None;
        }
        let normal = directions[0];
        Some((Plane { normal, distance: normal.dot(&self.mean()) }, variances[0].sqrt()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::SplitMix64;

    fn cloud_on_plane(rng: &mut SplitMix64, normal: Vec3, distance: f64) -> Moments {
        let mut moments = Moments::default();
        for _ in 0..200 {
            let p = Vec3::new(rng.unit() - 0.5, rng.unit() - 0.5, rng.unit() - 0.5);
            moments.add_point(&(p - normal * (normal.dot(&p) - distance)));
        }
        moments
    }

    #[test]
    fn recovers_the_plane_of_exact_points() {
        let mut rng = SplitMix64::new(3);
        let mut cases = 0;
        for _ in 0..500 {
            let normal = Vec3::new(rng.unit() - 0.5, rng.unit() - 0.5, rng.unit() - 0.5).normalize();
            let distance = 4.0 * (rng.unit() - 0.5);
            let (plane, rms) = cloud_on_plane(&mut rng, normal, distance).fit_plane().unwrap();
            assert!(plane.normal.cross(&normal).norm() < 1e-6);
            assert!((plane.distance.abs() - distance.abs()).abs() < 1e-6 && rms < 1e-6);
            cases += 1;
        }
        assert_eq!(cases, 500);
    }

    #[test]
    fn sets_add() {
        let mut rng = SplitMix64::new(5);
        let a = cloud_on_plane(&mut rng, Vec3::x(), 1.0);
        let b = cloud_on_plane(&mut rng, Vec3::x(), 1.0);
        let mut both = a;
        both.add(&b);
        assert_eq!(both.weight, 400.0);
        assert!((both.mean() - (a.mean() + b.mean()) / 2.0).norm() < 1e-12);
    }

    #[test]
    fn no_plane_through_a_line_or_a_point() {
        let mut line = Moments::default();
        let mut point = Moments::default();
        for k in 0..10 {
            line.add_point(&Vec3::new(f64::from(k), 0.0, 0.0));
            point.add_point(&Vec3::new(1.0, 2.0, 3.0));
        }
        assert!(line.fit_plane().is_none() && point.fit_plane().is_none() && Moments::default().fit_plane().is_none());
    }
}
