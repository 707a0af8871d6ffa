//! The whole of it: which flaps, in which order, and the ways between them.

use super::flap::Standing;
use super::guard::{Guard, Moment};
use super::known::Margins;
use super::load::Load;
use super::order;
use super::piece::{Kind, Piece};
use super::problem::BoxProblem;
use super::push::PushMotion;
use super::reason::{Obstacle, Status, WhyNot};
use super::request::Method;
use super::settings::PlanningSettings;
use super::transit::Transit;
use crate::arm::{Arm, JointPositions};

/// What became of a flap.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    pub status: Status,
    /// One line; empty where it is planned.
    pub reason: String,
    /// Spent on its pushes.
    pub seconds: f64,
    /// Where it is taken to rest after its push, where it is planned.
    pub rest_rad: Option<f64>,
}

impl Outcome {
    pub fn new(status: Status, reason: String) -> Self {
        Self { status, reason, seconds: 0.0, rest_rad: None }
    }
}

impl WhyNot {
    fn outcome(self) -> Outcome {
        Outcome::new(self.status, self.reason)
    }
}

/// A closing without times.
#[derive(Debug, Clone)]
pub struct Closing {
    /// Flaps as they are closed.
    pub order: Vec<usize>,
    /// In the problem's order.
    pub outcomes: Vec<Outcome>,
    pub pieces: Vec<Piece>,
    /// The first flap whose push was planned but to which the arm found no way: those after it were planned as if it had closed.
    pub stranded: Option<usize>,
}

/// Everything that stays the same while a box is closed.
pub struct Closer<'a, G: Guard> {
    pub arm: &'a Arm,
    pub guard: &'a G,
    pub problem: &'a BoxProblem,
    pub load: &'a Load,
    pub settings: &'a PlanningSettings,
    pub margins: &'a Margins,
    pub method: Method,
    /// Only the first effort is made.
    pub quick: bool,
    /// The flaps to close, by name; all that are open where there are none.
    pub only: &'a [String],
    /// Flaps that are not to be closed.
    pub left_open: &'a [&'a str],
}

impl<G: Guard> Closer<'_, G> {
    /// Plans the closing of all flaps that are open and seen, from the arm's posture `start` and back to it.
    pub fn plan(&self, start: &JointPositions) -> Closing {
        let angles_rad: Vec<f64> = self.problem.flaps.iter().map(|flap| flap.position_rad).collect();
        let mut outcomes: Vec<Option<Outcome>> = (0..angles_rad.len()).map(|flap| self.needs_nothing(flap)).collect();
        let asked = |flap: usize| {
            let name = &self.problem.flaps[flap].name;
            (self.only.is_empty() || self.only.contains(name)) && !self.left_open.contains(&name.as_str())
        };
        let open: Vec<usize> = (0..outcomes.len()).filter(|&flap| outcomes[flap].is_none() && asked(flap)).collect();
        let ordered = match self.method {
            Method::Layered => order::search(self, &open, &angles_rad),
            Method::Paper => order::ascending_area(self, &open, &angles_rad),
        };
        for (flap, why) in ordered.why_not {
            outcomes[flap] = Some(why.outcome());
        }
        let mut way = Way {
            closer: self,
            at: *start,
            opening_m: self.arm.gripper.opening_m[0],
            angles_rad,
            order: Vec::new(),
            pieces: Vec::new(),
        };
        let mut stranded = None;
        for (flap, push) in ordered.order.into_iter().zip(ordered.pushes) {
            outcomes[flap] = Some(match way.close(flap, push) {
                Ok(rest_rad) => Outcome { rest_rad: Some(rest_rad), ..Outcome::new(Status::Planned, String::new()) },
                Err(why) => {
                    stranded = stranded.or(Some(flap));
                    why.outcome()
                }
            });
        }
        way.home(start);
        for (flap, outcome) in outcomes.iter_mut().enumerate() {
            if let Some(outcome) = outcome {
                outcome.seconds = self.margins.known.seconds(flap);
            }
        }
        let unknown = || Outcome::new(Status::OutOfTime, "was not tried".into());
        Closing {
            order: way.order,
            outcomes: outcomes.into_iter().map(|outcome| outcome.unwrap_or_else(unknown)).collect(),
            pieces: way.pieces,
            stranded,
        }
    }

    /// What is known of a flap without planning.
    pub fn needs_nothing(&self, flap: usize) -> Option<Outcome> {
        let flap = &self.problem.flaps[flap];
        let outcome = |status, reason: String| Some(Outcome::new(status, reason));
        match flap.standing {
            Standing::Absent => outcome(Status::Absent, "is not there".into()),
            Standing::Hidden => outcome(Status::Hidden, "was not seen, so where it stands is not known".into()),
            Standing::Seen if flap.position_rad.abs() <= self.settings.closed_rad => {
                outcome(Status::AlreadyClosed, format!("stands at {:.1} degrees", flap.position_rad.to_degrees()))
            }
            Standing::Seen if flap.position_rad < 0.0 => {
                let degrees = flap.position_rad.to_degrees();
                outcome(
                    Status::Blocked,
                    format!("is pushed in to {degrees:.0} degrees; a push would go through the board"),
                )
            }
            Standing::Seen => None,
        }
    }
}

/// The way so far.
struct Way<'a, 'b, G: Guard> {
    closer: &'a Closer<'b, G>,
    at: JointPositions,
    opening_m: f64,
    angles_rad: Vec<f64>,
    order: Vec<usize>,
    pieces: Vec<Piece>,
}

impl<G: Guard> Way<'_, '_, G> {
    /// Goes to a flap and closes it; where it rests then. All or nothing.
    fn close(&mut self, flap: usize, mut push: PushMotion) -> Result<f64, WhyNot> {
        let before = (self.at, self.opening_m, self.angles_rad.clone(), self.pieces.len());
        let rest_rad = self.closer.rest_rad(flap, &push);
        let mut motions = std::mem::take(&mut push.first);
        motions.push(push);
        // Each leaves the flap where the next begins.
        let left = motions.iter().skip(1).map(|next| next.hinge_rad[0]).chain(std::iter::once(rest_rad));
        let left: Vec<f64> = left.collect();
        for (motion, rest_rad) in motions.into_iter().zip(left) {
            if self.push(flap, motion, rest_rad).is_none() {
                (self.at, self.opening_m, self.angles_rad) = (before.0, before.1, before.2);
                self.pieces.truncate(before.3);
                return Err(WhyNot { by_flaps: false, ..WhyNot::by_boards(&Obstacle::NoWay { to: "to it" }) });
            }
        }
        self.order.push(flap);
        Ok(rest_rad)
    }

    /// One push and the way to it.
    fn push(&mut self, flap: usize, push: PushMotion, rest_rad: f64) -> Option<()> {
        let ready = self.closer.arm.ready;
        if push.opening_m != self.opening_m {
            // The gripper opens and closes where there is room.
            let back = self.transit(&ready, &ready, flap)?;
            self.add_transit(back);
            self.opening_m = push.opening_m;
        }
        let transit = self.transit(&push.approach[0], &ready, flap)?;
        self.add_transit(transit);
        let (pushed, opening_m, meanwhile) = (Some(flap), push.opening_m, push.meanwhile_rad);
        let mut held = meanwhile.clone();
        held[flap] = push.hinge_rad[push.hinge_rad.len() - 1];
        self.add(Piece::new(Kind::Approach, pushed, push.approach, meanwhile.clone(), opening_m));
        let piece = Piece::new(Kind::Push, pushed, push.push, meanwhile, opening_m);
        self.add(Piece { hinge_rad: push.hinge_rad, contact: push.contact, ..piece });
        self.add(Piece::new(Kind::Retreat, pushed, push.retreat, held, opening_m));
        self.angles_rad[flap] = rest_rad;
        Some(())
    }

    fn add_transit(&mut self, way: Vec<JointPositions>) {
        self.add(Piece::new(Kind::Transit, None, way, self.angles_rad.clone(), self.opening_m));
    }

    /// Back to where the arm began, if there is a way: an arm that stays stands clear.
    fn home(&mut self, start: &JointPositions) {
        let Some(&last) = self.order.last() else { return };
        if let Some(transit) = self.transit(start, &self.closer.arm.ready.clone(), last) {
            self.add_transit(transit);
        }
    }

    /// A way to or from a flap, with its margins.
    fn transit(&self, to: &JointPositions, via: &JointPositions, flap: usize) -> Option<Vec<JointPositions>> {
        let moment = Moment::resting(&self.angles_rad);
        let closer = self.closer;
        let settings = closer.settings_of(flap);
        let guard = closer.guard.with_opening(self.opening_m);
        let step_rad = settings.joint_step_rad;
        Transit { arm: closer.arm, guard: &guard, settings, moment: &moment, step_rad }.way(&self.at, to, via)
    }

    fn add(&mut self, piece: Piece) {
        if let Some(last) = piece.positions.last() {
            self.at = *last;
        }
        self.pieces.push(piece);
    }
}
