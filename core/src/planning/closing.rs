//! The whole of it: which flaps, in which order, and the ways between them.

use super::boards::met;
use super::contact::Contacts;
use super::flap::Standing;
use super::guard::{Guard, Moment};
use super::known::{Force, Known, Tried};
use super::load::Load;
use super::order;
use super::orientations::OrientationGrid;
use super::piece::{Kind, Piece};
use super::planes::PlanesSearch;
use super::problem::BoxProblem;
use super::push::{closed_finger, PushMotion, Pusher};
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
}

/// Everything that stays the same while a box is closed.
pub struct Closer<'a, G: Guard> {
    pub arm: &'a Arm,
    pub guard: &'a G,
    pub problem: &'a BoxProblem,
    pub load: &'a Load,
    pub settings: &'a PlanningSettings,
    /// The settings of flaps whose margins were widened, once, twice, and so on; and how often each was, in the problem's order.
    pub wider: &'a [PlanningSettings],
    pub widened: &'a [usize],
    pub known: &'a Known,
    pub method: Method,
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
        let mut way = Way { closer: self, at: *start, angles_rad, order: Vec::new(), pieces: Vec::new() };
        for (flap, push) in ordered.order.into_iter().zip(ordered.pushes) {
            outcomes[flap] = Some(match way.close(flap, push) {
                Ok(rest_rad) => Outcome { rest_rad: Some(rest_rad), ..Outcome::new(Status::Planned, String::new()) },
                Err(why) => why.outcome(),
            });
        }
        way.home(start);
        for (flap, outcome) in outcomes.iter_mut().enumerate() {
            if let Some(outcome) = outcome {
                outcome.seconds = self.known.seconds(flap);
            }
        }
        let unknown = || Outcome::new(Status::OutOfTime, "was not tried".into());
        Closing {
            order: way.order,
            outcomes: outcomes.into_iter().map(|outcome| outcome.unwrap_or_else(unknown)).collect(),
            pieces: way.pieces,
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

    /// One flap's push while the others stand as they do.
    ///
    /// # Errors
    /// The status and the reason why there is none.
    pub fn push(&self, flap: usize, moment: &Moment) -> Tried {
        self.known.push(flap, self.widened[flap], moment, Force::Careful, || self.push_anew(flap, moment))
    }

    fn push_anew(&self, flap: usize, moment: &Moment) -> Tried {
        if self.method == Method::Paper {
            return self.paper_push(flap, moment);
        }
        let hold_rad = self.hold_rad(flap, moment);
        if let Some(obstacle) = met(self.problem, &moment.angles_rad, flap, hold_rad.max(0.0), self.settings) {
            return Err(WhyNot::by_boards(&obstacle));
        }
        if hold_rad > self.settings.most_propped_rad {
            return Err(WhyNot::by_boards(&Obstacle::Propped { flap: self.problem.flaps[flap].name.clone() }));
        }
        let most_strain = self.settings.most_strain;
        let first = self.pusher(flap, moment, hold_rad, most_strain).plan();
        let short_rad = self.settings.short_on_others_rad;
        match first {
            // Arms that cannot follow the flap beyond closed may still lay it down.
            Err(why) if hold_rad < 0.0 && !why.at_start => {
                self.pusher(flap, moment, short_rad, most_strain).plan().map_err(|_| why)
            }
            tried => tried,
        }
    }

    /// The same without a reserve of force; a flap that stands low closes even if the box slides a little. None where there is none.
    pub fn push_home(&self, flap: usize, moment: &Moment) -> Option<PushMotion> {
        let hold_rad = self.hold_rad(flap, moment);
        let is_low = moment.angles_rad[flap] <= self.settings.slides_home_rad;
        let most_strain = if is_low { f64::INFINITY } else { 1.0 };
        let meets = met(self.problem, &moment.angles_rad, flap, hold_rad.max(0.0), self.settings).is_some();
        if meets || hold_rad > self.settings.most_propped_rad {
            return None;
        }
        let plan = || self.pusher(flap, moment, hold_rad, most_strain).plan();
        self.known.push(flap, self.widened[flap], moment, Force::Home, plan).ok()
    }

    /// A flap's settings, as wide as its margins are by now.
    fn settings_of(&self, flap: usize) -> &PlanningSettings {
        self.widened[flap].checked_sub(1).map_or(self.settings, |times| &self.wider[times])
    }

    fn pusher(&self, flap: usize, moment: &Moment, hold_rad: f64, most_strain: f64) -> Pusher<'_, G> {
        let settings = self.settings_of(flap);
        let half_board_m = self.problem.thickness_m / 2.0;
        Pusher {
            arm: self.arm,
            guard: self.guard,
            settings,
            contacts: Contacts::new(
                &self.problem.flaps[flap],
                closed_finger(self.arm),
                half_board_m,
                settings,
                (self.load.folds[flap], self.load.stand.as_ref()),
                OrientationGrid::coarse(),
            ),
            most_strain,
            flap,
            moment: moment.clone(),
            hold_rad,
            rest_rad: self.load.folds[flap].rest_rad(hold_rad).min(self.settings.closed_rad),
        }
    }

    /// The paper's push, to closed and no further.
    fn paper_push(&self, flap: usize, moment: &Moment) -> Result<PushMotion, WhyNot> {
        let pusher = self.pusher(flap, moment, 0.0, f64::INFINITY);
        PlanesSearch { pusher: &pusher, settings: self.settings_of(flap) }.plan()
    }
}

/// The way so far.
struct Way<'a, 'b, G: Guard> {
    closer: &'a Closer<'b, G>,
    at: JointPositions,
    angles_rad: Vec<f64>,
    order: Vec<usize>,
    pieces: Vec<Piece>,
}

impl<G: Guard> Way<'_, '_, G> {
    /// Goes to a flap and pushes it; where it rests then. A flap left open before changes what the others meet: the push is planned anew where the
    /// one at hand no longer holds.
    fn close(&mut self, flap: usize, push: PushMotion) -> Result<f64, WhyNot> {
        let ready = self.closer.arm.ready;
        let Some(transit) = self.transit(&push.approach[0], &ready, flap) else {
            return Err(WhyNot { by_flaps: false, ..WhyNot::by_boards(&Obstacle::NoWay { to: "to it" }) });
        };
        let resting = self.angles_rad.clone();
        let rest_rad = self.closer.rest_rad(flap, &push);
        let meanwhile = push.meanwhile_rad;
        let mut held = meanwhile.clone();
        held[flap] = push.hinge_rad[push.hinge_rad.len() - 1];
        let pushed = Some(flap);
        self.add(Piece::new(Kind::Transit, None, transit, resting));
        self.add(Piece::new(Kind::Approach, pushed, push.approach, meanwhile.clone()));
        let piece = Piece::new(Kind::Push, pushed, push.push, meanwhile);
        self.add(Piece { hinge_rad: push.hinge_rad, contact: push.contact, ..piece });
        self.add(Piece::new(Kind::Retreat, pushed, push.retreat, held));
        self.angles_rad[flap] = rest_rad;
        self.order.push(flap);
        Ok(rest_rad)
    }

    /// Back to where the arm began, if there is a way: an arm that stays stands clear.
    fn home(&mut self, start: &JointPositions) {
        let Some(&last) = self.order.last() else { return };
        if let Some(transit) = self.transit(start, &self.closer.arm.ready.clone(), last) {
            self.add(Piece::new(Kind::Transit, None, transit, self.angles_rad.clone()));
        }
    }

    /// A way to or from a flap, with its margins.
    fn transit(&self, to: &JointPositions, via: &JointPositions, flap: usize) -> Option<Vec<JointPositions>> {
        let moment = Moment::resting(&self.angles_rad);
        let closer = self.closer;
        let settings = closer.settings_of(flap);
        let step_rad = settings.joint_step_rad;
        Transit { arm: closer.arm, guard: closer.guard, settings, moment: &moment, step_rad }.way(&self.at, to, via)
    }

    fn add(&mut self, piece: Piece) {
        if let Some(last) = piece.positions.last() {
            self.at = *last;
        }
        self.pieces.push(piece);
    }
}
