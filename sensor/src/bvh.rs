//! A bounding volume hierarchy over triangles, split by the surface area heuristic in bins (Wald 2007).

use crate::frustum::Frustum;
use crate::vector::{add_scaled, cross, dot, sub, Vec3};
use crate::Triangle;

const BINS: usize = 12;
const LEAF: usize = 3;
/// Up to this many triangles are tried one by one.
const MANY: usize = 24;

#[derive(Clone, Copy)]
struct Bounds {
    lo: Vec3,
    hi: Vec3,
}

impl Bounds {
    const EMPTY: Self = Self { lo: [f64::INFINITY; 3], hi: [f64::NEG_INFINITY; 3] };

    fn add(&mut self, p: Vec3) {
        for (k, &c) in p.iter().enumerate() {
            self.lo[k] = self.lo[k].min(c);
            self.hi[k] = self.hi[k].max(c);
        }
    }

    fn join(&mut self, other: &Self) {
        self.add(other.lo);
        self.add(other.hi);
    }

    fn half_area(&self) -> f64 {
        let d = sub(self.hi, self.lo);
        if d[0] < 0.0 {
            return 0.0;
        }
        d[0] * d[1] + d[1] * d[2] + d[2] * d[0]
    }
}

/// Inner node: `count` 0 and its children at `first` and `first + 1`. Leaf: triangles `first .. first + count` of the order.
struct Node {
    lo: [f32; 3],
    hi: [f32; 3],
    first: u32,
    count: u32,
}

struct Prepared {
    corner: Vec3,
    edge1: Vec3,
    edge2: Vec3,
}

/// Triangles that a bundle of rays may meet.
pub enum Candidates {
    Few(Vec<u32>),
    /// So many that every ray had better walk the tree.
    All,
}

pub struct Bvh {
    nodes: Vec<Node>,
    /// In the order of the leaves.
    prepared: Vec<Prepared>,
    /// Index in the caller's list for each prepared triangle.
    index: Vec<u32>,
}

/// A ray from `origin` along `direction`; positions are multiples of `direction`.
pub struct Ray {
    origin: Vec3,
    direction: Vec3,
    inverse: [f32; 3],
    origin32: [f32; 3],
}

impl Ray {
    pub fn new(origin: Vec3, direction: Vec3) -> Self {
        // A zero component would make 0 * inf = NaN in the slab test.
        let inverse = direction.map(|d| 1.0 / if d.abs() < 1e-12 { 1e-12f64.copysign(d) } else { d } as f32);
        Self { origin, direction, inverse, origin32: origin.map(|c| c as f32) }
    }
}

impl Bvh {
    pub fn new(triangles: &[Triangle]) -> Self {
        let bounds: Vec<Bounds> = triangles.iter().map(triangle_bounds).collect();
        let mut index: Vec<u32> = (0..triangles.len() as u32).collect();
        let mut nodes = vec![leaf(&bounds, &index, 0, triangles.len())];
        if !triangles.is_empty() {
            split(&mut nodes, 0, &bounds, &mut index);
        }
        let prepared = index.iter().map(|&i| prepare(&triangles[i as usize])).collect();
        Self { nodes, prepared, index }
    }

    /// The triangles that rays of a bundle may meet, for [`Bvh::closest`] and [`Bvh::blocked`] of these rays.
    pub fn gather(&self, bundle: &Frustum) -> Candidates {
        let mut found = Vec::new();
        let mut open = vec![0u32];
        while let Some(at) = open.pop() {
            let node = &self.nodes[at as usize];
            if bundle.misses(node.lo, node.hi) {
                continue;
            }
            if node.count > 0 {
                found.extend(node.first..node.first + node.count);
            } else if !self.prepared.is_empty() {
                open.extend([node.first + 1, node.first]);
            }
        }
        if found.len() > MANY {
            return Candidates::All;
        }
        Candidates::Few(found)
    }

    /// The nearest triangle in front of the ray and where: (position along the ray, index of the triangle).
    pub fn closest(&self, candidates: &Candidates, ray: &Ray) -> Option<(f64, usize)> {
        let mut best: Option<(f64, usize)> = None;
        let visit = |t, k: usize| {
            best = Some((t, self.index[k] as usize));
            Some(t)
        };
        self.visit(candidates, ray, f64::INFINITY, visit);
        best
    }

    /// Is anything on the ray before `limit`?
    pub fn blocked(&self, candidates: &Candidates, ray: &Ray, limit: f64) -> bool {
        let mut hit = false;
        let visit = |_, _| {
            hit = true;
            None
        };
        self.visit(candidates, ray, limit, visit);
        hit
    }

    /// Visits hits nearer than the limit; `visit` returns the new limit, or nothing to stop.
    fn visit(
        &self,
        candidates: &Candidates,
        ray: &Ray,
        mut limit: f64,
        mut visit: impl FnMut(f64, usize) -> Option<f64>,
    ) {
        let Candidates::Few(few) = candidates else {
            return self.walk(ray, limit, visit);
        };
        for &k in few {
            if let Some(t) = self.prepared[k as usize].meet(ray).filter(|&t| t < limit) {
                match visit(t, k as usize) {
                    Some(nearer) => limit = nearer,
                    None => return,
                }
            }
        }
    }

    /// The same through the whole tree.
    fn walk(&self, ray: &Ray, mut limit: f64, mut visit: impl FnMut(f64, usize) -> Option<f64>) {
        let mut stack = [0u32; 64];
        let mut depth = 1;
        if self.enters(0, ray, limit).is_none() {
            return;
        }
        while depth > 0 {
            depth -= 1;
            let node = &self.nodes[stack[depth] as usize];
            if node.count > 0 || self.prepared.is_empty() {
                for k in node.first as usize..(node.first + node.count) as usize {
                    if let Some(t) = self.prepared[k].meet(ray).filter(|&t| t < limit) {
                        match visit(t, k) {
                            Some(nearer) => limit = nearer,
                            None => return,
                        }
                    }
                }
                continue;
            }
            let (a, b) = (node.first, node.first + 1);
            match (self.enters(a, ray, limit), self.enters(b, ray, limit)) {
                (Some(ta), Some(tb)) => {
                    let (near, far) = if ta <= tb { (a, b) } else { (b, a) };
                    stack[depth] = far;
                    stack[depth + 1] = near;
                    depth += 2;
                }
                (Some(_), None) => (stack[depth], depth) = (a, depth + 1),
                (None, Some(_)) => (stack[depth], depth) = (b, depth + 1),
                (None, None) => {}
            }
        }
    }

    fn enters(&self, node: u32, ray: &Ray, limit: f64) -> Option<f32> {
        let node = &self.nodes[node as usize];
        let (mut near, mut far) = (0f32, limit as f32 * 1.000_001);
        for k in 0..3 {
            let a = (node.lo[k] - ray.origin32[k]) * ray.inverse[k];
            let b = (node.hi[k] - ray.origin32[k]) * ray.inverse[k];
            near = near.max(a.min(b));
            far = far.min(a.max(b));
        }
        (near <= far * 1.000_001).then_some(near)
    }
}

impl Prepared {
    /// Position along the ray, by Möller and Trumbore (1997).
    fn meet(&self, ray: &Ray) -> Option<f64> {
        let p = cross(ray.direction, self.edge2);
        let det = dot(self.edge1, p);
        if det == 0.0 {
            return None;
        }
        let inverse = 1.0 / det;
        let s = sub(ray.origin, self.corner);
        let a = dot(s, p) * inverse;
        if !(0.0..=1.0).contains(&a) {
            return None;
        }
        let q = cross(s, self.edge1);
        let b = dot(ray.direction, q) * inverse;
        if b < 0.0 || a + b > 1.0 {
            return None;
        }
        Some(dot(self.edge2, q) * inverse).filter(|&t| t > 0.0)
    }
}

fn prepare(t: &Triangle) -> Prepared {
    Prepared { corner: t[0], edge1: sub(t[1], t[0]), edge2: sub(t[2], t[0]) }
}

fn triangle_bounds(t: &Triangle) -> Bounds {
    let mut b = Bounds::EMPTY;
    t.iter().for_each(|&p| b.add(p));
    b
}

fn leaf(bounds: &[Bounds], index: &[u32], first: usize, count: usize) -> Node {
    let mut b = Bounds::EMPTY;
    index[first..first + count].iter().for_each(|&i| b.join(&bounds[i as usize]));
    // A few units of the last place wider than rounding needs, so that no triangle sticks out of its box.
    let margin = 1e-5;
    Node {
        lo: b.lo.map(|c| c as f32 - margin),
        hi: b.hi.map(|c| c as f32 + margin),
        first: first as u32,
        count: count as u32,
    }
}

fn split(nodes: &mut Vec<Node>, at: usize, bounds: &[Bounds], index: &mut [u32]) {
    let (first, count) = (nodes[at].first as usize, nodes[at].count as usize);
    if count <= LEAF {
        return;
    }
    let middle = partition(bounds, &mut index[first..first + count]);
    let child = nodes.len();
    nodes.push(leaf(bounds, index, first, middle));
    nodes.push(leaf(bounds, index, first + middle, count - middle));
    nodes[at].first = child as u32;
    nodes[at].count = 0;
    split(nodes, child, bounds, index);
    split(nodes, child + 1, bounds, index);
}

/// Orders the triangles so that the two children come one after the other; the size of the first.
fn partition(bounds: &[Bounds], index: &mut [u32]) -> usize {
    let centre = |i: u32| add_scaled(bounds[i as usize].lo, 1.0, bounds[i as usize].hi);
    let mut span = Bounds::EMPTY;
    index.iter().for_each(|&i| span.add(centre(i)));
    let size = sub(span.hi, span.lo);
    let axis = (0..3).max_by(|&a, &b| size[a].total_cmp(&size[b])).unwrap_or(0);
    let half = index.len() / 2;
    if size[axis] <= 0.0 {
        return half;
    }
    let bin = |i: u32| (((centre(i)[axis] - span.lo[axis]) / size[axis] * BINS as f64) as usize).min(BINS - 1);
    let cut = best_cut(bounds, index, bin);
    // Stable, so that the tree is the same on every run.
    index.sort_by_key(|&i| bin(i) >= cut);
    let middle = index.partition_point(|&i| bin(i) < cut);
    if middle == 0 || middle == index.len() {
        half
    } else {
        middle
    }
}

fn best_cut(bounds: &[Bounds], index: &[u32], bin: impl Fn(u32) -> usize) -> usize {
    let mut bins = [(Bounds::EMPTY, 0usize); BINS];
    for &i in index {
        let slot = &mut bins[bin(i)];
        slot.0.join(&bounds[i as usize]);
        slot.1 += 1;
    }
    let cost = |part: &[(Bounds, usize)]| {
        let mut all = Bounds::EMPTY;
        part.iter().filter(|b| b.1 > 0).for_each(|b| all.join(&b.0));
        all.half_area() * part.iter().map(|b| b.1).sum::<usize>() as f64
    };
    let costs = (1..BINS).map(|cut| (cost(&bins[..cut]) + cost(&bins[cut..]), cut));
    costs.min_by(|a, b| a.0.total_cmp(&b.0)).map_or(BINS / 2, |(_, cut)| cut)
}
