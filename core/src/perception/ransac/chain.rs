use super::super::clock::Clock;
use super::super::outline::push_segment;
use super::super::readings::Readings;
use super::super::segment::Segment;
use super::super::sides::tell_sides;
use super::super::{PerceptionSettings, Scene, Segments};
use super::base::SupportBand;
use super::clusters::{clusters, readings_of_things};
use super::planes::planar_segments;
use super::support::{find_ground, Ground};
use crate::cloud::CloudView;
use crate::error::Result;
use rayon::prelude::*;

/// From a cloud to its planar segments, as in the paper (section "Perception"): support, Euclidean clusters, sequential
/// RANSAC, Euclidean filter, hull, minimum rectangle; and the base, which the paper passes over.
///
/// Equal input gives equal bits, on any number of threads.
///
/// # Errors
/// `InputError` where the cloud has no finite reading, several directions could be up, or the support is seen from below.
pub fn perceive_by_ransac(cloud: &CloudView, settings: &PerceptionSettings) -> Result<Scene> {
    let mut clock = Clock::start();
    let mut readings = Readings::new(cloud, settings);
    let indices = readings.finite_indices()?;
    let ground = find_ground(&mut readings, &indices, cloud.is_organized(), settings)?;
    clock.lap("support");
    let things = readings_of_things(&readings, &indices, &ground, settings);
    let groups = clusters(&readings, &things, &ground, settings);
    clock.lap("clusters");
    let mut found = planes_of_groups(&readings, &groups, settings);
    clock.lap("planes");
    let width = if cloud.is_organized() { cloud.width } else { 0 };
    add_bases(&readings, &indices, width, &ground, &mut found, settings);
    let mut segments = outline_all(&readings, &found);
    clock.lap("rectangles");
    tell_sides(&mut segments, &readings, cloud, ground.support.as_ref(), None);
    clock.lap("sides");
    let Ground { up, support, warnings, .. } = ground;
    Ok(Scene { up, support, viewpoint: cloud.viewpoint, segments, warnings, stage_seconds: clock.laps })
}

fn planes_of_groups(readings: &Readings, groups: &[Vec<u32>], settings: &PerceptionSettings) -> Vec<Vec<Segment>> {
    let segment = |(g, group): (usize, &Vec<u32>)| planar_segments(readings, group, settings, g as u64);
    groups.par_iter().enumerate().map(segment).collect()
}

fn add_bases(
    readings: &Readings,
    indices: &[u32],
    width: usize,
    ground: &Ground,
    found: &mut [Vec<Segment>],
    settings: &PerceptionSettings,
) {
    let Some(support) = &ground.support else { return };
    let mut free = vec![false; readings.points.len()];
    indices.iter().for_each(|&i| free[i as usize] = true);
    found.iter().flatten().flat_map(|s| &s.points).for_each(|&i| free[i as usize] = false);
    let band = SupportBand::new(readings, &free, width, support, settings);
    found.iter_mut().for_each(|segments| band.add_base(readings, segments, settings));
}

/// All groups that have a segment, numbered anew from 0, largest cluster first.
fn outline_all(readings: &Readings, found: &[Vec<Segment>]) -> Segments {
    let mut segments = Segments { point_starts: vec![0], ..Segments::default() };
    for (group, of_group) in found.iter().filter(|f| !f.is_empty()).enumerate() {
        of_group.iter().for_each(|s| push_segment(&mut segments, readings, s, group as i32));
    }
    segments
}
