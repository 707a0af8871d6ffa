/// phi 3 (eq. 4): a part that has a segment counts one; empty parts count 0 for every feature.
pub fn value() -> f64 {
    1.0
}
