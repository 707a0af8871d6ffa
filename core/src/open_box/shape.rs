use crate::body::ObjectAnswer;
use crate::fit::{layout, Role};

use super::found_box::FoundBox;
use super::judgement::Judgement;

/// What tells a box's kind: of a fitted body what was seen of it, metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shape {
    /// Length, width, height.
    pub dimensions_m: [f64; 3],
    pub thickness_m: f64,
    /// From hinge to free edge; `None` where no flap is known.
    pub flaps_m: [Option<f64>; 4],
    /// Hinge angles of flaps; of those that were not seen they say nothing.
    pub flaps_rad: [f64; 4],
    pub has_tuck: [bool; 4],
}

/// What `Shape::features` holds, in its order; the file of weights names them.
pub const SHAPE_FEATURES: [&str; 12] = [
    "one",
    "log_height",
    "log_base",
    "log_aspect",
    "board_mm",
    "flaps_seen",
    "no_flap",
    "longest_flap",
    "shortest_flap",
    "tuck_seen",
    "longest_reach",
    "flaps_apart",
];

/// A box of these sizes has logarithms of 0.
const USUAL_HEIGHT_M: f64 = 0.2;
const USUAL_BASE_M: f64 = 0.3;
const MILLIMETRE: f64 = 0.001;
/// A tote's lip reaches less than this.
const LIP_M: f64 = 0.06;

impl Shape {
    /// By the flaps that are told.
    pub fn of_found(found: &FoundBox, judgement: Option<&Judgement>) -> Self {
        let body = &found.solution.body;
        let is_told = |role: Role| judgement.is_none_or(|judgement| found.is_probable(role, judgement));
        let seen = |role: Role| !found.labels.of(role).is_empty() && is_told(role);
        let flap_m = |k: usize| body.get(layout::flap(k) + layout::FLAP_LENGTH);
        Self {
            dimensions_m: [layout::LENGTH, layout::WIDTH, layout::HEIGHT].map(|place| body.get(place)),
            thickness_m: body.board_m(),
            // A lid is known by its tuck flap, too.
            flaps_m: std::array::from_fn(|k| (seen(Role::Flap(k)) || seen(Role::Tuck(k))).then(|| flap_m(k))),
            flaps_rad: std::array::from_fn(|k| body.get(layout::flap(k) + layout::FLAP_ANGLE)),
            has_tuck: std::array::from_fn(|k| seen(Role::Tuck(k))),
        }
    }

    /// Of an object with a fitted body, whose parameters tell the flaps that were seen; `None` where nothing was fitted.
    pub fn of_answer(object: &ObjectAnswer) -> Option<Self> {
        let number = |name: String| object.parameters.get(&name).map(|parameter| parameter.value);
        let joint = |k: usize| object.joints.iter().find(|joint| joint.child == format!("flap_{k}"));
        object.parameters.get("length")?;
        Some(Self {
            dimensions_m: object.dimensions?,
            thickness_m: object.thickness?,
            flaps_m: std::array::from_fn(|k| number(format!("flap_{k}_length"))),
            flaps_rad: std::array::from_fn(|k| joint(k).map_or(0.0, |joint| joint.position)),
            has_tuck: std::array::from_fn(|k| number(format!("tuck_{k}_length")).is_some()),
        })
    }

    /// Aligned with `SHAPE_FEATURES`. Lengths of flaps are shares of the way across the opening.
    pub fn features(&self) -> [f64; SHAPE_FEATURES.len()] {
        let [length, width, height] = self.dimensions_m;
        let across = |k: usize| [width, length][k % 2];
        let shares = (0..4).filter_map(|k| Some(self.flaps_m[k]? / across(k)));
        let count = shares.clone().count();
        let longest = shares.clone().fold(0.0, f64::max);
        let shortest = shares.fold(longest, f64::min);
        let reach_m = self.flaps_m.iter().flatten().copied().fold(0.0, f64::max);
        let angles = || (0..4).filter(|&k| self.flaps_m[k].is_some()).map(|k| self.flaps_rad[k]);
        // A lip leaves its rim everywhere alike; flaps are moved one by one.
        let apart_rad =
            if count > 1 { angles().fold(f64::MIN, f64::max) - angles().fold(f64::MAX, f64::min) } else { 0.0 };
        let flag = |is_so: bool| f64::from(u8::from(is_so));
        [
            1.0,
            (height / USUAL_HEIGHT_M).ln(),
            ((length * width).sqrt() / USUAL_BASE_M).ln(),
            (length.max(width) / length.min(width)).ln(),
            self.thickness_m / MILLIMETRE,
            count as f64,
            flag(count == 0),
            longest,
            shortest,
            flag(self.has_tuck.contains(&true)),
            (reach_m / LIP_M).ln_1p(),
            apart_rad,
        ]
    }
}
