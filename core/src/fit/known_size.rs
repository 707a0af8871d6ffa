//! Outer sizes that boxes may have, as a prior on a body's dimensions (docs/maths.md, "What is known beforehand").

use nalgebra::{DMatrix, Matrix3, SMatrix, Vector3};

use super::body::{FittedBody, Parameters};
use super::layout::{HEIGHT, LENGTH, PARAMETER_COUNT, THICKNESS, WIDTH};
use super::solve::Solution;
use crate::body::SizeAnswer;
use crate::error::{InputError, Result};

/// An outer size by its name: three lengths in any order, metres.
#[derive(Debug, Clone, PartialEq)]
pub struct KnownSize {
    pub name: String,
    pub outer_m: [f64; 3],
}

/// What a person's rule, and boxes of one kind among themselves, err by.
const SIZE_SIGMA_M: f64 = 0.001;
/// How far a fit may be off beside its own standard deviations, and still be of a box of that size.
const MATCH_SIGMA_M: f64 = 0.004;
/// Chi-squared of three numbers, exceeded once in a thousand.
const MOST_CHI2: f64 = 16.27;
/// A box of no given size keeps this share of its score among its rivals.
const SHARE_OF_OTHERS: f64 = 0.8;
/// No length of a box is less or more than this: the unit is wrong.
const SIZES_M: [f64; 2] = [0.01, 3.0];

const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [1, 0, 2], [0, 2, 1], [2, 0, 1], [1, 2, 0], [2, 1, 0]];

impl KnownSize {
    /// # Errors
    /// Where a length is no number, or that of no box.
    pub fn new(name: &str, outer_m: [f64; 3]) -> Result<Self> {
        let wrong = outer_m.iter().find(|&&m| !(SIZES_M[0]..=SIZES_M[1]).contains(&m));
        if let Some(length) = wrong {
            let problem = format!("size {name:?} has a length of {} mm", 1e3 * length);
            let [least, most] = SIZES_M.map(|m| 1e3 * m);
            return Err(InputError::new(problem).mend(format!("give outer lengths in mm, {least} to {most} each")));
        }
        Ok(Self { name: name.to_owned(), outer_m })
    }
}

/// The given size, and the way round, that comes nearest to a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SizeMatch {
    /// Its place in the list.
    pub size: usize,
    /// Its lengths along the body's length, width and height, m.
    pub outer_m: [f64; 3],
    /// Squared distance in standard deviations (eq. 91).
    pub chi2: f64,
}

impl SizeMatch {
    pub fn is_met(&self) -> bool {
        self.chi2 < MOST_CHI2
    }
}

/// Length, width and height over the boards, m.
pub fn outer_m(body: &FittedBody) -> [f64; 3] {
    let board = body.board_m();
    [body.get(LENGTH) + board, body.get(WIDTH) + board, body.get(HEIGHT)]
}

/// Of a fitted body, by the fit's covariance; `None` where no size is given.
pub fn best_match(solution: &Solution, sizes: &[KnownSize]) -> Option<SizeMatch> {
    if sizes.is_empty() {
        return None;
    }
    nearest(outer_m(&solution.body), &outer_covariance(&solution.covariance), sizes)
}

/// Of measured lengths that are each known within `sigma_m`.
pub fn best_match_within(outer_m: [f64; 3], sigma_m: f64, sizes: &[KnownSize]) -> Option<SizeMatch> {
    nearest(outer_m, &(Matrix3::identity() * sigma_m * sigma_m), sizes)
}

/// The solution, conditioned on the given size that it matches, if it does (eq. 91, 93).
pub fn with_known_size(solution: Solution, sizes: &[KnownSize], scale: f64) -> (Solution, Option<SizeMatch>) {
    let Some(found) = best_match(&solution, sizes).filter(SizeMatch::is_met) else { return (solution, None) };
    match condition(&solution, &found, scale) {
        Some(conditioned) => (conditioned, Some(found)),
        None => (solution, None),
    }
}

impl SizeMatch {
    pub fn answer(&self, sizes: &[KnownSize]) -> SizeAnswer {
        SizeAnswer { name: sizes[self.size].name.clone(), outer_dimensions: self.outer_m }
    }
}

/// What a box's score is worth among its rivals: one where it has a given size, less where it has none (eq. 92).
pub fn share_of_score(found: Option<&SizeMatch>) -> f64 {
    found.map_or(1.0, |m| SHARE_OF_OTHERS + (1.0 - SHARE_OF_OTHERS) * (-m.chi2 / 2.0).exp())
}

/// The solution given that its outer dimensions are the match's, each give or take the rule (eq. 93): the step that one more
/// residual for each of them makes from where the fit ended. Standard deviations are the covariance's times `scale`. `None`
/// where the covariance is singular.
pub fn condition(solution: &Solution, to: &SizeMatch, scale: f64) -> Option<Solution> {
    let by = by_numbers();
    let covariance: &DMatrix<f64> = &solution.covariance;
    let innovation = Vector3::from(to.outer_m) - Vector3::from(outer_m(&solution.body));
    let spread = outer_covariance(covariance) + Matrix3::identity() * (SIZE_SIGMA_M / scale).powi(2);
    let gain = covariance * by.transpose() * spread.try_inverse()?;
    let step: Parameters = (&gain * innovation).fixed_view::<PARAMETER_COUNT, 1>(0, 0).into_owned();
    let left = covariance - &gain * by * covariance;
    // Rounding must not leave it lopsided.
    let covariance = (&left + left.transpose()) * 0.5;
    Some(Solution {
        body: solution.body.moved(&step),
        covariance: covariance.into(),
        motions: solution.motions.clone(),
    })
}

fn nearest(outer_m: [f64; 3], covariance: &Matrix3<f64>, sizes: &[KnownSize]) -> Option<SizeMatch> {
    let spread = covariance + Matrix3::identity() * (MATCH_SIGMA_M * MATCH_SIGMA_M);
    let information = spread.try_inverse()?;
    let mut best: Option<SizeMatch> = None;
    for (number, size) in sizes.iter().enumerate() {
        for order in ORDERS {
            let told = order.map(|i| size.outer_m[i]);
            let off = Vector3::from(outer_m) - Vector3::from(told);
            let chi2 = off.dot(&(information * off));
            if best.is_none_or(|b| chi2 < b.chi2) {
                best = Some(SizeMatch { size: number, outer_m: told, chi2 });
            }
        }
    }
    best
}

/// Of the outer dimensions, from that of the body's numbers.
fn outer_covariance(covariance: &DMatrix<f64>) -> Matrix3<f64> {
    let by = by_numbers();
    (by * covariance * by.transpose()).fixed_view::<3, 3>(0, 0).into_owned()
}

/// Derivatives of the outer dimensions by the body's numbers; the lean of racked sides is left out.
fn by_numbers() -> SMatrix<f64, 3, PARAMETER_COUNT> {
    let mut by = SMatrix::zeros();
    for (row, places) in [&[LENGTH, THICKNESS][..], &[WIDTH, THICKNESS], &[HEIGHT]].into_iter().enumerate() {
        places.iter().for_each(|&place| by[(row, place)] = 1.0);
    }
    by
}
