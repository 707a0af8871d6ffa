use super::background::join_background;
use super::bases::add_bases;
use super::cells::Cells;
use super::ground::{find_ground, Seen};
use super::islands::runs_by_label;
use super::merge::merge;
use super::noise::Noise;
use super::piece::Piece;
use super::pixels::refine;
use super::rays::Rays;
use super::regions::{Regions, NONE};
use super::roundness::round_facets;
use super::runs::Runs;
use super::things::Sorting;
use crate::cloud::CloudView;
use crate::error::Result;
use crate::perception::clock::Clock;
use crate::perception::readings::Readings;
use crate::perception::scene::{EdgeKind, Scene, Segments};
use crate::perception::sides::tell_sides;
use crate::perception::PerceptionSettings;

/// From an organized cloud to its planar segments in a few milliseconds, on one thread.
///
/// # Errors
/// As of `perceive`.
pub fn perceive_on_grid(cloud: &CloudView, settings: &PerceptionSettings) -> Result<Scene> {
    let mut clock = Clock::start();
    let rays = Rays::new(cloud);
    let cells = Cells::new(&rays);
    let readings = Readings::new(cloud, settings);
    if cells.moments.iter().all(|m| m.n == 0.0) {
        // Says what is wrong where no reading is finite.
        readings.finite_indices()?;
    }
    let noise = Noise::measure(&cells);
    clock.lap("cells");
    let mut regions = Regions::grow(&cells, &noise);
    clock.lap("regions");
    let touching = merge(&mut regions, &cells, &noise);
    clock.lap("merging");
    let labels = refine(&rays, &cells, &regions, &noise);
    clock.lap("borders");
    let runs = Runs::new(&labels, rays.width);
    let is_round = round_facets(&cells, &regions, &touching);
    let (mut pieces, piece_of_label) = pieces(&rays, &runs, &regions, &is_round, settings);
    clock.lap("outlines");
    let seen = Seen { labels: &labels, piece_of_label: &piece_of_label, width: rays.width, pieces: &pieces };
    let (ground, support) = find_ground(&readings, &seen, &noise, settings)?;
    clock.lap("support");
    let mut sorting = Sorting { readings: &readings, ground: &ground, settings, support };
    let mut group = sorting.groups(&pieces, &runs, &piece_of_label);
    join_background(&rays, &readings, &mut pieces, &mut group, &mut sorting.support);
    clock.lap("groups");
    add_bases(&rays, noise.pitch, &sorting, &mut pieces, &mut group);
    clock.lap("bases");
    let mut segments = to_segments(&pieces, &group);
    clock.lap("segments");
    let labels = label_image(&pieces, cloud.points.len());
    tell_sides(&mut segments, &readings, cloud, ground.support.as_ref(), Some(labels));
    clock.lap("sides");
    Ok(Scene {
        up: ground.up,
        support: ground.support,
        viewpoint: cloud.viewpoint,
        segments,
        warnings: ground.warnings,
        stage_seconds: clock.laps,
    })
}

/// Pieces of enough readings that are no facets of round things, and the piece of each label.
fn pieces(
    rays: &Rays,
    runs: &Runs,
    regions: &Regions,
    is_round: &[bool],
    settings: &PerceptionSettings,
) -> (Vec<Piece>, Vec<u16>) {
    let mut pieces = Vec::new();
    let mut piece_of_label = vec![NONE; regions.list.len()];
    for (label, runs) in runs_by_label(runs, regions.list.len()).into_iter().enumerate() {
        let points: usize = runs.iter().map(|r| r.len() as usize).sum();
        if is_round[label] || points < settings.min_segment_points {
            continue;
        }
        if let Some(piece) = Piece::new(rays, runs, &regions.list[label].moments) {
            piece_of_label[label] = pieces.len() as u16;
            pieces.push(piece);
        }
    }
    (pieces, piece_of_label)
}

fn to_segments(pieces: &[Piece], group: &[i32]) -> Segments {
    let mut out = Segments { point_starts: vec![0], ..Segments::default() };
    out.point_indices.reserve_exact(pieces.iter().map(|p| p.points).sum());
    for (piece, &group) in pieces.iter().zip(group) {
        out.planes.push(piece.plane);
        out.rectangles.push(piece.rectangle);
        out.hulls.push(piece.hull.clone());
        out.rms.push(piece.rms_m);
        out.edges.push([EdgeKind::Edge; 4]);
        out.group.push(group);
        piece.runs.iter().for_each(|r| out.point_indices.extend(r.start..r.end));
        out.point_starts.push(out.point_indices.len() as u32);
    }
    out
}

/// The piece of each pixel, -1 for none.
fn label_image(pieces: &[Piece], pixels: usize) -> Vec<i32> {
    let mut labels = vec![-1; pixels];
    for (number, piece) in pieces.iter().enumerate() {
        piece.runs.iter().for_each(|r| labels[r.start as usize..r.end as usize].fill(number as i32));
    }
    labels
}
