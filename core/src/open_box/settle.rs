//! No box reaches into what it stands on.

use nalgebra::{Translation3, UnitQuaternion};

use super::upright::{lies, lower_side};
use crate::fit::{layout, FittedBody};
use crate::geometry::Vec3;

/// Deeper than the noise, metres.
const SUNK_M: f64 = 0.006;
/// A box that leans more does not stand on the support with its whole base (cosine).
pub const LEVEL_COS: f64 = 0.9994;

/// The body with its walls cut off at the support, where they reach into it; its rim stays. Level frame.
pub fn settled(body: &FittedBody) -> FittedBody {
    let depth = -lowest_m(body);
    if depth < SUNK_M {
        return body.clone();
    }
    let mut out = body.clone();
    let up = body.input_from_object.rotation * Vec3::z();
    if up.z > LEVEL_COS {
        let rim = body.to_input(&(Vec3::z() * body.get(layout::HEIGHT)));
        let turn = UnitQuaternion::rotation_between(&up, &Vec3::z()).unwrap_or_default();
        out.input_from_object.rotation = turn * body.input_from_object.rotation;
        out.input_from_object.translation = Translation3::new(rim.x, rim.y, 0.0);
        out.numbers[layout::HEIGHT] = rim.z;
    } else if lies(body) {
        // Its upper side stays.
        let upright = [layout::WIDTH, layout::LENGTH, layout::WIDTH, layout::LENGTH][lower_side(body)];
        out.input_from_object.translation.vector.z += depth / 2.0;
        out.numbers[upright] -= depth;
    } else {
        let cut = depth / up.z;
        out.input_from_object.translation.vector += up * cut;
        out.numbers[layout::HEIGHT] -= cut;
    }
    out
}

/// Whether a body still reaches into the support: it is no box.
pub fn is_sunk(body: &FittedBody) -> bool {
    -lowest_m(body) > 2.0 * SUNK_M
}

/// Height of its lowest corner over the support.
pub fn lowest_m(body: &FittedBody) -> f64 {
    let (l, w) = (body.get(layout::LENGTH) / 2.0, body.get(layout::WIDTH) / 2.0);
    let corners = [[-l, -w], [l, -w], [l, w], [-l, w]];
    // What lies does so on a side's outer face, rim and foot.
    let (top, half_board) = if lies(body) { (body.get(layout::HEIGHT), body.board_m() / 2.0) } else { (0.0, 0.0) };
    let height = |z: f64| move |[x, y]: &[f64; 2]| body.to_input(&Vec3::new(*x, *y, z)).z;
    corners.iter().map(height(0.0)).chain(corners.iter().map(height(top))).fold(f64::INFINITY, f64::min) - half_board
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::Parameters;
    use nalgebra::Isometry3;

    fn body(z_m: f64, lean_rad: f64) -> FittedBody {
        let mut numbers = Parameters::zeros();
        (numbers[layout::LENGTH], numbers[layout::WIDTH], numbers[layout::HEIGHT]) = (0.4, 0.3, 0.2);
        let input_from_object = Isometry3::new(Vec3::new(0.1, 0.2, z_m), Vec3::x() * lean_rad);
        FittedBody { input_from_object, numbers }
    }

    fn rim(body: &FittedBody) -> Vec3 {
        body.to_input(&(Vec3::z() * body.get(layout::HEIGHT)))
    }

    #[test]
    fn what_stands_stays() {
        for (z_m, lean_rad) in [(0.0, 0.0), (0.05, 0.0), (0.03, 0.15), (-0.004, 0.0)] {
            let given = body(z_m, lean_rad);
            assert_eq!(settled(&given), given);
        }
    }

    /// A box of 0.4 x 0.3 x 0.2 m on side 0, 1, 2 or 3, whose outer face is this high.
    fn lying(side: usize, z_m: f64) -> FittedBody {
        let mut given = body(0.0, 0.0);
        given.numbers[layout::THICKNESS] = 0.004;
        let turn = [Vec3::x(), Vec3::y(), -Vec3::x(), -Vec3::y()][side] * std::f64::consts::FRAC_PI_2;
        let across = if side == 0 || side == 2 { 0.3 } else { 0.4 };
        given.input_from_object = Isometry3::new(Vec3::new(0.1, 0.2, z_m + across / 2.0 + 0.002), turn);
        given
    }

    #[test]
    fn what_lies_is_told_from_what_stands_and_loses_what_sinks_of_its_lower_side() {
        let mut cases = 0;
        for side in 0..4 {
            for z_m in [0.03, 0.0, -0.004, -0.05] {
                let given = lying(side, z_m);
                assert!(lies(&given) && !lies(&body(0.0, 0.26)));
                assert_eq!(lower_side(&given), side);
                assert!((lowest_m(&given) - z_m).abs() < 1e-12, "{side} {z_m}: {}", lowest_m(&given));
                let out = settled(&given);
                if z_m < -SUNK_M {
                    let upright = [layout::WIDTH, layout::LENGTH][side % 2];
                    let top = |body: &FittedBody| body.input_from_object.translation.z + body.get(upright) / 2.0;
                    assert!(lowest_m(&out).abs() < 1e-12);
                    assert!((top(&out) - top(&given)).abs() < 1e-12);
                } else {
                    assert_eq!(out, given);
                }
                cases += 1;
            }
        }
        assert_eq!(cases, 16);
    }

    #[test]
    fn what_sinks_is_cut_off_and_its_rim_stays() {
        for (z_m, lean_rad) in [(-0.05, 0.0), (-0.03, 0.02), (0.0, 0.1), (-0.02, 0.2)] {
            let given = body(z_m, lean_rad);
            let out = settled(&given);
            assert!(lowest_m(&out).abs() < 1e-12, "{z_m} {lean_rad}: {}", lowest_m(&out));
            assert!((rim(&out) - rim(&given)).norm() < 1e-12);
            assert!(out.get(layout::HEIGHT) < given.get(layout::HEIGHT));
            assert!(is_sunk(&given) && !is_sunk(&out));
        }
    }
}
