//! Which of the proposals that lie upon each other are fitted, and in which order.

use rayon::prelude::*;

use super::found_box::FoundBox;
use super::proposed::{alike, lies, overlap};
use super::shells::Shell;

/// Of proposals that lie upon each other so many are fitted.
const RIVALS_FITTED: usize = 8;
/// The same of proposals of boxes on their side.
const LYING_FITTED: usize = 4;
/// Proposals whose walls are all this near to each other fit alike.
const TWINS_M: f64 = 0.016;
/// So many of them are fitted before the rest.
const FIRST_FITTED: usize = 2;
/// A box that is so probable is surely one.
const SURE: f64 = 0.95;

/// Without those that lie upon enough better ones; best first, as they come.
pub fn best_of_rivals(shells: &[Shell]) -> Vec<&Shell> {
    let mut out: Vec<&Shell> = Vec::new();
    for shell in shells {
        let most = if lies(&shell.proposal) { LYING_FITTED } else { RIVALS_FITTED };
        let is_new = out.iter().all(|other| !alike(&other.proposal, &shell.proposal, TWINS_M));
        if is_new && out.iter().filter(|other| are_rivals(other, shell)).count() < most {
            out.push(shell);
        }
    }
    out
}

/// The fits of proposals, best first, in their order; `None` of those that end in no box, and of those that need none: the first of
/// those that lie upon each other are fitted before the rest, and where one of them is surely a box and holds what another promises,
/// that is taken to come to the same box or to less.
pub fn fitted_in_turn(shells: &[&Shell], fit: impl Fn(&Shell) -> Option<FoundBox> + Sync) -> Vec<Option<FoundBox>> {
    let rivals = |i: usize| (0..i).filter(move |&j| are_rivals(shells[j], shells[i]));
    let (first, rest): (Vec<usize>, Vec<usize>) =
        (0..shells.len()).partition(|&i| rivals(i).nth(FIRST_FITTED - 1).is_none());
    let mut out: Vec<Option<FoundBox>> = vec![None; shells.len()];
    fit_some(shells, &first, &fit, &mut out);
    let is_beaten = |i: usize| {
        let mut found = first.iter().filter(|&&j| are_rivals(shells[j], shells[i])).filter_map(|&j| out[j].as_ref());
        found.any(|one| is_sure(one) && one.rank(1.0) >= shells[i].score)
    };
    let left: Vec<usize> = rest.into_iter().filter(|&i| !is_beaten(i)).collect();
    fit_some(shells, &left, &fit, &mut out);
    out
}

/// What its corners say against it (eq. 104) leaves it to be seen.
fn is_sure(one: &FoundBox) -> bool {
    one.probability >= SURE && one.slots >= 1.0
}

/// Each by itself, in their order: the same bits on any number of threads.
fn fit_some(
    shells: &[&Shell],
    numbers: &[usize],
    fit: &(impl Fn(&Shell) -> Option<FoundBox> + Sync),
    out: &mut [Option<FoundBox>],
) {
    let fitted: Vec<Option<FoundBox>> = numbers.par_iter().map(|&i| fit(shells[i])).collect();
    numbers.iter().zip(fitted).for_each(|(&i, one)| out[i] = one);
}

fn are_rivals(a: &Shell, b: &Shell) -> bool {
    lies(&a.proposal) == lies(&b.proposal) && overlap(&a.proposal, &b.proposal)
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use nalgebra::{DMatrix, Isometry3};

    use super::super::labels::{Labels, Present};
    use super::*;
    use crate::fit::{FittedBody, Parameters, Solution};

    fn found(score: f64, probability: f64, slots: f64) -> FoundBox {
        let body = FittedBody { input_from_object: Isometry3::identity(), numbers: Parameters::zeros() };
        let solution = Solution { body, covariance: DMatrix::zeros(0, 0).into(), motions: Vec::new() };
        let labels = Labels { parts: Vec::new(), stride: 1 };
        let one = FoundBox::unjudged(solution, Present::default(), labels, Vec::new(), score);
        FoundBox { probability, slots, ..one }
    }

    #[test]
    fn what_promises_no_more_than_a_sure_box_holds_is_not_fitted() {
        // Three upon each other, and two apart.
        let places = [(0.0, 900.0), (0.02, 850.0), (1.0, 810.0), (0.04, 800.0), (1.02, 700.0)];
        let all: Vec<Shell> = places.map(|(at_m, score)| Shell::that_far(at_m, score)).into();
        let mut cases = 0;
        for (score, probability, slots, is_left) in
            [(800.0, 0.95, 1.0, true), (790.0, 0.99, 1.0, false), (950.0, 0.94, 1.0, false), (950.0, 0.99, 0.9, false)]
        {
            let fitted = Mutex::new(Vec::new());
            let fit = |shell: &Shell| {
                fitted.lock().unwrap().push(shell.score as usize);
                (shell.score > 860.0).then(|| found(score, probability, slots))
            };
            let out = fitted_in_turn(&all.iter().collect::<Vec<_>>(), fit);
            let mut fitted = fitted.into_inner().unwrap();
            fitted.sort_unstable();
            let expected = if is_left { vec![700, 810, 850, 900] } else { vec![700, 800, 810, 850, 900] };
            assert_eq!(fitted, expected, "{score} {probability} {slots}");
            assert_eq!(out.iter().map(Option::is_some).collect::<Vec<_>>(), [true, false, false, false, false]);
            cases += 1;
        }
        assert_eq!(cases, 4);
    }
}
