//! The shipped arms: forward kinematics against published tables, the inverse against the forward.

use boxwright_core::arm::{Arm, JointPositions, Solution};
use boxwright_core::geometry::rigid::rotation_vector;
use boxwright_core::geometry::{Rigid, SplitMix64, Vec3};
use nalgebra::Matrix3;

const VIPER: &str = include_str!("../../src/boxwright/robots/data/viper_s850.toml");
const KUKA: &str = include_str!("../../src/boxwright/robots/data/kuka_kr6_r700.toml");
const PANDA: &str = include_str!("../../src/boxwright/robots/data/franka_panda.toml");
const POSES: usize = 100_000;

fn arm(text: &str) -> Arm {
    Arm::from_toml(text).unwrap()
}

/// Positions within the limits, drawn evenly.
fn drawn(arm: &Arm, rng: &mut SplitMix64) -> JointPositions {
    let mut positions = JointPositions::zeros(arm.axes());
    for (k, joint) in arm.joints.iter().enumerate() {
        positions[k] = joint.lower_rad + (joint.upper_rad - joint.lower_rad) * rng.unit();
    }
    positions
}

/// How far two poses are apart: metres or radians, the larger.
fn apart(a: &Rigid, b: &Rigid) -> f64 {
    let turned = rotation_vector(&(a.rotation.transpose() * b.rotation)).norm();
    (a.translation - b.translation).norm().max(turned)
}

/// One joint by standard Denavit-Hartenberg parameters: metres and degrees.
fn denavit_hartenberg(theta_rad: f64, d_m: f64, a_m: f64, alpha_deg: f64) -> Rigid {
    let (st, ct) = theta_rad.sin_cos();
    let (sa, ca) = alpha_deg.to_radians().sin_cos();
    let rotation = Matrix3::new(ct, -st * ca, st * sa, st, ct * ca, -ct * sa, 0.0, sa, ca);
    Rigid::new(rotation, Vec3::new(a_m * ct, a_m * st, d_m))
}

/// ViSP's vpViper850: a, d in metres, alpha, theta's offset in degrees.
const VIPER_DH: [[f64; 4]; 6] = [
    [0.075, 0.335, -90.0, 0.0],
    [0.365, 0.0, 0.0, 0.0],
    [0.090, 0.0, -90.0, -180.0],
    [0.0, 0.405, 90.0, 0.0],
    [0.0, 0.0, -90.0, 0.0],
    [0.0, 0.080, 0.0, -180.0],
];

#[test]
fn the_viper_stands_where_its_denavit_hartenberg_table_has_it() {
    let arm = arm(VIPER);
    let mut rng = SplitMix64::new(1);
    for _ in 0..1_000 {
        let positions = drawn(&arm, &mut rng);
        let links = positions.iter().zip(VIPER_DH);
        let by_table = links.fold(Rigid::identity(), |base_from_link, (q, [a_m, d_m, alpha_deg, offset_deg])| {
            base_from_link.then(&denavit_hartenberg(q + f64::to_radians(offset_deg), d_m, a_m, alpha_deg))
        });
        assert!(apart(&arm.flange(&positions), &by_table) < 1e-12);
    }
}

#[test]
fn the_viper_reaches_and_rests_where_its_figures_have_it() {
    let arm = arm(VIPER);
    assert!((arm.flange(&arm.ready).translation - Vec3::new(0.560, 0.0, 0.790)).norm() < 1e-12);
    assert!((arm.flange(&arm.ready).rotation.column(2) - Vec3::x()).norm() < 1e-12);
    let opw = arm.opw.unwrap();
    let reach_m = opw.a1_m + opw.c2_m + opw.a2_m.hypot(opw.c3_m);
    assert!((reach_m - 0.8549).abs() < 5e-5);
    assert!((arm.forward(&arm.ready).translation - Vec3::new(0.710, 0.0, 0.790)).norm() < 1e-12);
}

/// Every solution is inside the limits and reaches the pose, and one of them is where the pose was made from.
fn inverse_undoes_forward(arm: &Arm, seed: u64, poses: usize) -> usize {
    let mut rng = SplitMix64::new(seed);
    let mut solutions = 0;
    for _ in 0..poses {
        let positions = drawn(arm, &mut rng);
        let tool = arm.forward(&positions);
        let found = arm.inverse(&tool);
        for solution in &found {
            assert_eq!(arm.limit_violation(&solution.positions), None);
            assert!(apart(&arm.forward(&solution.positions), &tool) < 1e-9);
        }
        let same = |s: &Solution| s.positions.iter().zip(positions.iter()).all(|(a, b)| (a - b).abs() < 1e-6);
        assert!(found.iter().any(same), "{positions:?}");
        solutions += found.len();
    }
    solutions
}

#[test]
fn the_inverse_undoes_the_forward() {
    let solutions = inverse_undoes_forward(&arm(VIPER), 7, POSES);
    assert!(solutions > 5 * POSES, "{solutions}");
    let solutions = inverse_undoes_forward(&arm(KUKA), 8, POSES / 10);
    assert!(solutions > 5 * POSES / 10, "{solutions}");
}

#[test]
fn what_the_numeric_inverse_finds_is_right_and_the_same_each_time() {
    let panda = arm(PANDA);
    let mut viper = arm(VIPER);
    viper.opw = None;
    for (arm, least) in [(panda, 90), (viper, 75)] {
        let mut rng = SplitMix64::new(9);
        let mut reached = 0;
        for _ in 0..100 {
            let tool = arm.forward(&drawn(&arm, &mut rng));
            let found = arm.inverse(&tool);
            assert_eq!(found, arm.inverse(&tool));
            for solution in &found {
                assert_eq!(arm.limit_violation(&solution.positions), None);
                assert!(apart(&arm.forward(&solution.positions), &tool) < 1e-8);
            }
            reached += usize::from(!found.is_empty());
        }
        assert!(reached >= least, "{}: {reached}", arm.name);
    }
}

#[test]
fn singular_poses_are_reached_and_marked() {
    let arm = arm(VIPER);
    let mut rng = SplitMix64::new(3);
    for _ in 0..1_000 {
        let mut wrist = drawn(&arm, &mut rng);
        wrist[4] = 0.0;
        let mut elbow = drawn(&arm, &mut rng);
        elbow[2] = (90.0_f64 + (90.0_f64).atan2(405.0).to_degrees()).to_radians();
        for (positions, is_wrist) in [(wrist, true), (elbow, false)] {
            let tool = arm.forward(&positions);
            let found = arm.inverse(&tool);
            assert!(!found.is_empty());
            for solution in &found {
                assert!(apart(&arm.forward(&solution.positions), &tool) < 1e-8);
            }
            let marked = |s: &Solution| if is_wrist { s.singular.wrist } else { s.singular.elbow };
            assert!(found.iter().any(marked));
        }
    }
}

#[test]
fn out_of_reach_is_no_solution() {
    let arm = arm(VIPER);
    let mut far = arm.forward(&arm.ready);
    far.translation.x = 1.2;
    assert!(arm.inverse(&far).is_empty());
    assert!(arm.branches(&far).is_empty());
}

#[test]
fn a_joint_that_is_too_short_is_named() {
    let arm = arm(VIPER);
    let mut behind = arm.ready;
    behind[0] = 175.0_f64.to_radians();
    let branches = arm.branches(&arm.forward(&behind));
    let facing = branches.iter().find(|b| (b.angles_rad[0] - behind[0]).abs() < 1e-6 && b.number & 4 == 0).unwrap();
    let (joint, short_rad) = arm.joint_short_of(facing).unwrap();
    assert_eq!(arm.joints[joint].name, "joint_1");
    assert!((short_rad.to_degrees() - 5.0).abs() < 1e-6);
}

#[test]
fn the_jacobian_is_the_slope_of_the_forward() {
    let arm = arm(VIPER);
    let mut rng = SplitMix64::new(5);
    const STEP_RAD: f64 = 1e-6;
    for _ in 0..200 {
        let positions = drawn(&arm, &mut rng);
        let jacobian = arm.jacobian(&positions);
        for k in 0..arm.axes() {
            let (mut low, mut high) = (positions, positions);
            low[k] -= STEP_RAD;
            high[k] += STEP_RAD;
            let (low, high) = (arm.forward(&low), arm.forward(&high));
            let moved = (high.translation - low.translation) / (2.0 * STEP_RAD);
            let turned = rotation_vector(&(high.rotation * low.rotation.transpose())) / (2.0 * STEP_RAD);
            assert!((moved - jacobian.fixed_view::<3, 1>(0, k)).norm() < 1e-8);
            assert!((turned - jacobian.fixed_view::<3, 1>(3, k)).norm() < 1e-8);
        }
    }
}

#[test]
fn refusals_name_the_key() {
    let cases = [
        ("version = 1", "version = 2", "version: is 2; this program reads 1"),
        (
            "limits_deg = [-170.0, 170.0]",
            "limits_deg = [170.0, -170.0]",
            "joint joint_1: limits_deg are [170.0, -170.0]",
        ),
        ("limits_deg = [-170.0, 170.0]\n", "", "missing field `limits_deg`"),
        ("speed_deg_per_s = 600.0", "speed_deg_per_s = 0.0", "joint joint_6: speed_deg_per_s holds 0"),
        ("signs = [1, 1, 1, 1, 1, 1]", "signs = [1, 1, 1, 1, 1, 2]", "opw: signs are"),
        ("[\"link_4\", \"link_6\"]", "[\"link_4\", \"link_9\"]", "may_touch: no link link_9; links are base, link_1"),
        ("ready_deg = [0.0", "ready_deg = [180.0", "ready_deg: joint_1 at 180 is outside its limits"),
        ("name = \"viper_s850\"", "name = \"viper s850\"", "name: is \"viper s850\""),
        ("name = \"link_1\"", "name = \"base\"", "link base: the name is taken"),
        ("limits_deg = [-190.0, 190.0]", "limits_deg = [-360.0, 360.0]", "be reached in 72 ways"),
    ];
    for (right, wrong, expected) in cases {
        let text = VIPER.replacen(right, wrong, 1);
        assert_ne!(text, VIPER, "{right}");
        let error = Arm::from_toml(&text).unwrap_err().to_string();
        assert!(error.contains(expected), "{error}");
        assert!(!error.contains('\n'), "{error}");
    }
    assert_eq!(cases.len(), 10);
}
