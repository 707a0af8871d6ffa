//! The proposals that are worth a closer look.

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
    let mut all: Vec<Shell> = of_one_direction.par_iter().flat_map_iter(look).collect();
    all.sort_by(|a, b| b.score.total_cmp(&a.score));
    let mut out: Vec<Shell> = Vec::new();
    // What lies takes no place of what stands.
    for shell in all {
        let of_its_kind = || out.iter().filter(|other| lies(&other.proposal) == lies(&shell.proposal));
        let rivals = of_its_kind().filter(|other| overlap(&other.proposal, &shell.proposal)).count();
        let is_new = rivals < RIVALS && !of_its_kind().any(|other| alike(&other.proposal, &shell.proposal, ALIKE_M));
        if is_new && of_its_kind().count() < if lies(&shell.proposal) { MOST_LYING } else { MOST_SHELLS } {
            out.push(shell);
        }
    }
    out
}

/// Of proposals that share their directions those that the rays bear out.
fn borne_out(sight: &Sight, rays: &Rays, proposals: &[Proposal]) -> Vec<Shell> {
    let Some(first) = proposals.first() else { return Vec::new() };
    let along = rays.along(sight, first);
    let mut out = Vec::new();
    for proposal in proposals {
        let least = LEAST_SCORE - OF_FLAPS * proposal.on_flaps;
        let Some(looked) = rays.look(sight, proposal, &along, least) else { continue };
        let on_rims = rims::of_body(sight, &body_of(proposal));
        let shell = Shell { proposal: proposal.clone(), looked, on_rims, score: 0.0, flaps: [None; 4] };
        out.push(Shell { score: shell.of_walls() + OF_FLAPS * proposal.on_flaps, ..shell });
    }
    out
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
