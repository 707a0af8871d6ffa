//! Whether two fitted boxes are one: whatever follows leads both to the same answer. And whether one is another with higher sides.

use super::found_box::FoundBox;
use crate::fit::layout;

/// Two are one whose numbers are nearer than these.
const SAME_M: f64 = 0.003;
const SAME_RAD: f64 = 0.02;
const SAME_FLAP_M: f64 = 0.008;
const SAME_FLAP_RAD: f64 = 0.05;

/// Where they stand, their sizes, which flaps they have and at what angles; whichever side is told first.
pub fn is_same(one: &FoundBox, other: &FoundBox) -> bool {
    (0..4).any(|turn| is_same_at(one, other, turn))
}

fn is_same_at(one: &FoundBox, other: &FoundBox, turn: usize) -> bool {
    let (a, b) = (&one.solution.body, &other.solution.body.turned(turn));
    let present = other.present.turned(turn);
    let apart = |place: usize| (a.get(place) - b.get(place)).abs();
    let (at, other_at) = (&a.input_from_object, &b.input_from_object);
    let stands = (at.translation.vector - other_at.translation.vector).norm() < SAME_M
        && at.rotation.angle_to(&other_at.rotation) < SAME_RAD;
    let is_as_large = [layout::LENGTH, layout::WIDTH, layout::HEIGHT].iter().all(|&place| apart(place) < SAME_M);
    let has_its_flap = |k: usize| {
        let flap = |number: usize| apart(layout::flap(k) + number);
        let is_alike = flap(layout::FLAP_ANGLE) < SAME_FLAP_RAD && flap(layout::FLAP_LENGTH) < SAME_FLAP_M;
        one.present.flaps[k] == present.flaps[k] && (!present.flaps[k] || is_alike)
    };
    stands && is_as_large && (0..4).all(has_its_flap)
}

/// What both are told as is this near.
const OUTLINE_M: f64 = 0.03;
const OUTLINE_RAD: f64 = 0.1;
/// Higher by less it is no other box.
const HIGHER_M: f64 = 0.015;

/// Whether the other stands where the one does, with sides that go on where those of the one end.
pub fn is_higher(other: &FoundBox, one: &FoundBox) -> bool {
    let is_higher_at = |turn: usize| {
        let (a, b) = (&one.solution.body, &other.solution.body.turned(turn));
        let (at, other_at) = (&a.input_from_object, &b.input_from_object);
        let near = |place: usize| (a.get(place) - b.get(place)).abs() < OUTLINE_M;
        (at.translation.vector - other_at.translation.vector).norm() < OUTLINE_M
            && at.rotation.angle_to(&other_at.rotation) < OUTLINE_RAD
            && near(layout::LENGTH)
            && near(layout::WIDTH)
            && b.get(layout::HEIGHT) > a.get(layout::HEIGHT) + HIGHER_M
    };
    (0..4).any(is_higher_at)
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, Isometry3, Translation3};

    use super::super::labels::{Labels, Present};
    use super::*;
    use crate::fit::{FittedBody, Parameters, Solution};

    /// A box of 0.4 x 0.3 x 0.2 m with a flap on side 1.
    fn found(change: impl Fn(&mut FittedBody), flaps: [bool; 4]) -> FoundBox {
        let mut numbers = Parameters::zeros();
        let lengths = [(layout::LENGTH, 0.4), (layout::WIDTH, 0.3), (layout::HEIGHT, 0.2)];
        lengths.iter().for_each(|&(place, length_m)| numbers[place] = length_m);
        numbers[layout::flap(1) + layout::FLAP_LENGTH] = 0.15;
        numbers[layout::flap(1) + layout::FLAP_ANGLE] = 2.0;
        let mut body = FittedBody { input_from_object: Isometry3::identity(), numbers };
        change(&mut body);
        let solution = Solution { body, covariance: DMatrix::zeros(0, 0).into(), motions: Vec::new() };
        let present = Present { flaps, ..Present::default() };
        FoundBox::unjudged(solution, present, Labels::default(), Vec::new(), 1.0)
    }

    #[test]
    fn boxes_are_one_whichever_side_is_told_first_and_not_where_a_flap_differs() {
        let flap = layout::flap(1);
        let one = found(|_| (), [false, true, false, false]);
        for turn in 0..4 {
            let present = one.present.turned(turn);
            let body = one.solution.body.turned(turn);
            assert!(is_same(&one, &found(|other| *other = body.clone(), present.flaps)), "{turn}");
        }
        type Change = fn(&mut FittedBody);
        let changes: [(Change, bool); 6] = [
            (|body| body.numbers[layout::LENGTH] += 0.002, true),
            (|body| body.numbers[layout::LENGTH] += 0.004, false),
            (|body| body.numbers[layout::flap(1) + layout::FLAP_ANGLE] += 0.04, true),
            (|body| body.numbers[layout::flap(1) + layout::FLAP_ANGLE] += 0.06, false),
            (|body| body.numbers[layout::flap(1) + layout::FLAP_LENGTH] -= 0.01, false),
            (|body| body.input_from_object.translation = Translation3::new(0.0, 0.0, 0.004), false),
        ];
        for (number, (change, expected)) in changes.into_iter().enumerate() {
            assert_eq!(is_same(&one, &found(change, one.present.flaps)), expected, "{number}");
        }
        // What a flap that is not there is like says nothing.
        let without = [false; 4];
        let bent = |body: &mut FittedBody| body.numbers[flap + layout::FLAP_ANGLE] = 0.3;
        assert!(is_same(&found(|_| (), without), &found(bent, without)));
        assert!(!is_same(&one, &found(|_| (), without)));
    }

    #[test]
    fn a_box_is_higher_whose_sides_go_on_upon_the_same_outline() {
        type Change = fn(&mut FittedBody);
        let changes: [(Change, bool); 6] = [
            (|body| body.numbers[layout::HEIGHT] += 0.06, true),
            (|body| body.numbers[layout::HEIGHT] += 0.01, false),
            (|body| body.numbers[layout::HEIGHT] -= 0.06, false),
            (|body| (body.numbers[layout::HEIGHT], body.numbers[layout::LENGTH]) = (0.26, 0.36), false),
            (|body| (body.numbers[layout::HEIGHT], body.numbers[layout::WIDTH]) = (0.26, 0.32), true),
            (
                |body| {
                    body.numbers[layout::HEIGHT] = 0.26;
                    body.input_from_object.translation = Translation3::new(0.05, 0.0, 0.0);
                },
                false,
            ),
        ];
        let one = found(|_| (), [false, true, false, false]);
        for (number, (change, expected)) in changes.into_iter().enumerate() {
            let other = found(change, [false; 4]);
            for turn in 0..4 {
                let turned = found(|body| *body = other.solution.body.turned(turn), [false; 4]);
                assert_eq!(is_higher(&turned, &one), expected, "{number} {turn}");
            }
        }
    }
}
