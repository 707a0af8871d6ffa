use super::*;
use crate::geometry::{Rigid, SplitMix64, Vec3};

const VIPER: &str = include_str!("../../../src/boxwright/robots/data/viper_s850.toml");

fn viper() -> Arm {
    Arm::from_toml(VIPER).unwrap()
}

/// Positions within the limits, drawn evenly.
fn drawn(arm: &Arm, rng: &mut SplitMix64) -> JointPositions {
    let mut positions = JointPositions::zeros(arm.axes());
    for (k, joint) in arm.joints.iter().enumerate() {
        positions[k] = joint.lower_rad + (joint.upper_rad - joint.lower_rad) * rng.unit();
    }
    positions
}

fn off(a: &Rigid, b: &Rigid) -> f64 {
    (a.translation - b.translation).norm().max((a.rotation - b.rotation).norm())
}

#[test]
fn the_ready_pose_is_where_its_data_sheet_has_it() {
    let arm = viper();
    let flange = arm.flange(&arm.ready);
    assert!((flange.translation - Vec3::new(0.560, 0.0, 0.790)).norm() < 1e-12);
    assert!((flange.rotation.column(2) - Vec3::x()).norm() < 1e-12);
    assert!((arm.forward(&arm.ready).translation - Vec3::new(0.710, 0.0, 0.790)).norm() < 1e-12);
}

#[test]
fn the_inverse_holds_the_position_it_was_made_from() {
    let arm = viper();
    let mut rng = SplitMix64::new(7);
    let (mut solutions, mut missed) = (0, 0);
    for _ in 0..100_000 {
        let positions = drawn(&arm, &mut rng);
        let tool = arm.forward(&positions);
        let found = arm.inverse(&tool);
        for solution in &found {
            assert!(arm.limit_violation(&solution.positions).is_none());
            assert!(off(&arm.forward(&solution.positions), &tool) < 1e-9);
        }
        solutions += found.len();
        let same = |s: &Solution| s.positions.iter().zip(positions.iter()).all(|(a, b)| (a - b).abs() < 1e-6);
        missed += usize::from(!found.iter().any(same));
    }
    assert!(solutions > 100_000, "{solutions}");
    assert_eq!(missed, 0);
}
