use nalgebra::Isometry3;

use super::super::found_box::FoundBox;
use super::super::sight::{level, Sight};
use super::View;
use crate::cloud::Projection;
use crate::geometry::{Plane, Vec3};

/// Supports that differ by less are one: their tilt, rad, and their heights where the boxes stand, metres.
const SAME_TILT_RAD: f64 = 0.035;
const SAME_HEIGHT_M: f64 = 0.02;

/// first_from_level of the frame that all views are told in: on the mean of the supports that most of them agree on (eq. 98); with it the
/// numbers of views whose support is another.
///
/// `None` of a first view without an image or a viewpoint. `own` are the views' own level frames.
pub fn common_level(views: &[View], own: &[Sight], found: &[Vec<FoundBox>]) -> Option<(Isometry3<f64>, Vec<usize>)> {
    let first = views.first()?;
    let place = |(number, view): (usize, &View)| -> Vec<Vec3> {
        let first_from_own = view.first_from_view * own[number].input_from_level;
        let of = |one: &FoundBox| first_from_own * one.solution.body.input_from_object.translation.vector;
        found[number].iter().map(of).collect()
    };
    let places: Vec<Vec3> = views.iter().enumerate().flat_map(place).collect();
    let middle = places.iter().sum::<Vec3>() / places.len().max(1) as f64;
    let of_view = |(number, view): (usize, &View)| Some((number, moved(&view.scene.support?, &view.first_from_view)));
    let (numbers, supports): (Vec<usize>, Vec<Plane>) = views.iter().enumerate().filter_map(of_view).unzip();
    let agree = |a: &Plane, b: &Plane| {
        let tilt = a.normal.cross(&b.normal).norm();
        tilt < SAME_TILT_RAD && (a.height_of(&middle) - b.height_of(&middle)).abs() < SAME_HEIGHT_M
    };
    let friends = |one: &Plane| supports.iter().filter(|other| agree(one, other)).count();
    // The first of those with most friends.
    let best = supports.iter().fold(None, |best: Option<&Plane>, one| match best {
        Some(best) if friends(best) >= friends(one) => Some(best),
        _ => Some(one),
    });
    let Some(best) = best else { return Some((own.first()?.input_from_level, Vec::new())) };
    let support = mean(supports.iter().filter(|one| agree(best, one)))?;
    let strange = numbers.iter().zip(&supports).filter(|(_, one)| !agree(best, one)).map(|(number, _)| *number);
    Some((level(&Projection::of(&first.cloud)?, &support.normal, &support), strange.collect()))
}

/// A line of a view whose support is another than that of most.
pub fn told(number: usize, of: usize) -> String {
    let others = if of == 2 { "that of the other frame" } else { "those of most frames" };
    format!("frame {}: by its pose the support that it shows lies elsewhere than {others}; check its pose", number + 1)
}

fn moved(plane: &Plane, to_from_plane: &Isometry3<f64>) -> Plane {
    let normal = to_from_plane.rotation * plane.normal;
    Plane { normal, distance: plane.distance + normal.dot(&to_from_plane.translation.vector) }
}

/// The plane that is as high as they are on average, everywhere.
fn mean<'a>(planes: impl Iterator<Item = &'a Plane>) -> Option<Plane> {
    let sum = planes.fold((Vec3::zeros(), 0.0), |(n, d), plane| (n + plane.normal, d + plane.distance));
    let length = sum.0.norm();
    (length > 1e-9).then(|| Plane { normal: sum.0 / length, distance: sum.1 / length })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_moved_plane_holds_the_moved_points_and_the_mean_lies_between() {
        let plane = Plane { normal: Vec3::new(0.1, 0.2, 0.9).normalize(), distance: 0.7 };
        let mut checked = 0;
        for turn in [Vec3::zeros(), Vec3::new(0.3, -0.2, 0.9), Vec3::new(-1.0, 2.0, 0.1)] {
            let motion = Isometry3::new(Vec3::new(0.4, -1.0, 0.2), turn);
            let there = moved(&plane, &motion);
            for p in [Vec3::new(0.3, 0.1, 1.0), Vec3::new(-0.2, 0.5, -0.4)] {
                let off = there.height_of(&motion.transform_point(&p.into()).coords) - plane.height_of(&p);
                assert!(off.abs() < 1e-12);
                checked += 1;
            }
        }
        assert_eq!(checked, 6);
        let lifted = Plane { distance: plane.distance + 0.01, ..plane };
        let between = mean([plane, lifted].iter()).unwrap();
        assert!((between.height_of(&(plane.normal * plane.distance)) + 0.005).abs() < 1e-12);
    }
}
