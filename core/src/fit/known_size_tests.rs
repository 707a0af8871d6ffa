//! Given sizes: the right one and way round is found, and conditioning is what one more residual each would do.

use nalgebra::{DMatrix, DVector, Isometry3};

use super::body::{FittedBody, Parameters};
use super::known_size::{best_match, best_match_within, outer_m, share_of_score, with_known_size, KnownSize};
use super::layout::{HEIGHT, LENGTH, PARAMETER_COUNT, THICKNESS, WIDTH};
use super::solve::Solution;

const SIGMA_M: f64 = 0.001;

fn size(name: &str, mm: [f64; 3]) -> KnownSize {
    KnownSize::new(name, mm.map(|length| length / 1e3)).unwrap()
}

fn solution(outer_mm: [f64; 3]) -> Solution {
    let mut numbers = Parameters::zeros();
    let [length, width, height] = outer_mm.map(|mm| mm / 1e3);
    (numbers[LENGTH], numbers[WIDTH], numbers[HEIGHT], numbers[THICKNESS]) =
        (length - 0.004, width - 0.004, height, 0.004);
    // Positive definite, with every number tied to every other.
    let root = DMatrix::from_fn(PARAMETER_COUNT, PARAMETER_COUNT, |i, j| {
        let off = ((i * 7 + j * 13) % 11) as f64 * 1e-4 - 5e-4;
        if i == j {
            2e-3 + off
        } else {
            off
        }
    });
    Solution {
        body: FittedBody { input_from_object: Isometry3::identity(), numbers },
        covariance: (&root * root.transpose() + DMatrix::identity(PARAMETER_COUNT, PARAMETER_COUNT) * 1e-7).into(),
        motions: Vec::new(),
    }
}

#[test]
fn the_right_size_is_found_whichever_way_round() {
    let sizes = [size("a", [400.0, 300.0, 200.0]), size("b", [310.0, 220.0, 90.0]), size("c", [405.0, 330.0, 150.0])];
    let orders = [[0, 1, 2], [1, 0, 2], [0, 2, 1], [2, 0, 1], [1, 2, 0], [2, 1, 0]];
    let mut counted = 0;
    for (number, one) in sizes.iter().enumerate() {
        for order in orders {
            let stands = order.map(|i| one.outer_m[i] + 0.003);
            let found = best_match_within(stands, 0.002, &sizes).unwrap();
            assert_eq!((found.size, found.is_met()), (number, true));
            assert_eq!(found.outer_m, order.map(|i| one.outer_m[i]));
            assert!(!best_match_within(stands.map(|m| m * 1.2), 0.002, &sizes).unwrap().is_met());
            counted += 1;
        }
    }
    assert_eq!(counted, 18);
    assert!(best_match(&solution([400.0, 300.0, 200.0]), &[]).is_none());
}

#[test]
fn conditioning_is_one_more_residual_for_each_dimension() {
    let mut counted = 0;
    for outer_mm in [[402.0, 297.0, 203.0], [298.0, 405.0, 199.0], [200.0, 301.0, 396.0]] {
        for scale in [1.0, 2.5] {
            let before = solution(outer_mm);
            let (after, found) = with_known_size(before.clone(), &[size("a", [200.0, 300.0, 400.0])], scale);
            let told = found.expect("it is of that size").outer_m;
            // By information: that of the fit, and that of three rules.
            let mut information = (&*before.covariance * (scale * scale)).try_inverse().unwrap();
            let mut gradient = DVector::zeros(PARAMETER_COUNT);
            for (i, places) in [vec![LENGTH, THICKNESS], vec![WIDTH, THICKNESS], vec![HEIGHT]].iter().enumerate() {
                let off = (told[i] - outer_m(&before.body)[i]) / (SIGMA_M * SIGMA_M);
                for &a in places {
                    gradient[a] += off;
                    places.iter().for_each(|&b| information[(a, b)] += 1.0 / (SIGMA_M * SIGMA_M));
                }
            }
            let covariance = information.try_inverse().unwrap();
            let step = &covariance * gradient;
            let error =
                (0..PARAMETER_COUNT).skip(6).map(|i| (after.body.numbers[i] - before.body.numbers[i] - step[i]).abs());
            assert!(error.fold(0.0, f64::max) < 1e-9);
            assert!((&*after.covariance * (scale * scale) - covariance).amax() < 1e-10);
            for (now, size) in outer_m(&after.body).iter().zip(told) {
                assert!((now - size).abs() < 0.003, "{now} {size}");
            }
            counted += 1;
        }
    }
    assert_eq!(counted, 6);
}

#[test]
fn a_box_of_another_size_stays_as_it_was_and_ranks_lower() {
    let before = solution([402.0, 297.0, 203.0]);
    let sizes = [size("a", [500.0, 300.0, 200.0])];
    let (after, found) = with_known_size(before.clone(), &sizes, 1.0);
    assert!(found.is_none());
    assert_eq!(after.body, before.body);
    let (other, same) = (best_match(&before, &sizes), best_match(&before, &[size("a", [402.0, 297.0, 203.0])]));
    assert!(share_of_score(other.as_ref()) < 0.81 && share_of_score(same.as_ref()) > 0.999);
    assert_eq!(share_of_score(None), 1.0);
}

#[test]
fn lengths_that_no_box_has_are_refused() {
    for outer_m in [[400.0, 300.0, 200.0], [0.4, 0.3, 0.0], [0.4, f64::NAN, 0.2], [0.4, -0.3, 0.2]] {
        let error = KnownSize::new("a", outer_m).unwrap_err().to_string();
        assert!(error.contains("\"a\"") && error.contains("in mm"), "{error}");
    }
}
