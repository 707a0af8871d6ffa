use super::patch::Patch;
use crate::geometry::Vec3;

/// A box may lean this much off the support's vertical, rad: on a book, on a ramp. Less than the first is none.
const LEANS_RAD: [f64; 2] = [0.025, 0.26];
/// Ways up nearer than this are one, rad.
const SAME_RAD: f64 = 0.03;
const MOST: usize = 5;
/// A face that tells a way up has so many readings, and reaches so far.
const LEAST_READINGS: f64 = 300.0;
const LEAST_REACH_M: f64 = 0.06;
/// Walls are square to each other within this (cosine).
const SQUARE_COS: f64 = 0.12;

/// The ways up that boxes may have, unit vectors, the vertical first: a leaning box shows it by two of its walls, or by its base.
pub fn ways_up(patches: &[Patch]) -> Vec<Vec3> {
    let vertical = Vec3::z();
    let leans = |up: &Vec3| (LEANS_RAD[0]..=LEANS_RAD[1]).contains(&up.dot(&vertical).clamp(-1.0, 1.0).acos());
    let large: Vec<&Patch> =
        patches.iter().filter(|p| p.readings >= LEAST_READINGS && reach_m(p) >= LEAST_REACH_M).collect();
    let mut votes: Vec<(Vec3, f64)> = Vec::new();
    for (i, a) in large.iter().enumerate() {
        if leans(&a.normal) {
            votes.push((a.normal, a.readings.sqrt()));
        }
        for b in &large[i + 1..] {
            if !a.is_upright(&vertical) || !b.is_upright(&vertical) || a.normal.dot(&b.normal).abs() > SQUARE_COS {
                continue;
            }
            let up = a.normal.cross(&b.normal).normalize();
            let up = if up.z < 0.0 { -up } else { up };
            if leans(&up) {
                votes.push((up, a.readings.min(b.readings).sqrt()));
            }
        }
    }
    let mut out = vec![vertical];
    while out.len() <= MOST {
        let near = |a: &Vec3, b: &Vec3| a.cross(b).norm() < SAME_RAD;
        let weight = |up: &Vec3| votes.iter().filter(|v| near(&v.0, up)).map(|v| v.1).sum::<f64>();
        let best =
            votes.iter().map(|v| (weight(&v.0), v.0)).fold((0.0, vertical), |a, b| if b.0 > a.0 { b } else { a });
        if best.0 <= 0.0 {
            break;
        }
        let sum: Vec3 = votes.iter().filter(|v| near(&v.0, &best.1)).map(|v| v.0 * v.1).sum();
        votes.retain(|v| !near(&v.0, &best.1));
        out.push(sum.normalize());
    }
    out
}

fn reach_m(patch: &Patch) -> f64 {
    let far = |from: &Vec3| patch.hull.iter().map(|corner| (corner - from).norm()).fold(0.0, f64::max);
    patch.hull.first().map_or(0.0, far)
}
