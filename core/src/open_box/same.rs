//! Whether two fitted boxes are one: whatever follows leads both to the same answer.

use super::grow::FoundBox;
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
