use crate::arm::JointPositions;

/// A curve through postures with a continuous second derivative: a cubic spline for each joint over the way's length, at rest in
/// neither derivative at its ends (natural). The parameter is the sum of the widest turns, rad.
pub struct Spline {
    knots: Vec<f64>,
    values: Vec<JointPositions>,
    /// Second derivatives at the knots.
    curvatures: Vec<JointPositions>,
}

/// Postures nearer than this to the one before (widest turn, rad) add nothing to a way but noise.
const SAME_RAD: f64 = 1e-7;

impl Spline {
    /// None where the postures are fewer than two once those that repeat are left out.
    pub fn through(way: &[JointPositions]) -> Option<Self> {
        let mut values: Vec<JointPositions> = Vec::with_capacity(way.len());
        let mut knots: Vec<f64> = Vec::with_capacity(way.len());
        for posture in way {
            match values.last() {
                Some(last) => {
                    let turn = super::widest_turn(last, posture);
                    if turn > SAME_RAD {
                        knots.push(knots[knots.len() - 1] + turn);
                        values.push(*posture);
                    }
                }
                None => {
                    knots.push(0.0);
                    values.push(*posture);
                }
            }
        }
        if values.len() < 2 {
            return None;
        }
        // The ends are the way's own, to the last bit.
        let last = values.len() - 1;
        values[last] = way[way.len() - 1];
        let curvatures = curvatures(&knots, &values);
        Some(Self { knots, values, curvatures })
    }

    pub fn length(&self) -> f64 {
        self.knots[self.knots.len() - 1]
    }

    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// Value, first and second derivative of each joint.
    pub fn at(&self, place: f64) -> [JointPositions; 3] {
        let k = self.knots.partition_point(|&knot| knot <= place).clamp(1, self.knots.len() - 1) - 1;
        let width = self.knots[k + 1] - self.knots[k];
        let after = ((place - self.knots[k]) / width).clamp(0.0, 1.0);
        let rest = 1.0 - after;
        // Weights of the knots' values p, q and curvatures c, d.
        let mixed = |weights: [f64; 4]| {
            let mut made = self.values[k];
            for (j, value) in made.iter_mut().enumerate() {
                let (p, q) = (self.values[k][j], self.values[k + 1][j]);
                let (c, d) = (self.curvatures[k][j], self.curvatures[k + 1][j]);
                *value = weights[0] * p + weights[1] * q + weights[2] * c + weights[3] * d;
            }
            made
        };
        let (sixth, slope) = (width / 6.0, 1.0 / width);
        let cubic = |share: f64| sixth * width * (share.powi(3) - share);
        [
            mixed([rest, after, cubic(rest), cubic(after)]),
            mixed([-slope, slope, sixth * (1.0 - 3.0 * rest * rest), sixth * (3.0 * after * after - 1.0)]),
            mixed([0.0, 0.0, rest, after]),
        ]
    }
}

/// Second derivatives of natural cubic splines at their knots (Thomas' algorithm).
fn curvatures(knots: &[f64], values: &[JointPositions]) -> Vec<JointPositions> {
    let count = knots.len();
    let mut found = vec![JointPositions::zeros(values[0].len()); count];
    let width = |k: usize| knots[k + 1] - knots[k];
    for j in 0..values[0].len() {
        let slope = |k: usize| (values[k + 1][j] - values[k][j]) / width(k);
        let (mut upper, mut right) = (vec![0.0; count], vec![0.0; count]);
        for k in 1..count - 1 {
            let pivot = 2.0 * (width(k - 1) + width(k)) - width(k - 1) * upper[k - 1];
            upper[k] = width(k) / pivot;
            right[k] = (6.0 * (slope(k) - slope(k - 1)) - width(k - 1) * right[k - 1]) / pivot;
        }
        for k in (1..count - 1).rev() {
            found[k][j] = right[k] - upper[k] * found[k + 1][j];
        }
    }
    found
}
