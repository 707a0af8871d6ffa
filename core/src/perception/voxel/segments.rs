use super::super::scene::{EdgeKind, Segments, BACKGROUND};
use super::super::PerceptionSettings;
use super::labels::Labels;
use super::outlines::Outline;
use super::readings_by_place::ReadingsByPlace;
use super::surfaces::Surfaces;
use super::things::Role;
use super::voxels::{Voxels, NONE};
use crate::geometry::{minimum_rectangle, Plane, Rectangle, Vec3};

/// What is known of each surface.
pub struct Found<'a> {
    pub surfaces: &'a Surfaces,
    pub labels: &'a Labels,
    pub outlines: &'a [Option<Outline>],
    pub roles: &'a [Role],
    pub groups: &'a [usize],
}

/// The surfaces that are segments: things first, the largest thing first, within it the largest segment; then the background.
pub fn segments(
    found: &Found,
    voxels: &Voxels,
    readings: &ReadingsByPlace,
    viewpoint: Option<Vec3>,
    settings: &PerceptionSettings,
) -> Segments {
    let Found { surfaces, labels, outlines, roles, groups } = found;
    let order = order(found, voxels, settings);
    let mut number = vec![NONE; surfaces.list.len()];
    let mut out = Segments { point_starts: vec![0], ..Segments::default() };
    let (mut last, mut group) = (None, BACKGROUND);
    for &s in &order {
        let Some(outline) = &outlines[s] else { continue };
        let Some(rectangle) = minimum_rectangle(&outline.hull) else { continue };
        let thing = (roles[s] == Role::Thing).then_some(groups[s]);
        if thing.is_some() && thing != last {
            (last, group) = (thing, group + 1);
        }
        number[s] = out.planes.len() as u32;
        let to_space = |c: &[f64; 2]| outline.frame.to_space(c) + voxels.low;
        out.planes.push(facing(voxels.plane_of_input(&outline.plane), viewpoint));
        out.rectangles.push(Rectangle { corners: rectangle.corners.map(|c| to_space(&c)) });
        out.hulls.push(outline.hull.iter().map(to_space).collect());
        out.rms.push(outline.rms_m);
        out.edges.push([EdgeKind::Edge; 4]);
        out.group.push(if thing.is_some() { group } else { BACKGROUND });
        out.point_starts.push(out.point_starts[out.point_starts.len() - 1] + labels.fits[s].count() as u32);
    }
    out.point_indices = gather(readings, &labels.of_reading, &number, &out.point_starts);
    out
}

/// The surfaces that have enough readings and area, in the order in which they are listed.
fn order(found: &Found, voxels: &Voxels, settings: &PerceptionSettings) -> Vec<usize> {
    let Found { surfaces, labels, outlines, roles, groups } = found;
    let is_segment = |s: &usize| {
        let area_m2 = surfaces.list[*s].voxels.len() as f64 * voxels.size_m.powi(2);
        let outline = outlines[*s].as_ref();
        labels.fits[*s].count() >= settings.min_segment_points.max(3)
            && area_m2 >= settings.min_segment_area_m2
            && outline.is_some_and(|o| o.hull.len() > 2)
    };
    let mut order: Vec<usize> = (0..surfaces.list.len()).filter(is_segment).collect();
    let mut of_group = vec![0usize; surfaces.list.len()];
    order.iter().for_each(|&s| of_group[groups[s]] += labels.fits[s].count());
    order.sort_by_key(|&s| {
        let is_thing = roles[s] == Role::Thing;
        let group = if is_thing { (usize::MAX - of_group[groups[s]], groups[s]) } else { (0, 0) };
        (!is_thing, group, usize::MAX - labels.fits[s].count(), s)
    });
    order
}

fn facing(plane: Plane, viewpoint: Option<Vec3>) -> Plane {
    match viewpoint {
        Some(viewpoint) if plane.height_of(&viewpoint) < 0.0 => plane.flipped(),
        _ => plane,
    }
}

/// Points of the cloud by segment, each segment's in input order.
fn gather(readings: &ReadingsByPlace, of_reading: &[u32], number: &[u32], starts: &[u32]) -> Vec<u32> {
    let mut of_point = vec![NONE; readings.index.iter().max().map_or(0, |&last| last as usize + 1)];
    for (&point, &surface) in readings.index.iter().zip(of_reading).filter(|(_, &s)| s != NONE) {
        of_point[point as usize] = number[surface as usize];
    }
    let mut next = starts.to_vec();
    let mut indices = vec![0u32; starts[starts.len() - 1] as usize];
    for (point, &segment) in of_point.iter().enumerate().filter(|(_, &s)| s != NONE) {
        indices[next[segment as usize] as usize] = point as u32;
        next[segment as usize] += 1;
    }
    indices
}
