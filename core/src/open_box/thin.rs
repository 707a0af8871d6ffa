//! Flaps that are seen from their edge: a band of some pixels, too narrow to be met where a scan asks, in the plane of the eye and the
//! edge that they hang on.

use super::flap_scan::ScannedFlap;
use super::found_box::{FoundBox, FINE_M};
use super::grow::fitted_as_it_stands;
use super::hanging::{longest_flap_m, put_flap, FLAP_ANGLES_RAD};
use super::hinge_line::HingeLine;
use super::labels::Labels;
use super::sight::Sight;
use super::surfaces::FROM_EDGE_RAD;
use crate::fit::{lid_length_m, FitSettings, FittedBody, Role};

/// To either side of the angle at which the eye lies in the flap's plane so many angles are asked, half a degree apart.
const STEPS: usize = 16;
const STEP_RAD: f64 = FROM_EDGE_RAD / STEPS as f64;
const ANGLES: usize = 2 * STEPS + 1;
/// A flap's readings lie so far off the middle of its board, and half a pixel; three times as far there are hardly more.
const HALF_SLAB_M: f64 = 0.0035;
const WIDE: f64 = 3.0;
const LEAST_OF_WIDE: f64 = 0.55;
/// Nearer to the edge they may be the side's.
const LEAST_REACH_M: f64 = 0.012;
/// Beyond the ends of the edge, metres.
const BEYOND_END_M: f64 = 0.006;
/// A flap has so many, on so many of the columns along its edge, and reaches so far.
const LEAST_READINGS: usize = 120;
const COLUMNS: usize = 12;
const LEAST_COLUMNS: usize = 9;
const LEAST_OF_COLUMN: f64 = 0.15;
const LEAST_LENGTH_M: f64 = 0.02;
/// What is longer than a lid by so much is one with its tuck flap in its plane.
const LONGER_M: f64 = 0.01;
/// This share of them lies nearer to the edge than it reaches.
const WITHIN: f64 = 0.97;

/// The flaps that are seen from their edge on those edges that are asked for; readings of `labels` are the box's other panels'.
pub fn thin_flaps(sight: &Sight, body: &FittedBody, labels: &Labels, is_asked: [bool; 4]) -> [Option<ScannedFlap>; 4] {
    if is_asked.iter().all(|asked| !asked) {
        return [None; 4];
    }
    let mut is_taken = vec![false; sight.points.len()];
    let mut others = labels.clone();
    (0..4).filter(|&k| is_asked[k]).for_each(|k| others.clear(Role::Flap(k)));
    others.mark(sight.width, &mut is_taken);
    std::array::from_fn(|k| is_asked[k].then(|| thin_flap(sight, body, &is_taken, k))?)
}

/// The box fitted with such a flap on side `k`; `None` where it then holds no more.
pub fn with_thin(
    sight: &Sight,
    found: &FoundBox,
    k: usize,
    flap: ScannedFlap,
    settings: &FitSettings,
) -> Option<FoundBox> {
    let mut body = found.solution.body.clone();
    // Its ends hardly show: it is as long as it was found.
    put_flap(&mut body, k, &flap);
    let mut present = found.present;
    (present.flaps[k], present.tucks[k], present.thin[k]) = (true, false, true);
    let again = fitted_as_it_stands(sight, &body, present, settings)?;
    (again.score > found.score).then_some(again)
}

fn thin_flap(sight: &Sight, body: &FittedBody, is_taken: &[bool], k: usize) -> Option<ScannedFlap> {
    let hinge = HingeLine::of_side(body, k);
    let longest_m = longest_flap_m(body, k);
    let either_way = hinge.edge_on_angles(&sight.eye, 0, 0.0, FLAP_ANGLES_RAD);
    let found = either_way.into_iter().filter_map(|edge_on| {
        let near = readings_near(sight, &hinge, is_taken, edge_on, longest_m);
        let angle_rad = fullest(&near)?;
        let flap = flap(&near, &hinge, angle_rad).filter(|flap| flap.length_m < lid_length_m(body, k) + LONGER_M);
        flap.map(|flap| ScannedFlap { angle_rad: edge_on + flap.angle_rad, ..flap })
    });
    found.fold(None, |best: Option<ScannedFlap>, one| match best {
        Some(best) if best.met >= one.met => Some(best),
        _ => Some(one),
    })
}

/// A reading near the plane of the eye and the edge: along the edge, away from it, off the plane, and how far off a flap it may lie.
struct Near {
    along: f64,
    away: f64,
    off: f64,
    most_off: f64,
}

impl Near {
    /// Whether it lies on a flap at that angle off the plane, `slabs` times as far off as it may.
    fn is_on(&self, angle_rad: f64, slabs: f64) -> bool {
        let (sin, cos) = angle_rad.sin_cos();
        (self.off * cos - self.away * sin).abs() <= slabs * self.most_off
    }
}

fn readings_near(sight: &Sight, hinge: &HingeLine, is_taken: &[bool], edge_on: f64, longest_m: f64) -> Vec<Near> {
    let (way, normal) = hinge.directions(edge_on);
    let Some([left, right, top, bottom]) = window_px(sight, hinge, edge_on, longest_m) else { return Vec::new() };
    let mut out = Vec::new();
    for row in top..=bottom {
        for column in left..=right {
            let index = row * sight.width + column;
            let Some(look) = sight.look(index).filter(|_| !is_taken[index]) else { continue };
            let from = look.at() - hinge.middle;
            let (along, away, off) = (hinge.along.dot(&from), way.dot(&from), normal.dot(&from));
            let half_pixel_m = sight.pixel_rad * (look.at() - sight.eye).norm() / 2.0;
            let most_off = HALF_SLAB_M + half_pixel_m;
            let is_near = along.abs() < hinge.half_m + BEYOND_END_M
                && (LEAST_REACH_M..longest_m).contains(&away)
                && off.abs() < away * FROM_EDGE_RAD.tan() + WIDE * most_off;
            if is_near && !hinge.is_of_others(sight.eye.z, look, FINE_M) {
                out.push(Near { along, away, off, most_off });
            }
        }
    }
    out
}

/// Columns and rows that see a flap at any of the angles: left, right, top, bottom, inclusive.
fn window_px(sight: &Sight, hinge: &HingeLine, edge_on: f64, longest_m: f64) -> Option<[usize; 4]> {
    let mut bounds = [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY];
    for turn in [-FROM_EDGE_RAD, FROM_EDGE_RAD] {
        let way = hinge.directions(edge_on + turn).0;
        for (side, reach_m) in [(-1.0, 0.0), (1.0, 0.0), (-1.0, longest_m), (1.0, longest_m)] {
            let corner = hinge.middle + hinge.along * (side * (hinge.half_m + BEYOND_END_M)) + way * reach_m;
            let [x, y] = sight.pixel(&corner)?;
            bounds = [bounds[0].min(x), bounds[1].max(x), bounds[2].min(y), bounds[3].max(y)];
        }
    }
    let [left, right, top, bottom] = bounds;
    let (width, height) = (sight.width as f64 - 1.0, sight.height as f64 - 1.0);
    let is_seen = right >= 0.0 && left <= width && bottom >= 0.0 && top <= height;
    let cell = |at: f64, most: f64| at.clamp(0.0, most) as usize;
    is_seen.then(|| [cell(left, width), cell(right, width), cell(top, height), cell(bottom, height)])
}

/// The angle off the plane at which a flap has most readings.
fn fullest(near: &[Near]) -> Option<f64> {
    // Changes of the count from angle to angle.
    let mut changes = [0_i64; ANGLES + 1];
    let place = |angle: f64| angle / STEP_RAD + STEPS as f64;
    for reading in near {
        let (angle, wide) =
            (reading.off.atan2(reading.away), (reading.most_off / reading.away.hypot(reading.off)).min(1.0).asin());
        let first = place(angle - wide).ceil().max(0.0) as usize;
        let after = (place(angle + wide).floor() + 1.0).clamp(0.0, ANGLES as f64) as usize;
        if first < after {
            changes[first] += 1;
            changes[after] -= 1;
        }
    }
    let mut count = 0;
    let counts = changes[..ANGLES].iter().map(|change| {
        count += change;
        count
    });
    let (best, number) = counts.zip(0..).fold((0, 0), |best, one| if one.0 > best.0 { one } else { best });
    (best > 0).then(|| (f64::from(number) - STEPS as f64) * STEP_RAD)
}

fn flap(near: &[Near], hinge: &HingeLine, angle_rad: f64) -> Option<ScannedFlap> {
    let on: Vec<&Near> = near.iter().filter(|reading| reading.is_on(angle_rad, 1.0)).collect();
    let wide = near.iter().filter(|reading| reading.is_on(angle_rad, WIDE)).count();
    let mut columns = [0_usize; COLUMNS];
    let mut away: Vec<f64> = Vec::with_capacity(on.len());
    for reading in &on {
        let share = (reading.along / hinge.half_m + 1.0) / 2.0;
        columns[((share * COLUMNS as f64).max(0.0) as usize).min(COLUMNS - 1)] += 1;
        away.push(reading.away);
    }
    away.sort_unstable_by(f64::total_cmp);
    let length_m = *away.get(((away.len() as f64 * WITHIN) as usize).min(away.len().saturating_sub(1)))?;
    let least = LEAST_OF_COLUMN * on.len() as f64 / COLUMNS as f64;
    let full = columns.iter().filter(|&&column| column as f64 >= least.max(3.0)).count();
    let is_flap = on.len() >= LEAST_READINGS
        && on.len() as f64 >= LEAST_OF_WIDE * wide as f64
        && full >= LEAST_COLUMNS
        && length_m >= LEAST_LENGTH_M;
    is_flap.then_some(ScannedFlap { angle_rad, curl: 0.0, length_m, met: on.len() as f64, through: 0.0, hidden: 0.0 })
}

#[cfg(test)]
mod tests {
    use nalgebra::Isometry3;

    use super::*;
    use crate::cloud::CloudView;
    use crate::fit::{layout, Parameters};
    use crate::geometry::Vec3;
    use crate::perception::readings::Readings;
    use crate::perception::PerceptionSettings;

    const EYE: [f64; 3] = [0.3, -0.9, 0.8];
    const BOARD_M: f64 = 0.004;

    /// A board that leaves an edge at an angle, from one share of it to another, so far; `thick_m` for a block.
    struct Board {
        angle_rad: f64,
        along: [f64; 2],
        length_m: f64,
        thick_m: f64,
    }

    fn body() -> FittedBody {
        let mut numbers = Parameters::zeros();
        let lengths = [(layout::LENGTH, 0.4), (layout::WIDTH, 0.3), (layout::HEIGHT, 0.2)];
        lengths.iter().for_each(|&(place, length_m)| numbers[place] = length_m);
        FittedBody { input_from_object: Isometry3::identity(), numbers }
    }

    /// What a camera sees of such boards, and of a floor; that looks at the box, which is not there.
    fn points(hinge: &HingeLine, boards: &[Board]) -> Vec<[f32; 3]> {
        let eye = Vec3::from(EYE);
        let ahead = (Vec3::new(0.0, 0.0, 0.2) - eye).normalize();
        let right = ahead.cross(&Vec3::z()).normalize();
        let down = ahead.cross(&right);
        let ray = |i: usize| {
            let (u, v) = ((i % 640) as f64 - 319.5, (i / 640) as f64 - 239.5);
            ahead + right * (u / 575.0) + down * (v / 575.0)
        };
        let reach = |ray: &Vec3, board: &Board| {
            let (way, normal) = hinge.directions(board.angle_rad);
            let ends = [
                (hinge.along, board.along.map(|share| share * hinge.half_m)),
                (way, [0.0, board.length_m]),
                (normal, [-board.thick_m / 2.0, board.thick_m / 2.0]),
            ];
            let from = eye - hinge.middle;
            let [first, last] = ends.iter().fold([0.0, f64::INFINITY], |[first, last], (axis, ends)| {
                let at = ends.map(|end| (end - axis.dot(&from)) / axis.dot(ray));
                [f64::max(first, at[0].min(at[1])), f64::min(last, at[0].max(at[1]))]
            });
            if first < last {
                first
            } else {
                f64::INFINITY
            }
        };
        let seen = |i: usize| {
            let ray = ray(i);
            let floor = if ray.z < 0.0 { -eye.z / ray.z } else { f64::INFINITY };
            let nearest = boards.iter().map(|board| reach(&ray, board)).fold(floor, f64::min);
            (eye + ray * nearest).cast::<f32>().into()
        };
        (0..640 * 480).map(seen).collect()
    }

    fn found(k: usize, boards: &[Board]) -> [Option<ScannedFlap>; 4] {
        let points = points(&HingeLine::of_side(&body(), k), boards);
        let cloud = CloudView { points: &points, width: 640, height: 480, viewpoint: Some(Vec3::from(EYE)) };
        let settings = PerceptionSettings::default();
        let readings = Readings::new(&cloud, &settings);
        let sight = Sight::in_level(&cloud, &readings, Isometry3::identity()).unwrap();
        thin_flaps(&sight, &body(), &Labels { parts: Vec::new(), stride: 1 }, [true; 4])
    }

    fn edge_on_rad(k: usize) -> f64 {
        HingeLine::of_side(&body(), k).edge_on_angles(&Vec3::from(EYE), 0, 0.0, FLAP_ANGLES_RAD)[0]
    }

    #[test]
    fn a_flap_that_is_seen_from_its_edge_is_found_with_its_angle_and_length() {
        let mut cases = 0;
        for k in 0..4 {
            for off_deg in [-6.0_f64, -3.0, -0.5, 0.0, 1.0, 4.0] {
                for length_m in [0.08, 0.14] {
                    let angle_rad = edge_on_rad(k) + off_deg.to_radians();
                    let board = Board { angle_rad, along: [-1.0, 1.0], length_m, thick_m: BOARD_M };
                    let flap = found(k, &[board])[k].unwrap_or_else(|| panic!("{k} {off_deg} {length_m}"));
                    assert!((flap.angle_rad - angle_rad).abs() < 0.03, "{k} {off_deg} {length_m}: {flap:?}");
                    assert!((flap.length_m - length_m).abs() < 0.01, "{k} {off_deg} {length_m}: {flap:?}");
                    cases += 1;
                }
            }
        }
        assert_eq!(cases, 48);
    }

    #[test]
    fn what_is_no_thin_flap_is_none() {
        let mut cases = 0;
        for k in 0..4 {
            let angle_rad = edge_on_rad(k);
            let board = |along: [f64; 2], length_m: f64, thick_m: f64| Board { angle_rad, along, length_m, thick_m };
            for (why, boards) in [
                ("nothing is there", vec![]),
                ("it has half of its edge", vec![board([-1.0, 0.0], 0.1, BOARD_M)]),
                ("it is short", vec![board([-1.0, 1.0], 0.015, BOARD_M)]),
                ("it is a block", vec![board([-1.0, 1.0], 0.1, 0.06)]),
                ("it is longer than a lid", vec![board([-1.0, 1.0], body().edge_m(k + 1) + 0.018, BOARD_M)]),
            ] {
                assert_eq!(found(k, &boards)[k], None, "{k}: {why}");
                cases += 1;
            }
        }
        assert_eq!(cases, 20);
    }
}
