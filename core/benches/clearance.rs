//! What a planner's questions cost: `cargo bench -p boxwright-core --bench clearance`. Nanoseconds a question, the best of some
//! rounds, one thread: the Viper s850 at 4,000 poses around an open carton with three things beside it.

use std::hint::black_box;
use std::time::Instant;

use boxwright_core::arm::{Arm, JointPositions};
use boxwright_core::collision::{ArmPieces, Checker, HalfSpace, OrientedBox, Rules, Solid, World};
use boxwright_core::geometry::rigid::turn;
use boxwright_core::geometry::{Rigid, SplitMix64, Vec3};

const VIPER: &str = include_str!("../../src/boxwright/robots/data/viper_s850.toml");
const POSES: usize = 4_000;
const ROUNDS: usize = 7;
const CLEARANCE_M: f64 = 0.005;

fn main() {
    let arm = Arm::from_toml(VIPER).expect("the shipped arm reads");
    let world = world();
    let rules = Rules::new(&arm, &world, CLEARANCE_M);
    let pieces = ArmPieces::new(&arm, 0.0);
    let checker = Checker { arm: &arm, pieces: &pieces, world: &world };
    let poses = poses(&arm);
    let tools: Vec<Rigid> = poses.iter().map(|q| arm.forward(q)).collect();
    let (clear, blocked): (Vec<JointPositions>, Vec<JointPositions>) =
        poses.iter().copied().partition(|q| checker.is_clear(q, &rules));
    println!("{} things, {} poses, {} of them clear", world.obstacles().len(), poses.len(), clear.len());
    time("forward", &poses, |q| arm.forward(q).translation.x);
    time("inverse", &tools, |tool| arm.inverse(tool).len() as f64);
    time("place the arm's pieces", &poses, |q| pieces.place(&arm, q).len() as f64);
    time("is_clear, clear poses", &clear, |q| f64::from(checker.is_clear(q, &rules)));
    time("is_clear, blocked poses", &blocked, |q| f64::from(checker.is_clear(q, &rules)));
    time("nearest, clear poses", &clear, |q| checker.nearest(q, &rules).map_or(0.0, |n| n.distance_m));
    time("nearest, blocked poses", &blocked, |q| checker.nearest(q, &rules).map_or(0.0, |n| n.distance_m));
}

fn time<T>(what: &str, over: &[T], ask: impl Fn(&T) -> f64) {
    let round = || {
        let start = Instant::now();
        black_box(over.iter().map(|item| black_box(ask(item))).sum::<f64>());
        start.elapsed().as_nanos() as f64 / over.len() as f64
    };
    println!("{what:26} {:8.0} ns", (0..ROUNDS).map(|_| round()).fold(f64::INFINITY, f64::min));
}

/// A carton 0.4 x 0.3 x 0.25 m before the arm, its flaps each at another angle, on a table; a post, a fence, another box.
fn world() -> World {
    let mut world = World::default();
    world.add("support", Solid::HalfSpace(HalfSpace { normal: Vec3::z(), distance_m: -0.2 }));
    let centre = Vec3::new(0.55, 0.1, -0.2);
    let (half_x, half_y, height, board) = (0.2, 0.15, 0.25, 0.002);
    let mut add = |name: String, at: Vec3, rotation: nalgebra::Matrix3<f64>, half: Vec3| {
        world.add(name, Solid::Box(OrientedBox::new(Rigid::new(rotation, centre + at), half)));
    };
    let straight = nalgebra::Matrix3::identity();
    add("base".into(), Vec3::z() * board, straight, Vec3::new(half_x, half_y, board));
    for (k, flap_angle_deg) in [100.0_f64, 150.0, 200.0, 235.0].into_iter().enumerate() {
        let quarter = turn(&Vec3::z(), k as f64 * std::f64::consts::FRAC_PI_2);
        let (along, out) = if k % 2 == 0 { (half_x, half_y) } else { (half_y, half_x) };
        let side = quarter * Vec3::new(0.0, -out, height / 2.0);
        add(format!("side_{k}"), side, quarter, Vec3::new(along, board, height / 2.0));
        let angle = flap_angle_deg.to_radians();
        let (sin, cos) = angle.sin_cos();
        let flap = quarter * Vec3::new(0.0, -out + 0.075 * cos, height + 0.075 * sin);
        add(format!("flap_{k}"), flap, quarter * turn(&Vec3::x(), angle), Vec3::new(along, 0.075, board));
    }
    add("post".into(), Vec3::new(-0.2, 0.5, 0.4), straight, Vec3::new(0.03, 0.03, 0.4));
    add("fence".into(), Vec3::new(0.5, 0.0, 0.4), straight, Vec3::new(0.01, 0.6, 0.4));
    add("other box".into(), Vec3::new(0.0, -0.45, 0.1), straight, Vec3::new(0.15, 0.1, 0.1));
    world
}

/// Positions that hold the tool near the carton: what a planner asks about.
fn poses(arm: &Arm) -> Vec<JointPositions> {
    let mut rng = SplitMix64::new(11);
    let mut poses = Vec::new();
    while poses.len() < POSES {
        let mut between = |low: f64, high: f64| low + (high - low) * rng.unit();
        let at = Vec3::new(between(0.3, 0.8), between(-0.2, 0.4), between(-0.05, 0.3));
        let rotation = turn(&Vec3::z(), between(-3.0, 3.0)) * turn(&Vec3::y(), between(1.2, 3.1));
        poses.extend(arm.inverse(&Rigid::new(rotation, at)).iter().take(2).map(|solution| solution.positions));
    }
    poses
}
