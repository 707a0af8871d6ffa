//! Proposals share most of their edges: each is scanned for its flap once.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::flap_scan::{follow_best, peaks, ScanRange, ScannedFlap};
use super::hanging::{flap_range, is_flap, FlapScan};
use super::hinge_line::HingeLine;
use super::sight::Sight;
use crate::fit::FittedBody;

/// Edges that differ by less are one: less than rounding leaves of what is the same number, metres.
const SAME_M: f64 = 1e-8;

/// The flap on each top edge of each of many bodies, as `scan_flaps` tells them of one.
pub fn scan_flaps_of_all(
    sight: &Sight,
    bodies: &[FittedBody],
    model_m: f64,
    by: FlapScan,
) -> Vec<[Option<ScannedFlap>; 4]> {
    let edges: Vec<(HingeLine, ScanRange)> = bodies
        .iter()
        .flat_map(|body| (0..4).map(move |k| (HingeLine::of_side(body, k), flap_range(body, k, model_m, by))))
        .collect();
    // Angles do not depend on how long a flap may be, how far one is followed does.
    let (first, number) = distinct(edges.iter().map(|(hinge, _)| hinge_key(hinge).to_vec()));
    // Each by itself, in their order: the same bits on any number of threads.
    let angles: Vec<Vec<f64>> = first.par_iter().map(|&i| peaks(sight, &edges[i].0, &edges[i].1)).collect();
    let with_length =
        |(&number, (_, range)): (&usize, &(HingeLine, ScanRange))| vec![number as i64, key(range.longest_m)];
    let (first_followed, followed) = distinct(number.iter().zip(&edges).map(with_length));
    let follow = |&i: &usize| {
        let (hinge, range) = &edges[i];
        follow_best(sight, hinge, angles[number[i]].iter().copied(), range).filter(is_flap)
    };
    let flaps: Vec<Option<ScannedFlap>> = first_followed.par_iter().map(follow).collect();
    followed.chunks_exact(4).map(|of| std::array::from_fn(|k| flaps[of[k]])).collect()
}

/// Of each distinct key where it comes first, and for each key which of them it is.
fn distinct(keys: impl Iterator<Item = Vec<i64>>) -> (Vec<usize>, Vec<usize>) {
    let (mut first, mut numbers) = (Vec::new(), BTreeMap::new());
    let number = keys.enumerate().map(|(i, key)| {
        *numbers.entry(key).or_insert_with(|| {
            first.push(i);
            first.len() - 1
        })
    });
    let number = number.collect();
    (first, number)
}

fn hinge_key(hinge: &HingeLine) -> [i64; 14] {
    let HingeLine { middle, along, closed, up, half_m, .. } = hinge;
    let numbers = [middle, along, closed, up].into_iter().flat_map(|v| [v.x, v.y, v.z]);
    let mut numbers = numbers.chain([*half_m, hinge.base_m()]).map(key);
    std::array::from_fn(|_| numbers.next().unwrap_or_default())
}

fn key(number: f64) -> i64 {
    (number / SAME_M).round() as i64
}

#[cfg(test)]
mod tests {
    use nalgebra::Isometry3;

    use super::super::hanging::{scan_flaps, COARSE_SCAN};
    use super::*;
    use crate::cloud::CloudView;
    use crate::fit::{layout, Parameters};
    use crate::geometry::Vec3;
    use crate::perception::readings::Readings;
    use crate::perception::PerceptionSettings;

    /// A box that opens towards the camera, at its distance from there; side 0 lies where those of others do.
    fn body(length_m: f64, width_m: f64) -> FittedBody {
        let mut numbers = Parameters::zeros();
        let lengths = [(layout::LENGTH, length_m), (layout::WIDTH, width_m), (layout::HEIGHT, 0.2)];
        lengths.iter().for_each(|&(place, length_m)| numbers[place] = length_m);
        FittedBody { input_from_object: Isometry3::translation(0.0, width_m / 2.0 - 0.1, 1.0), numbers }
    }

    #[test]
    fn many_bodies_have_the_flaps_that_each_has() {
        // Boards in the plane of the boxes' rims, and nothing where they open.
        let (width, height, focal) = (160, 120, 130.0_f32);
        let place = |i: usize| {
            let (u, v) = (((i % width) as f32 - 80.0) / focal, ((i / width) as f32 - 60.0) / focal);
            let z = if u.abs() < 0.1 && v > -0.08 { 2.0 } else { 1.2 };
            [u * z, v * z, z]
        };
        let points: Vec<[f32; 3]> = (0..width * height).map(place).collect();
        let cloud = CloudView { points: &points, width, height, viewpoint: Some(Vec3::zeros()) };
        let settings = PerceptionSettings::default();
        let readings = Readings::new(&cloud, &settings);
        let sight = Sight::in_level(&cloud, &readings, Isometry3::identity()).unwrap();
        let bodies: Vec<FittedBody> =
            [(0.25, 0.3), (0.25, 0.35), (0.2, 0.3), (0.25, 0.3)].map(|(l, w)| body(l, w)).into();
        let told = scan_flaps_of_all(&sight, &bodies, 0.004, COARSE_SCAN);
        let mut count = 0;
        for (body, told) in bodies.iter().zip(&told) {
            let expected = scan_flaps(&sight, body, 0.004, COARSE_SCAN);
            assert_eq!(expected.map(|flap| flap.is_some()), told.map(|flap| flap.is_some()));
            for (expected, told) in expected.iter().flatten().zip(told.iter().flatten()) {
                assert!((expected.angle_rad - told.angle_rad).abs() < 1e-6 && expected.met == told.met, "{told:?}");
                count += 1;
            }
        }
        assert!(count >= 6, "{count}");
        assert_eq!(told[0], told[3]);
        let hinges = bodies.iter().flat_map(|body| (0..4).map(|k| HingeLine::of_side(body, k)));
        // The first three share side 0 or its length; the last has all edges of the first.
        let (first, number) = distinct(hinges.map(|hinge| hinge_key(&hinge).to_vec()));
        assert_eq!((first.len(), number[0], number[4]), (11, 0, 0));
        assert_eq!(number[12..], number[..4]);
    }
}
