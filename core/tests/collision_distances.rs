//! Signed distances that can be said by hand, and what the quick questions must agree with. Random solids are held against coal in
//! `tests/oracles/test_collision_distances.py`.

use boxwright_core::collision::{clear_by, signed_distance_m, Capsule, HalfSpace, OrientedBox, Solid};
use boxwright_core::geometry::rigid::turn;
use boxwright_core::geometry::{Rigid, SplitMix64, Vec3};

const PAIRS: usize = 20_000;

fn between(rng: &mut SplitMix64, low: f64, high: f64) -> f64 {
    low + (high - low) * rng.unit()
}

fn point(rng: &mut SplitMix64, reach_m: f64) -> Vec3 {
    Vec3::from_fn(|_, _| between(rng, -reach_m, reach_m))
}

/// One of the three kinds, small enough to be apart as often as not.
fn random_solid(rng: &mut SplitMix64, kind: usize) -> Solid {
    match kind {
        0 => {
            let rotation = turn(&point(rng, 1.0).normalize(), between(rng, 0.0, 3.0));
            let half_m = Vec3::new(between(rng, 0.01, 0.2), between(rng, 0.01, 0.2), between(rng, 0.001, 0.05));
            Solid::Box(OrientedBox::new(Rigid::new(rotation, point(rng, 0.2)), half_m))
        }
        1 => {
            Solid::Capsule(Capsule { from: point(rng, 0.3), to: point(rng, 0.3), radius_m: between(rng, 0.005, 0.08) })
        }
        _ => Solid::HalfSpace(HalfSpace { normal: point(rng, 1.0).normalize(), distance_m: between(rng, -0.4, 0.1) }),
    }
}

fn moved(solid: &Solid, by: &Rigid) -> Solid {
    match solid {
        Solid::Box(b) => Solid::Box(OrientedBox::new(by.then(&b.base_from_box), b.half_m)),
        Solid::Capsule(c) => Solid::Capsule(Capsule { from: by.apply(&c.from), to: by.apply(&c.to), ..*c }),
        Solid::HalfSpace(h) => {
            let normal = by.rotation * h.normal;
            Solid::HalfSpace(HalfSpace { normal, distance_m: h.distance_m + normal.dot(&by.translation) })
        }
    }
}

#[test]
fn quick_questions_agree_with_distances_and_motions_change_nothing() {
    let mut rng = SplitMix64::new(1);
    let (mut apart, mut overlapping) = (0, 0);
    for n in 0..PAIRS {
        let (a, b) = (random_solid(&mut rng, n % 2), random_solid(&mut rng, n / 2 % 3));
        let distance_m = signed_distance_m(&a, &b);
        assert!((distance_m - signed_distance_m(&b, &a)).abs() < 1e-12);
        for asked_m in [distance_m - 1e-9, distance_m + 1e-9, 0.005] {
            assert_eq!(clear_by(&a, &b, asked_m), distance_m >= asked_m, "{distance_m} {asked_m} {a:?} {b:?}");
        }
        let by = Rigid::new(turn(&point(&mut rng, 1.0).normalize(), 2.0), point(&mut rng, 1.0));
        assert!((signed_distance_m(&moved(&a, &by), &moved(&b, &by)) - distance_m).abs() < 1e-12, "{a:?} {b:?}");
        apart += usize::from(distance_m > 0.0);
        overlapping += usize::from(distance_m <= 0.0);
    }
    assert!(apart + overlapping == PAIRS && apart.min(overlapping) > PAIRS / 5, "{apart} {overlapping}");
}

/// Boards square to one another, edge on edge and face on face: what boxes are full of, and random draws never show.
#[test]
fn aligned_boards() {
    let board = |x: f64, y: f64, z: f64, half: [f64; 3]| {
        Solid::Box(OrientedBox::new(Rigid::shift(Vec3::new(x, y, z)), Vec3::from(half)))
    };
    let floor = board(0.0, 0.0, 0.0, [0.2, 0.15, 0.002]);
    let cases = [
        (board(0.0, 0.0, 0.1, [0.01, 0.005, 0.04]), 0.058),
        (board(0.3, 0.25, 0.1, [0.05, 0.05, 0.03]), (0.05_f64.powi(2) * 2.0 + 0.068_f64.powi(2)).sqrt()),
        (board(0.3, 0.0, 0.0, [0.1, 0.1, 0.002]), 0.0),
        (board(0.0, 0.0, 0.041, [0.01, 0.005, 0.04]), -0.001),
        (board(0.0, 0.0, 0.0, [0.2, 0.15, 0.002]), -0.004),
    ];
    for (other, expected_m) in &cases {
        assert!((signed_distance_m(&floor, other) - expected_m).abs() < 1e-12, "{other:?}");
    }
    assert_eq!(cases.len(), 5);
}

#[test]
fn capsules_that_lie_along_and_across_a_board() {
    let board = Solid::Box(OrientedBox::new(Rigid::identity(), Vec3::new(0.2, 0.15, 0.002)));
    let capsule =
        |from: [f64; 3], to: [f64; 3]| Solid::Capsule(Capsule { from: from.into(), to: to.into(), radius_m: 0.01 });
    let cases = [
        (capsule([-0.1, 0.0, 0.05], [0.1, 0.0, 0.05]), 0.038),
        (capsule([0.0, 0.0, 0.05], [0.0, 0.0, 0.2]), 0.038),
        (capsule([0.0, 0.0, -0.05], [0.0, 0.0, 0.2]), -0.062),
        (capsule([0.0, 0.0, 0.0], [0.0, 0.0, 0.0]), -0.012),
        (capsule([-0.1, 0.0, 0.002], [0.1, 0.0, 0.002]), -0.01),
        (capsule([0.25, 0.0, 0.0], [0.4, 0.3, 0.0]), 0.04),
    ];
    for (capsule, expected_m) in &cases {
        assert!((signed_distance_m(&board, capsule) - expected_m).abs() < 1e-12, "{capsule:?}");
    }
    assert_eq!(cases.len(), 6);
}
