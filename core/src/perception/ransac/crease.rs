//! Panels that meet at a few degrees lie in one plane's tolerance: a segment that is folded becomes two.

use super::super::readings::Readings;
use super::super::segment::Segment;
use super::super::PerceptionSettings;
use crate::geometry::{minimum_rectangle, Plane, PlaneFrame, Point2, Vec3};
use nalgebra::{SMatrix, SVector};

/// Strips across a segment; a crease is looked for at their borders.
const STRIPS: usize = 48;
/// A parabola takes all but 1/16 of a symmetric fold's squared heights, so a little less than its residuals decides.
const MAX_SHARE_OF_BENT: f64 = 0.985;

/// Where and how strongly a segment is folded.
#[derive(Debug, Clone, Copy)]
struct Fold {
    /// Squared residuals over those of the flat and of the bent fit.
    of_flat: f64,
    of_bent: f64,
    planes: [Plane; 2],
}

/// The two planes of a folded segment, `None` for one that is flat or evenly bent.
///
/// Along each axis t of its rectangle the height over its plane is fitted by a line, by a parabola (a bent panel) and, for
/// each place of a crease, by two lines that meet there; the fold must beat both others.
pub fn fold(readings: &Readings, segment: &Segment, settings: &PerceptionSettings) -> Option<[Plane; 2]> {
    let frame = PlaneFrame::new(&segment.plane, &readings.point(*segment.points.first()?));
    let flat: Vec<Point2> = segment.points.iter().map(|&i| frame.to_plane(&readings.point(i))).collect();
    let corners = minimum_rectangle(&flat)?.corners;
    let axes = [[corners[0], corners[1]], [corners[1], corners[2]]];
    let folds = axes.iter().filter_map(|[a, b]| {
        let length_m = (b[0] - a[0]).hypot(b[1] - a[1]);
        let axis = (frame.u * (b[0] - a[0]) + frame.v * (b[1] - a[1])) / length_m;
        (length_m > 2.0 * settings.min_crease_side_m)
            .then(|| best_fold(readings, segment, &frame.to_space(a), &axis, length_m, settings))?
    });
    let best = folds.reduce(|x, y| if y.of_flat < x.of_flat { y } else { x })?;
    let folded = best.of_flat < settings.max_crease_residual_share && best.of_bent < MAX_SHARE_OF_BENT;
    folded.then_some(best.planes)
}

/// Sums over one strip for least squares in (1, t, ...): powers of t, and of t times height.
#[derive(Debug, Clone, Copy, Default)]
struct Strip {
    t: [f64; 5],
    ht: [f64; 3],
    hh: f64,
}

impl Strip {
    fn add(&mut self, t: f64, h: f64) {
        let powers = [1.0, t, t * t, t * t * t, t * t * t * t];
        self.t.iter_mut().zip(powers).for_each(|(sum, p)| *sum += p);
        self.ht.iter_mut().zip(powers).for_each(|(sum, p)| *sum += h * p);
        self.hh += h * h;
    }

    fn plus(mut self, other: &Strip) -> Strip {
        self.t.iter_mut().zip(other.t).for_each(|(a, b)| *a += b);
        self.ht.iter_mut().zip(other.ht).for_each(|(a, b)| *a += b);
        self.hh += other.hh;
        self
    }
}

fn best_fold(
    readings: &Readings,
    segment: &Segment,
    start: &Vec3,
    axis: &Vec3,
    length_m: f64,
    settings: &PerceptionSettings,
) -> Option<Fold> {
    let mut strips = [Strip::default(); STRIPS];
    for &i in &segment.points {
        let p = readings.point(i);
        let t = (p - start).dot(axis);
        let strip = ((t / length_m * STRIPS as f64).max(0.0) as usize).min(STRIPS - 1);
        strips[strip].add(t, segment.plane.height_of(&p));
    }
    let all = strips.iter().fold(Strip::default(), |sum, s| sum.plus(s));
    let (flat, bent) = residuals_unfolded(&all)?;
    let mut best: Option<(f64, f64, SVector<f64, 3>)> = None;
    let mut right = all;
    for border in 1..STRIPS {
        let left = &strips[border - 1];
        right.t.iter_mut().zip(left.t).for_each(|(a, b)| *a -= b);
        right.ht.iter_mut().zip(left.ht).for_each(|(a, b)| *a -= b);
        right.hh -= left.hh;
        let crease = length_m * border as f64 / STRIPS as f64;
        let sides_m = crease.min(length_m - crease);
        let fewer = right.t[0].min(all.t[0] - right.t[0]);
        if sides_m < settings.min_crease_side_m || fewer < settings.min_segment_points as f64 {
            continue;
        }
        let Some((residual, fit)) = fit_fold(&all, &right, crease) else { continue };
        if best.is_none_or(|(least, _, _)| residual < least) {
            best = Some((residual, crease, fit));
        }
    }
    let (residual, crease, fit) = best?;
    let slopes = [fit[1], fit[1] + fit[2]];
    let angle_rad = (slopes[0].atan() - slopes[1].atan()).abs();
    let height = fit[0] + fit[1] * crease;
    let hinge = start + axis * crease + segment.plane.normal * height;
    let plane = |slope: f64| {
        let normal = (segment.plane.normal - axis * slope).normalize();
        Plane { normal, distance: normal.dot(&hinge) }
    };
    let planes = slopes.map(plane);
    (angle_rad >= settings.min_crease_rad).then_some(Fold {
        of_flat: residual / flat,
        of_bent: residual / bent,
        planes,
    })
}

/// Squared residuals of the line and of the parabola through the heights.
fn residuals_unfolded(all: &Strip) -> Option<(f64, f64)> {
    let [n, t, tt, ttt, tttt] = all.t;
    let line = SMatrix::<f64, 2, 2>::new(n, t, t, tt);
    let side = SVector::<f64, 2>::new(all.ht[0], all.ht[1]);
    let flat = all.hh - line.cholesky()?.solve(&side).dot(&side);
    let parabola = SMatrix::<f64, 3, 3>::new(n, t, tt, t, tt, ttt, tt, ttt, tttt);
    let side = SVector::<f64, 3>::from(all.ht);
    let bent = all.hh - parabola.cholesky()?.solve(&side).dot(&side);
    (flat > 0.0 && bent > 0.0).then_some((flat, bent))
}

/// Least squares of `a + b t + c max(0, t - crease)` (eq. 32): squared residuals and (a, b, c).
fn fit_fold(all: &Strip, right: &Strip, crease: f64) -> Option<(f64, SVector<f64, 3>)> {
    let [n, t, tt, ..] = all.t;
    let [rn, rt, rtt, ..] = right.t;
    let (k, kt) = (rt - crease * rn, rtt - crease * rt);
    let kk = rtt - 2.0 * crease * rt + crease * crease * rn;
    let normal = SMatrix::<f64, 3, 3>::new(n, t, k, t, tt, kt, k, kt, kk);
    let side = SVector::<f64, 3>::new(all.ht[0], all.ht[1], right.ht[1] - crease * right.ht[0]);
    let fit = normal.cholesky()?.solve(&side);
    Some(((all.hh - fit.dot(&side)).max(0.0), fit))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cloud::CloudView;
    use crate::geometry::{Moments, SplitMix64};

    /// Noisy readings of a 20 x 20 cm panel whose height over t = x is given, 1 m from the viewpoint; the planes of its fold.
    fn fold_of(height: impl Fn(f64) -> f64, seed: u64) -> Option<[Plane; 2]> {
        let mut rng = SplitMix64::new(seed);
        let mut noise = || (0..12).map(|_| rng.unit()).sum::<f64>() - 6.0;
        let grid = (0..6400).map(|k| (f64::from(k % 80) * 0.0025, f64::from(k / 80) * 0.0025));
        let points: Vec<[f32; 3]> =
            grid.map(|(x, y)| [x as f32, y as f32, (1.0 + height(x) + 0.002 * noise()) as f32]).collect();
        let settings = PerceptionSettings::default();
        let cloud = CloudView { points: &points, width: points.len(), height: 1, viewpoint: Some(Vec3::zeros()) };
        let readings = Readings::new(&cloud, &settings);
        let mut moments = Moments::default();
        (0..points.len()).for_each(|i| moments.add_point(&readings.point(i as u32)));
        let (plane, rms_m) = moments.fit_plane().unwrap();
        let points = (0..points.len() as u32).collect();
        fold(&readings, &Segment { plane, rms_m, area_m2: 0.04, points }, &settings)
    }

    #[test]
    fn finds_folds_at_their_angle_and_leaves_flat_and_bent_panels() {
        let mut cases = 0;
        for seed in 0..20 {
            let angle_rad = 0.16 + 0.01 * seed as f64;
            let crease_m = 0.06 + 0.004 * seed as f64;
            let [a, b] = fold_of(|x| (x - crease_m).max(0.0) * angle_rad.tan(), seed).expect("a fold");
            assert!((a.normal.dot(&b.normal).abs().acos() - angle_rad).abs() < 0.02, "{angle_rad}");
            assert!(fold_of(|_| 0.0, seed).is_none());
            assert!(fold_of(|x| 0.6 * (x - 0.1) * (x - 0.1), seed).is_none());
            cases += 1;
        }
        assert_eq!(cases, 20);
    }
}
