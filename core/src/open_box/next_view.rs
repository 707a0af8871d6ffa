//! From where a hidden panel would be seen: the next view.

use super::evidence::Sheet;
use super::sight::Sight;
use crate::fit::{corners, FittedBody, Role};
use crate::free_space::Facet;
use crate::geometry::Vec3;

/// Directions that are tried: so many around, at these heights above the horizon, degrees, and straight down.
const AROUND: usize = 16;
const HEIGHTS_DEG: [f64; 5] = [15.0, 30.0, 45.0, 60.0, 75.0];
/// A panel is seen where this share of it is.
const ENOUGH: f64 = 0.7;
/// Where no view shows so much, the best will do if it shows this much.
const SOME: f64 = 0.35;
/// Faces that a ray meets under less than this (cosine) tell nothing.
const LEAST_COS: f64 = 0.2;
/// Points of a panel that are looked at, along and away from its hinge, and how far from its ends.
const ALONG: usize = 3;
const AWAY: usize = 3;
const END_SHARE: f64 = 0.12;
/// What lies nearer to a point than this is the panel's own neighbour at an edge, metres.
const OWN_M: f64 = 0.002;
/// Steps along a ray that looks for surfaces that the camera saw, from where and how far, metres.
const STEP_M: f64 = 0.02;
const FIRST_M: f64 = 0.03;
const FARTHEST_M: f64 = 0.6;
/// Halvings of the way from the present direction to the one found.
const HALVINGS: usize = 5;

/// What stands between a panel and a place.
pub struct Surroundings<'a> {
    /// The last of `sights`: where the camera is.
    sight: &'a Sight<'a>,
    sights: &'a [Sight<'a>],
    panels: Vec<(Role, Facet)>,
}

/// Points of a panel with its normals there, and what each counts; they sum to one.
struct Sample {
    point: Vec3,
    normal: Vec3,
    weight: f64,
}

impl<'a> Surroundings<'a> {
    /// Of a body with these panels, in the level frame; `None` without a view.
    pub fn new(sights: &'a [Sight<'a>], body: &FittedBody, roles: &[Role]) -> Option<Self> {
        let facet = |&role: &Role| Some((role, Facet::new(corners(body, role))?));
        Some(Self { sight: sights.last()?, sights, panels: roles.iter().filter_map(facet).collect() })
    }

    /// Unit vector, level frame, from the middle of a panel that may be posed in any of these ways (weighted) towards the place
    /// at the camera's distance that sees it, and is nearest to the camera's (eq. 95). `None` where nothing would show it.
    pub fn seen_from(&self, role: Role, poses: &[(FittedBody, f64)]) -> Option<Vec3> {
        let samples = samples(self.sight, role, poses);
        let middle: Vec3 = samples.iter().map(|s| s.point * s.weight).sum();
        let range_m = (self.sight.eye - middle).norm();
        let present = (self.sight.eye - middle) / range_m;
        let shown = |direction: &Vec3| self.share_seen(role, &samples, &(middle + direction * range_m));

        let mut best = (SOME, None);
        for direction in nearest_first(&present) {
            let share = shown(&direction);
            if share >= ENOUGH {
                return Some(nearer(&present, direction, |d| shown(d) >= ENOUGH));
            }
            if share > best.0 {
                best = (share, Some(direction));
            }
        }
        best.1
    }

    /// The share of the panel that a camera at `place` would see.
    fn share_seen(&self, role: Role, samples: &[Sample], place: &Vec3) -> f64 {
        let is_seen = |sample: &&Sample| {
            let way = place - sample.point;
            let (range_m, ray) = (way.norm(), way.normalize());
            let cos = ray.dot(&sample.normal);
            // Off the board's middle, on the side that is looked at.
            let start = sample.point + sample.normal * (OWN_M * cos.signum());
            cos.abs() > LEAST_COS
                && !self.panel_before(role, &start, &ray, range_m)
                && !self.sights.iter().any(|sight| surface_before(sight, &start, &ray))
        };
        samples.iter().filter(is_seen).map(|sample| sample.weight).sum()
    }

    fn panel_before(&self, role: Role, start: &Vec3, ray: &Vec3, range_m: f64) -> bool {
        let others = self.panels.iter().filter(|(other, _)| *other != role);
        others.filter_map(|(_, facet)| facet.hit_m(start, ray, 0.0)).any(|hit_m| hit_m > OWN_M && hit_m < range_m)
    }
}

/// Whether a ray goes through a surface that a view saw: from behind its readings to before them, or back, without a jump in
/// depth there.
fn surface_before(sight: &Sight, start: &Vec3, ray: &Vec3) -> bool {
    let mut last: Option<f64> = None;
    for step in 0..((FARTHEST_M - FIRST_M) / STEP_M) as usize {
        let at = start + ray * (FIRST_M + step as f64 * STEP_M);
        let reading = sight.index(&at).and_then(|index| sight.reading(index));
        let behind_m = reading.map(|p| (at - sight.eye).norm() - (p - sight.eye).norm());
        if let (Some(before), Some(now)) = (last, behind_m) {
            if before * now < 0.0 && before.abs().max(now.abs()) < 2.0 * STEP_M {
                return true;
            }
        }
        last = behind_m;
    }
    false
}

fn samples(sight: &Sight, role: Role, poses: &[(FittedBody, f64)]) -> Vec<Sample> {
    let total: f64 = poses.iter().map(|(_, weight)| weight).sum::<f64>() * (ALONG * AWAY) as f64;
    let share = |i: usize, n: usize| END_SHARE + (1.0 - 2.0 * END_SHARE) * i as f64 / (n - 1) as f64;
    let mut out = Vec::with_capacity(poses.len() * ALONG * AWAY);
    for (body, weight) in poses {
        let mut sheet = Sheet::new(body, role, &sight.eye);
        sheet.face = 0.0;
        for i in 0..ALONG {
            for j in 0..AWAY {
                let (point, normal) = sheet.at(share(i, ALONG) - 0.5, share(j, AWAY) * sheet.length_m);
                out.push(Sample { point, normal, weight: weight / total });
            }
        }
    }
    out
}

/// The present direction, then those that are tried, by their angle from it.
fn nearest_first(present: &Vec3) -> Vec<Vec3> {
    let mut out = vec![Vec3::z()];
    for height in HEIGHTS_DEG.map(f64::to_radians) {
        for k in 0..AROUND {
            let turn = k as f64 * std::f64::consts::TAU / AROUND as f64;
            out.push(Vec3::new(turn.cos() * height.cos(), turn.sin() * height.cos(), height.sin()));
        }
    }
    out.sort_by(|a, b| present.dot(b).total_cmp(&present.dot(a)));
    out.insert(0, *present);
    out
}

/// On the way from `present` to `found`, which will do, the direction nearest to the present one that still will.
fn nearer(present: &Vec3, found: Vec3, will_do: impl Fn(&Vec3) -> bool) -> Vec3 {
    let (mut near, mut far) = (0.0, 1.0);
    let on_the_way = |share: f64| (present * (1.0 - share) + found * share).try_normalize(1e-6).unwrap_or(found);
    for _ in 0..HALVINGS {
        let middle = (near + far) / 2.0;
        if will_do(&on_the_way(middle)) {
            far = middle;
        } else {
            near = middle;
        }
    }
    on_the_way(far)
}
