//! The planner's face: one question as data, one answer as data.

use std::collections::HashSet;

use serde::Deserialize;

use super::answer::{timed, Answer, Conflict};
use super::closing::Closer;
use super::exhaustive::Exhaustive;
use super::flap::Standing;
use super::guard::Moment;
use super::known::Margins;
use super::load::Load;
use super::problem::MeasuredBox;
use super::reason::Obstacle;
use super::settings::PlanningSettings;
use super::surroundings::Surroundings;
use crate::arm::Arm;
use crate::collision::{OrientedBox, Solid};
use crate::error::{InputError, Result};
use crate::geometry::{Rigid, Vec3};

/// A box beside the one to close: its centre's pose and its sizes, metres, base frame.
#[derive(Debug, Clone, Deserialize)]
pub struct SceneBox {
    pub name: String,
    pub centre_m: [f64; 3],
    /// Rows of the rotation from the box's axes to the base's.
    pub rotation: [[f64; 3]; 3],
    pub size_m: [f64; 3],
}

/// What is to be closed, amid what, and how.
#[derive(Debug, Clone, Deserialize)]
pub struct Request {
    #[serde(rename = "box")]
    pub measured: MeasuredBox,
    #[serde(default)]
    pub scene: Vec<SceneBox>,
    #[serde(default)]
    pub settings: PlanningSettings,
    #[serde(default)]
    pub method: Method,
    /// Where it holds names: the flaps to close; all others stay as they are.
    #[serde(default)]
    pub only: Vec<String>,
    /// Flaps that were closed before and rest where they were let go.
    #[serde(default)]
    pub closed: Vec<String>,
    /// Makes the first effort alone: what it closes, a plan without this closes too.
    #[serde(default)]
    pub quick: bool,
}

/// Which planner.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// Over contacts, tool angles and postures, in the order that closes most.
    #[default]
    Layered,
    /// As of 2011: planes and samples, by ascending area.
    Paper,
}

impl Request {
    /// # Errors
    /// Where the text is no request.
    pub fn from_json(text: &str) -> Result<Self> {
        serde_json::from_str(text).map_err(|error| InputError::new(error.to_string()).in_source("planning request"))
    }

    /// Plans the closing with that arm, from its ready pose and back.
    ///
    /// # Errors
    /// Where there is nothing to close, or where the arm's base stands inside the box.
    pub fn plan(self, arm: &Arm) -> Result<Answer> {
        let mut problem = self.measured.into_problem()?;
        let settings = &self.settings;
        let load = Load::of(&problem, &settings.assumed);
        for (flap, fold) in problem.flaps.iter_mut().zip(&load.folds).filter(|(f, _)| self.closed.contains(&f.name)) {
            flap.position_rad = fold.rest_rad(0.0).min(settings.closed_rad);
        }
        let scene = self.scene.iter().map(|thing| (thing.name.clone(), thing.solid())).collect();
        let guard = Surroundings::new(arm, &problem, scene);
        guard.check_base()?;
        let mut margins = Margins::new(settings, problem.flaps.len());
        let mut left_open: Vec<(String, Obstacle)> = Vec::new();
        // One more of a flap's margins is wider each time, or one more flap is left open: this ends.
        loop {
            let left: Vec<&str> = left_open.iter().map(|(name, _)| name.as_str()).collect();
            let closer = Closer {
                arm,
                guard: &guard,
                problem: &problem,
                load: &load,
                settings,
                margins: &margins,
                method: self.method,
                quick: self.quick,
                only: &self.only,
                left_open: &left,
            };
            let closing = closer.plan(&arm.ready);
            if let Some(flap) = closing.stranded {
                // Another push may begin elsewhere; else what comes after it is planned as it stands, maybe in the way.
                if !margins.widen(flap) {
                    left_open.push((problem.flaps[flap].name.clone(), Obstacle::NoWay { to: "to it" }));
                }
                continue;
            }
            let mut answer = timed(&closing, arm, &problem, settings);
            let conflicts = answer.conflicts(arm, &guard, settings.check_s, settings.clearance_m);
            if conflicts.is_empty() {
                answer.tell_left_open(&left_open);
                return Ok(answer);
            }
            let mut seen = HashSet::new();
            for Conflict { flap: name, obstacle, .. } in conflicts {
                let number = problem.flaps.iter().position(|flap| flap.name == name);
                if seen.insert(name.clone()) && !number.is_some_and(|flap| margins.widen(flap)) {
                    left_open.push((name, obstacle));
                }
            }
        }
    }
}

impl Request {
    /// For each flap that is open, by name: can brute force close it by itself, all others as they are? Takes minutes.
    ///
    /// # Errors
    /// As [`Request::plan`].
    pub fn feasible(self, arm: &Arm) -> Result<Vec<(String, bool)>> {
        let problem = self.measured.into_problem()?;
        let scene = self.scene.iter().map(|thing| (thing.name.clone(), thing.solid())).collect();
        let guard = Surroundings::new(arm, &problem, scene);
        guard.check_base()?;
        let angles_rad: Vec<f64> = problem.flaps.iter().map(|flap| flap.position_rad).collect();
        let moment = Moment::resting(&angles_rad);
        let asked = problem.flaps.iter().enumerate().filter(|(_, flap)| {
            flap.standing == Standing::Seen
                && flap.position_rad > self.settings.closed_rad
                && (self.only.is_empty() || self.only.contains(&flap.name))
        });
        let answers = asked.map(|(number, flap)| {
            let search = Exhaustive {
                arm,
                guard: &guard,
                settings: &self.settings,
                flap,
                number,
                thickness_m: problem.thickness_m,
                moment: &moment,
            };
            (flap.name.clone(), search.can_close())
        });
        Ok(answers.collect())
    }
}

impl Request {
    /// For each flap that is open, by name: does the box, as its folds and weight are assumed, stand its closing?
    ///
    /// # Errors
    /// Where there is nothing to close.
    pub fn bearable(self) -> Result<Vec<(String, bool)>> {
        let problem = self.measured.into_problem()?;
        let load = Load::of(&problem, &self.settings.assumed);
        let open = problem
            .flaps
            .iter()
            .enumerate()
            .filter(|(_, flap)| flap.standing == Standing::Seen && flap.position_rad > self.settings.closed_rad);
        Ok(open.map(|(k, flap)| (flap.name.clone(), load.is_bearable(&problem, k))).collect())
    }
}

impl SceneBox {
    fn solid(&self) -> Solid {
        let rotation = nalgebra::Matrix3::from_fn(|row, column| self.rotation[row][column]);
        let pose = Rigid::new(rotation, Vec3::from(self.centre_m));
        Solid::Box(OrientedBox::new(pose, Vec3::from(self.size_m) / 2.0))
    }
}
