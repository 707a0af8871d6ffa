//! A closing with times, as plan.json tells it (docs/formats.md).

use serde::Serialize;

use super::closing::Closing;
use super::guard::{Guard, Moment};
use super::piece::{Kind, Piece};
use super::problem::BoxProblem;
use super::reason::{Obstacle, Status};
use super::settings::PlanningSettings;
use super::timing::{time, Bounds, Timed};
use super::transit::widest_turn;
use crate::arm::{Arm, JointPositions};
use crate::error::{InputError, Result};
use crate::geometry::Vec3;

/// A piece of the motion with N samples; the keys are plan.json's.
#[derive(Debug, Clone, Serialize)]
pub struct Segment {
    pub flap: Option<String>,
    pub kind: &'static str,
    pub times: Vec<f64>,
    pub positions: Vec<Vec<f64>>,
    pub velocities: Vec<Vec<f64>>,
    pub gripper_opening_m: f64,
    pub hinge_angle_rad: Option<Vec<f64>>,
    pub contact: Option<Vec<[f64; 3]>>,
    /// Where all flaps are meanwhile, in the problem's order; the pushed one moves.
    #[serde(skip)]
    pub angles_rad: Vec<f64>,
    #[serde(skip)]
    pub pushed: Option<usize>,
}

#[derive(Debug, Clone, Serialize)]
pub struct FlapAnswer {
    pub name: String,
    pub status: &'static str,
    pub reason: Option<String>,
    pub seconds: f64,
    pub rest_rad: Option<f64>,
}

/// What plan.json says of the motion.
#[derive(Debug, Clone, Serialize)]
pub struct Answer {
    pub robot: String,
    pub joint_names: Vec<String>,
    pub order: Vec<String>,
    pub flaps: Vec<FlapAnswer>,
    pub segments: Vec<Segment>,
}

impl Answer {
    /// # Errors
    /// Where a number is none: a fault of the planner.
    pub fn to_json(&self) -> Result<String> {
        serde_json::to_string(self).map_err(|error| InputError::new(error.to_string()).in_source("plan"))
    }
}

/// Where a motion violates what it must keep.
#[derive(Debug, Clone, PartialEq)]
pub struct Conflict {
    /// The flap that is pushed, or that the arm is on its way to or from.
    pub flap: String,
    pub time_s: f64,
    pub obstacle: Obstacle,
}

/// Beyond a limit by less is on it.
const ROUNDING_RAD: f64 = 1e-9;

impl Answer {
    /// The first conflict of each segment, of moments a step apart.
    pub fn conflicts<G: Guard>(&self, arm: &Arm, guard: &G, step_s: f64, clearance_m: f64) -> Vec<Conflict> {
        guard.explain_anew();
        let found = self.segments.iter().enumerate().filter_map(|(k, segment)| {
            let guard = guard.with_opening(segment.gripper_opening_m);
            let (time_s, obstacle) = segment.conflict(arm, &guard, step_s, clearance_m)?;
            Some(Conflict { flap: self.flap_of(k)?, time_s, obstacle })
        });
        found.collect()
    }

    /// A transit belongs to the flap that it leads to; the last to the one that it comes from.
    fn flap_of(&self, segment: usize) -> Option<String> {
        let after = self.segments[segment..].iter().find_map(|later| later.flap.clone());
        after.or_else(|| self.segments[..segment].iter().rev().find_map(|before| before.flap.clone()))
    }

    /// Says of flaps that were left open why.
    pub fn tell_left_open(&mut self, left_open: &[(String, Obstacle)]) {
        for (name, obstacle) in left_open {
            if let Some(flap) = self.flaps.iter_mut().find(|flap| flap.name == *name) {
                flap.status = Status::Blocked.name();
                flap.reason = Some(match obstacle {
                    Obstacle::NoWay { .. } => obstacle.to_string(),
                    _ => format!("between two postures: {obstacle}"),
                });
            }
        }
    }
}

/// Directions of two steps whose cosine is below this make a corner, at which the arm stops.
const CORNER: f64 = 0.98;

/// Gives every piece its times, one after the other.
pub fn timed(closing: &Closing, arm: &Arm, problem: &BoxProblem, settings: &PlanningSettings) -> Answer {
    let name = |flap: usize| problem.flaps[flap].name.clone();
    let mut segments = Vec::new();
    let mut start_s = 0.0;
    for piece in &closing.pieces {
        let segment = segment(piece, arm, problem, settings, start_s);
        start_s = *segment.times.last().unwrap_or(&start_s);
        segments.push(segment);
    }
    segments.retain(|segment| segment.times.len() > 1);
    let flaps = closing.outcomes.iter().enumerate().map(|(flap, outcome)| FlapAnswer {
        name: name(flap),
        status: outcome.status.name(),
        reason: (!outcome.reason.is_empty()).then(|| outcome.reason.clone()),
        seconds: outcome.seconds,
        rest_rad: outcome.rest_rad,
    });
    Answer {
        robot: arm.name.clone(),
        joint_names: arm.joints.iter().map(|joint| joint.name.clone()).collect(),
        order: closing.order.iter().map(|&flap| name(flap)).collect(),
        flaps: flaps.collect(),
        segments,
    }
}

fn segment(piece: &Piece, arm: &Arm, problem: &BoxProblem, settings: &PlanningSettings, start_s: f64) -> Segment {
    let is_push = piece.kind == Kind::Push;
    let mut segment = Segment {
        flap: piece.flap.map(|flap| problem.flaps[flap].name.clone()),
        kind: piece.kind.name(),
        times: Vec::new(),
        positions: Vec::new(),
        velocities: Vec::new(),
        gripper_opening_m: piece.opening_m,
        hinge_angle_rad: is_push.then(Vec::new),
        contact: is_push.then(Vec::new),
        angles_rad: piece.angles_rad.clone(),
        pushed: piece.flap,
    };
    let share = match piece.kind {
        Kind::Transit => settings.free_share,
        Kind::Approach | Kind::Push | Kind::Retreat => settings.contact_share,
    };
    let bounds: Vec<Bounds> = arm
        .joints
        .iter()
        .map(|joint| Bounds {
            speed: share * joint.speed_rad_per_s,
            acceleration: share * joint.acceleration_rad_per_s2,
        })
        .collect();
    let lengths = lengths(&piece.positions);
    let mut now_s = start_s;
    for (first, last) in legs(&piece.positions) {
        let way = &piece.positions[first..=last];
        // A leg's places begin at 0; those of the piece where the leg begins.
        let cap = |place: f64| match is_push {
            true => speed_cap(piece, &lengths, lengths[first] + place, settings).powi(2),
            false => f64::INFINITY,
        };
        let Some(leg) = time(way, &bounds, settings.period_s, cap) else { continue };
        segment.add(&leg, now_s, piece, &lengths, (lengths[first], lengths[last]));
        now_s += leg.duration_s();
    }
    segment
}

impl Segment {
    fn add(&mut self, leg: &Timed, start_s: f64, piece: &Piece, lengths: &[f64], (from, to): (f64, f64)) {
        // A corner's posture ends one leg and begins the next: once.
        let skip = usize::from(!self.times.is_empty());
        for k in skip..leg.times_s.len() {
            self.times.push(start_s + leg.times_s[k]);
            self.positions.push(leg.positions[k].to_vec());
            self.velocities.push(leg.velocities[k].to_vec());
            let place = from + (to - from) * leg.shares[k];
            let (knot, share) = knot_before(lengths, place);
            if let Some(angles) = &mut self.hinge_angle_rad {
                angles.push(piece.hinge_rad[knot] * (1.0 - share) + piece.hinge_rad[knot + 1] * share);
            }
            if let Some(points) = &mut self.contact {
                let point: Vec3 = piece.contact[knot] * (1.0 - share) + piece.contact[knot + 1] * share;
                points.push([point.x, point.y, point.z]);
            }
        }
    }

    /// The first moment, of those a step apart, at which the motion leaves the joints' limits or comes nearer to anything than
    /// `clearance_m`: when, and to what.
    fn conflict<G: Guard>(&self, arm: &Arm, guard: &G, step_s: f64, clearance_m: f64) -> Option<(f64, Obstacle)> {
        for k in 0..self.times.len() - 1 {
            let span_s = self.times[k + 1] - self.times[k];
            let steps = (span_s / step_s).ceil().max(1.0) as usize;
            for step in 0..steps {
                let share = step as f64 / steps as f64;
                let positions = self.between(k, share, span_s);
                let limit = arm.limit_violation(&positions).filter(|&(_, over_rad)| over_rad > ROUNDING_RAD);
                let beyond = limit.map(|(joint, _)| Obstacle::Limit { joint: arm.joints[joint].name.clone() });
                let near = || guard.conflict(&positions, &self.moment(k, share), clearance_m);
                if let Some(obstacle) = beyond.or_else(near) {
                    return Some((self.times[k] + share * span_s, obstacle));
                }
            }
        }
        None
    }

    /// Where the flaps are within sample k and the next.
    fn moment(&self, k: usize, share: f64) -> Moment {
        let resting = Moment::resting(&self.angles_rad);
        match (&self.hinge_angle_rad, self.pushed) {
            (Some(angles), Some(flap)) => resting.pushing(flap, angles[k] * (1.0 - share) + angles[k + 1] * share),
            (None, Some(flap)) => resting.pushing(flap, self.angles_rad[flap]),
            (_, None) => resting,
        }
    }

    /// The cubic through two samples' positions and velocities.
    fn between(&self, k: usize, share: f64, span_s: f64) -> JointPositions {
        let mut made = JointPositions::from_slice(&self.positions[k]);
        let (rest, s) = (1.0 - share, share);
        for j in 0..made.len() {
            let (p, q) = (self.positions[k][j], self.positions[k + 1][j]);
            let (v, w) = (self.velocities[k][j] * span_s, self.velocities[k + 1][j] * span_s);
            made[j] = p * rest * rest * (1.0 + 2.0 * s) + v * s * rest * rest + q * s * s * (3.0 - 2.0 * s)
                - w * s * s * rest;
        }
        made
    }
}

/// The greatest path speed (widest turns, rad/s) at which hinge and finger keep to the speeds of contact.
fn speed_cap(piece: &Piece, lengths: &[f64], place: f64, settings: &PlanningSettings) -> f64 {
    let (knot, _) = knot_before(lengths, place);
    let width = (lengths[knot + 1] - lengths[knot]).max(1e-9);
    let turn = (piece.hinge_rad[knot + 1] - piece.hinge_rad[knot]).abs() / width;
    let slide = (piece.contact[knot + 1] - piece.contact[knot]).norm() / width;
    let by_hinge = settings.hinge_rad_per_s / turn.max(1e-9);
    by_hinge.min(settings.contact_m_per_s / slide.max(1e-9))
}

fn lengths(way: &[JointPositions]) -> Vec<f64> {
    let mut found = vec![0.0];
    for pair in way.windows(2) {
        found.push(found[found.len() - 1] + widest_turn(&pair[0], &pair[1]));
    }
    found
}

/// The knot before a place, and the share of the way from it to the next.
fn knot_before(lengths: &[f64], place: f64) -> (usize, f64) {
    let knot = lengths.partition_point(|&length| length <= place).clamp(1, lengths.len() - 1) - 1;
    let width = lengths[knot + 1] - lengths[knot];
    (knot, if width > 0.0 { ((place - lengths[knot]) / width).clamp(0.0, 1.0) } else { 1.0 })
}

/// Index ranges, ends included, of a way between its corners.
fn legs(way: &[JointPositions]) -> Vec<(usize, usize)> {
    let mut found = Vec::new();
    let mut first = 0;
    for k in 1..way.len().saturating_sub(1) {
        let steps = way[k].iter().zip(way[k - 1].iter()).zip(way[k + 1].iter()).map(|((q, p), r)| (q - p, r - q));
        let sums = steps.fold([0.0; 3], |[dot, before_sq, after_sq], (before, after)| {
            [dot + before * after, before_sq + before * before, after_sq + after * after]
        });
        if sums[0] < CORNER * f64::sqrt(sums[1] * sums[2]) {
            found.push((first, k));
            first = k;
        }
    }
    if way.len() > 1 {
        found.push((first, way.len() - 1));
    }
    found
}
