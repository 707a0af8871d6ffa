//! Planes of clouds without an image grid: laws, small scenes with known answers, and clouds that hold nothing.

use boxwright_core::cloud::CloudView;
use boxwright_core::geometry::{SplitMix64, Vec3};
use boxwright_core::perception::{perceive, PerceptionSettings, PlaneFinder, Scene, BACKGROUND};
use nalgebra::{Isometry3, Translation3, UnitQuaternion};

type Points = Vec<[f32; 3]>;

/// A corner and the two edges from it, metres.
type Quad = [Vec3; 3];

fn settings() -> PerceptionSettings {
    PerceptionSettings { planes: PlaneFinder::Grid, ..PerceptionSettings::default() }
}

fn see(points: &Points) -> Scene {
    try_see(points).unwrap()
}

fn try_see(points: &Points) -> Result<Scene, boxwright_core::error::InputError> {
    perceive(&CloudView { points, width: points.len(), height: 1, viewpoint: None }, &settings())
}

fn gauss(rng: &mut SplitMix64) -> f64 {
    (0..12).map(|_| rng.unit()).sum::<f64>() - 6.0
}

/// Readings spread evenly over the quads, about `spacing_m` apart, with this noise in every direction.
fn scan(quads: &[Quad], spacing_m: f64, sigma_m: f64, rng: &mut SplitMix64) -> Points {
    let mut points = Points::new();
    for [corner, a, b] in quads {
        let count = (a.cross(b).norm() / spacing_m.powi(2)) as usize;
        for _ in 0..count {
            let mut p = corner + a * rng.unit() + b * rng.unit();
            p += Vec3::new(gauss(rng), gauss(rng), gauss(rng)) * sigma_m;
            points.push([p.x as f32, p.y as f32, p.z as f32]);
        }
    }
    points
}

fn quad(corner: [f64; 3], a: [f64; 3], b: [f64; 3]) -> Quad {
    [Vec3::from(corner), Vec3::from(a), Vec3::from(b)]
}

/// Four walls and a base 4 mm over z = 0, turned about the vertical.
fn open_box(center: [f64; 2], size: [f64; 3], yaw: f64) -> Vec<Quad> {
    let (s, c) = yaw.sin_cos();
    let turned = |x: f64, y: f64| Vec3::new(c * x - s * y, s * x + c * y, 0.0);
    let [l, w, h] = size;
    let corners = [turned(-l, -w), turned(l, -w), turned(l, w), turned(-l, w)]
        .map(|p| p / 2.0 + Vec3::new(center[0], center[1], 0.004));
    let wall = |k: usize| [corners[k], corners[(k + 1) % 4] - corners[k], Vec3::z() * h];
    let base = [corners[0], corners[1] - corners[0], corners[3] - corners[0]];
    (0..4).map(wall).chain([base]).collect()
}

/// The floor around boxes, none under them.
fn floor_without(points: Points, center: [f64; 2], size: [f64; 3], yaw: f64) -> Points {
    let (s, c) = yaw.sin_cos();
    let is_under = |p: &[f32; 3]| {
        let (x, y) = (f64::from(p[0]) - center[0], f64::from(p[1]) - center[1]);
        (c * x + s * y).abs() < size[0] / 2.0 && (c * y - s * x).abs() < size[1] / 2.0
    };
    points.into_iter().filter(|p| !is_under(p)).collect()
}

const FLOOR: [[f64; 3]; 3] = [[-0.8, -0.8, 0.0], [1.6, 0.0, 0.0], [0.0, 1.6, 0.0]];

/// A box with two flaps on a floor.
fn box_on_floor(seed: u64, spacing_m: f64, sigma_m: f64) -> Points {
    let mut rng = SplitMix64::new(seed);
    let (size, yaw) = ([0.4, 0.3, 0.22 + 0.01 * seed as f64], 0.3 * seed as f64);
    let floor = scan(&[FLOOR.map(Vec3::from)], spacing_m, sigma_m, &mut rng);
    let mut points = floor_without(floor, [0.1, 0.05], size, yaw);
    let mut quads = open_box([0.1, 0.05], size, yaw);
    for k in [0, 2] {
        let [corner, along, rise] = quads[k];
        let out = along.cross(&Vec3::z()).normalize() * 0.12;
        quads.push([corner + rise, along, out + Vec3::z() * (0.03 + 0.02 * k as f64)]);
    }
    points.extend(scan(&quads, spacing_m, sigma_m, &mut rng));
    points
}

fn shuffled(points: &Points, rng: &mut SplitMix64) -> (Points, Vec<usize>) {
    let mut order: Vec<usize> = (0..points.len()).collect();
    for k in (1..order.len()).rev() {
        order.swap(k, rng.below(k + 1));
    }
    (order.iter().map(|&i| points[i]).collect(), order)
}

/// Everything but point indices, bit by bit.
fn bits(scene: &Scene) -> Vec<u64> {
    let s = &scene.segments;
    let mut values: Vec<f64> = scene.up.iter().copied().collect();
    values.extend(scene.support.iter().flat_map(|p| [p.normal.x, p.normal.y, p.normal.z, p.distance]));
    values.extend(s.planes.iter().flat_map(|p| [p.normal.x, p.normal.y, p.normal.z, p.distance]));
    values.extend(s.rectangles.iter().flat_map(|r| r.corners).flat_map(|c| [c.x, c.y, c.z]));
    values.extend(s.hulls.iter().flatten().flat_map(|c| [c.x, c.y, c.z]));
    values.extend(&s.rms);
    values.extend(s.group.iter().map(|&g| f64::from(g)));
    values.extend(s.point_starts.iter().map(|&p| f64::from(p)));
    values.iter().map(|v| v.to_bits()).collect()
}

#[test]
fn a_shuffled_cloud_has_the_same_segments_of_the_same_points() {
    let mut rng = SplitMix64::new(71);
    let mut cases = 0;
    for seed in 0..4 {
        let mut points = box_on_floor(seed, 0.004, 0.0015);
        let twice: Points = points.iter().step_by(7).copied().collect();
        points.extend(twice);
        let before = see(&points);
        assert!(before.segments.len() >= 8);
        for _ in 0..3 {
            let (mixed, order) = shuffled(&points, &mut rng);
            let after = see(&mixed);
            assert_eq!(bits(&before), bits(&after), "scene {seed}");
            for s in 0..before.segments.len() {
                let mut back: Vec<u32> =
                    after.segments.points_of(s).iter().map(|&i| order[i as usize] as u32).collect();
                back.sort_unstable();
                assert_eq!(before.segments.points_of(s), back);
            }
            cases += 1;
        }
    }
    assert_eq!(cases, 12);
}

#[test]
fn equal_bits_in_twenty_runs_and_on_any_number_of_threads() {
    let points = box_on_floor(2, 0.005, 0.001);
    let first = bits(&see(&points));
    let mut cases = 0;
    for threads in (0..20).map(|run| [1, 2, 8][run % 3]) {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert_eq!(first, pool.install(|| bits(&see(&points))));
        cases += 1;
    }
    assert_eq!(cases, 20);
}

#[test]
fn planes_move_with_the_cloud() {
    // Voxels do not turn with the cloud, so borders move by single readings: planes within half a degree and 2 mm.
    let mut rng = SplitMix64::new(72);
    let mut cases = 0;
    for seed in 0..4 {
        let points = box_on_floor(seed, 0.004, 0.0015);
        let before = see(&points);
        for _ in 0..3 {
            let turn = UnitQuaternion::from_scaled_axis(Vec3::new(
                0.3 * gauss(&mut rng),
                0.3 * gauss(&mut rng),
                gauss(&mut rng),
            ));
            let motion =
                Isometry3::from_parts(Translation3::new(gauss(&mut rng), gauss(&mut rng), gauss(&mut rng)), turn);
            let moved: Points = points
                .iter()
                .map(|p| {
                    (motion.rotation * Vec3::from(p.map(f64::from)) + motion.translation.vector)
                        .map(|c| c as f32)
                        .into()
                })
                .collect();
            let after = see(&moved);
            assert!((after.up - motion.rotation * before.up).norm() < 0.01, "scene {seed}");
            for s in (0..before.segments.len()).filter(|&s| before.segments.points_of(s).len() > 1000) {
                let normal = motion.rotation * before.segments.planes[s].normal;
                let center = motion.rotation * before.segments.rectangles[s].center() + motion.translation.vector;
                let is_same = |k: usize| {
                    let plane = &after.segments.planes[k];
                    let near = (after.segments.rectangles[k].center() - center).norm() < 0.02;
                    near && plane.normal.cross(&normal).norm() < 0.5f64.to_radians()
                        && plane.height_of(&center).abs() < 0.002
                };
                assert!((0..after.segments.len()).any(is_same), "scene {seed}, segment {s}");
                cases += 1;
            }
        }
    }
    assert!(cases >= 4 * 3 * 7, "{cases}");
}

#[test]
fn a_box_on_a_floor_is_one_group_with_walls_base_and_flaps() {
    let mut cases = 0;
    for (spacing_m, sigma_m) in [(0.003, 0.0005), (0.003, 0.002), (0.005, 0.001), (0.005, 0.003)] {
        let scene = see(&box_on_floor(1, spacing_m, sigma_m));
        let s = &scene.segments;
        assert!(scene.up.z > 0.9999 && scene.support.unwrap().distance.abs() < 0.002);
        let things: Vec<usize> = (0..s.len()).filter(|&k| s.group[k] != BACKGROUND).collect();
        assert_eq!((things.len(), s.len()), (7, 8), "{spacing_m} {sigma_m} {:?}", s.rms);
        assert!(things.iter().all(|&k| s.group[k] == 0));
        let upright = things.iter().filter(|&&k| s.planes[k].normal.z.abs() < 0.05).count();
        let base = things.iter().filter(|&&k| s.rectangles[k].center().z.abs() < 0.01).count();
        assert_eq!((upright, base), (4, 1), "{spacing_m} {sigma_m}");
        cases += 1;
    }
    assert_eq!(cases, 4);
}

#[test]
fn small_panels_at_five_millimetres_are_found() {
    // 0.11 x 0.11 m: some 500 readings.
    let mut rng = SplitMix64::new(73);
    let mut points = scan(&[FLOOR.map(Vec3::from)], 0.005, 0.001, &mut rng);
    points.extend(scan(&[quad([0.0, 0.0, 0.2], [0.11, 0.0, 0.0], [0.0, 0.1, 0.05])], 0.005, 0.001, &mut rng));
    let scene = see(&points);
    let found = (0..scene.segments.len()).filter(|&s| scene.segments.group[s] == 0).collect::<Vec<_>>();
    assert_eq!(found.len(), 1);
    assert!(scene.segments.points_of(found[0]).len() > 450);
}

#[test]
fn what_differs_stays_apart_and_what_touches_belongs_together() {
    let floor = FLOOR.map(Vec3::from);
    let mut rng = SplitMix64::new(74);
    // Two panels: (name, quads, segments of things, groups).
    let lean = |deg: f64| [0.2 * deg.to_radians().cos(), 0.0, 0.2 * deg.to_radians().sin()];
    let cases = [
        (
            "a fold of 14 degrees",
            vec![
                quad([-0.2, 0.0, 0.2], [0.2, 0.0, 0.0], [0.0, 0.3, 0.0]),
                quad([0.0, 0.0, 0.2], lean(14.0), [0.0, 0.3, 0.0]),
            ],
            2,
            1,
        ),
        (
            "a step of 5 mm",
            vec![
                quad([-0.2, 0.0, 0.2], [0.2, 0.0, 0.0], [0.0, 0.3, 0.0]),
                quad([0.0, 0.0, 0.205], [0.2, 0.0, 0.0], [0.0, 0.3, 0.0]),
            ],
            2,
            1,
        ),
        (
            "flaps at one height, 10 cm apart",
            vec![
                quad([-0.2, 0.0, 0.2], [0.15, 0.0, 0.0], [0.0, 0.3, 0.0]),
                quad([0.05, 0.0, 0.2], [0.15, 0.0, 0.0], [0.0, 0.3, 0.0]),
            ],
            2,
            2,
        ),
        (
            "two walls, 25 mm apart",
            vec![
                quad([0.0, 0.0, 0.0], [0.0, 0.3, 0.0], [0.0, 0.0, 0.25]),
                quad([0.025, 0.0, 0.0], [0.0, 0.3, 0.0], [0.0, 0.0, 0.25]),
            ],
            2,
            2,
        ),
        (
            "both faces of a board",
            vec![
                quad([0.0, 0.0, 0.1], [0.0, 0.3, 0.0], [0.0, 0.0, 0.25]),
                quad([0.004, 0.0, 0.1], [0.0, 0.3, 0.0], [0.0, 0.0, 0.25]),
            ],
            1,
            1,
        ),
        (
            "a flap over clutter",
            vec![
                quad([0.0, 0.0, 0.2], [0.2, 0.0, 0.0], [0.0, 0.3, 0.0]),
                quad([0.05, 0.1, 0.1], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0]),
            ],
            2,
            2,
        ),
    ];
    let mut counted = 0;
    for (name, quads, segments, groups) in cases {
        let mut points = scan(&[floor], 0.004, 0.001, &mut rng);
        points.extend(scan(&quads, 0.003, 0.001, &mut rng));
        let scene = see(&points);
        let of_things: Vec<i32> = scene.segments.group.iter().copied().filter(|&g| g != BACKGROUND).collect();
        assert_eq!(of_things.len(), segments, "{name}");
        assert_eq!(of_things.iter().max(), Some(&(groups - 1)), "{name}");
        counted += 1;
    }
    assert_eq!(counted, 6);
}

#[test]
fn hulls_and_rectangles_hold_every_reading() {
    let points = box_on_floor(3, 0.004, 0.002);
    let scene = see(&points);
    let mut cases = 0;
    for s in 0..scene.segments.len() {
        let (plane, hull) = (&scene.segments.planes[s], &scene.segments.hulls[s]);
        let turn = |a: &Vec3, b: &Vec3, p: &Vec3| (b - a).cross(&(p - a)).dot(&plane.normal);
        let around = (0..hull.len()).map(|k| turn(&hull[k], &hull[(k + 1) % hull.len()], &hull[(k + 2) % hull.len()]));
        let sign = around.sum::<f64>().signum();
        for &i in scene.segments.points_of(s) {
            let p = Vec3::from(points[i as usize].map(f64::from));
            assert!((0..hull.len()).all(|k| sign * turn(&hull[k], &hull[(k + 1) % hull.len()], &p) > -1e-9));
            cases += 1;
        }
    }
    assert!(cases > 50_000, "{cases}");
}

#[test]
fn clouds_that_hold_nothing_are_answered() {
    let mut rng = SplitMix64::new(75);
    let mut even = |n: usize, size: f64| -> Points {
        (0..n).map(|_| [rng.unit(), rng.unit(), rng.unit()].map(|c| (size * c) as f32)).collect()
    };
    let noise = even(100_000, 1.0);
    let three = even(3, 1.0);
    let sparse = even(1000, 9000.0);
    let sphere: Points = even(100_000, 1.0)
        .iter()
        .filter_map(|p| (Vec3::from(p.map(f64::from)) - Vec3::from([0.5; 3])).try_normalize(1e-3))
        .map(|d| (d * 0.5).map(|c| c as f32).into())
        .collect();
    let line: Points = (0..50_000).map(|k| [k as f32 * 1e-4, 0.0, 1.0]).collect();
    let clouds = [
        ("equal", vec![[1.0, 2.0, 3.0]; 50_000]),
        ("noise", noise),
        ("three", three),
        ("sparse", sparse),
        ("sphere", sphere),
        ("line", line),
    ];
    let mut cases = 0;
    for (name, points) in &clouds {
        match try_see(points) {
            Ok(scene) => assert!(scene.segments.rms.iter().all(|r| r.is_finite()), "{name}"),
            Err(error) => assert!(!error.mend.is_empty(), "{name}"),
        }
        cases += 1;
    }
    assert_eq!(cases, 6);
    assert!(see(&clouds[0].1).segments.is_empty() && see(&clouds[5].1).segments.is_empty());
    assert!(try_see(&vec![[f32::NAN; 3]; 100]).unwrap_err().problem.contains("no finite readings"));
    assert!(try_see(&vec![]).is_err());
}

#[test]
fn far_from_the_origin_and_among_readings_that_are_none() {
    let mut points = box_on_floor(1, 0.004, 0.0015);
    let near = see(&points);
    for k in 0..1000 {
        points.insert(k * 37, [f32::NAN, 0.0, f32::INFINITY]);
    }
    assert_eq!(bits(&near), bits(&see(&points)));
    // At 9 km a float's steps are a millimetre.
    let far: Points = points.iter().map(|p| [p[0] + 9000.0, p[1] - 9000.0, p[2] + 9000.0]).collect();
    let scene = see(&far);
    assert!(scene.up.z > 0.999);
    assert!(scene.segments.group.iter().filter(|&&g| g == 0).count() >= 6);
}
