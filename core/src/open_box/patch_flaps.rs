//! Flaps whose hinge is hidden, known by a segment whose plane meets the edge that they hang on.

use super::flap_scan::{follow_best, ScannedFlap};
use super::hanging::{hidden_range, is_flap};
use super::hinge_line::HingeLine;
use super::patch::Patch;
use super::sight::Sight;
use crate::fit::FittedBody;
use crate::geometry::Vec3;

/// The plane of a flap's segment turns off that through the edge and the segment's middle by less (sine): few readings tell it badly.
const MOST_TURN: f64 = 0.35;
/// Segments are asked whose middle lies further from the edge than what a scan near the hinge sees.
const LEAST_REACH_M: f64 = 0.02;
/// A flap's segment reaches no further beyond the ends of the edge.
const BEYOND_END_M: f64 = 0.03;

/// The flaps on those edges that are asked for that segments tell.
pub fn flaps_of_patches(
    sight: &Sight,
    patches: &[Patch],
    body: &FittedBody,
    model_m: f64,
    is_asked: [bool; 4],
) -> [Option<ScannedFlap>; 4] {
    std::array::from_fn(|k| {
        if !is_asked[k] {
            return None;
        }
        let (hinge, range) = (HingeLine::of_side(body, k), hidden_range(body, k, model_m));
        let angles = patches.iter().filter_map(|patch| angle(patch, &hinge, range.angles_rad, range.longest_m));
        follow_best(sight, &hinge, angles, &range).filter(is_flap)
    })
}

/// At which a flap leaves the edge to hold the patch; `None` where none could.
fn angle(patch: &Patch, hinge: &HingeLine, [least, most]: [f64; 2], longest_m: f64) -> Option<f64> {
    let from_hinge = || patch.hull.iter().map(|corner| corner - hinge.middle);
    let middle = from_hinge().sum::<Vec3>() / patch.hull.len() as f64;
    let (closed, up) = (hinge.closed.dot(&middle), hinge.up.dot(&middle));
    let reach_m = closed.hypot(up);
    let way = (hinge.closed * closed + hinge.up * up) / reach_m;
    let turn = patch.normal.dot(&hinge.along).hypot(patch.normal.dot(&way));
    let most_along = |way: &Vec3| from_hinge().map(|corner| corner.dot(way)).fold(f64::MIN, f64::max);
    let beyond_m = most_along(&hinge.along).max(most_along(&-hinge.along)) - hinge.half_m;
    if turn > MOST_TURN || reach_m < LEAST_REACH_M || beyond_m > BEYOND_END_M || most_along(&way) > longest_m {
        return None;
    }
    let angle = up.atan2(closed);
    let angle = if angle < least { angle + std::f64::consts::TAU } else { angle };
    (angle <= most).then_some(angle)
}

#[cfg(test)]
mod tests {
    use nalgebra::Isometry3;

    use super::*;
    use crate::fit::{layout, Parameters, Rim};

    const ANGLES_RAD: [f64; 2] = [-0.25, 4.3];

    fn body() -> FittedBody {
        let mut numbers = Parameters::zeros();
        let lengths = [(layout::LENGTH, 0.4), (layout::WIDTH, 0.3), (layout::HEIGHT, 0.2)];
        lengths.iter().for_each(|&(place, length_m)| numbers[place] = length_m);
        FittedBody { input_from_object: Isometry3::new(Vec3::new(0.1, 0.2, 0.0), Vec3::z() * 0.4), numbers }
    }

    /// Of a flap on side `k`: what is seen of it lies between two ways from its hinge, its plane turned by so much about the edge.
    fn patch(k: usize, angle_rad: f64, [near_m, far_m]: [f64; 2], turn_rad: f64) -> Patch {
        let (body, rim) = (body(), Rim::new(&body(), k));
        let (sin, cos) = angle_rad.sin_cos();
        let corner = |along: f64, away: f64| body.to_input(&rim.place(along, away * cos, away * sin));
        let hull = vec![corner(0.0, near_m), corner(0.1, near_m), corner(0.1, far_m), corner(0.0, far_m)];
        let hinge = HingeLine::of_side(&body, k);
        let (_, normal) = hinge.directions(angle_rad + turn_rad);
        Patch { normal, distance_m: normal.dot(&hull[0]), hull, readings: 600.0 }
    }

    #[test]
    fn a_segment_far_from_the_edge_tells_the_angle() {
        let mut cases = 0;
        for k in 0..4 {
            for angle_rad in [0.0, 0.5, 1.3, 2.4, 3.5, 4.2] {
                for turn_rad in [-0.2, 0.0, 0.2] {
                    let hinge = HingeLine::of_side(&body(), k);
                    let told = angle(&patch(k, angle_rad, [0.08, 0.12], turn_rad), &hinge, ANGLES_RAD, 0.2);
                    assert!((told.unwrap() - angle_rad).abs() < 1e-9, "{k} {angle_rad} {turn_rad}: {told:?}");
                    cases += 1;
                }
            }
        }
        assert_eq!(cases, 72);
    }

    #[test]
    fn what_no_flap_could_hold_tells_none() {
        let hinge = HingeLine::of_side(&body(), 1);
        let told = |patch: &Patch| angle(patch, &hinge, ANGLES_RAD, 0.2);
        assert!(told(&patch(1, 1.3, [0.08, 0.12], 0.0)).is_some());
        let refused = [
            ("its plane runs past the edge", patch(1, 1.3, [0.08, 0.12], 0.5)),
            ("it reaches too far", patch(1, 1.3, [0.15, 0.25], 0.0)),
            ("it lies on the side", patch(1, -1.5, [0.08, 0.12], 0.0)),
            ("it lies at the edge", patch(1, 1.3, [0.0, 0.03], 0.0)),
            ("it is another side's", patch(2, 1.3, [0.08, 0.12], 0.0)),
        ];
        for (why, patch) in refused {
            assert_eq!(told(&patch), None, "{why}");
        }
    }
}
