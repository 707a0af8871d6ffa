//! An arm in a world: rules for each pair, what is named, and that the quick question and the nearest pair agree.

use boxwright_core::arm::{Arm, JointPositions};
use boxwright_core::collision::{ArmPieces, Checker, HalfSpace, OrientedBox, Other, Rules, Solid, World, IGNORED};
use boxwright_core::geometry::{Rigid, SplitMix64, Vec3};

const VIPER: &str = include_str!("../../src/boxwright/robots/data/viper_s850.toml");

/// A board square before the closed fingers of the ready arm, `gap_m` beyond their tips, and a floor.
fn world(arm: &Arm, gap_m: f64) -> World {
    let tips = arm.forward(&arm.ready).translation;
    let board = OrientedBox::new(Rigid::shift(tips + Vec3::x() * (gap_m + 0.002)), Vec3::new(0.002, 0.1, 0.1));
    let mut world = World::default();
    world.add("flap", Solid::Box(board));
    world.add("floor", Solid::HalfSpace(HalfSpace { normal: Vec3::z(), distance_m: -0.05 }));
    world
}

#[test]
fn rules_say_who_may_touch_what() {
    let arm = Arm::from_toml(VIPER).unwrap();
    let world = world(&arm, 0.001);
    let pieces = ArmPieces::new(&arm, 0.0);
    let checker = Checker { arm: &arm, pieces: &pieces, world: &world };
    let mut rules = Rules::new(&arm, &world, 0.005);
    assert_eq!(checker.conflict(&arm.ready, &rules), Some((arm.fingers_body(), Other::Obstacle(0))));
    let nearest = checker.nearest(&arm.ready, &rules).unwrap();
    assert_eq!((arm.body_name(nearest.body), checker.other_name(nearest.other)), ("fingers", "flap"));
    assert!((nearest.distance_m - 0.001).abs() < 1e-9 && (nearest.spare_m + 0.004).abs() < 1e-9);
    rules.set(arm.fingers_body(), 0, 0.0);
    assert!(checker.is_clear(&arm.ready, &rules));
    rules.set_obstacle(0, 0.2);
    assert!(!checker.is_clear(&arm.ready, &rules));
    rules.set_obstacle(0, IGNORED);
    assert!(checker.is_clear(&arm.ready, &rules));
    rules.set_body(arm.gripper_body(), 10.0);
    assert_eq!(checker.conflict(&arm.ready, &rules).map(|(body, _)| body), Some(arm.gripper_body()));
}

#[test]
fn things_move() {
    let arm = Arm::from_toml(VIPER).unwrap();
    let mut world = world(&arm, 0.1);
    let pieces = ArmPieces::new(&arm, 0.0);
    let rules = Rules::new(&arm, &world, 0.005);
    assert!(Checker { arm: &arm, pieces: &pieces, world: &world }.is_clear(&arm.ready, &rules));
    let nearer = self::world(&arm, -0.01).obstacles()[0].solid;
    world.replace(0, nearer);
    let checker = Checker { arm: &arm, pieces: &pieces, world: &world };
    assert!((checker.nearest(&arm.ready, &rules).unwrap().distance_m + 0.010).abs() < 1e-9);
    assert_eq!(world.index_of("flap"), Some(0));
}

#[test]
fn clear_is_when_the_nearest_has_something_to_spare() {
    let arm = Arm::from_toml(VIPER).unwrap();
    let world = world(&arm, 0.05);
    let mut rules = Rules::new(&arm, &world, 0.005);
    rules.set(0, 1, IGNORED);
    let mut rng = SplitMix64::new(2);
    let (mut clear, mut blocked) = (0, 0);
    for opening_m in [0.0, 0.08] {
        let pieces = ArmPieces::new(&arm, opening_m);
        let checker = Checker { arm: &arm, pieces: &pieces, world: &world };
        for _ in 0..2_000 {
            let drawn =
                arm.joints.iter().map(|joint| joint.lower_rad + (joint.upper_rad - joint.lower_rad) * rng.unit());
            let positions = JointPositions::from_slice(&drawn.collect::<Vec<_>>());
            let nearest = checker.nearest(&positions, &rules).unwrap();
            assert_eq!(checker.is_clear(&positions, &rules), nearest.spare_m >= 0.0);
            clear += usize::from(nearest.spare_m >= 0.0);
            blocked += usize::from(nearest.spare_m < 0.0);
        }
    }
    assert!(clear + blocked == 4_000 && clear.min(blocked) > 500, "{clear} {blocked}");
}
