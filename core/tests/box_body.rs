//! The open box's body against a box that was made by hand.

mod common;

use std::f64::consts::PI;

use boxwright_core::body::ObjectAnswer;
use boxwright_core::geometry::{Rectangle, Vec3};
use boxwright_core::inference::{ObjectModel, SearchSettings};
use boxwright_core::model::{Template, Weights};
use boxwright_core::pipeline::{understand, Bodies};
use common::{carton_rectangles, scene, unit_weights};

const CARTON: &str = include_str!("../../src/boxwright/models/templates/carton.toml");

fn infer(rectangles: Vec<Rectangle>) -> ObjectAnswer {
    let template = Template::from_toml(CARTON).unwrap();
    let weights = Weights::from_json(&unit_weights(&template, 0.5), &template).unwrap();
    let settings = SearchSettings::default();
    let model = ObjectModel::new(template, weights, &settings.staged);
    let count = 10 * rectangles.len();
    let mut answer = understand(&scene(rectangles), count, &[model], &settings, Bodies::Rectangles).unwrap();
    assert_eq!(answer.objects.len(), 1);
    answer.objects.remove(0)
}

fn near(a: [f64; 3], b: [f64; 3], tolerance: f64) -> bool {
    (Vec3::from(a) - Vec3::from(b)).norm() < tolerance
}

#[test]
fn a_whole_carton_comes_back_at_every_flap_angle() {
    let mut cases = 0;
    for angle_deg in (20..=230).step_by(15) {
        let angle = f64::from(angle_deg).to_radians();
        let object = infer(carton_rectangles(angle));
        let dimensions = object.dimensions.unwrap();
        assert!(near(dimensions, [0.4, 0.3, 0.2], 1e-6), "{dimensions:?}");
        assert!(near(object.pose.as_ref().unwrap().position, [0.0, 0.0, 0.0], 1e-6));
        assert_eq!(object.joints.len(), 4, "at {angle_deg} degrees");
        for joint in &object.joints {
            assert!((joint.position - angle).abs() < 1e-6, "{} at {angle_deg}", joint.position.to_degrees());
        }
        // Side 0 is a longer side, nearest to the viewpoint: the one at y = -0.15, from -x to +x.
        let side_0 = object.parts[1].corners.unwrap();
        assert!(near(side_0[0], [-0.2, -0.15, 0.2], 1e-6) && near(side_0[1], [0.2, -0.15, 0.2], 1e-6), "{side_0:?}");
        assert!(near(side_0[2], [0.2, -0.15, 0.0], 1e-6) && near(side_0[3], [-0.2, -0.15, 0.0], 1e-6));
        assert!(near(object.joints[0].axis, [1.0, 0.0, 0.0], 1e-9));
        assert!(near(object.joints[1].axis, [0.0, 1.0, 0.0], 1e-9));
        let base = object.parts[0].corners.unwrap();
        assert!(near(base[0], [-0.2, -0.15, 0.0], 1e-6) && near(base[1], [0.2, -0.15, 0.0], 1e-6));
        cases += 1;
    }
    assert_eq!(cases, 15);
}

#[test]
fn hidden_sides_are_completed_and_marked() {
    // Every pair of neighbouring sides taken away, and each single one.
    let mut cases = 0;
    for hidden in [vec![1], vec![2], vec![3], vec![4], vec![1, 2], vec![2, 3], vec![3, 4], vec![4, 1], vec![1, 3]] {
        let mut rectangles = carton_rectangles(PI * 0.8);
        for &k in hidden.iter().rev().collect::<std::collections::BTreeSet<_>>().into_iter().rev() {
            rectangles.remove(k);
        }
        let object = infer(rectangles);
        assert!(near(object.dimensions.unwrap(), [0.4, 0.3, 0.2], 1e-6), "{hidden:?}: {:?}", object.dimensions);
        let unseen = object.parts.iter().filter(|part| !part.observed).count();
        assert_eq!(unseen, hidden.len(), "{hidden:?}");
        assert!(object.parts.iter().all(|part| part.corners.is_some()));
        cases += 1;
    }
    assert_eq!(cases, 9);
}

#[test]
fn a_turned_scene_gives_the_turned_model() {
    // Rotating everything about z by a quarter keeps the lengths; the pose turns along.
    let mut cases = 0;
    for step in 1..12 {
        let angle = f64::from(step) * PI / 6.0 + 0.1;
        let turn = nalgebra_rotation(angle);
        let rectangles: Vec<Rectangle> =
            carton_rectangles(2.0).into_iter().map(|r| Rectangle { corners: r.corners.map(|c| turn * c) }).collect();
        let object = infer(rectangles);
        assert!(near(object.dimensions.unwrap(), [0.4, 0.3, 0.2], 1e-6));
        for joint in &object.joints {
            assert!((joint.position - 2.0).abs() < 1e-6);
        }
        cases += 1;
    }
    assert_eq!(cases, 11);
}

fn nalgebra_rotation(angle: f64) -> nalgebra::Rotation3<f64> {
    nalgebra::Rotation3::from_axis_angle(&nalgebra::Vector3::z_axis(), angle)
}
