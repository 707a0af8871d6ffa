/// A plane as the camera sees it: along the ray `(u, v, 1)` the inverse depth is `q = a u + b v + c` (eq. 52).
///
/// A disparity sensor's noise is nearly constant in q, so that least squares in q weighs near and far readings rightly.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RayPlane {
    pub a: f64,
    pub b: f64,
    pub c: f64,
}

impl RayPlane {
    pub fn inverse_depth(&self, u: f64, v: f64) -> f64 {
        self.a * u + self.b * v + self.c
    }
}

/// Rays that vary less span no area: a thousandth of the step between a camera's pixels, squared.
const LEAST_VARIANCE: f64 = 1e-12;
/// Nor do rays along a line: one minus their squared correlation.
const LEAST_INDEPENDENCE: f64 = 1e-4;

/// Sums over readings at rays `(u, v, 1)` with inverse depths q: enough for a least-squares plane, and sets add.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RayMoments {
    pub n: f64,
    pub u: f64,
    pub v: f64,
    pub q: f64,
    pub uu: f64,
    pub uv: f64,
    pub vv: f64,
    pub uq: f64,
    pub vq: f64,
    pub qq: f64,
}

impl RayMoments {
    pub fn add_reading(&mut self, u: f64, v: f64, q: f64) {
        self.n += 1.0;
        self.u += u;
        self.v += v;
        self.q += q;
        self.uu += u * u;
        self.uv += u * v;
        self.vv += v * v;
        self.uq += u * q;
        self.vq += v * q;
        self.qq += q * q;
    }

    pub fn add(&mut self, other: &Self) {
        self.add_scaled(other, 1.0);
    }

    /// Takes away a set that was added before.
    pub fn remove(&mut self, other: &Self) {
        self.add_scaled(other, -1.0);
    }

    fn add_scaled(&mut self, other: &Self, sign: f64) {
        self.n += sign * other.n;
        self.u += sign * other.u;
        self.v += sign * other.v;
        self.q += sign * other.q;
        self.uu += sign * other.uu;
        self.uv += sign * other.uv;
        self.vv += sign * other.vv;
        self.uq += sign * other.uq;
        self.vq += sign * other.vq;
        self.qq += sign * other.qq;
    }

    /// Least-squares plane and its sum of squared residuals; `None` where the rays span no area.
    pub fn fit(&self) -> Option<(RayPlane, f64)> {
        if self.n < 3.0 {
            return None;
        }
        let (mu, mv, mq) = (self.u / self.n, self.v / self.n, self.q / self.n);
        let (uu, uv, vv) = (self.uu - mu * self.u, self.uv - mu * self.v, self.vv - mv * self.v);
        let (uq, vq, qq) = (self.uq - mu * self.q, self.vq - mv * self.q, self.qq - mq * self.q);
        let det = uu * vv - uv * uv;
        let flat = uu.min(vv) <= LEAST_VARIANCE * self.n || det <= LEAST_INDEPENDENCE * uu * vv;
        if flat || det.is_nan() {
            return None;
        }
        let (a, b) = ((uq * vv - vq * uv) / det, (vq * uu - uq * uv) / det);
        let plane = RayPlane { a, b, c: mq - a * mu - b * mv };
        Some((plane, (qq - a * uq - b * vq).max(0.0)))
    }

    /// Sum of squared residuals about a plane.
    pub fn squares_about(&self, p: &RayPlane) -> f64 {
        let linear = p.a * self.uq + p.b * self.vq + p.c * self.q;
        let square = p.a * p.a * self.uu
            + p.b * p.b * self.vv
            + p.c * p.c * self.n
            + 2.0 * (p.a * p.b * self.uv + p.a * p.c * self.u + p.b * p.c * self.v);
        (self.qq - 2.0 * linear + square).max(0.0)
    }

    /// Mean residual about a plane; positive where the readings lie nearer.
    pub fn mean_about(&self, p: &RayPlane) -> f64 {
        (self.q - p.a * self.u - p.b * self.v - p.c * self.n) / self.n
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::SplitMix64;

    #[test]
    fn recovers_exact_planes_and_sets_add() {
        let mut rng = SplitMix64::new(8);
        let mut cases = 0;
        for _ in 0..300 {
            let mut value = |scale: f64| scale * (rng.unit() - 0.5);
            let plane = RayPlane { a: value(4.0), b: value(4.0), c: 1.0 + value(1.0) };
            let (mut one, mut other) = (RayMoments::default(), RayMoments::default());
            for k in 0..60 {
                let (u, v) = (value(1.2), value(1.0));
                let half = if k % 2 == 0 { &mut one } else { &mut other };
                half.add_reading(u, v, plane.inverse_depth(u, v));
            }
            one.add(&other);
            let (found, squares) = one.fit().unwrap();
            assert!((found.a - plane.a).abs() + (found.b - plane.b).abs() + (found.c - plane.c).abs() < 1e-9);
            assert!(squares < 1e-12 && one.squares_about(&plane) < 1e-10 && one.mean_about(&plane).abs() < 1e-9);
            cases += 1;
        }
        assert_eq!(cases, 300);
    }

    #[test]
    fn rays_in_a_line_have_no_plane() {
        let mut line = RayMoments::default();
        (0..20).for_each(|k| line.add_reading(f64::from(k) * 0.01, 0.2, 1.0));
        assert!(line.fit().is_none());
    }
}
