//! Where what was fitted first is not told, more of the proposals that lie upon it are fitted.

use super::choose::excludes;
use super::finish::Finishing;
use super::found_box::FoundBox;
use super::judgement::Judgement;
use super::last_fits::last_fits;
use super::proposed::{lies, lies_upon};
use super::refused::{Refusal, Refused};
use super::shells::Shell;
use super::told::refusal;
use crate::fit::FittedBody;

/// Of proposals that lie upon what is not told so many more are fitted.
const MORE_FITTED: usize = 16;
/// What is less probable is no box, however it is fitted.
const LEAST_PROBABLE: f64 = 0.005;

/// The proposals to fit after `boxes` and `refused` have come out of the first: best first, as they come.
pub fn more_to_fit<'a>(
    shells: &'a [Shell],
    is_fitted: impl Fn(&Shell) -> bool,
    boxes: &[FoundBox],
    refused: &[Refused],
    judgement: Option<&Judgement>,
) -> Vec<&'a Shell> {
    let of_boxes = boxes.iter().filter_map(|one| Some((&one.solution.body, refusal(one, judgement)?)));
    let missed = refused.iter().map(|one| (&one.body, one.why.clone())).chain(of_boxes);
    let missed: Vec<&FittedBody> = missed.filter(|(_, why)| is_worth_it(why)).map(|(body, _)| body).collect();
    let mut counts = vec![0; missed.len()];
    let mut is_wanted = |shell: &Shell| {
        let upon: Vec<usize> = (0..missed.len()).filter(|&i| lies_upon(&shell.proposal, missed[i])).collect();
        let is_wanted = upon.iter().any(|&i| counts[i] < MORE_FITTED);
        upon.iter().for_each(|&i| counts[i] += usize::from(is_wanted));
        is_wanted
    };
    shells.iter().filter(|shell| !lies(&shell.proposal) && !is_fitted(shell) && is_wanted(shell)).collect()
}

/// What may be a closed box may as well be one.
fn is_worth_it(why: &Refusal) -> bool {
    match why {
        Refusal::Improbable { probability, .. } => *probability >= LEAST_PROBABLE,
        Refusal::FewPanels { .. } | Refusal::NotFitted(_) => true,
        Refusal::MayBeClosed => false,
    }
}

/// The boxes with those that are told of what was fitted second: it takes no readings of what was told first, and the place of what
/// was not.
pub fn with_second(
    boxes: Vec<FoundBox>,
    second: Vec<FoundBox>,
    finishing: &Finishing,
) -> (Vec<FoundBox>, Vec<Refused>) {
    let is_told = |one: &FoundBox| refusal(one, finishing.judgement).is_none();
    let is_free = |one: &FoundBox, of: &[FoundBox]| !of.iter().any(|other| excludes(other, one, finishing.sight.width));
    let (mut told, doubtful): (Vec<FoundBox>, Vec<FoundBox>) = boxes.into_iter().partition(is_told);
    let (second, refused) = last_fits(second.into_iter().filter(|one| is_free(one, &told)).collect(), finishing, true);
    for one in second.into_iter().filter(is_told) {
        if is_free(&one, &told) {
            told.push(one);
        }
    }
    for one in doubtful {
        if is_free(&one, &told) {
            told.push(one);
        }
    }
    (told, refused)
}

#[cfg(test)]
mod tests {
    use nalgebra::{Isometry3, Translation3};

    use super::*;
    use crate::fit::{layout, NotFitted, Parameters};

    fn refused(at_m: f64, why: Refusal) -> Refused {
        let mut numbers = Parameters::zeros();
        let lengths = [(layout::LENGTH, 0.4), (layout::WIDTH, 0.2), (layout::HEIGHT, 0.2)];
        lengths.iter().for_each(|&(place, length_m)| numbers[place] = length_m);
        let input_from_object =
            Isometry3::from_parts(Translation3::new(at_m, 0.0, 0.0), nalgebra::UnitQuaternion::identity());
        Refused { body: FittedBody { input_from_object, numbers }, why }
    }

    #[test]
    fn proposals_upon_what_was_refused_are_fitted_if_that_may_be_a_box() {
        // Two of each place are fitted already; of one there are more than are tried.
        let places = [(0.0, 40), (1.0, 5), (2.0, 5), (3.0, 5), (4.0, 5), (5.0, 5)];
        let of_place = |&(at_m, count): &(f64, usize)| {
            (0..count).map(move |i| Shell::that_far(at_m + 0.01 * i as f64, 900.0 - i as f64))
        };
        let shells: Vec<Shell> = places.iter().flat_map(of_place).collect();
        let why = |probability: f64| Refusal::Improbable { probability, least: 0.3 };
        let refused = [
            refused(0.0, why(0.2)),
            refused(1.0, why(0.001)),
            refused(2.0, Refusal::FewPanels { seen: 2, least: 3 }),
            refused(3.0, Refusal::MayBeClosed),
            refused(4.0, Refusal::NotFitted(NotFitted::Sunk)),
        ];
        let more = more_to_fit(&shells, |shell| shell.score > 898.5, &[], &refused, None);
        let count =
            |at_m: f64| more.iter().filter(|shell| (shell.proposal.spans[0][0] + 0.2 - at_m).abs() < 0.45).count();
        assert_eq!(places.map(|(at_m, _)| count(at_m)), [MORE_FITTED, 0, 3, 0, 3, 0]);
        assert!(more.windows(2).take(MORE_FITTED - 1).all(|pair| pair[0].score > pair[1].score));
    }
}
