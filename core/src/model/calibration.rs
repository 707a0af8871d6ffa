use serde::{Deserialize, Serialize};

use crate::error::{InputError, Result};

/// What a part's marginal says of the part being right (eq. 64): a rising line between logits.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Calibration {
    /// Above 0, so that the order of parts stays.
    pub slope: f64,
    pub offset: f64,
}

impl Default for Calibration {
    /// The marginal as it is.
    fn default() -> Self {
        Self { slope: 1.0, offset: 0.0 }
    }
}

/// Probabilities nearer to 0 or 1 count as this far away.
const MARGIN: f64 = 1e-6;

impl Calibration {
    pub fn apply(&self, marginal: f64) -> f64 {
        let inside = marginal.clamp(MARGIN, 1.0 - MARGIN);
        let logit = (inside / (1.0 - inside)).ln();
        1.0 / (1.0 + (-self.slope * logit - self.offset).exp())
    }

    /// # Errors
    /// A slope that is not above 0, an offset that is not finite.
    pub fn check(&self) -> Result<()> {
        if !(self.slope.is_finite() && self.slope > 0.0) {
            let problem = InputError::new(format!("is {}", self.slope)).at("calibration.slope");
            return Err(problem.mend("a finite number above 0"));
        }
        if !self.offset.is_finite() {
            return Err(InputError::new(format!("is {}", self.offset))
                .at("calibration.offset")
                .mend("a finite number"));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::Calibration;

    #[test]
    fn the_default_changes_nothing_and_every_line_keeps_the_order() {
        let tilted = Calibration { slope: 0.4, offset: -0.7 };
        let marginals: Vec<f64> = (1..1000).map(|k| f64::from(k) / 1000.0).collect();
        assert_eq!(marginals.len(), 999);
        assert!(marginals.iter().all(|&p| (Calibration::default().apply(p) - p).abs() < 1e-12));
        assert!(marginals.windows(2).all(|w| tilted.apply(w[0]) < tilted.apply(w[1])));
        // By hand: the logit of 1/2 is 0, so the offset alone is left.
        assert!((tilted.apply(0.5) - 1.0 / (1.0 + 0.7f64.exp())).abs() < 1e-15);
        assert!(tilted.apply(0.0) > 0.0 && tilted.apply(1.0) < 1.0);
        for (slope, offset) in [(0.0, 0.0), (-1.0, 0.0), (f64::NAN, 0.0), (1.0, f64::INFINITY)] {
            assert!(Calibration { slope, offset }.check().is_err());
        }
    }
}
