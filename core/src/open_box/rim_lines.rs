//! Upper edges that stand before something further away: of a wall seen edge-on they are all that is seen.

use super::patch::Patch;
use super::proposal::HEIGHTS_M;
use super::sight::Sight;
use super::yaw::difference;
use crate::geometry::Vec3;

/// What lies behind an edge is further off by this much, metres and standard deviations of a reading there.
const STEP_M: f64 = 0.012;
const STEP_SIGMAS: f64 = 5.0;
/// Beside an edge the sensor's shadow has no readings: so many pixels are stepped over.
const SHADOW_PX: usize = 5;

/// Ranges in single precision are off by less, metres.
const SINGLE_M: f32 = 1e-5;

/// Readings that something further away is seen right beside, in the level frame, no higher than a rim may be.
pub fn edge_points(sight: &Sight) -> Vec<Vec3> {
    let eye = sight.eye.cast::<f32>();
    let ranges_m: Vec<f32> = sight.points.iter().map(|p| (nalgebra::Vector3::from(*p) - eye).norm()).collect();
    // Of nearly all readings the four neighbours, none of them missing, tell at once that nothing lies behind.
    let goes_on = |index: usize, column: usize, row: usize| {
        let is_within = (1..sight.width - 1).contains(&column) && (1..sight.height - 1).contains(&row);
        let most_m = ranges_m[index] + STEP_M as f32 - SINGLE_M;
        let beside = || [index - 1, index + 1, index - sight.width, index + sight.width];
        is_within && beside().iter().all(|&other| ranges_m[other] <= most_m)
    };
    let mut out = Vec::new();
    for row in 0..sight.height {
        for column in 0..sight.width {
            let index = row * sight.width + column;
            let z = f64::from(sight.points[index][2]);
            if !(HEIGHTS_M[0]..=HEIGHTS_M[1]).contains(&z) || goes_on(index, column, row) {
                continue;
            }
            let Some(point) = sight.reading(index) else { continue };
            let range = (point - sight.eye).norm();
            let step = STEP_M.max(STEP_SIGMAS * sight.sigma_m(range));
            let is_beyond = |index: usize| sight.reading(index).map(|other| (other - sight.eye).norm() > range + step);
            let beside = |room: usize, stride: isize| {
                let places = (1..=SHADOW_PX.min(room)).map(|n| index.wrapping_add_signed(n as isize * stride));
                places.into_iter().find_map(is_beyond).unwrap_or(false)
            };
            let width = sight.width as isize;
            if beside(column, -1)
                || beside(sight.width - 1 - column, 1)
                || beside(row, -width)
                || beside(sight.height - 1 - row, width)
            {
                out.push(point);
            }
        }
    }
    out
}

/// Bins of places along an axis, and of heights, metres.
const PLACE_M: f64 = 0.004;
const HEIGHT_M: f64 = 0.006;
/// A rim shows at least so many readings, so long; so much of its length has some; gaps longer than this end it.
const LEAST_READINGS: usize = 14;
const LEAST_M: f64 = 0.06;
const GAP_M: f64 = 0.03;
/// Of one direction, at most.
const MOST: usize = 10;
/// The wall below a rim, as a patch, reaches down so far, metres.
const WALL_M: f64 = 0.02;
const HALF_BOARD_M: f64 = 0.002;

/// Level lines of edge points across each of a box's directions, as the walls that stand below them.
pub fn walls_of_rims(points: &[Vec3], axes: &[Vec3; 3]) -> Vec<Patch> {
    [0, 1].into_iter().flat_map(|a| across(points, &axes[a], &axes[1 - a], &axes[2])).collect()
}

fn across(points: &[Vec3], axis: &Vec3, along: &Vec3, up: &Vec3) -> Vec<Patch> {
    let bin = |p: &Vec3| ((p.dot(axis) / PLACE_M).floor() as i32, (p.dot(up) / HEIGHT_M).floor() as i32);
    let mut binned: Vec<((i32, i32), f64, Vec3)> = points.iter().map(|p| (bin(p), p.dot(along), *p)).collect();
    binned.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut counts: Vec<((i32, i32), usize, usize)> = Vec::new();
    for (number, (bin, _, _)) in binned.iter().enumerate() {
        match counts.last_mut().filter(|(last, _, _)| last == bin) {
            Some(last) => last.2 = number + 1,
            None => counts.push((*bin, number, number + 1)),
        }
    }
    let of = |bin: (i32, i32)| counts.binary_search_by(|c| c.0.cmp(&bin)).ok().map(|i| counts[i]);
    let about = |(x, z): (i32, i32)| (-1..=1).flat_map(move |i| (-1..=1).map(move |j| (x + i, z + j))).filter_map(of);
    let mut votes: Vec<(usize, (i32, i32))> =
        counts.iter().map(|c| (about(c.0).map(|(_, from, to)| to - from).sum(), c.0)).collect();
    votes.retain(|vote| vote.0 >= LEAST_READINGS);
    votes.sort_by(|a, b| b.0.cmp(&a.0).then(a.1.cmp(&b.1)));
    let mut out = Vec::new();
    let mut taken: Vec<(i32, i32)> = Vec::new();
    for (_, bin) in votes {
        if taken.iter().any(|other| (other.0 - bin.0).abs() <= 2 && (other.1 - bin.1).abs() <= 2) {
            continue;
        }
        taken.push(bin);
        let mut near: Vec<&((i32, i32), f64, Vec3)> = about(bin).flat_map(|(_, from, to)| &binned[from..to]).collect();
        near.sort_by(|a, b| a.1.total_cmp(&b.1));
        out.extend(longest_run(&near).and_then(|run| wall(run, axis, along, up)));
        if out.len() >= MOST {
            break;
        }
    }
    out
}

type Placed<'a> = &'a ((i32, i32), f64, Vec3);

fn longest_run<'a, 'b>(sorted: &'b [Placed<'a>]) -> Option<&'b [Placed<'a>]> {
    let (mut best, mut start) = (0..0, 0);
    for i in 1..=sorted.len() {
        if i == sorted.len() || sorted[i].1 - sorted[i - 1].1 > GAP_M {
            if i - start > best.len() {
                best = start..i;
            }
            start = i;
        }
    }
    Some(&sorted[best]).filter(|run| run.len() >= LEAST_READINGS)
}

fn wall(run: &[Placed], axis: &Vec3, along: &Vec3, up: &Vec3) -> Option<Patch> {
    let (from, to) = (run.first()?.1, run.last()?.1);
    let count = run.len() as f64;
    let mean = run.iter().map(|one| one.2).sum::<Vec3>() / count;
    let (at_m, top) = (mean.dot(axis) + HALF_BOARD_M, mean.dot(up));
    let corner = |u: f64, z: f64| axis * at_m + along * u + up * z;
    let hull = vec![corner(from, top - WALL_M), corner(to, top - WALL_M), corner(to, top), corner(from, top)];
    (to - from >= LEAST_M).then_some(Patch { normal: *axis, distance_m: at_m, hull, readings: count })
}

/// Directions are asked for in steps of so much, rad, of so many points at most.
const TURN_RAD: f64 = 0.0175;
const MOST_ASKED: usize = 2000;
/// Places and heights that an edge's points share, metres, and how many of them there are: others fall in with them.
const CELL_M: [f64; 2] = [0.006, 0.010];
const CELLS: [usize; 2] = [256, 64];
const _: () = assert!(CELLS[0].is_power_of_two() && CELLS[1].is_power_of_two() && MOST_ASKED <= u16::MAX as usize);
/// So many points in a cell make no line.
const BY_CHANCE: u16 = 6;
const MOST_YAWS: usize = 3;
const NEAR_RAD: f64 = 0.06;
/// Of the best direction's count.
const LEAST_SHARE: f64 = 0.3;

/// The directions along which, and across which, level edges run (eq. 102), rad in [0, pi/2) about the vertical, strongest
/// first.
pub fn yaws_of_edges(points: &[Vec3]) -> Vec<f64> {
    let stride = points.len().div_ceil(MOST_ASKED).max(1);
    let steps = (std::f64::consts::FRAC_PI_2 / TURN_RAD).round() as usize;
    let number = |at: f64, cells: usize| at.floor() as i32 as usize & (cells - 1);
    let placed = |p: &Vec3| ([p.x / CELL_M[0], p.y / CELL_M[0]], number(p.z / CELL_M[1], CELLS[1]));
    let asked: Vec<([f64; 2], usize)> = points.iter().step_by(stride).map(placed).collect();
    let mut counts = vec![0_u16; CELLS[0] * CELLS[1]];
    let mut of_turn = |turn: usize| -> f64 {
        let (sin, cos) = (turn as f64 * TURN_RAD).sin_cos();
        let mut squares = 0_u64;
        for (x, y) in [(cos, sin), (-sin, cos)] {
            counts.fill(0);
            for (place, height) in &asked {
                let count = &mut counts[number(place[0] * x + place[1] * y, CELLS[0]) * CELLS[1] + height];
                // From n squared to (n + 1) squared.
                squares += if *count < BY_CHANCE { 0 } else { 2 * u64::from(*count - BY_CHANCE) + 1 };
                *count += 1;
            }
        }
        squares as f64
    };
    let votes: Vec<f64> = (0..steps).map(&mut of_turn).collect();
    let mut order: Vec<usize> = (0..steps).filter(|&turn| votes[turn] > 0.0).collect();
    order.sort_by(|&a, &b| votes[b].total_cmp(&votes[a]).then(a.cmp(&b)));
    let mut out: Vec<f64> = Vec::new();
    for turn in order {
        let yaw = turn as f64 * TURN_RAD;
        if out.len() == MOST_YAWS || votes[turn] < LEAST_SHARE * votes.iter().copied().fold(0.0, f64::max) {
            break;
        }
        if out.iter().all(|other| difference(yaw, *other).abs() > NEAR_RAD) {
            out.push(yaw);
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::super::proposal::turned;
    use super::*;

    const SIZE_M: [f64; 2] = [0.4, 0.3];
    const RIM_M: f64 = 0.05;

    /// Readings on the rims of a box that stands at (0.2, -0.1), a sensor's noise off them.
    fn rims(yaw: f64, seed: u64) -> Vec<Vec3> {
        let mut state = seed;
        let mut draw = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as f64 / f64::from(1_u32 << 31) - 0.5
        };
        let [x, y, _] = turned(&[Vec3::x(), Vec3::y(), Vec3::z()], yaw);
        let [l, w] = SIZE_M;
        let mut out = Vec::new();
        for i in 0..100 {
            let t = f64::from(i) / 99.0 - 0.5;
            for (along, across) in [(t * l, -w / 2.0), (t * l, w / 2.0), (-l / 2.0, t * w), (l / 2.0, t * w)] {
                let noise = Vec3::new(draw(), draw(), draw()) * 0.004;
                out.push(Vec3::new(0.2, -0.1, RIM_M) + x * along + y * across + noise);
            }
        }
        out
    }

    #[test]
    fn rims_tell_where_walls_stand_and_which_way() {
        let mut cases = 0;
        for k in 0..30 {
            let yaw = f64::from(k) * 0.05;
            let points = rims(yaw, k as u64 + 1);
            let found = yaws_of_edges(&points);
            assert!(difference(found[0], yaw).abs() < 0.02, "{yaw}: {found:?}");
            let axes = turned(&[Vec3::x(), Vec3::y(), Vec3::z()], yaw);
            let walls = walls_of_rims(&points, &axes);
            let middle = Vec3::new(0.2, -0.1, 0.0);
            for (a, size) in SIZE_M.iter().enumerate() {
                for side in [-0.5, 0.5] {
                    let at_m = axes[a].dot(&middle) + side * size;
                    let is_it = |wall: &Patch| {
                        let top = wall.span(&Vec3::z())[1];
                        wall.normal.dot(&axes[a]) > 0.99
                            && (wall.distance_m - at_m).abs() < 0.006
                            && (top - RIM_M).abs() < 0.005
                    };
                    assert_eq!(walls.iter().filter(|wall| is_it(wall)).count(), 1, "{yaw} {a} {side}: {walls:?}");
                    cases += 1;
                }
            }
        }
        assert_eq!(cases, 120);
    }

    #[test]
    fn what_is_short_or_scattered_is_no_rim() {
        let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
        let short: Vec<Vec3> = (0..60).map(|i| Vec3::new(0.1, f64::from(i) * 0.0008, 0.05)).collect();
        assert!(walls_of_rims(&short, &axes).is_empty());
        let scattered: Vec<Vec3> = (0..40).map(|i| Vec3::new(0.1, f64::from(i) * 0.05, 0.05)).collect();
        assert!(walls_of_rims(&scattered, &axes).is_empty());
        assert!(yaws_of_edges(&[]).is_empty());
    }
}
