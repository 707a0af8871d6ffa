//! The proposals that are worth a closer look.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use rayon::prelude::*;

use super::flap_scan::ScannedFlap;
use super::lids::of_lids;
use super::patch::Patch;
use super::proposal::{proposals, turned, Proposal, OF_FLAPS};
use super::proposed::{alike, lies, overlap};
use super::rim_lines::{edge_points, walls_of_rims, yaws_of_edges};
use super::rims::{self, OnRims};
use super::shell::Rays;
use super::shell_look::ShellLook;
use super::sight::Sight;
use super::start::body_of;
use super::upright::{lying_frames, ways_up};
use super::yaw::{near, yaws};
use crate::geometry::Vec3;
use crate::perception::Scene;

/// Of proposals that lie upon each other, and of all, so many are kept.
const RIVALS: usize = 40;
const MOST_SHELLS: usize = 140;
const MOST_LYING: usize = 60;

/// A proposal with what the rays say of it.
#[derive(Debug, Clone)]
pub struct Shell {
    pub proposal: Proposal,
    pub looked: ShellLook,
    /// What the rims say.
    pub on_rims: OnRims,
    pub score: f64,
    pub flaps: [Option<ScannedFlap>; 4],
}

impl Shell {
    /// What walls and rims say, without the flaps.
    pub fn of_walls(&self) -> f64 {
        self.looked.score() + self.on_rims.pixels + self.on_rims.open * self.looked.lid
    }
}

/// Proposals that the rays bear out, distinct, best first.
pub fn shells(sight: &Sight, scene: &Scene) -> Vec<Shell> {
    let patches = Patch::of_things(scene, sight);
    let rays = Rays::new(sight);
    let proposed = all_proposals(&patches, &edge_points(sight), &sight.eye);
    // Proposals come by their directions.
    let of_one_direction: Vec<&[Proposal]> = proposed.chunk_by(|a, b| a.axes == b.axes && a.up == b.up).collect();
    let look = |proposals: &&[Proposal]| borne_out(sight, &rays, proposals);
    best(sight, of_one_direction.par_iter().flat_map_iter(look).collect())
}

/// Of proposals that share their directions those that the rays bear out.
fn borne_out(sight: &Sight, rays: &Rays, proposals: &[Proposal]) -> Vec<Shell> {
    let Some(first) = proposals.first() else { return Vec::new() };
    let along = rays.along(sight, first);
    let look = |proposal: &Proposal| {
        let least = LEAST_SCORE - OF_FLAPS * proposal.on_flaps;
        let looked = rays.look(sight, proposal, &along, least)?;
        Some(Shell {
            proposal: proposal.clone(),
            looked,
            on_rims: OnRims::default(),
            score: f64::INFINITY,
            flaps: [None; 4],
        })
    };
    proposals.iter().filter_map(look).collect()
}

/// The best of them, distinct, best first. Rims are looked along where what they could say at most lets a proposal be among them.
fn best(sight: &Sight, all: Vec<Shell>) -> Vec<Shell> {
    let score = |shell: &Shell| shell.of_walls() + OF_FLAPS * shell.proposal.on_flaps;
    let at_most = |shell: &Shell| {
        let on_rims = OnRims { pixels: rims::most_px(sight, &body_of(&shell.proposal)), open: 1.0 };
        score(&Shell { on_rims, ..shell.clone() }) + ROUNDED
    };
    let waiting =
        all.iter().enumerate().map(|(number, shell)| Waiting { score: at_most(shell), is_exact: false, number });
    let mut waiting: BinaryHeap<Waiting> = waiting.collect();
    let mut all: Vec<Option<Shell>> = all.into_iter().map(Some).collect();
    let mut kept = Kept::default();
    while let Some(Waiting { is_exact, number, .. }) = waiting.pop() {
        let Some(mut shell) = all[number].take().filter(|shell| kept.has_room(shell)) else { continue };
        if is_exact {
            kept.shells.push(shell);
            continue;
        }
        shell.on_rims = rims::of_body(sight, &body_of(&shell.proposal));
        shell.score = score(&shell);
        waiting.push(Waiting { score: shell.score, is_exact: true, number });
        all[number] = Some(shell);
    }
    kept.shells
}

/// More than sums of pixels are off.
const ROUNDED: f64 = 1e-3;

/// A proposal by its number, with its score or more than that.
struct Waiting {
    score: f64,
    is_exact: bool,
    number: usize,
}

/// The highest score comes first; of equals what is not yet exact, then the first.
impl Ord for Waiting {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_score = self.score.total_cmp(&other.score);
        by_score.then(other.is_exact.cmp(&self.is_exact)).then(other.number.cmp(&self.number))
    }
}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Waiting {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Waiting {}

/// Proposals that are kept. What has no room among them has none among more.
#[derive(Default)]
struct Kept {
    shells: Vec<Shell>,
}

impl Kept {
    /// What lies takes no place of what stands.
    fn has_room(&self, shell: &Shell) -> bool {
        let proposal = &shell.proposal;
        let is_lying = lies(proposal);
        let of_its_kind = || self.shells.iter().map(|other| &other.proposal).filter(|other| lies(other) == is_lying);
        of_its_kind().count() < if is_lying { MOST_LYING } else { MOST_SHELLS }
            && !of_its_kind().any(|other| alike(other, proposal, ALIKE_M))
            && of_its_kind().filter(|other| overlap(other, proposal)).count() < RIVALS
    }
}

fn all_proposals(patches: &[Patch], edges: &[Vec3], eye: &Vec3) -> Vec<Proposal> {
    let mut out = Vec::new();
    for up in ways_up(patches) {
        let x = (Vec3::x() - up * up.x).normalize();
        let frame = [x, up.cross(&x), up];
        let of_patches = yaws(patches, &frame);
        // Rims are level where the box is; a lid does not tell how deep a leaning box reaches.
        if up != Vec3::z() {
            out.extend(of_patches.iter().flat_map(|&yaw| proposals(patches, &[], &frame, yaw)));
            continue;
        }
        let is_new = |yaw: &f64| of_patches.iter().all(|other| !near(*yaw, *other));
        let of_edges: Vec<f64> = yaws_of_edges(edges).into_iter().filter(is_new).collect();
        for &yaw in of_patches.iter().chain(&of_edges) {
            let rims = walls_of_rims(edges, &turned(&frame, yaw));
            out.extend(proposals(patches, &rims, &frame, yaw));
            out.extend(of_lids(patches, &frame, yaw));
        }
        for frame in lying_frames(patches, &of_patches, eye) {
            out.extend(proposals(patches, &[], &frame, 0.0));
        }
    }
    out
}

/// So many pixels for a box more than against it.
pub const LEAST_SCORE: f64 = 300.0;
const ALIKE_M: f64 = 0.009;

#[cfg(test)]
impl Shell {
    /// One so far along x that holds so much.
    pub fn that_far(at_m: f64, score: f64) -> Self {
        let proposal = Proposal {
            axes: [Vec3::x(), Vec3::y()],
            up: Vec3::z(),
            spans: [[at_m - 0.2, at_m + 0.2], [-0.1, 0.1]],
            heights: [0.0, 0.2],
            on_flaps: 0.0,
        };
        Self { proposal, looked: ShellLook::default(), on_rims: OnRims::default(), score, flaps: [None; 4] }
    }
}
