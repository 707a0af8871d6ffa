//! How well a fitted body's numbers are known: asked of few of the many bodies that are fitted.

use std::ops::Deref;
use std::sync::{Arc, OnceLock};

use nalgebra::DMatrix;

use super::factor::Factor;

/// A covariance that is worked out when it is first asked for.
#[derive(Debug, Clone)]
pub struct Covariance(Arc<Told>);

#[derive(Debug)]
struct Told {
    /// Of its inverse; `None` where it was told.
    factor: Option<Factor>,
    matrix: OnceLock<DMatrix<f64>>,
}

impl Covariance {
    /// The inverse of a curvature.
    pub fn of(factor: Factor) -> Self {
        Self(Arc::new(Told { factor: Some(factor), matrix: OnceLock::new() }))
    }
}

impl From<DMatrix<f64>> for Covariance {
    fn from(matrix: DMatrix<f64>) -> Self {
        Self(Arc::new(Told { factor: None, matrix: OnceLock::from(matrix) }))
    }
}

impl Deref for Covariance {
    type Target = DMatrix<f64>;

    fn deref(&self) -> &DMatrix<f64> {
        let Told { factor, matrix } = &*self.0;
        matrix.get_or_init(|| factor.as_ref().map_or_else(|| DMatrix::zeros(0, 0), Factor::inverse))
    }
}
