//! Which bodies of a scene come too near to each other: boards must not pass through boards, nor a cup through a carton.

use crate::vector::{add_scaled, cross, dot, sub, Vec3};
use crate::{SensorError, Triangle};

#[derive(Clone, Copy)]
struct Span {
    lo: Vec3,
    hi: Vec3,
}

impl Span {
    fn of<'a>(points: impl Iterator<Item = &'a Vec3>) -> Self {
        let mut s = Self { lo: [f64::INFINITY; 3], hi: [f64::NEG_INFINITY; 3] };
        for p in points {
            for (k, &c) in p.iter().enumerate() {
                s.lo[k] = s.lo[k].min(c);
                s.hi[k] = s.hi[k].max(c);
            }
        }
        s
    }

    fn within(&self, other: &Self, gap: f64) -> bool {
        (0..3).all(|k| self.lo[k] - gap <= other.hi[k] && other.lo[k] - gap <= self.hi[k])
    }
}

struct Body {
    group: i32,
    span: Span,
    triangles: Vec<(Triangle, Span)>,
}

/// Pairs of groups (smaller first, in rising order) whose surfaces come nearer than `gap_m` or cross.
///
/// `groups` names the body of each triangle. A body wholly inside another is not noticed.
///
/// # Errors
/// [`SensorError`] where the two lists differ in length.
pub fn close_groups(triangles: &[Triangle], groups: &[i32], gap_m: f64) -> Result<Vec<(i32, i32)>, SensorError> {
    if triangles.len() != groups.len() {
        let (t, g) = (triangles.len(), groups.len());
        return Err(SensorError::new(format!("groups has {g} entries: expected one for each of {t} triangles")));
    }
    let bodies = collect(triangles, groups);
    let mut pairs = Vec::new();
    for (k, a) in bodies.iter().enumerate() {
        pairs.extend(bodies[k + 1..].iter().filter(|b| near(a, b, gap_m)).map(|b| (a.group, b.group)));
    }
    Ok(pairs)
}

fn collect(triangles: &[Triangle], groups: &[i32]) -> Vec<Body> {
    let mut names: Vec<i32> = groups.to_vec();
    names.sort_unstable();
    names.dedup();
    let body = |&group: &i32| {
        let own = triangles.iter().zip(groups).filter(|(_, &g)| g == group);
        let triangles: Vec<_> = own.map(|(t, _)| (*t, Span::of(t.iter()))).collect();
        let span = Span::of(triangles.iter().flat_map(|(t, _)| t.iter()));
        Body { group, span, triangles }
    };
    names.iter().map(body).collect()
}

fn near(a: &Body, b: &Body, gap: f64) -> bool {
    if !a.span.within(&b.span, gap) {
        return false;
    }
    let candidates: Vec<_> = b.triangles.iter().filter(|(_, s)| s.within(&a.span, gap)).collect();
    let mut own = a.triangles.iter().filter(|(_, s)| s.within(&b.span, gap));
    own.any(|(t, s)| candidates.iter().any(|(o, os)| s.within(os, gap) && triangles_near(t, o, gap)))
}

fn triangles_near(a: &Triangle, b: &Triangle, gap: f64) -> bool {
    let gap_sq = gap * gap;
    let edges = |t: &Triangle| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])];
    let (ea, eb) = (edges(a), edges(b));
    ea.iter().any(|&(p, q)| crosses(p, q, b))
        || eb.iter().any(|&(p, q)| crosses(p, q, a))
        || ea.iter().any(|&s| eb.iter().any(|&o| segments_dist_sq(s, o) < gap_sq))
        || a.iter().any(|&p| face_dist_sq(p, b).is_some_and(|d| d < gap_sq))
        || b.iter().any(|&p| face_dist_sq(p, a).is_some_and(|d| d < gap_sq))
}

/// Does the segment pass through the triangle?
fn crosses(p: Vec3, q: Vec3, t: &Triangle) -> bool {
    let n = cross(sub(t[1], t[0]), sub(t[2], t[0]));
    let (dp, dq) = (dot(n, sub(p, t[0])), dot(n, sub(q, t[0])));
    dp * dq < 0.0 && contains(t, n, add_scaled(p, dp / (dp - dq), sub(q, p)))
}

/// Squared distance from a point to the triangle's face, where the foot of the perpendicular lies on it.
fn face_dist_sq(p: Vec3, t: &Triangle) -> Option<f64> {
    let n = cross(sub(t[1], t[0]), sub(t[2], t[0]));
    let (d, n_sq) = (dot(n, sub(p, t[0])), dot(n, n));
    (n_sq > 0.0 && contains(t, n, add_scaled(p, -d / n_sq, n))).then(|| d * d / n_sq)
}

fn contains(t: &Triangle, n: Vec3, p: Vec3) -> bool {
    (0..3).all(|k| dot(n, cross(sub(t[(k + 1) % 3], t[k]), sub(p, t[k]))) >= 0.0)
}

/// Ericson, Real-Time Collision Detection (2005), 5.1.9.
fn segments_dist_sq((p1, q1): (Vec3, Vec3), (p2, q2): (Vec3, Vec3)) -> f64 {
    let (d1, d2, r) = (sub(q1, p1), sub(q2, p2), sub(p1, p2));
    let (a, e, f, c, b) = (dot(d1, d1), dot(d2, d2), dot(d2, r), dot(d1, r), dot(d1, d2));
    if a <= 0.0 || e <= 0.0 {
        return f64::INFINITY;
    }
    let denominator = a * e - b * b;
    let mut s = if denominator > 0.0 { ((b * f - c * e) / denominator).clamp(0.0, 1.0) } else { 0.0 };
    let mut t = (b * s + f) / e;
    if !(0.0..=1.0).contains(&t) {
        t = t.clamp(0.0, 1.0);
        s = ((b * t - c) / a).clamp(0.0, 1.0);
    }
    let gap = sub(add_scaled(p1, s, d1), add_scaled(p2, t, d2));
    dot(gap, gap)
}
