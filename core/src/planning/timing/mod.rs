//! Times for ways: as fast as speeds and accelerations allow, from rest to rest.

mod spline;
mod topp;

pub use spline::Spline;
pub use topp::{fastest, Bounds, Profile};

use super::transit::widest_turn;
use crate::arm::JointPositions;

/// A timed piece: samples from time 0, the motion between which is the cubic through their positions and velocities.
#[derive(Debug, Clone)]
pub struct Timed {
    pub times_s: Vec<f64>,
    pub positions: Vec<JointPositions>,
    pub velocities: Vec<JointPositions>,
    /// The place on the way of each sample: 0 at its first posture, 1 at its last, by widest turns.
    pub shares: Vec<f64>,
}

/// Between two moments at which limits are checked, s.
const CHECK_S: f64 = 0.001;

/// Times a way from rest to rest with a sample every `period_s`. `cap_sq` bounds the squared path speed (widest turns, rad/s) at a
/// place. None where nothing moves.
pub fn time(way: &[JointPositions], bounds: &[Bounds], period_s: f64, cap_sq: impl Fn(f64) -> f64) -> Option<Timed> {
    let spline = Spline::through(way)?;
    let profile = fastest(&spline, bounds, cap_sq);
    let mut timed = sampled(&spline, &profile, period_s);
    timed.slow_down(timed.worst_ratio(bounds));
    Some(timed)
}

fn sampled(spline: &Spline, profile: &Profile, period_s: f64) -> Timed {
    let moments = moments(profile);
    let total_s = moments[moments.len() - 1];
    let count = (total_s / period_s).ceil().max(1.0) as usize;
    let mut timed = Timed { times_s: Vec::new(), positions: Vec::new(), velocities: Vec::new(), shares: Vec::new() };
    let mut k = 0;
    for sample in 0..=count {
        let time_s = total_s * sample as f64 / count as f64;
        while k + 2 < moments.len() && moments[k + 1] < time_s {
            k += 1;
        }
        let (place, speed) =
            if sample == count { (spline.length(), 0.0) } else { within(profile, &moments, k, time_s) };
        let [value, mut slope, _] = spline.at(place);
        slope.iter_mut().for_each(|joint| *joint *= speed);
        timed.times_s.push(time_s);
        timed.positions.push(value);
        timed.velocities.push(slope);
        timed.shares.push(place / spline.length());
    }
    timed
}

/// Place and path speed at a time within the profile's step k.
fn within(profile: &Profile, moments: &[f64], k: usize, time_s: f64) -> (f64, f64) {
    let width = profile.places[k + 1] - profile.places[k];
    let acceleration = (profile.speeds_sq[k + 1] - profile.speeds_sq[k]) / (2.0 * width);
    let start = profile.speeds_sq[k].sqrt();
    let passed = time_s - moments[k];
    let place = profile.places[k] + passed * (start + passed * acceleration / 2.0);
    (place.clamp(profile.places[k], profile.places[k + 1]), (start + passed * acceleration).max(0.0))
}

/// When each place is passed.
fn moments(profile: &Profile) -> Vec<f64> {
    let mut moments = vec![0.0];
    for k in 0..profile.places.len() - 1 {
        let speeds = profile.speeds_sq[k].sqrt() + profile.speeds_sq[k + 1].sqrt();
        let width = profile.places[k + 1] - profile.places[k];
        moments.push(moments[k] + 2.0 * width / speeds.max(SLOWEST));
    }
    moments
}

/// No place is passed slower than this on a step's average: path speed, rad/s.
const SLOWEST: f64 = 1e-4;

impl Timed {
    pub fn duration_s(&self) -> f64 {
        self.times_s[self.times_s.len() - 1]
    }

    /// By how much the motion must be slowed for every speed and acceleration, a millisecond apart, to be within its bounds; at least 1.
    pub fn worst_ratio(&self, bounds: &[Bounds]) -> f64 {
        let mut worst: f64 = 1.0;
        for k in 0..self.times_s.len() - 1 {
            let span_s = self.times_s[k + 1] - self.times_s[k];
            let checks = (span_s / CHECK_S).ceil() as usize;
            for check in 0..=checks {
                let share = check as f64 / checks as f64;
                for (j, bound) in bounds.iter().enumerate() {
                    let (speed, acceleration) = self.derivatives(k, j, share, span_s);
                    worst = worst.max(speed.abs() / bound.speed);
                    worst = worst.max((acceleration.abs() / bound.acceleration).sqrt());
                }
            }
        }
        worst
    }

    /// Speed and acceleration of a joint within the cubic from sample k to the next.
    fn derivatives(&self, k: usize, j: usize, share: f64, span_s: f64) -> (f64, f64) {
        let slope = (self.positions[k + 1][j] - self.positions[k][j]) / span_s;
        let (v, w) = (self.velocities[k][j], self.velocities[k + 1][j]);
        let (quadratic, cubic) = (3.0 * slope - 2.0 * v - w, v + w - 2.0 * slope);
        let speed = v + share * (2.0 * quadratic + share * 3.0 * cubic);
        (speed, (2.0 * quadratic + 6.0 * share * cubic) / span_s)
    }

    fn slow_down(&mut self, ratio: f64) {
        if ratio <= 1.0 {
            return;
        }
        // A hair more, so that rounding stays within.
        let ratio = ratio * (1.0 + 1e-9);
        self.times_s.iter_mut().for_each(|time_s| *time_s *= ratio);
        self.velocities.iter_mut().flat_map(|row| row.iter_mut()).for_each(|velocity| *velocity /= ratio);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: [Bounds; 2] = [Bounds { speed: 2.0, acceleration: 8.0 }, Bounds { speed: 1.0, acceleration: 3.0 }];

    fn posture(a: f64, b: f64) -> JointPositions {
        JointPositions::from_slice(&[a, b])
    }

    #[test]
    fn a_straight_way_takes_the_time_of_a_trapezoid() {
        let timed = time(&[posture(0.0, 0.0), posture(3.0, 0.0)], &BOUNDS, 0.004, |_| f64::INFINITY).unwrap();
        // Up to 2 rad/s within 0.25 s and down again, 0.5 rad together, and 2.5 rad at top speed.
        assert!((timed.duration_s() - (0.5 + 1.25)).abs() < 0.03, "{}", timed.duration_s());
        assert!(timed.worst_ratio(&BOUNDS) <= 1.0);
    }

    #[test]
    fn a_curve_keeps_its_bounds_and_ends_at_rest() {
        let way: Vec<_> = (0..60).map(|k| posture((k as f64 * 0.1).sin(), (k as f64 * 0.17).cos())).collect();
        let timed = time(&way, &BOUNDS, 0.008, |_| f64::INFINITY).unwrap();
        assert!(timed.worst_ratio(&BOUNDS) <= 1.0);
        assert_eq!(timed.positions[0], way[0]);
        assert_eq!(timed.positions[timed.positions.len() - 1], way[59]);
        assert!(timed.velocities[0]
            .iter()
            .chain(timed.velocities[timed.velocities.len() - 1].iter())
            .all(|v| *v == 0.0));
    }

    #[test]
    fn a_cap_on_the_path_speed_is_kept() {
        let timed = time(&[posture(0.0, 0.0), posture(1.0, 0.0)], &BOUNDS, 0.004, |_| 0.01).unwrap();
        assert!(timed.velocities.iter().all(|row| row[0] <= 0.1 + 1e-9));
        // From rest and to rest the first and the last step of the grid are passed at half the speed.
        let expected_s = 10.0 + 2.0 * topp::MOST_STEP / 0.1;
        assert!((timed.duration_s() - expected_s).abs() < 0.05, "{}", timed.duration_s());
    }
}
