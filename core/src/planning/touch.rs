//! Where a finger that is moved along the push direction first touches a flap's outer face, edges included.

use nalgebra::Matrix3;

use super::flap::FlapFrame;
use crate::geometry::Vec3;

/// The closed fingers as one block in the tool's frame: `half_m` to either side in x and y, from the tool point back by
/// `length_m` along -z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Finger {
    pub half_m: [f64; 2],
    pub length_m: f64,
}

/// The same, turned before a flap.
#[derive(Debug, Clone, Copy)]
pub struct TurnedFinger {
    finger: Finger,
    pub flap_from_tool: Matrix3<f64>,
    /// Relative to the tool point, in the flap's frame.
    corners: [Vec3; 8],
    /// The corner that reaches furthest in the push direction.
    furthest: Vec3,
    /// The corners' least and greatest along the hinge and away from it.
    least: [f64; 2],
    most: [f64; 2],
}

/// A first touch.
#[derive(Debug, Clone, Copy)]
pub struct Touch {
    /// The tool point's height over the flap's mid-board along `outward` (negative where it is beyond the board).
    pub tool_outward_m: f64,
    /// The point of touch on the outer face: along the hinge, away from it.
    pub contact: [f64; 2],
    /// Out of the board, square to what touches: the unit vector, in the flap's frame, against which the finger presses.
    pub normal: Vec3,
}

impl Finger {
    /// The eight corners relative to the tool point, tool axes as the columns of `rotation` told in the flap's frame.
    fn corners(&self, rotation: &Matrix3<f64>) -> [Vec3; 8] {
        std::array::from_fn(|k| {
            let x = if k & 1 == 0 { -self.half_m[0] } else { self.half_m[0] };
            let y = if k & 2 == 0 { -self.half_m[1] } else { self.half_m[1] };
            let z = if k & 4 == 0 { 0.0 } else { -self.length_m };
            rotation * Vec3::new(x, y, z)
        })
    }
}

impl TurnedFinger {
    pub fn new(finger: Finger, flap_from_tool: Matrix3<f64>) -> Self {
        let corners = finger.corners(&flap_from_tool);
        let furthest =
            corners[1..].iter().fold(corners[0], |best, corner| if corner.z < best.z { *corner } else { best });
        let extreme = |pick: fn(f64, f64) -> f64| {
            [0, 1].map(|axis| corners[1..].iter().map(|corner| corner[axis]).fold(corners[0][axis], pick))
        };
        let (least, most) = (extreme(f64::min), extreme(f64::max));
        Self { finger, flap_from_tool, corners, furthest, least, most }
    }

    /// The touch of the finger when its tool point is `at` (along, away) in the flap's plane.
    /// None where it passes the flap by.
    ///
    /// Eq. 84. What reaches furthest in the push direction of the finger inside the prism over the flap is a linear program in three
    /// variables: it lies at a corner of the finger, where one of its edges passes an edge of the flap, or over a corner of the flap.
    pub fn touch(&self, outline: &[[f64; 2]; 4], half_board_m: f64, at: [f64; 2]) -> Option<Touch> {
        let corners = &self.corners;
        let place = |p: &Vec3| [at[0] + p.x, at[1] + p.y];
        // Mostly the corner that reaches furthest is over the flap: nothing reaches further.
        if contains(outline, place(&self.furthest)) {
            let (tool_outward_m, contact) = (half_board_m - self.furthest.z, place(&self.furthest));
            return Some(Touch { tool_outward_m, contact, normal: Vec3::z() });
        }
        if self.is_beside(outline, at) {
            return None;
        }
        let mut lowest: Option<Low> = None;
        for corner in corners {
            if contains(outline, place(corner)) {
                keep_lowest(&mut lowest, (corner.z, place(corner), Vec3::z()));
            }
        }
        for a in 0..8usize {
            for bit in [1, 2, 4] {
                // What lies wholly above what was found reaches no further.
                if a & bit == 0 && lowest.is_none_or(|(best, ..)| corners[a].z.min(corners[a | bit].z) < best) {
                    cross_edges(outline, &corners[a], &corners[a | bit], at, &mut lowest);
                }
            }
        }
        for corner in outline {
            let offset = [corner[0] - at[0], corner[1] - at[1]];
            if let Some((w, square)) = self.lowest_over(offset) {
                keep_lowest(&mut lowest, (w, *corner, square));
            }
        }
        lowest.map(|(w, contact, square)| {
            let normal = square.try_normalize(0.0).unwrap_or(Vec3::z());
            let normal = if normal.z < 0.0 { -normal } else { normal };
            Touch { tool_outward_m: half_board_m - w, contact, normal }
        })
    }

    /// Is all of the finger to one side of the outline?
    fn is_beside(&self, outline: &[[f64; 2]; 4], at: [f64; 2]) -> bool {
        (0..2).any(|axis| {
            let (low, high) = (at[axis] + self.least[axis], at[axis] + self.most[axis]);
            outline.iter().all(|corner| corner[axis] < low) || outline.iter().all(|corner| corner[axis] > high)
        })
    }

    /// The lowest point of the finger on the line along `outward` through `offset` from the tool point, and what is square to the
    /// finger's face there.
    fn lowest_over(&self, offset: [f64; 2]) -> Option<(f64, Vec3)> {
        let (finger, flap_from_tool) = (&self.finger, &self.flap_from_tool);
        let start = flap_from_tool.tr_mul(&Vec3::new(offset[0], offset[1], 0.0));
        let direction = flap_from_tool.tr_mul(&Vec3::z());
        let low = [-finger.half_m[0], -finger.half_m[1], -finger.length_m];
        let high = [finger.half_m[0], finger.half_m[1], 0.0];
        let (mut enter, mut leave, mut face) = (f64::NEG_INFINITY, f64::INFINITY, 2);
        for k in 0..3 {
            if direction[k].abs() < 1e-12 {
                if start[k] < low[k] || start[k] > high[k] {
                    return None;
                }
                continue;
            }
            let (p, q) = ((low[k] - start[k]) / direction[k], (high[k] - start[k]) / direction[k]);
            if p.min(q) > enter {
                (enter, face) = (p.min(q), k);
            }
            leave = leave.min(p.max(q));
        }
        (enter <= leave).then(|| (enter, flap_from_tool.column(face).into_owned()))
    }
}

/// How low the finger reaches, where over the flap, and what is square to it there.
type Low = (f64, [f64; 2], Vec3);

fn keep_lowest(lowest: &mut Option<Low>, found: Low) {
    if lowest.is_none_or(|(best, ..)| found.0 < best) {
        *lowest = Some(found);
    }
}

/// Where the finger's edge from p to q passes over an edge of the flap.
fn cross_edges(outline: &[[f64; 2]; 4], p: &Vec3, q: &Vec3, at: [f64; 2], lowest: &mut Option<Low>) {
    let (px, py) = (at[0] + p.x, at[1] + p.y);
    let (dx, dy) = (q.x - p.x, q.y - p.y);
    for k in 0..4 {
        let (a, b) = (outline[k], outline[(k + 1) % 4]);
        let (ex, ey) = (b[0] - a[0], b[1] - a[1]);
        let cross = dx * ey - dy * ex;
        if cross.abs() < 1e-15 {
            continue;
        }
        let s = ((a[0] - px) * ey - (a[1] - py) * ex) / cross;
        let t = ((a[0] - px) * dy - (a[1] - py) * dx) / cross;
        if (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t) {
            let square = (q - p).cross(&Vec3::new(ex, ey, 0.0));
            keep_lowest(lowest, (p.z + s * (q.z - p.z), [a[0] + t * ex, a[1] + t * ey], square));
        }
    }
}

/// Is a point inside a convex outline that goes round counter-clockwise?
fn contains(outline: &[[f64; 2]; 4], p: [f64; 2]) -> bool {
    (0..4).all(|k| {
        let (a, b) = (outline[k], outline[(k + 1) % 4]);
        (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) >= 0.0
    })
}

/// A tool's rotation told in a flap's frame.
pub fn flap_from_tool(frame: &FlapFrame, base_from_tool: &Matrix3<f64>) -> Matrix3<f64> {
    Matrix3::from_columns(&[frame.along, frame.away, frame.outward]).tr_mul(base_from_tool)
}

#[cfg(test)]
mod tests {
    use nalgebra::Rotation3;

    use super::*;
    use crate::geometry::SplitMix64;

    const FINGER: Finger = Finger { half_m: [0.01, 0.01], length_m: 0.08 };
    const OUTLINE: [[f64; 2]; 4] = [[0.0, 0.0], [0.2, 0.0], [0.18, 0.1], [0.03, 0.1]];

    /// The lowest point over the outline of a finger filled with points.
    fn lowest_of_points(at: [f64; 2], rotation: &Matrix3<f64>) -> Option<f64> {
        let steps = 40;
        let share = |k: usize| k as f64 / steps as f64;
        let mut lowest: Option<f64> = None;
        for i in 0..=steps {
            for j in 0..=steps {
                for k in 0..=2 * steps {
                    let p = rotation
                        * Vec3::new(
                            0.02 * share(i) - 0.01,
                            0.02 * share(j) - 0.01,
                            -0.08 * k as f64 / (2 * steps) as f64,
                        );
                    if contains(&OUTLINE, [at[0] + p.x, at[1] + p.y]) {
                        lowest = Some(lowest.map_or(p.z, |w: f64| w.min(p.z)));
                    }
                }
            }
        }
        lowest
    }

    #[test]
    fn touches_where_a_finger_filled_with_points_does() {
        let mut rng = SplitMix64::new(84);
        let mut touched = 0;
        for _ in 0..60 {
            let axis = Vec3::new(rng.unit() - 0.5, rng.unit() - 0.5, rng.unit() - 0.5);
            let rotation = *Rotation3::new(axis.normalize() * (6.0 * rng.unit())).matrix();
            let at = [0.24 * rng.unit() - 0.02, 0.14 * rng.unit() - 0.02];
            let Some(touch) = TurnedFinger::new(FINGER, rotation).touch(&OUTLINE, 0.002, at) else {
                assert!(lowest_of_points(at, &rotation).is_none());
                continue;
            };
            let Some(lowest) = lowest_of_points(at, &rotation) else { continue };
            let exact = 0.002 - touch.tool_outward_m;
            // Points lie at most 2 mm from one another: the exact optimum is no higher, and lower by little.
            assert!(exact <= lowest + 1e-12 && lowest - exact < 0.0035, "{exact} {lowest}");
            touched += 1;
        }
        assert!(touched > 40, "{touched}");
    }

    /// A finger that keeps touching while it is moved aside moves square to the normal, wherever it touches.
    #[test]
    fn the_normal_is_square_to_what_the_touch_lets_move() {
        const ASIDE_M: f64 = 1e-7;
        let mut rng = SplitMix64::new(85);
        let mut slanting = 0;
        for _ in 0..400 {
            let axis = Vec3::new(rng.unit() - 0.5, rng.unit() - 0.5, rng.unit() - 0.5);
            let finger = TurnedFinger::new(FINGER, *Rotation3::new(axis.normalize() * (6.0 * rng.unit())).matrix());
            let at = [0.24 * rng.unit() - 0.02, 0.14 * rng.unit() - 0.02];
            let touch = |x: f64, y: f64| finger.touch(&OUTLINE, 0.002, [at[0] + x, at[1] + y]);
            let Some((here, along, away)) =
                touch(0.0, 0.0).and_then(|here| Some((here, touch(ASIDE_M, 0.0)?, touch(0.0, ASIDE_M)?)))
            else {
                continue;
            };
            assert!((here.normal.norm() - 1.0).abs() < 1e-12 && here.normal.z > 0.0);
            let is_one_touch = (here.normal - along.normal).norm() + (here.normal - away.normal).norm() < 1e-9;
            for (moved, aside) in [(along, Vec3::x()), (away, Vec3::y())].iter().filter(|_| is_one_touch) {
                let way = aside * ASIDE_M + Vec3::z() * (moved.tool_outward_m - here.tool_outward_m);
                assert!(way.dot(&here.normal).abs() < 1e-5 * way.norm(), "{:?} {way:?}", here.normal);
                slanting += usize::from(here.normal.z < 0.9);
            }
        }
        assert!(slanting > 60, "{slanting}");
    }

    #[test]
    fn a_finger_square_on_the_face_stands_on_its_tip() {
        let down = *Rotation3::from_axis_angle(&Vec3::x_axis(), std::f64::consts::PI).matrix();
        let touch = TurnedFinger::new(FINGER, down).touch(&OUTLINE, 0.002, [0.1, 0.05]).unwrap();
        assert!((touch.tool_outward_m - 0.002).abs() < 1e-12);
        assert!((touch.normal - Vec3::z()).norm() < 1e-12);
    }
}
