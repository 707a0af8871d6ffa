//! How well a fitted body's numbers are known: asked of few of the many bodies that are fitted.

use std::ops::Deref;
use std::sync::{Arc, OnceLock};

use nalgebra::DMatrix;

use super::factor::Factor;

/// A covariance that is worked out when it is first asked for.
#[derive(Debug, Clone)]
pub struct Covariance(Arc<Known>);

#[derive(Debug)]
enum Known {
    /// What its inverse is made of, and itself once it was asked for.
    Inverse(Box<Factor>, OnceLock<DMatrix<f64>>),
    Itself(DMatrix<f64>),
}

impl Covariance {
    /// The inverse of a curvature.
    pub fn of(factor: Factor) -> Self {
        Self(Arc::new(Known::Inverse(Box::new(factor), OnceLock::new())))
    }
}

impl From<DMatrix<f64>> for Covariance {
    fn from(matrix: DMatrix<f64>) -> Self {
        Self(Arc::new(Known::Itself(matrix)))
    }
}

impl Deref for Covariance {
    type Target = DMatrix<f64>;

    fn deref(&self) -> &DMatrix<f64> {
        match &*self.0 {
            Known::Inverse(factor, matrix) => matrix.get_or_init(|| factor.inverse()),
            Known::Itself(matrix) => matrix,
        }
    }
}
