//! Flaps, and tuck flaps on flaps, that nobody found: whether they hide, and where.

use super::evidence::look_from_all;
use super::sight::Sight;
use crate::fit::{layout, FittedBody, Role};
use crate::free_space::PartState;

/// A part that was not found; poses are bodies with the part at angles where it may hide, and the odds of each.
pub struct UnseenPart {
    pub state: PartState,
    pub poses: Vec<(FittedBody, f64)>,
}

/// Angles that are tried, degrees: from hanging into the box to hanging down, each as likely beforehand. At the ends, and where it is
/// closed, it would lie in a panel.
const FLAP_DEG: [i32; 2] = [-75, 265];
/// Of a tuck flap, from bent far out to folded in.
const TUCK_DEG: [i32; 2] = [-90, 130];
const STEP_DEG: usize = 10;
/// Poses less probable than this share of the likeliest are left out.
const LEAST_SHARE: f64 = 0.05;
const MODEL_M: f64 = 0.004;

/// A flap of that length.
pub fn unseen_flap(sights: &[Sight], body: &FittedBody, k: usize, length_m: f64) -> UnseenPart {
    let flap = layout::flap(k);
    let mut flat = body.clone();
    flat.numbers[flap + layout::FLAP_LENGTH] = length_m;
    flat.numbers[flap + layout::FLAP_CURL] = 0.0;
    unseen_part(sights, &flat, Role::Flap(k), flap + layout::FLAP_ANGLE, FLAP_DEG)
}

/// The tuck flap of a flap that was found, as long as the body has it.
pub fn unseen_tuck(sights: &[Sight], body: &FittedBody, k: usize) -> UnseenPart {
    unseen_part(sights, body, Role::Tuck(k), layout::tuck(k) + layout::TUCK_ANGLE, TUCK_DEG)
}

/// Asks the rays of all views at every angle (eq. 94). Readings that it would meet speak neither way: something else was found there.
fn unseen_part(sights: &[Sight], body: &FittedBody, role: Role, angle: usize, [from, to]: [i32; 2]) -> UnseenPart {
    let (mut poses, mut odds) = (Vec::new(), Vec::new());
    for degrees in (from..=to).step_by(STEP_DEG) {
        let mut posed = body.clone();
        posed.numbers[angle] = f64::from(degrees).to_radians();
        let there = PartState::unseen(&look_from_all(sights, &posed, role, MODEL_M).looked());
        odds.push((1.0 - there.absent) / there.absent);
        poses.push(posed);
    }
    let mean = odds.iter().sum::<f64>() / odds.len() as f64;
    let most = odds.iter().copied().fold(0.0, f64::max);
    let hidden = mean / (1.0 + mean);
    let likely = poses.into_iter().zip(&odds).filter(|(_, odds)| **odds > LEAST_SHARE * most);
    UnseenPart {
        state: PartState { seen: 0.0, hidden, absent: 1.0 - hidden },
        poses: likely.map(|(pose, odds)| (pose, *odds)).collect(),
    }
}
