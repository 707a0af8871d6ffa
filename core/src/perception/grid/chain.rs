use super::cells::Cells;
use super::ground::find_ground;
use super::islands::runs_by_label;
use super::merge::merge;
use super::noise::Noise;
use super::piece::Piece;
use super::pixels::PixelLabels;
use super::rays::Rays;
use super::regions::{Regions, NONE};
use super::things::{Sorting, Things};
use crate::cloud::CloudView;
use crate::error::Result;
use crate::geometry::Plane;
use crate::perception::clock::Clock;
use crate::perception::readings::Readings;
use crate::perception::scene::{EdgeKind, Scene, Segments};
use crate::perception::PerceptionSettings;
use std::borrow::Cow;

/// From an organized cloud to its planar segments in a few milliseconds, on one thread.
///
/// # Errors
/// As of `perceive`.
pub fn perceive_on_grid(cloud: &CloudView, settings: &PerceptionSettings) -> Result<Scene> {
    let mut clock = Clock::start();
    let rays = Rays::new(Cow::Borrowed(cloud.points), cloud.width, cloud.height);
    let cells = Cells::new(&rays);
    let noise = Noise::measure(&cells);
    clock.lap("cells");
    let mut regions = Regions::grow(&cells, &noise);
    merge(&mut regions, &cells, &noise);
    clock.lap("regions");
    let refined = PixelLabels::refine(&rays, &cells, &regions, &noise);
    clock.lap("borders");
    let (labels, pieces) = pieces(&rays, refined, settings);
    clock.lap("outlines");
    let readings = Readings::new(cloud, settings);
    let planes: Vec<Plane> = pieces.iter().map(|p| p.plane).collect();
    let (ground, candidates) = find_ground(&readings, &labels, cloud.width, &pieces, &planes, settings)?;
    clock.lap("support");
    let sorting = Sorting { rays: &rays, readings: &readings, ground: &ground, settings, planes: &planes };
    let things = sorting.sort(pieces, ground.chosen.map(|c| candidates[c]));
    let segments = to_segments(&things);
    clock.lap("groups");
    Ok(Scene {
        up: ground.up,
        support: ground.support,
        viewpoint: cloud.viewpoint,
        segments,
        warnings: ground.warnings,
        stage_seconds: clock.laps,
    })
}

/// Pieces of enough readings; the label image then holds their numbers.
fn pieces(rays: &Rays, refined: PixelLabels, settings: &PerceptionSettings) -> (Vec<u16>, Vec<Piece>) {
    let mut labels = refined.labels;
    let mut pieces = Vec::new();
    let mut number = vec![NONE; refined.moments.len()];
    for (r, runs) in runs_by_label(&mut labels, rays.width, refined.moments.len()).into_iter().enumerate() {
        let points: usize = runs.iter().map(|r| r.len() as usize).sum();
        if points < settings.min_segment_points {
            continue;
        }
        if let Some(piece) = Piece::new(rays, runs, &refined.moments[r]) {
            number[r] = pieces.len() as u16;
            pieces.push(piece);
        }
    }
    labels.iter_mut().filter(|l| **l != NONE).for_each(|l| *l = number[usize::from(*l)]);
    (labels, pieces)
}

fn to_segments(things: &Things) -> Segments {
    let mut out = Segments { point_starts: vec![0], ..Segments::default() };
    for (piece, &group) in things.pieces.iter().zip(&things.group) {
        out.planes.push(piece.plane);
        out.rectangles.push(piece.rectangle);
        out.hulls.push(piece.hull.clone());
        out.rms.push(piece.rms_m);
        out.edges.push([EdgeKind::Edge; 4]);
        out.group.push(group);
        out.point_indices.extend(piece.pixels());
        out.point_starts.push(out.point_indices.len() as u32);
    }
    out
}
