//! Which finished boxes are told.

use super::closed::may_be_closed;
use super::found_box::FoundBox;
use super::judgement::Judgement;
use super::labels::roles;
use super::refused::Refusal;
use crate::fit::Role;

/// An object has at least so many panels with enough readings.
const LEAST_PANELS: usize = 3;

/// Why a finished box is no object; `None` of one that is told.
pub fn refusal(found: &FoundBox, judgement: Option<&Judgement>) -> Option<Refusal> {
    let odds = judgement
        .map(|judgement| (judgement.box_probability(&found.features), judgement.box_told_from(&found.features)));
    if let Some((probability, least)) = odds.filter(|(probability, least)| probability < least) {
        return Some(Refusal::Improbable { probability, least });
    }
    if may_be_closed(found) {
        return Some(Refusal::MayBeClosed);
    }
    let is_told = |role: &Role| is_told(found, *role, judgement);
    few_panels(roles(&found.present).iter().filter(|role| is_told(role)).count())
}

/// Refuses what shows so few panels.
pub fn few_panels(seen: usize) -> Option<Refusal> {
    (seen < LEAST_PANELS).then_some(Refusal::FewPanels { seen, least: LEAST_PANELS })
}

/// Whether a panel is told as seen: a flap on a flap that was not seen hangs on nothing, but where that is seen from its edge.
pub fn is_told(found: &FoundBox, role: Role, judgement: Option<&Judgement>) -> bool {
    let has = |role: Role| {
        !found.labels.of(role).is_empty() && judgement.is_none_or(|judgement| found.is_probable(role, judgement))
    };
    let is_edge_on =
        |role: Role| found.evidence.iter().any(|(other, evidence)| *other == role && evidence.is_edge_on());
    match role {
        Role::Tuck(k) => has(role) && (has(Role::Flap(k)) || is_edge_on(Role::Flap(k))),
        _ => has(role),
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, Isometry3};

    use super::super::evidence::Evidence;
    use super::super::labels::{Labels, Present};
    use super::*;
    use crate::fit::{FittedBody, Parameters, Solution};

    /// A box on whose flap 0 a tuck flap hangs, with so many readings on its side, its flap and that.
    fn found(readings: [usize; 3], flap: Evidence) -> FoundBox {
        let body = FittedBody { input_from_object: Isometry3::identity(), numbers: Parameters::zeros() };
        let roles = [Role::Side(0), Role::Flap(0), Role::Tuck(0)];
        let parts = roles.iter().zip(readings).map(|(role, count)| (*role, vec![0; count])).collect();
        let first = [true, false, false, false];
        let present = Present { flaps: first, tucks: first, ..Present::default() };
        let solution = Solution { body, covariance: DMatrix::zeros(0, 0).into(), motions: Vec::new() };
        FoundBox::unjudged(solution, present, Labels { parts, stride: 1 }, vec![(Role::Flap(0), flap)], 0.0)
    }

    #[test]
    fn a_tuck_flap_on_nothing_is_not_told_and_three_panels_are_a_box() {
        let slanted = Evidence { met: 400.0, ..Evidence::default() };
        for (readings, seen) in [([900, 400, 90], 3), ([900, 0, 90], 1), ([0, 400, 90], 2), ([900, 400, 0], 2)] {
            let one = found(readings, slanted);
            let told =
                [Role::Side(0), Role::Flap(0), Role::Tuck(0)].iter().filter(|role| is_told(&one, **role, None)).count();
            assert_eq!(told, seen, "{readings:?}");
            assert_eq!(few_panels(told).is_none(), seen == 3, "{readings:?}");
        }
    }
}
