use super::cells::Cells;
use super::noise::Noise;
use super::ray_moments::RayPlane;
use super::regions::{Regions, NONE};

/// Regions may be one surface where the step at their border is below this many sigmas.
const STEP_SIGMAS: f64 = 1.4;
/// Planes that lean less than this are one surface, bent or misread.
const SAME_ANGLE_RAD: f64 = 0.13;
/// A region is part of a larger one that explains it within these sigmas: its own slope is noise.
const ABSORB_SIGMAS: f64 = 1.2;

/// Joins regions that one surface broke into, the most alike first; returns the pairs that still touch.
pub fn merge(regions: &mut Regions, cells: &Cells, noise: &Noise) -> Vec<(usize, usize)> {
    let mut contacts = contacts(regions, cells);
    loop {
        let mut best: Option<(f64, usize)> = None;
        for (k, contact) in contacts.iter().enumerate() {
            if let Some(cost) = cost(regions, cells, contact, noise) {
                if best.is_none_or(|(least, _)| cost < least) {
                    best = Some((cost, k));
                }
            }
        }
        let Some((_, k)) = best else {
            let number = drop_empty(regions);
            return contacts.iter().map(|c| (number[usize::from(c.a)], number[usize::from(c.b)])).collect();
        };
        let (a, b) = (contacts[k].a, contacts[k].b);
        join(regions, a, b);
        for contact in &mut contacts {
            let renamed = |r: u16| if r == b { a } else { r };
            let (x, y) = (renamed(contact.a), renamed(contact.b));
            if x > y {
                contact.pairs.iter_mut().for_each(|p| p.swap(0, 1));
            }
            (contact.a, contact.b) = (x.min(y), x.max(y));
        }
        contacts.retain(|c| c.a != c.b);
        contacts.sort_by_key(|c| (c.a, c.b));
        contacts.dedup_by(|from, into| {
            let same = (from.a, from.b) == (into.a, into.b);
            if same {
                into.pairs.append(&mut from.pairs);
            }
            same
        });
    }
}

/// Where two regions meet: pairs of cells, the first of region `a`.
struct Contact {
    a: u16,
    b: u16,
    pairs: Vec<[u32; 2]>,
}

fn contacts(regions: &Regions, cells: &Cells) -> Vec<Contact> {
    let mut met: Vec<(u16, u16, [u32; 2])> = Vec::new();
    // Across one cell that is nobody's too: the cell on a crease fits neither plane.
    let (right, down) = (1, cells.columns);
    for cell in cells.of_image() {
        let a = regions.owner[cell];
        if a == NONE {
            continue;
        }
        let across = |step: usize| (regions.owner[cell + step] == NONE).then_some(cell + 2 * step);
        let others = [Some(cell + right), Some(cell + down), Some(cell + down + right), across(right), across(down)];
        for other in others.into_iter().flatten() {
            let Some(&b) = regions.owner.get(other) else { continue };
            if b == NONE || b == a {
                continue;
            }
            let (x, y) = (cell as u32, other as u32);
            met.push(if a < b { (a, b, [x, y]) } else { (b, a, [y, x]) });
        }
    }
    met.sort_by_key(|m| (m.0, m.1));
    met.chunk_by(|x, y| (x.0, x.1) == (y.0, y.1))
        .map(|same| Contact { a: same[0].0, b: same[0].1, pairs: same.iter().map(|m| m.2).collect() })
        .collect()
}

/// How unlike two touching regions are; `None` where they are not one surface.
fn cost(regions: &Regions, cells: &Cells, contact: &Contact, noise: &Noise) -> Option<f64> {
    let (a, b) = (&regions.list[usize::from(contact.a)], &regions.list[usize::from(contact.b)]);
    let (large, small) = if a.moments.n < b.moments.n { (b, a) } else { (a, b) };
    let q = small.moments.q / small.moments.n;
    let variance = noise.variance_on(&large.plane) + noise.bias_variance(q);
    let own = small.moments.squares_about(&small.plane);
    let off = ((small.moments.squares_about(&large.plane) - own).max(0.0) / (small.moments.n * variance)).sqrt();
    let angle_rad = angle_rad(&a.plane, &b.plane);
    if angle_rad > SAME_ANGLE_RAD && off > ABSORB_SIGMAS {
        return None;
    }
    let step = step(cells, contact, &a.plane, &b.plane) / variance.sqrt();
    (step < STEP_SIGMAS).then_some(off)
}

/// By how much one region lies before the other along their border, in q, where both lean as their mean does (eq. 55).
fn step(cells: &Cells, contact: &Contact, a: &RayPlane, b: &RayPlane) -> f64 {
    let mean = RayPlane { a: (a.a + b.a) / 2.0, b: (a.b + b.b) / 2.0, c: (a.c + b.c) / 2.0 };
    let rise =
        |&[x, y]: &[u32; 2]| cells.moments[y as usize].mean_about(&mean) - cells.moments[x as usize].mean_about(&mean);
    (contact.pairs.iter().map(rise).sum::<f64>() / contact.pairs.len() as f64).abs()
}

/// Between the planes' normals in space.
pub fn angle_rad(a: &RayPlane, b: &RayPlane) -> f64 {
    let (m, n) = (nalgebra::Vector3::new(a.a, a.b, a.c), nalgebra::Vector3::new(b.a, b.b, b.c));
    m.cross(&n).norm().atan2(m.dot(&n))
}

fn join(regions: &mut Regions, into: u16, from: u16) {
    let gone = std::mem::take(&mut regions.list[usize::from(from)].cells);
    gone.iter().for_each(|&cell| regions.owner[cell as usize] = into);
    let moments = regions.list[usize::from(from)].moments;
    let region = &mut regions.list[usize::from(into)];
    region.cells.extend(gone);
    region.moments.add(&moments);
    if let Some((plane, _)) = region.moments.fit() {
        region.plane = plane;
    }
}

/// Numbers the regions anew, without those that went into others; returns the new number of each.
fn drop_empty(regions: &mut Regions) -> Vec<usize> {
    let mut count = 0;
    let number = regions.list.iter().map(|r| {
        count += usize::from(!r.cells.is_empty());
        count.saturating_sub(1)
    });
    let number = number.collect();
    regions.list.retain(|r| !r.cells.is_empty());
    for (id, region) in regions.list.iter().enumerate() {
        region.cells.iter().for_each(|&cell| regions.owner[cell as usize] = id as u16);
    }
    number
}
