//! A made-up box of exact panels, seen by an exact camera: it is found, measured, and found alike each time.

use boxwright_core::cloud::CloudView;
use boxwright_core::geometry::Vec3;
use boxwright_core::inference::{FoundObject, ObjectModel, SearchSettings};
use boxwright_core::model::{SegmentSet, Template, Weights};
use boxwright_core::open_box::Kinds;
use boxwright_core::perception::{PerceptionSettings, Scene};
use boxwright_core::pipeline::{infer, Answer, Bodies};

const WIDTH: usize = 480;
const HEIGHT: usize = 360;
const FOCAL_PX: f64 = 430.0;
const EYE: Vec3 = Vec3::new(0.9, -0.75, 0.95);
const LENGTH_M: f64 = 0.36;
const BREADTH_M: f64 = 0.26;
const TALL_M: f64 = 0.2;

/// Four corners going round.
type Panel = [Vec3; 4];

/// Walls, base and flaps at their positions, with the floor; a box without thickness.
fn scene(flap_positions_deg: [f64; 4]) -> Vec<Panel> {
    let (x, y, z) = (LENGTH_M / 2.0, BREADTH_M / 2.0, TALL_M);
    let at = |sx: f64, sy: f64, z: f64| Vec3::new(sx * x, sy * y, z);
    let foot = [at(-1.0, -1.0, 0.004), at(1.0, -1.0, 0.004), at(1.0, 1.0, 0.004), at(-1.0, 1.0, 0.004)];
    let floor = [(-2.0, -2.0), (2.0, -2.0), (2.0, 2.0), (-2.0, 2.0)].map(|(x, y)| Vec3::new(x, y, 0.0));
    let mut panels = vec![floor, foot];
    for k in 0..4 {
        let lift = Vec3::z() * (z - 0.004);
        let (start, end) = (foot[k] + lift, foot[(k + 1) % 4] + lift);
        panels.push([foot[k], foot[(k + 1) % 4], end, start]);
        let along = (end - start).normalize();
        let (sin, cos) = flap_positions_deg[k].to_radians().sin_cos();
        let out = (Vec3::z().cross(&along) * cos + Vec3::z() * sin) * 0.12;
        panels.push([
            start + along * 0.004,
            end - along * 0.004,
            end - along * 0.004 + out,
            start + along * 0.004 + out,
        ]);
    }
    panels
}

fn hit(panel: &Panel, ray: &Vec3) -> Option<f64> {
    let normal = (panel[1] - panel[0]).cross(&(panel[3] - panel[0]));
    let range = normal.dot(&(panel[0] - EYE)) / normal.dot(ray);
    let point = EYE + ray * range;
    let inside = (0..4).all(|k| (panel[(k + 1) % 4] - panel[k]).cross(&(point - panel[k])).dot(&normal) >= 0.0);
    (range > 0.0 && inside).then_some(range)
}

/// The camera's frame: x right, y down, z forward.
fn camera_axes() -> [Vec3; 3] {
    let forward = (Vec3::new(0.0, 0.0, 0.1) - EYE).normalize();
    let right = forward.cross(&Vec3::z()).normalize();
    [right, forward.cross(&right), forward]
}

fn look(panels: &[Panel]) -> Vec<[f32; 3]> {
    let [right, down, forward] = camera_axes();
    let point = |pixel: usize| {
        let (u, v) = ((pixel % WIDTH) as f64 - 239.5, (pixel / WIDTH) as f64 - 179.5);
        let ray = right * (u / FOCAL_PX) + down * (v / FOCAL_PX) + forward;
        let range = panels.iter().filter_map(|panel| hit(panel, &ray)).fold(f64::INFINITY, f64::min);
        let z = if range.is_finite() { range } else { f64::NAN };
        [(u / FOCAL_PX * z) as f32, (v / FOCAL_PX * z) as f32, z as f32]
    };
    (0..WIDTH * HEIGHT).map(point).collect()
}

fn understood(points: &[[f32; 3]]) -> Answer {
    inferred(points, &model()).1
}

fn model() -> ObjectModel {
    let template = Template::from_toml(include_str!("../../src/boxwright/models/templates/exact/carton.toml")).unwrap();
    let weights = Weights::from_json(&common::unit_weights(&template, 0.0), &template).unwrap();
    ObjectModel::new(template, weights, &SearchSettings::default().staged)
}

fn inferred(points: &[[f32; 3]], model: &ObjectModel) -> (Scene, Answer) {
    let cloud = CloudView { points, width: WIDTH, height: HEIGHT, viewpoint: Some(Vec3::zeros()) };
    let scene = boxwright_core::perception::perceive(&cloud, &PerceptionSettings::default()).unwrap();
    assert!(scene.support.is_some(), "the floor was overlooked");
    let (search, bodies) = (SearchSettings::default(), Bodies::Fitted(&cloud, None, &[]));
    let models = std::slice::from_ref(model);
    infer(&cloud, &PerceptionSettings::default(), models, &search, bodies, &Kinds::default()).unwrap()
}

mod common;

#[test]
fn a_box_of_exact_panels_is_measured() {
    let mut measured = 0;
    for positions in [[150.0, 110.0, 60.0, 200.0], [180.0, 90.0, 170.0, 35.0]] {
        let answer = understood(&look(&scene(positions)));
        let object = answer.objects.first().expect("no box");
        let [length, width, height] = object.dimensions.unwrap();
        for (value, truth) in [(length, LENGTH_M), (width, BREADTH_M), (height, TALL_M)] {
            assert!((value - truth).abs() < 0.008, "{value} for {truth}");
        }
        for joint in object.joints.iter().filter(|joint| joint.child.starts_with("flap")) {
            let error =
                positions.iter().map(|deg| (joint.position - deg.to_radians()).abs()).fold(f64::INFINITY, f64::min);
            assert!(error < 0.04, "{} at {} rad", joint.child, joint.position);
            measured += 1;
        }
    }
    // Of the second box's flap 3 most stands behind flap 1.
    assert_eq!(measured, 7);
}

#[test]
fn flaps_that_hang_into_the_box_or_far_down_are_found() {
    let mut found = 0;
    for positions in [[120.0, 120.0, -30.0, 120.0], [-20.0, 120.0, 150.0, 120.0], [120.0, -40.0, 120.0, 240.0]] {
        let answer = understood(&look(&scene(positions)));
        let object = answer.objects.first().expect("no box");
        let told: Vec<f64> =
            object.joints.iter().filter(|j| j.child.starts_with("flap")).map(|j| j.position.to_degrees()).collect();
        for deg in positions.iter().filter(|deg| **deg < 0.0) {
            assert!(told.iter().any(|at| (at - deg).abs() < 3.0), "{deg} of {told:?}");
            found += 1;
        }
    }
    assert_eq!(found, 3);
}

#[test]
fn a_box_whose_fit_is_refused_is_no_object() {
    // Sheared by more than any box's sides are off square; without an image the body is fitted to an assignment.
    let shear = |p: &Vec3| Vec3::new(p.x + 0.55 * p.y, p.y, p.z);
    let sheared: Vec<Panel> =
        scene([150.0, 110.0, 60.0, 200.0]).iter().map(|panel| panel.each_ref().map(shear)).collect();
    let points: Vec<[f32; 3]> = look(&sheared).into_iter().filter(|p| p[2].is_finite()).collect();
    let cloud = CloudView { points: &points, width: points.len(), height: 1, viewpoint: Some(Vec3::zeros()) };
    let (search, bodies) = (SearchSettings::default(), Bodies::Fitted(&cloud, None, &[]));
    let answer =
        infer(&cloud, &PerceptionSettings::default(), &[model()], &search, bodies, &Kinds::default()).unwrap().1;
    assert!(answer.objects.is_empty(), "{:?}", answer.objects[0].dimensions);
    assert!(answer.part_of_point.iter().all(|part| *part == -1));
    assert!(answer.refused.iter().any(|line| line.contains("rack")), "{:?}", answer.refused);
}

#[test]
fn the_same_readings_give_the_same_box() {
    let points = look(&scene([150.0, 110.0, 60.0, 200.0]));
    let (one, other) = (understood(&points), understood(&points));
    assert_eq!(one.objects, other.objects);
    assert_eq!(one.part_of_point, other.part_of_point);
    assert!(one.part_of_point.iter().any(|part| *part >= 0));
}

#[test]
fn a_box_is_told_what_its_assignment_scores() {
    let mut cases = 0;
    for positions in [[150.0, 110.0, 60.0, 200.0], [180.0, 90.0, 170.0, 35.0]] {
        let model = model();
        let (scene, answer) = inferred(&look(&scene(positions)), &model);
        let set = SegmentSet::by_group(&scene).into_iter().max_by_key(SegmentSet::len).unwrap();
        let of_part = |part: usize| {
            let is_its = |point: &&u32| answer.part_of_point[**point as usize] == part as i16;
            let held = |member: usize| scene.segments.points_of(set.scene_index[member]).iter().filter(is_its).count();
            (0..set.len()).max_by_key(|&member| held(member)).filter(|&member| held(member) > 0)
        };
        let assignment: Vec<_> = (0..model.template.parts.len()).map(of_part).collect();
        let each_once = assignment.iter().flatten().collect::<std::collections::BTreeSet<_>>().len();
        assert_eq!(each_once, assignment.iter().flatten().count(), "two parts share a segment");
        assert!(each_once >= 4, "{assignment:?}");
        let expected = FoundObject::of_assignment(&model, &set, assignment).candidate.score;
        let told = answer.features[0].of_box["assignment"];
        // Whichever way round a carton is told, it scores the same.
        assert!((told - expected).abs() < 1e-9, "{told} for {expected}");
        cases += 1;
    }
    assert_eq!(cases, 2);
}
