use crate::geometry::Vec3;

/// Variances along the principal directions, smallest first, square metres, and the direction of the smallest.
#[derive(Debug, Clone, Copy)]
pub struct Principal {
    pub variances: [f64; 3],
    /// Unit vector of either sign.
    pub normal: Vec3,
}

/// Eigenvalues of a covariance (xx, xy, xz, yy, yz, zz) in closed form (Smith 1961), the smallest one's vector by cross products.
pub fn principal(covariance: &[f64; 6]) -> Principal {
    let [xx, xy, xz, yy, yz, zz] = *covariance;
    let third = (xx + yy + zz) / 3.0;
    let (x, y, z) = (xx - third, yy - third, zz - third);
    let spread = ((x * x + y * y + z * z + 2.0 * (xy * xy + xz * xz + yz * yz)) / 6.0).sqrt();
    if spread <= f64::MIN_POSITIVE {
        return Principal { variances: [third.max(0.0); 3], normal: Vec3::z() };
    }
    let determinant = x * (y * z - yz * yz) - xy * (xy * z - yz * xz) + xz * (xy * yz - y * xz);
    let angle = (determinant / (2.0 * spread.powi(3))).clamp(-1.0, 1.0).acos() / 3.0;
    let most = third + 2.0 * spread * angle.cos();
    let least = third + 2.0 * spread * (angle + std::f64::consts::TAU / 3.0).cos();
    let normal = null_direction(covariance, least);
    let along = Vec3::new(
        xx * normal.x + xy * normal.y + xz * normal.z,
        xy * normal.x + yy * normal.y + yz * normal.z,
        xz * normal.x + yz * normal.y + zz * normal.z,
    );
    let least = along.dot(&normal);
    Principal { variances: [least, 3.0 * third - most - least, most].map(|v| v.max(0.0)), normal }
}

/// The direction that `covariance - value` sends to nothing: across its rows.
fn null_direction(covariance: &[f64; 6], value: f64) -> Vec3 {
    let [xx, xy, xz, yy, yz, zz] = *covariance;
    let rows = [Vec3::new(xx - value, xy, xz), Vec3::new(xy, yy - value, yz), Vec3::new(xz, yz, zz - value)];
    let across = [rows[0].cross(&rows[1]), rows[1].cross(&rows[2]), rows[2].cross(&rows[0])];
    let longest =
        across.iter().copied().fold(Vec3::zeros(), |a, b| if b.norm_squared() > a.norm_squared() { b } else { a });
    longest.try_normalize(f64::MIN_POSITIVE).unwrap_or_else(Vec3::z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Moments, SplitMix64};

    #[test]
    fn agrees_with_the_iterative_solver() {
        let mut rng = SplitMix64::new(61);
        let mut cases = 0;
        for round in 0..3000 {
            let thickness = [0.3, 1e-2, 1e-4][round % 3];
            let mut signed = || rng.unit() - 0.5;
            let normal = Vec3::new(signed(), signed(), signed()).normalize();
            let mut moments = Moments::default();
            for _ in 0..50 {
                let p = Vec3::new(signed(), signed(), signed());
                moments.add_point(&(p - normal * normal.dot(&p) * (1.0 - thickness)));
            }
            let (variances, directions) = moments.principal().unwrap();
            let found = principal(&moments.covariance());
            for k in 0..3 {
                assert!((found.variances[k] - variances[k]).abs() < 1e-9 * variances[2], "{variances:?} {found:?}");
            }
            if thickness < 0.1 {
                assert!(found.normal.cross(&directions[0]).norm() < 1e-6);
            }
            cases += 1;
        }
        assert_eq!(cases, 3000);
    }

    #[test]
    fn a_point_and_a_line_give_finite_answers() {
        for covariance in [[0.0; 6], [1.0, 0.0, 0.0, 0.0, 0.0, 0.0], [1e-300; 6], [1.0, 1.0, 1.0, 1.0, 1.0, 1.0]] {
            let found = principal(&covariance);
            assert!(found.normal.iter().chain(&found.variances).all(|v| v.is_finite()));
        }
    }
}
