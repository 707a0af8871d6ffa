//! Which pieces belong together, which are the room's, and which are bases.

use super::piece::Piece;
use super::rays::Rays;
use super::runs::{Run, Runs};
use crate::geometry::{Plane, PlaneFrame, Point2};
use crate::perception::ransac::clusters::clusters;
use crate::perception::ransac::enclosure::Enclosure;
use crate::perception::ransac::parting::Walls;
use crate::perception::ransac::support::Ground;
use crate::perception::readings::Readings;
use crate::perception::scene::BACKGROUND;
use crate::perception::PerceptionSettings;

/// Every so many pixels of a piece stand for it where groups are formed.
const STRIDE: usize = 4;
/// Pieces of the support that meet in fewer columns of neighbouring rows are apart: a wall seen from above parts them.
const MIN_BRIDGE_PX: u32 = 3;
/// Upright pieces without which nothing is enclosed.
const MIN_WALLS: usize = 2;
/// Pieces on the support lean less than this from it.
const LEVEL_COSINE: f64 = 0.996;

/// Pieces with their groups.
pub struct Things {
    pub pieces: Vec<Piece>,
    pub group: Vec<i32>,
}

pub struct Sorting<'a> {
    pub rays: &'a Rays<'a>,
    pub readings: &'a Readings<'a>,
    pub ground: &'a Ground,
    pub settings: &'a PerceptionSettings,
    /// Planes of the pieces in the input's frame.
    pub planes: &'a [Plane],
}

impl Sorting<'_> {
    /// Sorts the pieces: `support` is the one that the ground was read from.
    pub fn sort(&self, pieces: Vec<Piece>, support: Option<usize>) -> Things {
        let is_room: Vec<bool> = (0..pieces.len()).map(|p| Some(p) == support || self.is_room(&pieces[p], p)).collect();
        let mut group = vec![BACKGROUND; pieces.len()];
        let things: Vec<usize> = (0..pieces.len()).filter(|&p| !is_room[p]).collect();
        let footprints = self.group(&pieces, &things, &mut group);
        let mut out = Things { pieces, group };
        if let (Some(plane), Some(support)) = (self.ground.support, support) {
            self.add_bases(&mut out, &plane, support, &is_room, &footprints);
        }
        out
    }

    /// Walls of the room, and what lies on or below the support.
    fn is_room(&self, piece: &Piece, p: usize) -> bool {
        if piece.rectangle.size().iter().any(|&side| side > self.settings.largest_thing_m) {
            return true;
        }
        let Some(support) = &self.ground.support else { return false };
        let heights = self.sample(piece).map(|i| {
            let point = self.readings.point(i);
            support.height_of(&point) / self.readings.tolerance_m(&point)
        });
        let (sum, count) = heights.fold((0.0, 0.0), |(s, n), h| (s + h, n + 1.0));
        let height = sum / count;
        let level = self.planes[p].normal.dot(&support.normal) > LEVEL_COSINE;
        height < -1.0 || (level && height < 1.0)
    }

    fn sample<'p>(&self, piece: &'p Piece) -> impl Iterator<Item = u32> + 'p {
        piece.runs.iter().step_by(1 + piece.runs.len() / 64).map(|r| (r.start + r.end) / 2)
    }

    /// Numbers the groups of things; returns the readings of each.
    fn group(&self, pieces: &[Piece], things: &[usize], group: &mut [i32]) -> Vec<Vec<u32>> {
        let mut owner = Vec::new();
        for &p in things {
            owner.extend(pieces[p].pixels().step_by(STRIDE).map(|i| (i, p)));
        }
        owner.sort_unstable();
        let sampled: Vec<u32> = owner.iter().map(|o| o.0).collect();
        let found = clusters(self.readings, &sampled, self.ground, self.settings);
        let mut votes = vec![vec![0usize; found.len()]; pieces.len()];
        for (g, members) in found.iter().enumerate() {
            for i in members {
                if let Ok(k) = owner.binary_search_by_key(i, |o| o.0) {
                    votes[owner[k].1][g] += 1;
                }
            }
        }
        for &p in things {
            let most = votes[p].iter().copied().max().unwrap_or(0);
            if let Some(g) = votes[p].iter().position(|&v| v == most && most > 0) {
                group[p] = g as i32;
            }
        }
        found
    }

    /// Parts of the support, and level pieces on it, that a group's walls enclose are bases of that group.
    fn add_bases(&self, out: &mut Things, support: &Plane, main: usize, is_room: &[bool], footprints: &[Vec<u32>]) {
        let frame = PlaneFrame::new(support, &self.readings.point(out.pieces[main].runs[0].start));
        let flat = |points: &[u32]| {
            let every = 1 + points.len() / 256;
            points.iter().step_by(every).map(|&i| frame.to_plane(&self.readings.point(i))).collect::<Vec<Point2>>()
        };
        let (rest, mut patches) = self.patches(&out.pieces[main]);
        let low =
            (0..out.pieces.len()).filter(|&p| p != main && is_room[p] && self.is_in_band(&out.pieces[p], support));
        let low: Vec<usize> = low.collect();
        let mut taken = vec![false; out.pieces.len()];
        let mut added: Vec<(Piece, i32)> = Vec::new();
        for (g, members) in footprints.iter().enumerate() {
            let of_group: Vec<usize> = (0..out.group.len()).filter(|&p| out.group[p] == g as i32).collect();
            let is_wall =
                |p: &usize| self.planes[*p].normal.dot(&support.normal).abs() < self.settings.wall_tilt_rad.sin();
            if of_group.iter().filter(|p| is_wall(p)).count() < MIN_WALLS {
                continue;
            }
            let above = |i: &&u32| support.height_of(&self.readings.point(**i)) > self.settings.base_band_m;
            let standing: Vec<Point2> =
                members.iter().filter(above).map(|&i| frame.to_plane(&self.readings.point(i))).collect();
            let Some(enclosure) = Enclosure::new(&standing, self.settings.base_margin_m) else { continue };
            let mut mine: Vec<Vec<u32>> = Vec::new();
            patches.retain(|patch| {
                let points: Vec<u32> = patch.iter().flat_map(|r| r.start..r.end).collect();
                let inside = enclosure.encloses(&flat(&points));
                if inside {
                    mine.push(points);
                }
                !inside
            });
            for &p in &low {
                let points: Vec<u32> = out.pieces[p].pixels().collect();
                if !taken[p] && enclosure.encloses(&flat(&points)) {
                    taken[p] = true;
                    mine.push(points);
                }
            }
            let walls = of_group.iter().filter(|p| is_wall(p));
            let walls = Walls::new(walls.map(|&p| flat(&out.pieces[p].pixels().collect::<Vec<u32>>())));
            for points in walls.join_unparted(mine, flat) {
                let piece = Piece::from_runs(self.rays, to_runs(&points, self.rays.width as u32));
                added.extend(piece.map(|piece| (piece, g as i32)));
            }
        }
        let mut ground_runs = rest;
        ground_runs.extend(patches.into_iter().flatten());
        ground_runs.sort_unstable_by_key(|r| r.start);
        if let Some(ground) = Piece::from_runs(self.rays, ground_runs) {
            out.pieces[main] = ground;
        }
        let mut kept = taken.iter().map(|t| !t);
        let keep: Vec<bool> = kept.by_ref().collect();
        let mut flags = keep.iter();
        out.pieces.retain(|_| *flags.next().unwrap_or(&true));
        let mut flags = keep.iter();
        out.group.retain(|_| *flags.next().unwrap_or(&true));
        for (piece, g) in added {
            out.pieces.push(piece);
            out.group.push(g);
        }
    }

    /// The largest connected part of the support and strays, and each other part.
    fn patches(&self, support: &Piece) -> (Vec<Run>, Vec<Vec<Run>>) {
        let mut labels = vec![super::regions::NONE; self.rays.inverse_depth.len()];
        support.runs.iter().for_each(|r| labels[r.start as usize..r.end as usize].fill(0));
        let runs = Runs::new(&labels, self.rays.width);
        let component = runs.components(MIN_BRIDGE_PX);
        let mut parts: Vec<(u32, Vec<Run>)> = vec![(0, Vec::new()); runs.runs.len()];
        for (run, &c) in runs.runs.iter().zip(&component) {
            let part = &mut parts[c as usize];
            part.0 += run.len();
            part.1.push(*run);
        }
        let largest = (0..parts.len()).fold(0, |best, k| if parts[k].0 > parts[best].0 { k } else { best });
        let mut rest = Vec::new();
        let mut patches = Vec::new();
        for (k, (size, runs)) in parts.into_iter().enumerate() {
            if k == largest || (size as usize) < self.settings.min_segment_points {
                rest.extend(runs);
            } else {
                patches.push(runs);
            }
        }
        (rest, patches)
    }

    fn is_in_band(&self, piece: &Piece, support: &Plane) -> bool {
        let heights = self.sample(piece).map(|i| support.height_of(&self.readings.point(i)));
        let (sum, count) = heights.fold((0.0, 0.0), |(s, n), h| (s + h, n + 1.0));
        (sum / count).abs() < self.settings.base_band_m
    }
}

fn to_runs(points: &[u32], width: u32) -> Vec<Run> {
    let same = |a: &u32, b: &u32| *b == a + 1 && !b.is_multiple_of(width);
    points.chunk_by(same).map(|c| Run { start: c[0], end: c[c.len() - 1] + 1, label: 0 }).collect()
}
