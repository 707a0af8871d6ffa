//! Why a flap stays open.

use std::fmt;

use super::flap::Flap;
use crate::arm::FINGERS;

/// What kept a posture of the arm from being used.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Obstacle {
    /// The tool's pose is out of the arm's reach.
    Reach,
    /// The arm reaches it, but not within the limits of this joint.
    Limit { joint: String },
    /// This body comes too near to that one.
    Near { body: String, other: String },
    /// Something comes too near to something; which was not asked.
    Something,
    /// The push would move the box rather than the flap.
    Moves,
    /// Two boards meet, whatever the arm does.
    Boards { flap: String, other: String },
    /// Flaps that are closed keep it up.
    Propped { flap: String },
    /// Nothing holds it up once it is closed.
    Falls { flap: String },
    /// The arm cannot follow without a jump of its joints.
    Jump,
    /// There is no way from the arm's posture before to this flap, or back.
    NoWay { to: &'static str },
}

/// The arm finds no way on from where it has let go of a flap.
pub const CAUGHT: Obstacle = Obstacle::NoWay { to: "back from it" };

/// How the names of flaps and of their tucks begin.
const FLAP_NAMES: [&str; 2] = ["flap_", "tuck_"];

impl Obstacle {
    /// Is it another flap than this, or what hangs on one, or may it be?
    pub fn is_flap_beside(&self, flap: &Flap) -> bool {
        match self {
            Self::Near { other, .. } => !flap.is_own(other) && FLAP_NAMES.iter().any(|start| other.starts_with(start)),
            Self::Something => true,
            _ => false,
        }
    }
}

impl fmt::Display for Obstacle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Reach => write!(f, "is out of the arm's reach"),
            Self::Limit { joint } => write!(f, "is reached only beyond the limits of {joint}"),
            Self::Near { body, other } => {
                let comes = if body == FINGERS { "come" } else { "comes" };
                write!(f, "{body} {comes} too near to {other}")
            }
            Self::Something => write!(f, "something is in the way"),
            Self::Moves => write!(f, "the crease takes more force than holds the box: it would slide or tip"),
            Self::Boards { flap, other } => write!(f, "{flap} meets {other}"),
            Self::Propped { flap } => {
                write!(f, "{flap} would come to lie on the ends of flaps that overlap, far from closed")
            }
            Self::Falls { flap } => write!(f, "{flap} is heavier than its crease bears: it would fall into the box"),
            Self::Jump => write!(f, "the arm would have to change its posture while pushing"),
            Self::NoWay { to } => write!(f, "no way was found {to}"),
        }
    }
}

/// How often each obstacle was met; the commonest tells the reason.
#[derive(Debug, Clone, Default)]
pub struct Tally {
    counts: std::collections::BTreeMap<Obstacle, usize>,
}

impl Tally {
    pub fn add(&mut self, obstacle: Obstacle) {
        *self.counts.entry(obstacle).or_default() += 1;
    }

    pub fn add_many(&mut self, obstacle: Obstacle, count: usize) {
        if count > 0 {
            *self.counts.entry(obstacle).or_default() += count;
        }
    }

    pub fn any(&self, passes: impl Fn(&Obstacle) -> bool) -> bool {
        self.counts.keys().any(passes)
    }

    /// The commonest of those that pass, ties by their order.
    pub fn commonest(&self, passes: impl Fn(&Obstacle) -> bool) -> Option<&Obstacle> {
        let passing = self.counts.iter().filter(|(obstacle, _)| passes(obstacle));
        passing.rev().max_by_key(|(_, count)| **count).map(|(obstacle, _)| obstacle)
    }
}

/// A flap's status, as docs/formats.md has them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    Planned,
    AlreadyClosed,
    Hidden,
    Absent,
    Unreachable,
    JointLimit,
    Blocked,
    OutOfTime,
}

impl Status {
    pub fn name(self) -> &'static str {
        match self {
            Self::Planned => "planned",
            Self::AlreadyClosed => "already_closed",
            Self::Hidden => "hidden",
            Self::Absent => "absent",
            Self::Unreachable => "unreachable",
            Self::JointLimit => "joint_limit",
            Self::Blocked => "blocked",
            Self::OutOfTime => "out_of_time",
        }
    }
}

/// Why a flap could not be planned: the status, and one line.
#[derive(Debug, Clone, PartialEq)]
pub struct WhyNot {
    pub status: Status,
    pub reason: String,
    /// Whether other flaps had a part in it: then it may be otherwise once they have moved.
    pub by_flaps: bool,
    /// Whether it waits where it could come down on another's end, steeply but not so that boards jam.
    pub is_steep: bool,
    /// Whether the arm cannot even begin.
    pub at_start: bool,
    /// Where a push that begins ends on its way, rad.
    pub at_rad: Option<f64>,
    /// Whether pushes were left out that would have moved the box.
    pub moves_box: bool,
    /// Whether the arm's ways were searched for, which takes time.
    pub searched: bool,
}

impl WhyNot {
    /// No push of one finger leaves the box where it is.
    pub fn moving() -> Self {
        let reason = format!("where it stands: {}", Obstacle::Moves);
        Self {
            status: Status::Blocked,
            reason,
            by_flaps: false,
            is_steep: false,
            at_start: true,
            at_rad: None,
            moves_box: true,
            searched: true,
        }
    }

    /// The same flap, where no posture of the arm comes to any contact, whatever is near it.
    pub fn out_of_reach(self) -> Self {
        Self { status: Status::Unreachable, reason: format!("where it stands: {}", Obstacle::Reach), ..self }
    }

    /// No search was made.
    pub fn not_searched() -> Self {
        Self {
            status: Status::OutOfTime,
            reason: "no search was allowed".into(),
            by_flaps: false,
            is_steep: false,
            at_start: false,
            at_rad: None,
            moves_box: false,
            searched: true,
        }
    }

    /// Boards are in the way, whatever the arm does.
    pub fn by_boards(obstacle: &Obstacle) -> Self {
        let reason = obstacle.to_string();
        Self {
            status: Status::Blocked,
            reason,
            by_flaps: true,
            is_steep: false,
            at_start: false,
            at_rad: None,
            moves_box: false,
            searched: false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::problem::MeasuredBox;
    use super::*;

    #[test]
    fn a_flap_beside_is_a_flap_and_no_other_thing_that_begins_alike() {
        let corners = [[0.0, 0.0, 0.2], [0.2, 0.0, 0.2], [0.2, 0.0, 0.3], [0.0, 0.0, 0.3]];
        let told = serde_json::json!({
            "thickness_m": 0.004, "fixed": [], "support": null,
            "flaps": [{
                "name": "flap_0", "side": "side_0", "standing": "seen", "origin": [0.1, 0.0, 0.2], "axis": [1.0, 0.0, 0.0],
                "position_rad": std::f64::consts::FRAC_PI_2, "corners": corners,
                "tucks": [{"name": "tuck_0", "corners": corners}],
            }],
        });
        let problem = serde_json::from_value::<MeasuredBox>(told).unwrap().into_problem().unwrap();
        let near = |other: &str| Obstacle::Near { body: "fingers".into(), other: other.into() };
        let asked = [
            (near("flap_1"), true),
            (near("tuck_1"), true),
            (near("flap_0"), false),
            (near("tuck_0"), false),
            (near("side_1"), false),
            (near("the support"), false),
            (near("fence"), false),
            (Obstacle::Something, true),
            (Obstacle::Reach, false),
        ];
        let counted = asked.iter().filter(|(obstacle, is_beside)| {
            assert_eq!(obstacle.is_flap_beside(&problem.flaps[0]), *is_beside, "{obstacle:?}");
            true
        });
        assert_eq!(counted.count(), 9);
    }
}
