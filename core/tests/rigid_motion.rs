//! No feature, relation or score changes when the whole scene is moved.

mod common;

use boxwright_core::geometry::{Plane, Rectangle, Vec3};
use boxwright_core::model::{FeatureTables, SegmentSet, Template};
use boxwright_core::perception::Scene;
use common::{rectangle, scene, Random};
use nalgebra::{Isometry3, Translation3, UnitQuaternion};

const TEMPLATES: [&str; 5] = [
    include_str!("../../src/boxwright/models/templates/carton.toml"),
    include_str!("../../src/boxwright/models/templates/cake_box.toml"),
    include_str!("../../src/boxwright/models/templates/pizza_box.toml"),
    include_str!("../../src/boxwright/models/templates/exact/carton.toml"),
    include_str!("../../src/boxwright/models/templates/exact/pizza_box.toml"),
];
/// Largest change of a value, radians or metres, that rounding excuses.
const ROUNDING: f64 = 1e-6;

fn random_motion(random: &mut Random) -> Isometry3<f64> {
    let rotation = UnitQuaternion::from_scaled_axis(Vec3::from(random.vector(4.0)));
    Isometry3::from_parts(Translation3::from(Vec3::from(random.vector(5.0))), rotation)
}

fn moved_point(motion: &Isometry3<f64>, p: &Vec3) -> Vec3 {
    motion.rotation * p + motion.translation.vector
}

fn moved_plane(motion: &Isometry3<f64>, plane: &Plane) -> Plane {
    let normal = motion.rotation * plane.normal;
    Plane { normal, distance: plane.distance + normal.dot(&motion.translation.vector) }
}

fn moved(motion: &Isometry3<f64>, scene: &Scene) -> Scene {
    let mut out = scene.clone();
    out.up = motion.rotation * scene.up;
    out.support = scene.support.as_ref().map(|plane| moved_plane(motion, plane));
    out.viewpoint = scene.viewpoint.as_ref().map(|p| moved_point(motion, p));
    for plane in &mut out.segments.planes {
        *plane = moved_plane(motion, plane);
    }
    for rectangle in &mut out.segments.rectangles {
        *rectangle = Rectangle { corners: rectangle.corners.map(|c| moved_point(motion, &c)) };
    }
    out
}

/// Real rectangles: the second edge is square to the first.
fn random_scene(random: &mut Random, segments: usize) -> Scene {
    let one = |random: &mut Random| {
        let a = Vec3::from(random.vector(0.3));
        let b = a.cross(&Vec3::from(random.vector(1.0))).normalize() * random.between(0.02, 0.3);
        rectangle(random.vector(0.5), a.into(), b.into())
    };
    let mut made = scene((0..segments).map(|_| one(random)).collect());
    if random.unit() < 0.3 {
        made.support = None;
    }
    if random.unit() < 0.3 {
        made.viewpoint = None;
    }
    made
}

fn random_assignment(random: &mut Random, parts: usize, segments: usize) -> Vec<Option<usize>> {
    let mut free: Vec<usize> = (0..segments).collect();
    let mut pick = || match free.len() {
        0 => None,
        _ if random.unit() < 0.2 => None,
        n => Some(free.swap_remove((random.unit() * n as f64) as usize)),
    };
    (0..parts).map(|_| pick()).collect()
}

#[test]
fn values_stay_under_a_rigid_motion() {
    let mut random = Random::new(2011);
    let (mut scenes, mut values, mut most) = (0, 0usize, 0.0f64);
    for round in 0..600 {
        let template = Template::from_toml(TEMPLATES[round % 5]).unwrap();
        let segments = 2 + (random.unit() * 11.0) as usize;
        let before = random_scene(&mut random, segments);
        let after = moved(&random_motion(&mut random), &before);
        let indices: Vec<usize> = (0..segments).collect();
        let tables = [&before, &after].map(|s| FeatureTables::new(&template, &SegmentSet::new(s, &indices)));
        let all = |t: &FeatureTables| t.unary.iter().chain(&t.pair).flatten().copied().collect::<Vec<f64>>();
        for (a, b) in all(&tables[0]).iter().zip(all(&tables[1])) {
            most = most.max((a - b).abs());
            values += 1;
        }
        let assignment = random_assignment(&mut random, template.parts.len(), segments);
        let vectors = tables.map(|t| t.feature_vector(&template, &assignment));
        for (a, b) in vectors[0].iter().zip(&vectors[1]) {
            assert!((a - b).abs() < 8.0 * ROUNDING, "round {round}: {a} became {b}");
        }
        scenes += 1;
    }
    assert!(most < ROUNDING, "a value changed by {most}");
    assert_eq!(scenes, 600);
    assert!(values > 100_000);
}

#[test]
fn a_mirrored_scene_scores_the_same_and_a_stretched_one_does_not() {
    let mut random = Random::new(7);
    let template = Template::from_toml(TEMPLATES[0]).unwrap();
    let (mut cases, mut differing) = (0, 0);
    for _ in 0..50 {
        let before = random_scene(&mut random, 9);
        let change = |by: Vec3| {
            let mut out = before.clone();
            for rectangle in &mut out.segments.rectangles {
                rectangle.corners = rectangle.corners.map(|c| c.component_mul(&by));
            }
            for plane in &mut out.segments.planes {
                plane.normal = plane.normal.component_div(&by).normalize();
            }
            FeatureTables::new(&template, &SegmentSet::new(&out, &(0..9).collect::<Vec<_>>()))
        };
        let assignment = random_assignment(&mut random, 9, 9);
        let values = |t: FeatureTables| t.feature_vector(&template, &assignment);
        let start = values(change(Vec3::new(1.0, 1.0, 1.0)));
        let farthest = |other: &[f64]| start.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(farthest(&values(change(Vec3::new(-1.0, 1.0, 1.0)))) < 8.0 * ROUNDING);
        differing += usize::from(farthest(&values(change(Vec3::new(1.0, 1.0, 1.5)))) > 1e-3);
        cases += 1;
    }
    assert_eq!(cases, 50);
    assert!(differing > 45, "a law that nothing breaks says nothing");
}
