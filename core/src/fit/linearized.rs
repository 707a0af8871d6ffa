use nalgebra::{DMatrix, Isometry3};

use super::body::Parameters;
use super::layout::PARAMETER_COUNT;

/// The objective at a body, half the robust sum of squares, with its gradient and Gauss-Newton curvature (eq. 81, 82).
#[derive(Debug, Clone)]
pub struct Linearized {
    pub cost: f64,
    pub gradient: Parameters,
    /// Lower triangle.
    pub curvature: DMatrix<f64>,
    /// Of the other views' readings, object's frame: those that suit the body best.
    pub motions: Vec<Isometry3<f64>>,
}

impl Linearized {
    pub fn zeros() -> Self {
        let curvature = DMatrix::zeros(PARAMETER_COUNT, PARAMETER_COUNT);
        Self { cost: 0.0, gradient: Parameters::zeros(), curvature, motions: Vec::new() }
    }
}
