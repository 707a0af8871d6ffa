//! Boxes that a lid proposes: flat boxes show little of their walls, and much of the one flap that is as long as they are wide.

use super::patch::Patch;
use super::proposal::{Proposal, HEIGHTS_M, LEAST_COS, MOST_READINGS, SIZES_M};
use crate::geometry::Vec3;

/// A lid has so many readings, and is so long.
const LEAST_READINGS: f64 = 1200.0;
const LENGTHS_M: [f64; 2] = [0.12, 0.7];
/// The box's way away from the hinge, in lengths of its lid.
const DEPTHS: [f64; 4] = [0.92, 0.97, 1.02, 1.08];
/// Below this rise of its plane a lid stands on its edge.
const LEAST_RISE: f64 = 0.2;
/// What lies over the opening hangs higher than its hinge by this.
const OVER_M: f64 = 0.01;

/// All that patches propose as lids of boxes that stand level in this direction.
pub fn of_lids(patches: &[Patch], frame: &[Vec3; 3], yaw: f64) -> Vec<Proposal> {
    let (sin, cos) = yaw.sin_cos();
    let [x, y, up] = *frame;
    let axes = [x * cos + y * sin, y * cos - x * sin];
    let large = patches.iter().filter(|patch| patch.readings >= LEAST_READINGS);
    large.flat_map(|patch| [0, 1].into_iter().flat_map(move |a| of_lid(patch, &axes, a, &up))).collect()
}

fn of_lid(patch: &Patch, axes: &[Vec3; 2], a: usize, up: &Vec3) -> Vec<Proposal> {
    let (axis, across) = (&axes[a], &axes[1 - a]);
    let runs_across = patch.level_direction(up).is_none_or(|along| along.dot(across).abs() > LEAST_COS);
    let ([near, far], [from, to], [low, high]) = (patch.span(axis), patch.span(across), patch.span(up));
    let length_m = (far - near).hypot(high - low);
    if !runs_across || !within(to - from, SIZES_M) || !within(length_m, LENGTHS_M) {
        return Vec::new();
    }
    let hinges = hinges(patch, axis, up, [near, far], low);
    let on_hinge = |(at_m, rim_m, way): (f64, f64, f64)| {
        DEPTHS.map(move |depth| {
            let end_m = at_m + way * depth * length_m;
            let mut spans = [[from, to]; 2];
            spans[a] = [at_m.min(end_m), at_m.max(end_m)];
            let on_flaps = patch.readings.min(MOST_READINGS);
            Proposal { axes: *axes, up: *up, spans, heights: [0.0, rim_m], on_flaps }
        })
    };
    let is_rim = |hinge: &(f64, f64, f64)| within(hinge.1, HEIGHTS_M);
    hinges.into_iter().filter(is_rim).flat_map(on_hinge).collect()
}

fn within(x: f64, [least, most]: [f64; 2]) -> bool {
    (least..=most).contains(&x)
}

/// Where the lid may hang: along the axis, how high, and which way the box goes from there.
fn hinges(patch: &Patch, axis: &Vec3, up: &Vec3, ends: [f64; 2], low: f64) -> Vec<(f64, f64, f64)> {
    let rise = patch.normal.dot(up);
    if rise.abs() < LEAST_RISE {
        let at_m = (ends[0] + ends[1]) / 2.0;
        return vec![(at_m, low, -1.0), (at_m, low, 1.0)];
    }
    let middle = patch.hull.iter().sum::<Vec3>() / patch.hull.len().max(1) as f64;
    let height = |at_m: f64| middle.dot(up) - patch.normal.dot(axis) / rise * (at_m - middle.dot(axis));
    let [near, far] = ends;
    let mut out = vec![(near, height(near), -1.0), (far, height(far), 1.0)];
    // Half closed it hangs over the box.
    if height(far) > height(near) + OVER_M {
        out.push((near, height(near), 1.0));
    }
    if height(near) > height(far) + OVER_M {
        out.push((far, height(far), -1.0));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sheet that leaves a hinge along y at x = 0, z = 0.05 under an angle from the level.
    fn lid(angle_rad: f64) -> Patch {
        let way = Vec3::new(angle_rad.cos(), 0.0, angle_rad.sin());
        let corner = |along: f64, away: f64| Vec3::new(0.0, along, 0.05) + way * away;
        let normal = Vec3::new(-angle_rad.sin(), 0.0, angle_rad.cos());
        let hull = vec![corner(-0.15, 0.0), corner(0.15, 0.0), corner(0.15, 0.3), corner(-0.15, 0.3)];
        Patch { normal, distance_m: normal.z * 0.05, hull, readings: 9000.0 }
    }

    fn proposed(patch: Patch) -> Vec<Proposal> {
        of_lids(&[patch], &[Vec3::x(), Vec3::y(), Vec3::z()], 0.0)
    }

    #[test]
    fn a_lid_hangs_on_one_of_its_edges() {
        for angle_deg in [20.0_f64, 60.0, 90.0, 120.0, 150.0] {
            let all = proposed(lid(angle_deg.to_radians()));
            let is_box = |p: &&Proposal| {
                let [x, y] = p.spans;
                let ends = if angle_deg <= 90.0 { x[0].abs() } else { x[0].abs().min(x[1].abs()) };
                ends < 1e-9
                    && (y[1] - y[0] - 0.3).abs() < 1e-9
                    && (p.heights[1] - 0.05).abs() < 1e-9
                    && (x[1] - x[0] - 0.3).abs() < 0.012
            };
            assert!(all.iter().any(|p| is_box(&p)), "{angle_deg}: {all:?}");
        }
    }

    #[test]
    fn what_is_small_or_runs_askew_is_no_lid() {
        let few = Patch { readings: 300.0, ..lid(1.0) };
        assert!(proposed(few).is_empty());
        let askew = of_lids(&[lid(1.0)], &[Vec3::x(), Vec3::y(), Vec3::z()], 0.6);
        assert!(askew.is_empty());
    }
}
