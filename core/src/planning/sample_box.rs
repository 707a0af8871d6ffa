//! Boxes that tests of planning share.

use serde_json::json;

use super::problem::{BoxProblem, MeasuredBox};

const THICKNESS_M: f64 = 0.004;

/// A box of 0.4 by 0.3 by 0.2 m with flaps upright: so much narrower than their sides at each end, and so long.
pub fn carton(narrower_m: f64, lengths_m: [f64; 4]) -> BoxProblem {
    tapered(narrower_m, 0.0, lengths_m)
}

/// The same with flaps that much narrower again at each end of their free edges.
pub fn tapered(narrower_m: f64, taper_m: f64, lengths_m: [f64; 4]) -> BoxProblem {
    let rim = [[0.0, 0.0], [0.4, 0.0], [0.4, 0.3], [0.0, 0.3]];
    let mut sides = Vec::new();
    let mut flaps = Vec::new();
    for k in 0..4 {
        let ends = [rim[k], rim[(k + 1) % 4]];
        let at = |share: f64, z: f64| -> [f64; 3] {
            std::array::from_fn(|i| if i == 2 { z } else { ends[0][i] + (ends[1][i] - ends[0][i]) * share })
        };
        let length_m = f64::hypot(ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]);
        let (start, end) = (narrower_m / length_m, 1.0 - narrower_m / length_m);
        let taper = taper_m / length_m;
        let side =
            json!({"name": format!("side_{k}"), "corners": [at(0.0, 0.2), at(1.0, 0.2), at(1.0, 0.0), at(0.0, 0.0)]});
        let top = 0.2 + lengths_m[k];
        let along: [f64; 3] = std::array::from_fn(|i| if i == 2 { 0.0 } else { (ends[1][i] - ends[0][i]) / length_m });
        let flap = json!({
            "name": format!("flap_{k}"), "side": format!("side_{k}"), "standing": "seen", "origin": at(0.5, 0.2), "axis": along,
            "position_rad": std::f64::consts::FRAC_PI_2, "corners": [at(start, 0.2), at(end, 0.2), at(end - taper, top), at(start + taper, top)],
        });
        sides.push(side);
        flaps.push(flap);
    }
    let told = json!({"thickness_m": THICKNESS_M, "fixed": sides, "flaps": flaps, "support": null});
    serde_json::from_value::<MeasuredBox>(told).unwrap().into_problem().unwrap()
}
