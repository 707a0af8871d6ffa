//! Which pieces belong together, and which are the room's.

use super::piece::Piece;
use super::runs::Runs;
use super::touching::touching;
use crate::geometry::{convex_hull, Plane, PlaneFrame, Point2, Vec3};
use crate::perception::ransac::clusters::overlap;
use crate::perception::ransac::components::UnionFind;
use crate::perception::ransac::support::Ground;
use crate::perception::readings::Readings;
use crate::perception::scene::BACKGROUND;
use crate::perception::PerceptionSettings;

/// Pieces on the support lean less than this from it.
const LEVEL_COSINE: f64 = 0.996;
/// Readings of a piece that its height is taken from.
const HEIGHT_SAMPLE: usize = 64;
/// Gaps are bridged that the noise allows for, in sigmas.
const GAP_SIGMAS: f64 = 2.5;

/// What sorts pieces into things.
pub struct Sorting<'a> {
    pub readings: &'a Readings<'a>,
    pub ground: &'a Ground,
    pub settings: &'a PerceptionSettings,
    /// The piece that the ground was read from.
    pub support: Option<usize>,
}

impl Sorting<'_> {
    /// The group of each piece: the largest is 0, the room's pieces are `BACKGROUND`. `piece_of_label` is of the runs.
    pub fn groups(&self, pieces: &[Piece], runs: &Runs, piece_of_label: &[u16]) -> Vec<i32> {
        let is_thing: Vec<bool> = (0..pieces.len()).map(|p| !self.is_room(&pieces[p], p)).collect();
        let thing = |label: u16| {
            let piece = usize::from(*piece_of_label.get(usize::from(label))?);
            (*is_thing.get(piece)?).then_some(piece)
        };
        let mut sets = touching(self.readings, runs, pieces.len(), thing, self.gap_m(pieces, &is_thing));
        self.join_overlapping(pieces, &is_thing, &mut sets);
        number_by_size(pieces, &is_thing, &mut sets)
    }

    /// Walls of the room, and what lies on or below the support.
    fn is_room(&self, piece: &Piece, p: usize) -> bool {
        if Some(p) == self.support || piece.rectangle.size().iter().any(|&side| side > self.settings.largest_thing_m) {
            return true;
        }
        let Some(support) = &self.ground.support else { return false };
        let height = self.mean_height(piece, support, |p| self.readings.tolerance_m(p));
        let level = piece.plane.normal.dot(&support.normal) > LEVEL_COSINE;
        height < -1.0 || (level && height < 1.0)
    }

    /// Mean height over the support, in units of `unit_m`.
    pub fn mean_height(&self, piece: &Piece, support: &Plane, unit_m: impl Fn(&Vec3) -> f64) -> f64 {
        let points = piece.sample(HEIGHT_SAMPLE).map(|i| self.readings.point(i));
        let (sum, count) = points.fold((0.0, 0.0), |(sum, n), p| (sum + support.height_of(&p) / unit_m(&p), n + 1.0));
        sum / count
    }

    /// The gap that is bridged: at least what the noise of the middle piece allows for.
    fn gap_m(&self, pieces: &[Piece], is_thing: &[bool]) -> f64 {
        let things = pieces.iter().zip(is_thing).filter(|(_, &t)| t);
        let mut sigmas: Vec<f64> = things.map(|(p, _)| self.readings.sigma_m(&p.rectangle.center())).collect();
        sigmas.sort_unstable_by(f64::total_cmp);
        sigmas.get(sigmas.len() / 2).map_or(0.0, |s| GAP_SIGMAS * s).max(self.settings.cluster_gap_m)
    }

    /// Groups whose outlines on the support overlap are one thing: the near wall of a box, seen from outside, and its far
    /// wall, seen from inside, can be a box's length apart.
    fn join_overlapping(&self, pieces: &[Piece], is_thing: &[bool], sets: &mut UnionFind) {
        let frame = PlaneFrame::new(&Plane { normal: self.ground.up, distance: 0.0 }, &Vec3::zeros());
        let mut footprints: Vec<Vec<Point2>> = vec![Vec::new(); pieces.len()];
        for p in (0..pieces.len()).filter(|&p| is_thing[p]) {
            footprints[sets.find(p)].extend(pieces[p].hull.iter().map(|c| frame.to_plane(c)));
        }
        let outlines: Vec<Vec<Point2>> = footprints.iter().map(|f| convex_hull(f)).collect();
        for a in (0..pieces.len()).filter(|&a| !outlines[a].is_empty()) {
            for b in (0..a).filter(|&b| !outlines[b].is_empty()) {
                if overlap(&outlines[a], &outlines[b]) {
                    sets.join(a, b);
                }
            }
        }
    }
}

fn number_by_size(pieces: &[Piece], is_thing: &[bool], sets: &mut UnionFind) -> Vec<i32> {
    let mut size = vec![0; pieces.len()];
    for p in (0..pieces.len()).filter(|&p| is_thing[p]) {
        size[sets.find(p)] += pieces[p].points;
    }
    let mut order: Vec<usize> = (0..pieces.len()).filter(|&p| size[p] > 0).collect();
    order.sort_by_key(|&p| std::cmp::Reverse(size[p]));
    let mut number = vec![BACKGROUND; pieces.len()];
    order.iter().enumerate().for_each(|(g, &p)| number[p] = g as i32);
    (0..pieces.len()).map(|p| if is_thing[p] { number[sets.find(p)] } else { BACKGROUND }).collect()
}
