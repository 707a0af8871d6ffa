//! Time-optimal path parameterization by reachability analysis (H. Pham, Q.-C. Pham, "A New Approach to Time-Optimal Path
//! Parameterization Based on Reachability Analysis", T-RO 2018): with x the squared path speed and u the path acceleration, every
//! limit is linear in (u, x) (eq. 87). Backwards: the greatest x at each place from which the rest can be done. Forwards: as fast as that lets.
//!
//! Two variables and some fifteen bounds make each step's linear program a walk over their corners. The authors' library, toppra, is
//! the tests' oracle; here it would take most of the planning time and bring a plotting library along.

use super::spline::Spline;

/// What a joint may do on a piece, rad/s and rad/s^2.
#[derive(Debug, Clone, Copy)]
pub struct Bounds {
    pub speed: f64,
    pub acceleration: f64,
}

/// Squared path speeds at places along a way.
pub struct Profile {
    pub places: Vec<f64>,
    pub speeds_sq: Vec<f64>,
}

/// One bound low <= a u + b x <= high.
#[derive(Clone, Copy)]
struct Band {
    a: f64,
    b: f64,
    most: f64,
}

/// The fastest profile from rest to rest; `cap_sq` bounds the squared path speed at a place besides.
pub fn fastest(spline: &Spline, bounds: &[Bounds], cap_sq: impl Fn(f64) -> f64) -> Profile {
    let places = places(spline);
    let last = places.len() - 1;
    let points: Vec<(f64, Vec<Band>)> = places.iter().map(|&place| limits(spline, place, bounds, &cap_sq)).collect();
    let rows: Vec<(f64, Vec<Band>)> = (0..last).map(|k| step_limits(&points[k], &points[k + 1], &places, k)).collect();
    let mut most = vec![0.0; places.len()];
    for k in (0..last).rev() {
        let step = 2.0 * (places[k + 1] - places[k]);
        most[k] = greatest_start(&rows[k], step, most[k + 1]);
    }
    let mut speeds_sq = vec![0.0; places.len()];
    for k in 0..last {
        let step = 2.0 * (places[k + 1] - places[k]);
        let x = speeds_sq[k];
        let highest = rows[k].1.iter().filter(|band| band.a.abs() > FLAT).map(|band| {
            // a u <= most - b x and a u >= -most - b x, solved for the greater u.
            let sign = band.a.signum();
            (sign * band.most - band.b * x) / band.a
        });
        let u = highest.fold(f64::INFINITY, f64::min);
        speeds_sq[k + 1] = (x + step * u).clamp(0.0, most[k + 1]);
    }
    speeds_sq[last] = 0.0;
    Profile { places, speeds_sq }
}

/// Slopes below this bound nothing.
const FLAT: f64 = 1e-12;
/// Between two places of the profile, at most this share of the way, and at most half a knot.
pub(super) const MOST_STEP: f64 = 1.0 / 40.0;

fn places(spline: &Spline) -> Vec<f64> {
    let mut found = vec![0.0];
    for pair in spline.knots().windows(2) {
        let count = ((pair[1] - pair[0]) / (MOST_STEP * spline.length())).ceil().max(2.0) as usize;
        found.extend((1..=count).map(|k| pair[0] + (pair[1] - pair[0]) * k as f64 / count as f64));
    }
    found
}

/// The cap on x at a place, and the accelerations' bands.
fn limits(spline: &Spline, place: f64, bounds: &[Bounds], cap_sq: &impl Fn(f64) -> f64) -> (f64, Vec<Band>) {
    let [_, first, second] = spline.at(place);
    let mut cap = cap_sq(place);
    let mut bands = Vec::with_capacity(bounds.len());
    for (j, bound) in bounds.iter().enumerate() {
        if first[j].abs() > FLAT {
            cap = cap.min((bound.speed / first[j]).powi(2));
        }
        bands.push(Band { a: first[j], b: second[j], most: bound.acceleration });
    }
    (cap, bands)
}

/// The limits of a step: at its start, and at its end, where x has become x + step u (collocation at both).
fn step_limits(start: &(f64, Vec<Band>), end: &(f64, Vec<Band>), places: &[f64], k: usize) -> (f64, Vec<Band>) {
    let step = 2.0 * (places[k + 1] - places[k]);
    let at_end = end.1.iter().map(|band| Band { a: band.a + step * band.b, b: band.b, most: band.most });
    (start.0, start.1.iter().copied().chain(at_end).collect())
}

/// The greatest x in 0..cap for which some u keeps all bands and brings x + step u into 0..next.
///
/// For a fixed x the admissible u are an interval whose ends are linear in x: the greatest x is where a lower end meets an upper one.
fn greatest_start((cap, bands): &(f64, Vec<Band>), step: f64, next: f64) -> f64 {
    // Ends of the interval as (constant, slope): u >= c + s x, u <= c + s x.
    let mut lower = vec![(0.0, -1.0 / step)];
    let mut upper = vec![(next / step, -1.0 / step)];
    let mut most = *cap;
    for band in bands {
        if band.a.abs() <= FLAT {
            if band.b.abs() > FLAT {
                most = most.min(band.most / band.b.abs());
            }
            continue;
        }
        let slope = -band.b / band.a;
        let reach = band.most / band.a.abs();
        lower.push((-reach, slope));
        upper.push((reach, slope));
    }
    for &(low, low_slope) in &lower {
        for &(high, high_slope) in &upper {
            // low + low_slope x <= high + high_slope x, where high >= low: x = 0 always does.
            if low_slope > high_slope {
                most = most.min((high - low) / (low_slope - high_slope));
            }
        }
    }
    most.max(0.0)
}
