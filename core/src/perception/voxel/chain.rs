use super::super::clock::Clock;
use super::super::ransac::support::Ground;
use super::super::readings::Readings;
use super::super::sides::tell_sides;
use super::super::{PerceptionSettings, Scene};
use super::bases::add_bases;
use super::bounds::Bounds;
use super::faces::settle_faces;
use super::flatness::windows;
use super::folds::split_folds;
use super::ground::{expect_noise, find_ground, middles};
use super::groups::groups;
use super::labels::Labels;
use super::merge::merge;
use super::outlines::outlines;
use super::readings_by_place::ReadingsByPlace;
use super::segments::{segments, Found};
use super::spacing::Spacing;
use super::surfaces::Surfaces;
use super::things::{join_support, roles};
use super::voxels::Voxels;
use crate::cloud::CloudView;
use crate::error::Result;

/// From a cloud without an image grid to its planar segments: voxels, surfaces grown on them, support, groups, bases, and
/// each reading to its surface.
///
/// Equal readings in any order give equal bits (point indices aside), on one thread.
///
/// # Errors
/// `InputError` where the cloud has no finite reading, several directions could be up, or the support is seen from below.
pub fn perceive_on_voxels(cloud: &CloudView, settings: &PerceptionSettings) -> Result<Scene> {
    let mut clock = Clock::start();
    let bounds = Bounds::of(cloud.points)?;
    let spacing = Spacing::measure(cloud.points, &bounds);
    clock.lap("spacing");
    let placed = ReadingsByPlace::new(cloud.points, &bounds);
    let (voxels, voxel_of) = Voxels::new(&placed.points, &bounds, spacing.voxel_m);
    clock.lap("voxels");
    let windows = windows(&voxels);
    let mut surfaces = Surfaces::grow(&voxels, &windows, spacing.sigma_m);
    merge(&mut surfaces, &voxels, spacing.sigma_m);
    settle_faces(&mut surfaces, &voxels, spacing.sigma_m);
    clock.lap("planes");
    let middles = middles(&voxels);
    let of_middles = CloudView { points: &middles, width: middles.len(), height: 1, viewpoint: cloud.viewpoint };
    let mut readings = Readings::new(&of_middles, settings);
    expect_noise(&mut readings, spacing.sigma_m);
    split_folds(&mut surfaces, &voxels, &readings, settings);
    let mut ground = find_ground(&voxels, &readings, &surfaces, settings)?;
    let tolerance_m = join_support(&mut surfaces, &voxels, &readings, &mut ground, settings);
    let mut roles = roles(&surfaces, &voxels, &readings, &ground, tolerance_m, settings);
    clock.lap("support");
    let mut groups = groups(&surfaces, &voxels, &roles, &ground.up, settings);
    if let Some(support) = &ground.support {
        add_bases(&mut surfaces, &voxels, &readings, support, &mut roles, &mut groups, settings);
    }
    clock.lap("clusters");
    let labels = Labels::new(&placed.points, &voxel_of, &voxels, &surfaces, spacing.sigma_m, settings);
    clock.lap("labels");
    let outlines = outlines(&placed.points, &voxel_of, &voxels, &surfaces, &labels);
    let found = Found { surfaces: &surfaces, labels: &labels, outlines: &outlines, roles: &roles, groups: &groups };
    let mut segments = segments(&found, &voxels, &placed, cloud.viewpoint, settings);
    clock.lap("rectangles");
    tell_sides(&mut segments, &readings, cloud, ground.support.as_ref(), None);
    clock.lap("sides");
    let Ground { up, support, warnings, .. } = ground;
    Ok(Scene { up, support, viewpoint: cloud.viewpoint, segments, warnings, stage_seconds: clock.laps })
}
