use nalgebra::Isometry3;

use super::body::{FittedBody, Parameters};
use super::covariance::Covariance;
use super::factor::Factor;
use super::linearized::Linearized;
use super::problem::Problem;
use super::refusal::NotFitted;

/// A body at which the objective is least, and the covariance of its numbers there.
#[derive(Debug, Clone)]
pub struct Solution {
    pub body: FittedBody,
    /// Inverse of the curvature: of independent readings.
    pub covariance: Covariance,
    /// Of other views' readings, object's frame: where they suit the body best.
    pub motions: Vec<Isometry3<f64>>,
}

const FIRST_DAMPING: f64 = 1e-3;
const LEAST_DAMPING: f64 = 1e-9;
const MOST_DAMPING: f64 = 1e10;
/// Under each of the coarse cuts so many steps are taken to come near.
const STEPS_OF_STAGE: usize = 8;

/// Levenberg-Marquardt: coarse cuts first, so that a poor start does not lose its readings (eq. 82).
///
/// # Errors
/// Where the steps are spent or none betters the objective before it is least.
pub fn solve(problem: &Problem, start: &FittedBody) -> Result<Solution, NotFitted> {
    let mut body = start.clone();
    for &cut in problem.settings.coarse_cuts {
        let mut coarse = Descent::new(problem, body, cut);
        // It need not end: the next stage goes on from there.
        let _ = coarse.run(STEPS_OF_STAGE);
        body = coarse.body;
    }
    let mut descent = Descent::new(problem, body, problem.settings.last_cut);
    descent.run(problem.settings.max_steps)?;
    let covariance = Covariance::of(Factor::new(&descent.at.curvature, 0.0).ok_or(NotFitted::Singular)?);
    Ok(Solution { body: descent.body, covariance, motions: descent.at.motions })
}

struct Descent<'a> {
    problem: &'a Problem,
    cut: f64,
    body: FittedBody,
    at: Linearized,
    damping: f64,
    steps: usize,
}

impl<'a> Descent<'a> {
    fn new(problem: &'a Problem, body: FittedBody, cut: f64) -> Self {
        let at = problem.linearize(&body, cut);
        Self { problem, cut, body, at, damping: FIRST_DAMPING, steps: 0 }
    }

    /// Until a step would gain less than `least_gain`.
    fn run(&mut self, most: usize) -> Result<(), NotFitted> {
        while self.steps < most {
            self.steps += 1;
            if self.step()? {
                return Ok(());
            }
        }
        Err(NotFitted::StepsSpent(most))
    }

    /// One step downhill, damped until it is one; whether none was worth it.
    fn step(&mut self) -> Result<bool, NotFitted> {
        while self.damping < MOST_DAMPING {
            let damped = Factor::new(&self.at.curvature, self.damping).ok_or(NotFitted::Singular)?;
            let step: Parameters = -damped.solve(&self.at.gradient);
            // As good as undamped, a step tells what is left to gain.
            let is_free = self.damping <= FIRST_DAMPING;
            if is_free && -self.at.gradient.dot(&step) < 2.0 * self.problem.settings.least_gain {
                return Ok(true);
            }
            let body = self.body.moved(&step);
            let at = self.problem.linearize_from(&body, &self.at.motions, self.cut);
            if at.cost < self.at.cost {
                (self.body, self.at) = (body, at);
                self.damping = (self.damping / 10.0).max(LEAST_DAMPING);
                return Ok(false);
            }
            self.damping *= 8.0;
        }
        Err(NotFitted::NoStepBetters)
    }
}
