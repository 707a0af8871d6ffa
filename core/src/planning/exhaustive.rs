//! Brute force over one flap's push: can any motion of the arm close it? It shares the inverse kinematics and the collision engine with
//! the planner, not its contacts, its grid of orientations or its search; it answers yes or no, for tables, and takes its time.

use std::collections::{HashMap, HashSet};

use nalgebra::{Matrix3, Rotation3, Unit};

use super::flap::Flap;
use super::guard::{Guard, Moment};
use super::settings::PlanningSettings;
use crate::arm::{Arm, JointPositions, Shape};
use crate::collision::{signed_distance_m, OrientedBox, Solid};
use crate::geometry::{Rigid, Vec3};

/// Between two hinge angles; turns about the finger.
const STEP_RAD: f64 = 0.0873;
const TURNS: usize = 4;
/// A motion among fewer contacts and directions is one too: they are tried first, as they take a sixteenth of the time.
const COARSE: Fineness = Fineness { contacts: 5, directions: 50 };
const FINE: Fineness = Fineness { contacts: 10, directions: 200 };
/// No joint turns more from one hinge angle to the next.
const MOST_TURN_RAD: f64 = 0.6;
/// The finger is slid off the board in so many steps, to within this.
const SLIDES: usize = 12;
const TOUCHING_M: f64 = 0.0002;

/// How many contacts are tried along a flap and across it, and how many tool directions.
#[derive(Debug, Clone, Copy)]
struct Fineness {
    contacts: usize,
    directions: usize,
}

/// One flap before one arm.
pub struct Exhaustive<'a, G: Guard> {
    pub arm: &'a Arm,
    pub guard: &'a G,
    pub settings: &'a PlanningSettings,
    pub flap: &'a Flap,
    pub number: usize,
    pub thickness_m: f64,
    /// Where all flaps are.
    pub moment: &'a Moment,
}

impl<G: Guard> Exhaustive<'_, G> {
    /// Is there a chain of postures, hinge angle by hinge angle down to 0, each clear and near the one before?
    pub fn can_close(&self) -> bool {
        self.is_chain(COARSE) || self.is_chain(FINE)
    }

    fn is_chain(&self, fineness: Fineness) -> bool {
        let start_rad = self.moment.angles_rad[self.number];
        let steps = (start_rad / STEP_RAD).ceil().max(1.0) as usize;
        let mut last: Option<Vec<JointPositions>> = None;
        for step in 0..=steps {
            let angle_rad = start_rad * (1.0 - step as f64 / steps as f64);
            let near = last.as_ref().map(|postures| Cells::of(postures));
            let reached = self.postures(angle_rad, fineness, near.as_ref());
            if reached.is_empty() {
                return false;
            }
            last = Some(reached);
        }
        true
    }

    /// Every clear posture at an angle that is near one of the angle before.
    fn postures(&self, angle_rad: f64, fineness: Fineness, near: Option<&Cells<'_>>) -> Vec<JointPositions> {
        let contacts = fineness.contacts;
        let moment = self.moment.pushing(self.number, angle_rad);
        let Some(board) = OrientedBox::of_panel(&self.flap.corners(angle_rad), self.thickness_m) else {
            return Vec::new();
        };
        let frame = self.flap.frame(angle_rad);
        let mut found = Vec::new();
        let mut seen = HashSet::new();
        for direction in directions(fineness.directions) {
            for turn in 0..TURNS {
                let rotation = pointing(&direction, std::f64::consts::PI * turn as f64 / TURNS as f64);
                for contact in 0..contacts * contacts {
                    let share = |k: usize| 0.03 + 0.94 * k as f64 / (contacts - 1) as f64;
                    let u = self.flap.hinge_length_m() * share(contact % contacts);
                    let v = self.flap.length_m() * share(contact / contacts);
                    let start = Rigid::new(rotation, frame.at(u, v, self.thickness_m / 2.0));
                    let Some(pose) = self.slid_off(start, &board, &frame.outward) else { continue };
                    if self.guard.tool_conflict(&pose, &moment, self.settings.clearance_m).is_some() {
                        continue;
                    }
                    for solution in self.arm.inverse(&pose) {
                        let positions = solution.positions;
                        // Postures within a cell of a twentieth of a radian stand for one another.
                        let fresh =
                            seen.insert(positions.iter().map(|q| (q / 0.05).round() as i32).collect::<Vec<_>>());
                        let follows = near.is_none_or(|cells| cells.has_near(&positions));
                        if fresh
                            && follows
                            && self.guard.conflict(&positions, &moment, self.settings.clearance_m).is_none()
                        {
                            found.push(positions);
                        }
                    }
                }
            }
        }
        found
    }

    /// The tool moved along `outward` until its fingers are just off the board; None where they do not come off.
    fn slid_off(&self, mut pose: Rigid, board: &OrientedBox, outward: &Vec3) -> Option<Rigid> {
        let gripper = &self.arm.gripper;
        let tool_from_flange = gripper.flange_from_tool().inverse();
        for _ in 0..SLIDES {
            let fingers = gripper.fingers(gripper.opening_m[0]);
            let nearest_m = fingers.iter().filter_map(|finger| match finger {
                Shape::Box { body_from_box, half_m } => {
                    let placed = OrientedBox::new(pose.then(&tool_from_flange).then(body_from_box), *half_m);
                    Some(signed_distance_m(&Solid::Box(placed), &Solid::Box(*board)))
                }
                Shape::Capsule { .. } => None,
            });
            let gap_m = nearest_m.fold(f64::INFINITY, f64::min);
            if (0.0..=TOUCHING_M).contains(&gap_m) {
                return Some(pose);
            }
            pose.translation += outward * (TOUCHING_M / 2.0 - gap_m);
        }
        None
    }
}

/// Postures by cells of the first three joints.
struct Cells<'a> {
    postures: &'a [JointPositions],
    cells: HashMap<[i32; 3], Vec<usize>>,
}

impl<'a> Cells<'a> {
    fn of(postures: &'a [JointPositions]) -> Self {
        let mut cells: HashMap<[i32; 3], Vec<usize>> = HashMap::new();
        for (k, posture) in postures.iter().enumerate() {
            cells.entry(cell(posture)).or_default().push(k);
        }
        Self { postures, cells }
    }

    fn has_near(&self, posture: &JointPositions) -> bool {
        let [x, y, z] = cell(posture);
        let around = (0..27).map(|k| [x + k % 3 - 1, y + k / 3 % 3 - 1, z + k / 9 - 1]);
        around.filter_map(|key| self.cells.get(&key)).flatten().any(|&k| {
            let turns = self.postures[k].iter().zip(posture.iter()).map(|(a, b)| (a - b).abs());
            turns.fold(0.0, f64::max) <= MOST_TURN_RAD
        })
    }
}

fn cell(posture: &JointPositions) -> [i32; 3] {
    std::array::from_fn(|k| (posture[k] / MOST_TURN_RAD).floor() as i32)
}

/// Evenly spread over the sphere (Fibonacci's lattice).
fn directions(count: usize) -> impl Iterator<Item = Vec3> {
    (0..count).map(move |k| {
        let z = 1.0 - (2.0 * k as f64 + 1.0) / count as f64;
        let turn = k as f64 * std::f64::consts::PI * (3.0 - 5f64.sqrt());
        let radius = (1.0 - z * z).sqrt();
        Vec3::new(radius * turn.cos(), radius * turn.sin(), z)
    })
}

fn pointing(direction: &Vec3, turn_rad: f64) -> Matrix3<f64> {
    let reference = if direction.z.abs() < 0.9 { Vec3::z() } else { Vec3::x() };
    let x = (reference - direction * reference.dot(direction)).normalize();
    let upright = Matrix3::from_columns(&[x, direction.cross(&x), *direction]);
    Rotation3::from_axis_angle(&Unit::new_unchecked(*direction), turn_rad).matrix() * upright
}
