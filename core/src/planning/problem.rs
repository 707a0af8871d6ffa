use serde::Deserialize;

use super::flap::{Flap, Standing};
use crate::error::{InputError, Result};
use crate::geometry::Vec3;

/// A flat board between four corners at mid-board, going round; metres, the robot's base frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Board {
    pub name: String,
    pub corners: [Vec3; 4],
}

/// The boxes' boards, the plane they stand on and what else is in the way; metres, the robot's base frame.
#[derive(Debug, Clone, PartialEq)]
pub struct BoxProblem {
    pub thickness_m: f64,
    /// Base and sides, and boards of other objects.
    pub fixed: Vec<Board>,
    /// In the order of their numbers.
    pub flaps: Vec<Flap>,
    /// The support: points p with normal . p = distance.
    pub support: Option<(Vec3, f64)>,
}

/// A flap as the caller tells it: corners as measured at `position_rad`, hinge edge first.
#[derive(Debug, Clone, Deserialize)]
pub struct MeasuredFlap {
    pub name: String,
    pub side: String,
    pub standing: Standing,
    /// Corners, a point of the hinge and its axis; left out of an absent flap.
    pub corners: Option<[[f64; 3]; 4]>,
    pub origin: [f64; 3],
    pub axis: [f64; 3],
    pub position_rad: f64,
    #[serde(default)]
    pub tucks: Vec<MeasuredBoard>,
}

/// A board as the caller tells it.
#[derive(Debug, Clone, Deserialize)]
pub struct MeasuredBoard {
    pub name: String,
    pub corners: [[f64; 3]; 4],
}

/// What `BoxProblem` is made from.
#[derive(Debug, Clone, Deserialize)]
pub struct MeasuredBox {
    pub thickness_m: f64,
    pub fixed: Vec<MeasuredBoard>,
    pub flaps: Vec<MeasuredFlap>,
    pub support: Option<([f64; 3], f64)>,
}

/// Boards thinner than this (m) are taken to be this thick: a model without a thickness still has board.
pub const THINNEST_M: f64 = 0.001;
/// Flaps narrower or shorter than this (m) give a finger nothing to push.
const SHORTEST_M: f64 = 0.005;

impl MeasuredBox {
    /// # Errors
    /// Where there is no flap, or where a flap has no extent.
    pub fn into_problem(self) -> Result<BoxProblem> {
        if self.flaps.is_empty() {
            let error = InputError::new("the model has no flaps");
            return Err(error.at("joints").mend("a box to close has at least one flap on a hinge"));
        }
        let flaps = self.flaps.into_iter().map(MeasuredFlap::into_flap).collect::<Result<_>>()?;
        Ok(BoxProblem {
            thickness_m: self.thickness_m.max(THINNEST_M),
            fixed: self.fixed.into_iter().map(MeasuredBoard::into_board).collect(),
            flaps,
            support: self.support.map(|(normal, distance_m)| (Vec3::from(normal), distance_m)),
        })
    }
}

impl MeasuredFlap {
    fn into_flap(self) -> Result<Flap> {
        let axis = Vec3::from(self.axis).normalize();
        let Some(corners) = self.corners.map(|corners| corners.map(Vec3::from)) else {
            return Ok(self.without_extent(axis));
        };
        let hinge = Vec3::from(self.origin) + axis * (corners[0] - Vec3::from(self.origin)).dot(&axis);
        let middle = (corners[2] + corners[3]) / 2.0 - hinge;
        let across = middle - axis * middle.dot(&axis);
        let length_m = across.norm();
        let hinge_length_m = (corners[1] - hinge).dot(&axis);
        if length_m < SHORTEST_M || hinge_length_m < SHORTEST_M {
            let problem = format!("is {:.1} by {:.1} mm", 1e3 * hinge_length_m, 1e3 * length_m);
            let mend = "a flap's corners go round from the start of its hinge and it is at least 5 mm long and wide";
            return Err(InputError::new(problem).at(self.name).mend(mend));
        }
        let away = across / length_m;
        // Turned back from where it was measured to closed.
        let (sin, cos) = self.position_rad.sin_cos();
        let inward = away * cos - axis.cross(&away) * sin;
        let in_plane = |p: Vec3| [(p - hinge).dot(&axis), (p - hinge).dot(&away)];
        let outline = [[0.0, 0.0], [hinge_length_m, 0.0], in_plane(corners[2]), in_plane(corners[3])];
        let mut flap = Flap {
            name: self.name,
            side: self.side,
            standing: self.standing,
            hinge,
            axis,
            inward,
            outline,
            tucks: Vec::new(),
            position_rad: self.position_rad,
        };
        let frame = flap.frame(flap.position_rad);
        flap.tucks = self
            .tucks
            .into_iter()
            .map(|board| (board.name, board.corners.map(|p| frame.coordinates(&p.into()))))
            .collect();
        Ok(flap)
    }

    fn without_extent(self, axis: Vec3) -> Flap {
        Flap {
            name: self.name,
            side: self.side,
            standing: self.standing,
            hinge: self.origin.into(),
            axis,
            inward: Vec3::z(),
            outline: [[0.0; 2]; 4],
            tucks: Vec::new(),
            position_rad: self.position_rad,
        }
    }
}

impl MeasuredBoard {
    fn into_board(self) -> Board {
        Board { name: self.name, corners: self.corners.map(Vec3::from) }
    }
}
