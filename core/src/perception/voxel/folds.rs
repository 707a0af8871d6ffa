use super::super::ransac::fold;
use super::super::readings::Readings;
use super::super::segment::Segment;
use super::super::PerceptionSettings;
use super::surfaces::{Surface, Surfaces};
use super::voxels::Voxels;
use crate::geometry::{Moments, Plane};

/// Times that folded surfaces are looked for: a strip of four panels takes two.
const PASSES: usize = 2;

impl Voxels {
    /// The settings where voxels stand for readings.
    pub fn settings(&self, settings: &PerceptionSettings) -> PerceptionSettings {
        let readings_each = self.moments.iter().map(|m| m.weight).sum::<f64>() / self.len() as f64;
        let least = ((settings.min_segment_points as f64 / readings_each) as usize).max(4);
        PerceptionSettings { min_segment_points: least, ..*settings }
    }

    pub fn segment_of(&self, surface: &Surface) -> Segment {
        let mut points = surface.voxels.clone();
        points.sort_unstable();
        Segment {
            plane: self.plane_of_input(&surface.plane),
            rms_m: surface.variance.sqrt(),
            area_m2: surface.voxels.len() as f64 * self.size_m.powi(2),
            points,
        }
    }
}

/// Makes two surfaces of each that is folded (eq. 32). `readings` are the voxels' middles.
pub fn split_folds(surfaces: &mut Surfaces, voxels: &Voxels, readings: &Readings, settings: &PerceptionSettings) {
    let of_voxels = voxels.settings(settings);
    let mut next = 0;
    for _ in 0..PASSES {
        let known = surfaces.list.len();
        for k in next..known {
            if surfaces.list[k].sides_m()[0] > settings.largest_thing_m {
                continue;
            }
            let segment = voxels.segment_of(&surfaces.list[k]);
            if let Some(planes) = fold(readings, &segment, &of_voxels) {
                split(surfaces, voxels, k, &planes.map(|p| voxels.plane_inside(&p)));
            }
        }
        next = known;
    }
    surfaces.number_anew();
}

/// Each voxel to the nearer plane; the second plane's make a new surface.
fn split(surfaces: &mut Surfaces, voxels: &Voxels, k: usize, [one, other]: &[Plane; 2]) {
    let nearer = |plane: &Plane, than: &Plane, v: u32| {
        let center = &voxels.centers[v as usize];
        plane.height_of(center).abs() < than.height_of(center).abs()
    };
    let all = std::mem::take(&mut surfaces.list[k].voxels);
    let (seconds, firsts): (Vec<u32>, Vec<u32>) = all.into_iter().partition(|&v| nearer(other, one, v));
    surfaces.list[k] = Surface::of(voxels, firsts, one);
    surfaces.list.push(Surface::of(voxels, seconds, other));
}

impl Surface {
    /// The surface of these voxels; `plane` where they span none.
    pub fn of(voxels: &Voxels, mine: Vec<u32>, plane: &Plane) -> Self {
        let mut moments = Moments::default();
        mine.iter().for_each(|&v| moments.add(&voxels.moments[v as usize]));
        let mut surface = Self { plane: *plane, moments, variance: 0.0, voxels: mine };
        surface.refit();
        surface
    }
}
