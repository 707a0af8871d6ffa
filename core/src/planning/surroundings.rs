//! The collision engine as the planner's guard: the box with its flaps where they are at a moment, the support, the scene.

use std::cell::{Cell, RefCell};

use super::flap::Standing;
use super::guard::{Guard, Moment};
use super::problem::BoxProblem;
use super::reason::Obstacle;
use crate::arm::{Arm, Shape};
use crate::collision::{clear_by, ArmPieces, Checker, HalfSpace, OrientedBox, Rules, Solid, World, IGNORED};
use crate::error::{InputError, Result};
use crate::geometry::{Rigid, Vec3};

/// An arm with its gripper closed before a box; moves the box's flaps as it is asked.
pub struct Surroundings<'a> {
    arm: &'a Arm,
    problem: &'a BoxProblem,
    pieces: ArmPieces,
    state: RefCell<State>,
    /// Of each flap: its board and its tucks in the world, none where it is absent.
    boards: Vec<Vec<usize>>,
    conflicts: Cell<usize>,
    /// Fingers and gripper body: is it a finger, where it is in the tool's frame, half its sizes.
    tool: Vec<(bool, Rigid, Vec3)>,
}

struct State {
    world: World,
    at: Option<Vec<f64>>,
    /// By clearance and pushed flap.
    rules: Vec<((f64, Option<usize>), Rules)>,
}

/// A finger that touches is told to be this far inside by rounding.
const ROUNDING_M: f64 = 1e-6;
/// Which conflicts are looked into for their pair: all of the first, then one of so many. Asking which takes longer than whether.
const EXPLAINED: usize = 16;
const EXPLAINED_OF: usize = 32;

impl<'a> Surroundings<'a> {
    /// `scene` are things beside the box, by name.
    pub fn new(arm: &'a Arm, problem: &'a BoxProblem, scene: Vec<(String, Solid)>) -> Self {
        let mut world = World::default();
        for board in &problem.fixed {
            if let Some(solid) = OrientedBox::of_panel(&board.corners, problem.thickness_m) {
                world.add(board.name.as_str(), Solid::Box(solid));
            }
        }
        if let Some((normal, distance_m)) = problem.support {
            world.add("the support", Solid::HalfSpace(HalfSpace { normal, distance_m }));
        }
        for (name, solid) in scene {
            world.add(name, solid);
        }
        let boards = (0..problem.flaps.len()).map(|flap| add_flap(&mut world, problem, flap)).collect();
        Self {
            arm,
            problem,
            pieces: ArmPieces::new(arm, arm.gripper.opening_m[0]),
            state: RefCell::new(State { world, at: None, rules: Vec::new() }),
            boards,
            conflicts: Cell::new(0),
            tool: tool_pieces(arm, arm.gripper.opening_m[0]),
        }
    }

    /// # Errors
    /// Where the arm's base, or the arm in its ready pose, stands inside something.
    pub fn check_base(&self) -> Result<()> {
        let state = &*self.state.borrow();
        let mut rules = Rules::new(self.arm, &state.world, 0.0);
        for (k, obstacle) in state.world.obstacles().iter().enumerate() {
            if matches!(obstacle.solid, Solid::HalfSpace(_)) {
                rules.set(0, k, IGNORED);
            }
        }
        let checker = Checker { arm: self.arm, pieces: &self.pieces, world: &state.world };
        let nearest = checker.nearest(&self.arm.ready, &rules).filter(|nearest| nearest.spare_m < 0.0);
        let Some(nearest) = nearest else { return Ok(()) };
        let (body, other) = (self.arm.body_name(nearest.body), checker.other_name(nearest.other));
        let problem = format!("the arm's {body} stands inside {other} before it has moved");
        Err(InputError::new(problem)
            .mend("base_from_input must put box and support clear of the arm's base and ready pose"))
    }

    /// Puts the flaps where they are at a moment.
    fn place(&self, state: &mut State, moment: &Moment) {
        for (k, flap) in self.problem.flaps.iter().enumerate() {
            let angle_rad = moment.angles_rad[k];
            if self.boards[k].is_empty() || state.at.as_ref().is_some_and(|at| at[k] == angle_rad) {
                continue;
            }
            let corners =
                std::iter::once(flap.corners(angle_rad)).chain(flap.tuck_corners(angle_rad).map(|tuck| tuck.1));
            for (corners, &index) in corners.zip(&self.boards[k]) {
                if let Some(solid) = OrientedBox::of_panel(&corners, self.problem.thickness_m) {
                    state.world.replace(index, Solid::Box(solid));
                }
            }
        }
        state.at = Some(moment.angles_rad.clone());
    }

    fn rules_for(&self, state: &mut State, clearance_m: f64, pushed: Option<usize>) -> usize {
        let key = (clearance_m, pushed);
        if let Some(known) = state.rules.iter().position(|(other, _)| *other == key) {
            return known;
        }
        let mut rules = Rules::new(self.arm, &state.world, clearance_m);
        // It is bolted down: where it stands is checked before anything is planned.
        rules.set_body(0, IGNORED);
        if let Some(boards) = pushed.map(|flap| &self.boards[flap]) {
            // What is pushed comes to where nothing stood then.
            boards.iter().for_each(|&board| rules.set(0, board, 0.0));
            boards.first().into_iter().for_each(|&board| rules.set(self.arm.fingers_body(), board, -ROUNDING_M));
        }
        state.rules.push((key, rules));
        state.rules.len() - 1
    }
}

fn tool_pieces(arm: &Arm, opening_m: f64) -> Vec<(bool, Rigid, Vec3)> {
    let gripper = &arm.gripper;
    let tool_from_flange = gripper.flange_from_tool().inverse();
    let fingers = gripper.fingers(opening_m).map(|finger| (true, finger));
    let shapes = fingers.into_iter().chain(std::iter::once((false, gripper.body())));
    let boxes = shapes.filter_map(|(is_finger, shape)| match shape {
        Shape::Box { body_from_box, half_m } => Some((is_finger, tool_from_flange.then(&body_from_box), half_m)),
        Shape::Capsule { .. } => None,
    });
    boxes.collect()
}

/// Adds a flap's board and its tucks; what is not there adds nothing.
fn add_flap(world: &mut World, problem: &BoxProblem, flap: usize) -> Vec<usize> {
    let flap = &problem.flaps[flap];
    if flap.standing == Standing::Absent {
        return Vec::new();
    }
    let tucks = flap.tuck_corners(flap.position_rad);
    let boards = std::iter::once((flap.name.as_str(), flap.corners(flap.position_rad))).chain(tucks);
    let solids =
        boards.filter_map(|(name, corners)| Some((name, OrientedBox::of_panel(&corners, problem.thickness_m)?)));
    solids.map(|(name, solid)| world.add(name, Solid::Box(solid))).collect()
}

impl Guard for Surroundings<'_> {
    fn conflict(&self, positions_rad: &[f64], moment: &Moment, clearance_m: f64) -> Option<Obstacle> {
        let state = &mut *self.state.borrow_mut();
        self.place(state, moment);
        let rules = self.rules_for(state, clearance_m, moment.pushed);
        let checker = Checker { arm: self.arm, pieces: &self.pieces, world: &state.world };
        if checker.is_clear(positions_rad, &state.rules[rules].1) {
            return None;
        }
        let number = self.conflicts.get();
        self.conflicts.set(number + 1);
        if number >= EXPLAINED && !number.is_multiple_of(EXPLAINED_OF) {
            return Some(Obstacle::Something);
        }
        let nearest = checker.nearest(positions_rad, &state.rules[rules].1);
        Some(nearest.map_or(Obstacle::Something, |nearest| Obstacle::Near {
            body: self.arm.body_name(nearest.body).to_string(),
            other: checker.other_name(nearest.other).to_string(),
        }))
    }

    fn tool_conflict(&self, base_from_tool: &Rigid, moment: &Moment, clearance_m: f64) -> Option<Obstacle> {
        let state = &mut *self.state.borrow_mut();
        self.place(state, moment);
        let touched = moment.pushed.and_then(|flap| self.boards[flap].first());
        for (is_finger, tool_from_piece, half_m) in &self.tool {
            let piece = OrientedBox::new(base_from_tool.then(tool_from_piece), *half_m);
            let radius_m = half_m.norm();
            for (k, obstacle) in state.world.obstacles().iter().enumerate() {
                let far = match &obstacle.solid {
                    Solid::Box(thing) => {
                        thing.distance_to_point_sq_m2(&piece.centre()) >= (radius_m + clearance_m).powi(2)
                    }
                    _ => false,
                };
                if far
                    || (*is_finger && touched == Some(&k))
                    || clear_by(&Solid::Box(piece), &obstacle.solid, clearance_m)
                {
                    continue;
                }
                let body = if *is_finger { self.arm.fingers_body() } else { self.arm.gripper_body() };
                return Some(Obstacle::Near {
                    body: self.arm.body_name(body).to_string(),
                    other: obstacle.name.clone(),
                });
            }
        }
        None
    }

    fn base_conflict(&self, moment: &Moment) -> Option<Obstacle> {
        let state = &mut *self.state.borrow_mut();
        self.place(state, moment);
        let mut rules = Rules::new(self.arm, &state.world, IGNORED);
        self.boards[moment.pushed?].iter().for_each(|&board| rules.set(0, board, 0.0));
        let checker = Checker { arm: self.arm, pieces: &self.pieces, world: &state.world };
        let nearest = checker.nearest(&self.arm.ready, &rules).filter(|nearest| nearest.spare_m < 0.0)?;
        let (body, other) = (self.arm.body_name(nearest.body), checker.other_name(nearest.other));
        Some(Obstacle::Near { body: body.to_string(), other: other.to_string() })
    }

    fn with_opening(&self, opening_m: f64) -> Self {
        let state = self.state.borrow();
        Self {
            pieces: ArmPieces::new(self.arm, opening_m),
            state: RefCell::new(State { world: state.world.clone(), at: state.at.clone(), rules: Vec::new() }),
            boards: self.boards.clone(),
            conflicts: self.conflicts.clone(),
            tool: tool_pieces(self.arm, opening_m),
            ..*self
        }
    }

    fn explain_anew(&self) {
        self.conflicts.set(0);
    }
}
