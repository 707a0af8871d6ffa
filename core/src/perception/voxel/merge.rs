use super::pairs::Pairs;
use super::surfaces::{Surface, Surfaces};
use super::voxels::{Voxels, NONE};
use crate::geometry::Moments;

/// Surfaces that lean more than this are two.
const MOST_ANGLE_RAD: f64 = 0.16;
/// They are one where their planes meet within this along the border: root mean square, metres and standard deviations ...
const GAP_FIXED_M: f64 = 0.0005;
const GAP_SIGMAS: f64 = 1.0;
/// ... and the joint plane explains the smaller one almost as well: standard deviations.
const JOINT_SIGMAS: f64 = 0.6;
/// Up to this angle a joint plane may be so much worse: one surface, bent or misread.
const SAME_ANGLE_RAD: f64 = 0.06;
const BENT_SIGMAS: f64 = 1.2;

/// Where two surfaces meet: sums over the places between their voxels.
struct Contact {
    a: u32,
    b: u32,
    places: Moments,
    cost: Option<f64>,
}

/// Joins surfaces that one panel broke into, the most alike first.
pub fn merge(surfaces: &mut Surfaces, voxels: &Voxels, sigma_m: f64) {
    let mut contacts = contacts(surfaces, voxels);
    contacts.iter_mut().for_each(|c| c.cost = cost(&surfaces.list, c, sigma_m));
    while let Some((a, b)) = cheapest(&contacts) {
        surfaces.join(a as usize, b as usize);
        for contact in contacts.iter_mut().filter(|c| [c.a, c.b].contains(&a) || [c.a, c.b].contains(&b)) {
            let renamed = |r: u32| if r == b { a } else { r };
            let (x, y) = (renamed(contact.a), renamed(contact.b));
            (contact.a, contact.b) = (x.min(y), x.max(y));
        }
        contacts.retain(|c| c.a != c.b);
        contacts.sort_by_key(|c| (c.a, c.b));
        contacts.dedup_by(|from, into| {
            let same = (from.a, from.b) == (into.a, into.b);
            if same {
                into.places.add(&from.places);
            }
            same
        });
        contacts.iter_mut().filter(|c| c.a == a || c.b == a).for_each(|c| c.cost = cost(&surfaces.list, c, sigma_m));
    }
    surfaces.number_anew();
}

fn cheapest(contacts: &[Contact]) -> Option<(u32, u32)> {
    let costs = contacts.iter().filter_map(|c| c.cost.map(|cost| (cost, c.a, c.b)));
    costs.reduce(|best, c| if c.0 < best.0 { c } else { best }).map(|(_, a, b)| (a, b))
}

/// Of adjacent voxels of two surfaces, and of those that a voxel of nobody's lies between.
fn contacts(surfaces: &Surfaces, voxels: &Voxels) -> Vec<Contact> {
    let mut met: Pairs<Moments> = Pairs::new();
    let mut around: Vec<(u32, u32)> = Vec::new();
    let middle = |v: u32, w: u32| (voxels.centers[v as usize] + voxels.centers[w as usize]) / 2.0;
    for v in 0..voxels.len() {
        let own = surfaces.owner[v];
        let owned = voxels.neighbours.of(v).iter().map(|&n| (surfaces.owner[n as usize], n));
        if own != NONE {
            for (other, n) in owned.filter(|&(o, _)| o != NONE && o > own) {
                met.of(own, other).add_point(&middle(v as u32, n));
            }
            continue;
        }
        around.clear();
        for (owner, n) in owned.filter(|&(o, _)| o != NONE) {
            if around.iter().all(|&(o, _)| o != owner) {
                around.push((owner, n));
            }
        }
        for (k, a) in around.iter().enumerate() {
            for b in &around[k + 1..] {
                met.of(a.0.min(b.0), a.0.max(b.0)).add_point(&middle(a.1, b.1));
            }
        }
    }
    met.sorted().into_iter().map(|((a, b), places)| Contact { a, b, places, cost: None }).collect()
}

/// How unlike two touching surfaces are (eq. 48); `None` where they are not one.
fn cost(list: &[Surface], contact: &Contact, sigma_m: f64) -> Option<f64> {
    let (a, b) = (&list[contact.a as usize], &list[contact.b as usize]);
    let other = if a.plane.normal.dot(&b.plane.normal) < 0.0 { b.plane.flipped() } else { b.plane };
    let angle_rad = a.plane.normal.cross(&other.normal).norm().atan2(a.plane.normal.dot(&other.normal));
    if angle_rad > MOST_ANGLE_RAD {
        return None;
    }
    let squares = contact.places.squares_about(&(a.plane.normal - other.normal), a.plane.distance - other.distance);
    if (squares / contact.places.weight).sqrt() > GAP_FIXED_M + GAP_SIGMAS * sigma_m {
        return None;
    }
    let joint = joint_deviation(a, b)? / sigma_m;
    let most = if angle_rad < SAME_ANGLE_RAD { BENT_SIGMAS } else { JOINT_SIGMAS };
    (joint < most).then_some(joint)
}

/// By how much a joint plane explains the smaller surface worse than its own, root mean square, metres.
fn joint_deviation(a: &Surface, b: &Surface) -> Option<f64> {
    let mut both = a.moments;
    both.add(&b.moments);
    let (_, variance) = super::flatness::fit(&both)?;
    let apart = a.variance * a.moments.weight + b.variance * b.moments.weight;
    Some(((variance * both.weight - apart).max(0.0) / a.moments.weight.min(b.moments.weight)).sqrt())
}
