//! Flaps that nobody found: whether they hide, and where.

use super::evidence::look_from_all;
use super::sight::Sight;
use crate::fit::{layout, FittedBody, Role};
use crate::free_space::{Looked, PartState};

/// A flap that was not found; poses are bodies with the flap at angles where it may hide, and the odds of each.
pub struct UnseenFlap {
    pub state: PartState,
    pub poses: Vec<(FittedBody, f64)>,
}

/// Angles that are tried, degrees: from closed to hanging down, each as likely beforehand. At the ends it would lie in a panel.
const ANGLES_DEG: [usize; 2] = [5, 265];
const STEP_DEG: usize = 10;
/// Poses less probable than this share of the likeliest are left out.
const LEAST_SHARE: f64 = 0.05;
const MODEL_M: f64 = 0.004;

/// Asks the rays of all views at every angle (eq. 94). Readings that it would meet speak neither way: something else was found there.
pub fn unseen_flap(sights: &[Sight], body: &FittedBody, k: usize, length_m: f64) -> UnseenFlap {
    let (mut poses, mut odds) = (Vec::new(), Vec::new());
    for degrees in (ANGLES_DEG[0]..=ANGLES_DEG[1]).step_by(STEP_DEG) {
        let mut posed = body.clone();
        let flap = layout::flap(k);
        posed.numbers[flap + layout::FLAP_ANGLE] = (degrees as f64).to_radians();
        posed.numbers[flap + layout::FLAP_LENGTH] = length_m;
        posed.numbers[flap + layout::FLAP_CURL] = 0.0;
        let looked = look_from_all(sights, &posed, Role::Flap(k), MODEL_M).looked();
        let there = PartState::of(&Looked { met: 0.0, ..looked });
        odds.push((1.0 - there.absent) / there.absent);
        poses.push(posed);
    }
    let mean = odds.iter().sum::<f64>() / odds.len() as f64;
    let most = odds.iter().copied().fold(0.0, f64::max);
    let hidden = mean / (1.0 + mean);
    let likely = poses.into_iter().zip(&odds).filter(|(_, odds)| **odds > LEAST_SHARE * most);
    UnseenFlap {
        state: PartState { seen: 0.0, hidden, absent: 1.0 - hidden },
        poses: likely.map(|(pose, odds)| (pose, *odds)).collect(),
    }
}
