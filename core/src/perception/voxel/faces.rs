//! What is no panel of its own: the second face of a board, and the fringe along a crease.

use super::pairs::Pairs;
use super::surfaces::{Surface, Surfaces};
use super::voxels::{Voxels, NONE};

/// A board is no thicker than this, metres, and as many standard deviations.
const BOARD_M: f64 = 0.006;
const BOARD_SIGMAS: f64 = 1.5;
/// Its faces are parallel: cosine of 10 degrees.
const PARALLEL_COSINE: f64 = 0.985;
/// Of the smaller face's voxels, the share that touches the larger face. Boards side by side touch along a line.
const MIN_TOUCHING: f64 = 0.55;
/// A fringe is narrower than this many voxels, and so much of it touches larger surfaces.
const FRINGE_VOXELS: f64 = 5.0;
const FRINGE_TOUCHING: f64 = 0.8;
/// Times that faces are looked for: pieces of pieces.
const ROUNDS: usize = 4;

/// Joins surfaces that are the two faces of one board, seen from both its sides, and lets go of fringes.
///
/// Surfaces come largest first, and do so again afterwards.
pub fn settle_faces(surfaces: &mut Surfaces, voxels: &Voxels, sigma_m: f64) {
    for _ in 0..ROUNDS {
        let touches = touches(surfaces, voxels);
        let mut changed = vec![false; surfaces.list.len()];
        for of_one in touches.chunk_by(|a, b| a.0 == b.0).rev() {
            settle_one(surfaces, voxels, sigma_m, of_one, &mut changed);
        }
        surfaces.number_anew();
        if !changed.contains(&true) {
            return;
        }
    }
}

/// `(surface, larger surface, voxels of the first that touch the second)`, ascending.
fn touches(surfaces: &Surfaces, voxels: &Voxels) -> Vec<(u32, u32, u32)> {
    let mut met: Pairs<u32> = Pairs::new();
    let mut larger: Vec<u32> = Vec::new();
    for v in (0..voxels.len()).filter(|&v| surfaces.owner[v] != NONE) {
        let own = surfaces.owner[v];
        larger.clear();
        for &n in voxels.neighbours.of(v) {
            let other = surfaces.owner[n as usize];
            if other < own && !larger.contains(&other) {
                larger.push(other);
                *met.of(own, other) += 1;
            }
        }
    }
    met.sorted().into_iter().map(|((own, other), count)| (own, other, count)).collect()
}

fn settle_one(
    surfaces: &mut Surfaces,
    voxels: &Voxels,
    sigma_m: f64,
    touches: &[(u32, u32, u32)],
    changed: &mut [bool],
) {
    let own = touches[0].0 as usize;
    if changed[own] {
        return;
    }
    let surface = &surfaces.list[own];
    let count = surface.voxels.len() as f64;
    let is_face = |&&(_, larger, n): &&(u32, u32, u32)| {
        f64::from(n) >= MIN_TOUCHING * count && is_other_face(surface, &surfaces.list[larger as usize], sigma_m)
    };
    if let Some(&(_, larger, _)) = touches.iter().filter(is_face).max_by_key(|t| (t.2, u32::MAX - t.1)) {
        surfaces.join(larger as usize, own);
        (changed[own], changed[larger as usize]) = (true, true);
    } else if is_narrow(surface, voxels)
        && f64::from(touches.iter().map(|t| t.2).sum::<u32>()) >= FRINGE_TOUCHING * count
    {
        surfaces.list[own].voxels.clear();
        changed[own] = true;
    }
}

fn is_other_face(surface: &Surface, larger: &Surface, sigma_m: f64) -> bool {
    larger.plane.normal.dot(&surface.plane.normal).abs() > PARALLEL_COSINE
        && larger.plane.height_of(&surface.moments.mean()).abs() < BOARD_M + BOARD_SIGMAS * sigma_m
}

fn is_narrow(surface: &Surface, voxels: &Voxels) -> bool {
    surface.sides_m()[1] < FRINGE_VOXELS * voxels.size_m
}
