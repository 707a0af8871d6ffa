use super::patch::Patch;
use super::proposal::LEAST_COS;
use crate::fit::{FittedBody, Rim};
use crate::geometry::Vec3;

/// A box may lean this much off the support's vertical, rad: on a book, on a ramp. Less than the first is none.
const LEANS_RAD: [f64; 2] = [0.025, 0.26];
/// Ways up nearer than this are one, rad.
const SAME_RAD: f64 = 0.03;
const MOST: usize = 5;
/// A face that tells a way up has so many readings, and reaches so far.
const LEAST_READINGS: f64 = 300.0;
const LEAST_REACH_M: f64 = 0.06;
/// Walls are square to each other within this (cosine).
const SQUARE_COS: f64 = 0.12;

/// The ways up that boxes may have, unit vectors, the vertical first: a leaning box shows it by two of its walls, or by its base.
pub fn ways_up(patches: &[Patch]) -> Vec<Vec3> {
    let vertical = Vec3::z();
    let leans = |up: &Vec3| (LEANS_RAD[0]..=LEANS_RAD[1]).contains(&up.dot(&vertical).clamp(-1.0, 1.0).acos());
    let large: Vec<&Patch> =
        patches.iter().filter(|p| p.readings >= LEAST_READINGS && reach_m(p) >= LEAST_REACH_M).collect();
    let mut votes: Vec<(Vec3, f64)> = Vec::new();
    for (i, a) in large.iter().enumerate() {
        if leans(&a.normal) {
            votes.push((a.normal, a.readings.sqrt()));
        }
        for b in &large[i + 1..] {
            if !a.is_upright(&vertical) || !b.is_upright(&vertical) || a.normal.dot(&b.normal).abs() > SQUARE_COS {
                continue;
            }
            let up = a.normal.cross(&b.normal).normalize();
            let up = if up.z < 0.0 { -up } else { up };
            if leans(&up) {
                votes.push((up, a.readings.min(b.readings).sqrt()));
            }
        }
    }
    let mut out = vec![vertical];
    while out.len() <= MOST {
        let near = |a: &Vec3, b: &Vec3| a.cross(b).norm() < SAME_RAD;
        let weight = |up: &Vec3| votes.iter().filter(|v| near(&v.0, up)).map(|v| v.1).sum::<f64>();
        let best =
            votes.iter().map(|v| (weight(&v.0), v.0)).fold((0.0, vertical), |a, b| if b.0 > a.0 { b } else { a });
        if best.0 <= 0.0 {
            break;
        }
        let sum: Vec3 = votes.iter().filter(|v| near(&v.0, &best.1)).map(|v| v.0 * v.1).sum();
        votes.retain(|v| !near(&v.0, &best.1));
        out.push(sum.normalize());
    }
    out
}

/// What lies lower than this is no box on its side, metres.
const LEAST_TOP_M: f64 = 0.08;
/// So much of its opening's direction at least is towards the camera (cosine, level).
const LEAST_TOWARDS: f64 = -0.1;

/// The directions (level) of boxes that lie on a side and open towards the camera, as their frames: the vertical, square to it, and
/// that out of the opening. The side above shows itself to every camera that looks down on it: none without.
pub fn lying_frames(patches: &[Patch], yaws: &[f64], eye: &Vec3) -> Vec<[Vec3; 3]> {
    let is_top =
        |p: &Patch| p.readings >= LEAST_READINGS && p.normal.z > LEAST_COS && p.span(&Vec3::z())[1] > LEAST_TOP_M;
    let Some(top) = patches.iter().filter(|p| is_top(p)).max_by(|a, b| a.readings.total_cmp(&b.readings)) else {
        return Vec::new();
    };
    let to_eye = Vec3::new(eye.x - top.hull[0].x, eye.y - top.hull[0].y, 0.0);
    let towards = to_eye.try_normalize(1e-3).unwrap_or_else(Vec3::zeros);
    let quarters = yaws.iter().flat_map(|yaw| (0..4).map(move |i| yaw + f64::from(i) * std::f64::consts::FRAC_PI_2));
    let ways = quarters.map(|yaw| Vec3::new(yaw.cos(), yaw.sin(), 0.0));
    ways.filter(|way| way.dot(&towards) > LEAST_TOWARDS).map(|up| [Vec3::z(), up.cross(&Vec3::z()), up]).collect()
}

/// Whether a body lies on one of its sides.
pub fn lies(body: &FittedBody) -> bool {
    is_lying(&(body.input_from_object.rotation * Vec3::z()))
}

/// Whether what has this way up lies on a side.
pub fn is_lying(up: &Vec3) -> bool {
    up.z < LIES_COS
}

/// What leans further lies.
const LIES_COS: f64 = 0.7;

/// The side on which a body lies: the one whose outer face looks down most.
pub fn lower_side(body: &FittedBody) -> usize {
    let outward_z = |k: usize| -(body.input_from_object.rotation * Rim::new(body, k).directions().1).z;
    (1..4).fold(0, |best, k| if outward_z(k) < outward_z(best) { k } else { best })
}

fn reach_m(patch: &Patch) -> f64 {
    let far = |from: &Vec3| patch.hull.iter().map(|corner| (corner - from).norm()).fold(0.0, f64::max);
    patch.hull.first().map_or(0.0, far)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The side above of a box that lies, that high.
    fn top(height_m: f64) -> Patch {
        let corner = |x: f64, y: f64| Vec3::new(x, y, height_m);
        let hull = vec![corner(0.8, -0.2), corner(1.2, -0.2), corner(1.2, 0.2), corner(0.8, 0.2)];
        Patch { normal: Vec3::z(), distance_m: height_m, hull, readings: 2000.0 }
    }

    #[test]
    fn boxes_on_their_side_open_towards_the_camera_below_a_level_top() {
        let eye = Vec3::new(0.0, 0.0, 1.0);
        let frames = lying_frames(&[top(0.3)], &[0.1], &eye);
        assert!(!frames.is_empty() && frames.len() <= 3);
        for [x, y, up] in &frames {
            assert_eq!(*x, Vec3::z());
            assert!(up.x < 0.11 && up.z == 0.0);
            assert!((x.cross(y) - up).norm() < 1e-12);
        }
        assert!(lying_frames(&[top(0.05)], &[0.1], &eye).is_empty());
        assert!(lying_frames(&[Patch { normal: Vec3::x(), ..top(0.3) }], &[0.1], &eye).is_empty());
    }
}
