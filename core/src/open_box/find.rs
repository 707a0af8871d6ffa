use nalgebra::{Isometry3, Rotation3, Translation3, UnitQuaternion};

use super::evidence::{Evidence, Sheet};
use super::features::{self, Features};
use super::flap_scan::{scan, HingeLine, ScanRange, ScannedFlap};
use super::lean::lean;
use super::patch::Patch;
use super::proposal::{proposals, Proposal, OF_FLAPS};
use super::refit::refit;
use super::shell::{Rays, ShellLook};
use super::sight::Sight;
use super::surfaces::{label, roles, Labels, Present};
use super::upright::ways_up;
use super::yaw::yaws;
use crate::fit::{best_match, best_match_within, share_of_score, with_known_size, KnownSize, SizeMatch};
use crate::fit::{check, layout, FitSettings, FittedBody, Parameters, Role, Solution};
use crate::geometry::Vec3;
use crate::perception::Scene;

/// An open box in the level frame.
#[derive(Debug, Clone)]
pub struct FoundBox {
    pub solution: Solution,
    pub present: Present,
    pub labels: Labels,
    pub evidence: Vec<(Role, Evidence)>,
    pub score: f64,
    /// The given size that comes nearest.
    pub size: Option<SizeMatch>,
    pub features: Features,
    pub part_features: Vec<(Role, Features)>,
}

/// Of proposals that lie upon each other so many are looked at closely.
const RIVALS: usize = 40;
const MOST_SHELLS: usize = 140;
const RIVALS_FITTED: usize = 8;
const BOARD_M: f64 = 0.004;

#[derive(Debug, Clone)]
pub struct Shell {
    pub proposal: Proposal,
    pub looked: ShellLook,
    pub score: f64,
    pub flaps: [Option<ScannedFlap>; 4],
}

/// The boxes that the segments propose and the depth image bears out, best first; none takes another's readings.
///
/// Of rivals those that have one of the given `sizes` win.
pub fn find(sight: &Sight, scene: &Scene, sizes: &[KnownSize], settings: &FitSettings) -> Vec<FoundBox> {
    let t0 = std::time::Instant::now();
    let mut shells = shells(sight, scene);
    let t1 = t0.elapsed().as_secs_f64();
    for shell in &mut shells {
        let body = body_of(&shell.proposal);
        shell.flaps = scan_flaps(sight, &body, COARSE_M);
        shell.score = shell.looked.score() + shell.flaps.iter().flatten().map(ScannedFlap::score).sum::<f64>();
        shell.score *= share_of_score(best_match_within(outer_m(&shell.proposal), PROPOSED_SIGMA_M, sizes).as_ref());
    }
    shells.sort_by(|a, b| b.score.total_cmp(&a.score));
    let t2 = t0.elapsed().as_secs_f64();
    let mut found: Vec<FoundBox> = Vec::new();
    let mut fitted: Vec<&Shell> = Vec::new();
    for shell in &shells {
        if fitted.iter().filter(|other| overlap(&other.proposal, &shell.proposal)).count() >= RIVALS_FITTED {
            continue;
        }
        fitted.push(shell);
        found.extend(grow(sight, shell, settings).map(|found| sized(found, sizes)));
    }
    let t3 = t0.elapsed().as_secs_f64();
    if std::env::var("BW_T").is_ok() {
        eprintln!("shells {} {:.1} ms, flaps {:.1} ms, grow {} {:.1} ms", shells.len(), t1 * 1e3, (t2 - t1) * 1e3, fitted.len(), (t3 - t2) * 1e3);
    }
    choose(found, sight.width).into_iter().filter_map(|one| finish(sight, one, sizes, settings)).collect()
}

/// How well proposals and fitted bodies are known, beside the noise.
const COARSE_M: f64 = 0.007;
pub const FINE_M: f64 = 0.004;

/// Proposals that the rays bear out, distinct, best first.
pub fn shells(sight: &Sight, scene: &Scene) -> Vec<Shell> {
    let patches = Patch::of_things(scene, sight);
    let rays = Rays::new(sight);
    let mut all = Vec::new();
    for proposal in all_proposals(&patches) {
        {
            let looked = rays.look(sight, &proposal);
            let score = looked.score() + OF_FLAPS * proposal.on_flaps;
            if score > LEAST_SCORE {
                all.push(Shell { proposal, looked, score, flaps: [None; 4] });
            }
        }
    }
    all.sort_by(|a, b| b.score.total_cmp(&a.score));
    let mut out: Vec<Shell> = Vec::new();
    for shell in all {
        let rivals = out.iter().filter(|other| overlap(&other.proposal, &shell.proposal)).count();
        if rivals < RIVALS && !out.iter().any(|other| alike(&other.proposal, &shell.proposal)) {
            out.push(shell);
        }
        if out.len() >= MOST_SHELLS {
            break;
        }
    }
    out
}

fn all_proposals(patches: &[Patch]) -> Vec<Proposal> {
    let mut out = Vec::new();
    for up in ways_up(patches) {
        let x = (Vec3::x() - up * up.x).normalize();
        let frame = [x, up.cross(&x), up];
        out.extend(yaws(patches, &frame).into_iter().flat_map(|yaw| proposals(patches, &frame, yaw)));
    }
    out
}

/// Pixels for a box more than against it.
const LEAST_SCORE: f64 = 300.0;
const ALIKE_M: f64 = 0.009;

fn alike(a: &Proposal, b: &Proposal) -> bool {
    let same_axes = a.axes[0].dot(&b.axes[0]) > 0.998 && a.up.dot(&b.up) > 0.9993;
    let near = |x: &[f64; 2], y: &[f64; 2]| (x[0] - y[0]).abs() < ALIKE_M && (x[1] - y[1]).abs() < ALIKE_M;
    same_axes && near(&a.spans[0], &b.spans[0]) && near(&a.spans[1], &b.spans[1]) && near(&a.heights, &b.heights)
}

/// Whether one's middle lies in the other.
fn overlap(a: &Proposal, b: &Proposal) -> bool {
    let within = |a: &Proposal, b: &Proposal| {
        let middle = middle(b);
        (0..2).all(|i| (a.spans[i][0]..=a.spans[i][1]).contains(&a.axes[i].dot(&middle)))
    };
    within(a, b) || within(b, a)
}

fn middle(proposal: &Proposal) -> Vec3 {
    let half = |span: &[f64; 2]| (span[0] + span[1]) / 2.0;
    let [x, y] = proposal.spans.each_ref().map(half);
    proposal.axes[0] * x + proposal.axes[1] * y + proposal.up * half(&proposal.heights)
}

/// How well a proposal's lengths are known.
const PROPOSED_SIGMA_M: f64 = 0.01;

fn outer_m(proposal: &Proposal) -> [f64; 3] {
    let [x, y] = proposal.spans;
    [x[1] - x[0], y[1] - y[0], proposal.heights[1] - proposal.heights[0]]
}

fn sized(mut found: FoundBox, sizes: &[KnownSize]) -> FoundBox {
    found.size = best_match(&found.solution, sizes);
    found
}

fn body_of(proposal: &Proposal) -> FittedBody {
    let [x, y] = proposal.spans;
    let rotation = Rotation3::from_basis_unchecked(&[proposal.axes[0], proposal.axes[1], proposal.up]);
    let rotation = UnitQuaternion::from_rotation_matrix(&rotation);
    let mut numbers = Parameters::zeros();
    numbers[layout::LENGTH] = x[1] - x[0] - BOARD_M;
    numbers[layout::WIDTH] = y[1] - y[0] - BOARD_M;
    numbers[layout::HEIGHT] = proposal.heights[1] - proposal.heights[0];
    numbers[layout::THICKNESS] = BOARD_M;
    let bottom = middle(proposal) - proposal.up * (numbers[layout::HEIGHT] / 2.0);
    let mut body = FittedBody { input_from_object: Isometry3::from_parts(Translation3::from(bottom), rotation), numbers };
    for k in 0..4 {
        body.numbers[layout::flap(k) + layout::FLAP_LENGTH] = 0.1;
        body.numbers[layout::flap(k) + layout::FLAP_WIDTH] = body.edge_m(k) - 0.006;
        body.numbers[layout::flap(k) + layout::FLAP_ANGLE] = std::f64::consts::PI;
        body.numbers[layout::tuck(k) + layout::TUCK_LENGTH] = 0.04;
        body.numbers[layout::tuck(k) + layout::TUCK_WIDTH] = body.edge_m(k) - 0.016;
    }
    body
}

const FLAP_ANGLES_RAD: [f64; 2] = [-0.25, 4.3];

fn scan_flaps(sight: &Sight, body: &FittedBody, model_m: f64) -> [Option<ScannedFlap>; 4] {
    std::array::from_fn(|k| {
        let range = ScanRange { angles_rad: FLAP_ANGLES_RAD, longest_m: 1.06 * body.edge_m(k + 1) + 0.02, model_m };
        scan(sight, &HingeLine::of_side(body, k), &range).filter(is_flap)
    })
}

fn is_flap(flap: &ScannedFlap) -> bool {
    flap.met > 120.0 && flap.met > 1.5 * flap.through
}

fn with_flaps(body: &FittedBody, flaps: &[Option<ScannedFlap>; 4]) -> (FittedBody, Present) {
    let mut out = body.clone();
    let mut present = Present::default();
    for (k, flap) in flaps.iter().enumerate() {
        let Some(flap) = flap else { continue };
        present.flaps[k] = true;
        out.numbers[layout::flap(k) + layout::FLAP_ANGLE] = flap.angle_rad;
        out.numbers[layout::flap(k) + layout::FLAP_CURL] = flap.curl;
        out.numbers[layout::flap(k) + layout::FLAP_LENGTH] = flap.length_m;
    }
    (out, present)
}

/// Readings of other surfaces lean more than this off the panel that they were given to: the tangent.
const MOST_LEAN: f64 = 0.35;
/// Parts of fewer readings are not called seen.
const LEAST_READINGS: usize = 320;

/// Parts whose readings are few, or lie across them.
fn drop_unsure(sight: &Sight, body: &FittedBody, labels: &mut Labels) {
    let stride = labels.stride;
    for (role, points) in &mut labels.parts {
        let leans = || lean(sight, body, *role, points).is_none_or(|lean| lean > MOST_LEAN);
        if points.len() * stride * stride < LEAST_READINGS || leans() {
            points.clear();
        }
    }
    for k in 0..4 {
        if labels.of(Role::Flap(k)).is_empty() {
            labels.clear(Role::Tuck(k));
        }
    }
}

const LEAST_FLAP_M: f64 = 0.012;

/// Without flaps that the fit has made vanish.
fn long_enough(body: &FittedBody, present: &Present) -> Present {
    let mut out = *present;
    for k in 0..4 {
        out.flaps[k] &= body.get(layout::flap(k) + layout::FLAP_LENGTH) > LEAST_FLAP_M;
        out.tucks[k] &= out.flaps[k] && body.get(layout::tuck(k) + layout::TUCK_LENGTH) > LEAST_FLAP_M;
    }
    out
}

/// The tuck flap on each flap's free edge.
fn scan_tucks(sight: &Sight, body: &FittedBody, present: &Present, model_m: f64) -> [Option<ScannedFlap>; 4] {
    std::array::from_fn(|k| {
        if !present.flaps[k] {
            return None;
        }
        let longest_m = (0.45 * body.get(layout::flap(k) + layout::FLAP_LENGTH)).min(0.12);
        let range = ScanRange { angles_rad: TUCK_ANGLES_RAD, longest_m, model_m };
        scan(sight, &HingeLine::of_flap(body, k), &range).filter(is_flap)
    })
}

const TUCK_ANGLES_RAD: [f64; 2] = [-1.9, 2.2];

fn with_tucks(body: &FittedBody, present: &Present, tucks: &[Option<ScannedFlap>; 4]) -> (FittedBody, Present) {
    let (mut out, mut present) = (body.clone(), *present);
    for (k, tuck) in tucks.iter().enumerate() {
        let Some(tuck) = tuck else { continue };
        present.tucks[k] = true;
        out.numbers[layout::tuck(k) + layout::TUCK_ANGLE] = tuck.angle_rad;
        out.numbers[layout::tuck(k) + layout::TUCK_LENGTH] = tuck.length_m;
        out.numbers[layout::tuck(k) + layout::TUCK_WIDTH] = body.get(layout::flap(k) + layout::FLAP_WIDTH) - 0.01;
    }
    (out, present)
}

/// Every so many columns and rows are asked while boxes still compete.
const COARSE_STRIDE: usize = 3;

/// From a shell to a box fitted to some of its readings.
fn grow(sight: &Sight, shell: &Shell, settings: &FitSettings) -> Option<FoundBox> {
    let settings = FitSettings { face_samples: 40, end_strips: 10, least_gain: 1e-2, ..*settings };
    let (body, present) = with_flaps(&body_of(&shell.proposal), &shell.flaps);
    let labels = label(sight, &body, &present, COARSE_M, COARSE_STRIDE);
    let solution = refit(sight, &body, &present, &labels, &settings).ok()?;
    check(&solution.body).ok()?;
    let (body, present) = with_flaps(&solution.body, &scan_flaps(sight, &solution.body, FINE_M + 0.001));
    let mut labels = label(sight, &body, &present, FINE_M, COARSE_STRIDE);
    drop_unsure(sight, &body, &mut labels);
    let solution = refit(sight, &body, &present, &labels, &settings).ok()?;
    check(&solution.body).ok()?;
    Some(weigh(sight, solution, present, COARSE_STRIDE))
}

/// A box that has won, with its tuck flaps, fitted to all of its readings.
fn finish(sight: &Sight, found: FoundBox, sizes: &[KnownSize], settings: &FitSettings) -> Option<FoundBox> {
    let body = &found.solution.body;
    let (body, present) = with_tucks(body, &found.present, &scan_tucks(sight, body, &found.present, FINE_M));
    let mut labels = label(sight, &body, &present, FINE_M, 1);
    drop_unsure(sight, &body, &mut labels);
    let solution = refit(sight, &body, &present, &labels, settings).ok()?;
    let (solution, size) = with_known_size(solution, sizes, settings.seen_scale);
    check(&solution.body).ok()?;
    let mut out = FoundBox { size, ..weigh(sight, solution, present, 1) };
    out.features = features::of_box(sight, &out);
    let of = |(role, evidence): &(Role, Evidence)| {
        let points = out.labels.of(*role);
        (!points.is_empty()).then(|| (*role, features::of_part(sight, &out.solution.body, *role, points, evidence)))
    };
    out.part_features = out.evidence.iter().filter_map(of).collect();
    Some(out)
}

/// Readings on its panels, each counted once, less twice those through them, less those that close the opening and are of no
/// flap. The base says nothing: the floor agrees as well.
fn score(sight: &Sight, body: &FittedBody, labels: &Labels, evidence: &[(Role, Evidence)]) -> f64 {
    let lid = Sheet::of_opening(body, &sight.eye).look(sight, FINE_M).met;
    let is_closed = |role: Role| matches!(role, Role::Flap(k) if body.get(layout::flap(k) + layout::FLAP_ANGLE).abs() < CLOSED_RAD);
    let on = |wanted: &dyn Fn(Role) -> bool| -> f64 {
        labels.parts.iter().filter(|(role, _)| wanted(*role)).map(|(_, points)| labels.count(points) as f64).sum()
    };
    let through: f64 = evidence.iter().map(|(_, e)| e.through).sum();
    on(&|role| role != Role::Base) - 2.0 * through - (lid - on(&is_closed)).max(0.0)
}

const CLOSED_RAD: f64 = 0.3;

/// A fitted box with its readings and what the rays say of its panels.
fn weigh(sight: &Sight, solution: Solution, present: Present, stride: usize) -> FoundBox {
    let present = long_enough(&solution.body, &present);
    let mut labels = label(sight, &solution.body, &present, FINE_M, stride);
    drop_unsure(sight, &solution.body, &mut labels);
    let look = |role: Role| (role, Sheet::new(&solution.body, role, &sight.eye).look(sight, FINE_M));
    let evidence: Vec<(Role, Evidence)> = roles(&present).into_iter().map(look).collect();
    let score = score(sight, &solution.body, &labels, &evidence);
    FoundBox { solution, present, labels, evidence, score, size: None, features: Vec::new(), part_features: Vec::new() }
}

/// Readings are shared by cells of so many pixels: boxes were not asked at the same ones.
const COARSE_CELL: usize = 4;

/// Takes the best, and of the rest those that leave its readings alone.
fn choose(mut found: Vec<FoundBox>, width: usize) -> Vec<FoundBox> {
    let rank = |one: &FoundBox| one.score * share_of_score(one.size.as_ref());
    found.sort_by(|a, b| rank(b).total_cmp(&rank(a)));
    let mut out: Vec<FoundBox> = Vec::new();
    let mut taken = std::collections::BTreeSet::new();
    for candidate in found {
        let coarse = |index: &u32| {
            let (column, row) = (*index as usize % width / COARSE_CELL, *index as usize / width / COARSE_CELL);
            (row * width + column) as u32
        };
        let mut points: Vec<u32> = candidate.labels.parts.iter().flat_map(|(_, points)| points).map(coarse).collect();
        points.sort_unstable();
        points.dedup();
        let shared = points.iter().filter(|point| taken.contains(*point)).count();
        if candidate.score > LEAST_SCORE && 4 * shared <= points.len() {
            taken.extend(points);
            out.push(candidate);
        }
    }
    out
}
