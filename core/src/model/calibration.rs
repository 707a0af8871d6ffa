use std::collections::BTreeMap;

use serde::Deserialize;

use crate::error::{InputError, Result};

/// What is known of a part that was found, by name (eq. 64); from `part_seen` on only the rays of an image tell.
pub const EVIDENCE: [&str; 8] =
    ["one", "marginal", "assignment", "unsummed", "part_seen", "found_absent", "others_absent", "others_seen"];
/// Values of `EVIDENCE`, in that order; probabilities of the sums as logits, all others as they are.
pub type Evidence = [f64; EVIDENCE.len()];

const MARGINAL: usize = 1;

/// Probabilities nearer to 0 or 1 count as this far away.
const MARGIN: f64 = 1e-6;

/// How evidence of a part makes the probability that the part is right (eq. 64): what each counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Calibration {
    /// Where the rays of an image were asked.
    pub rays: Evidence,
    /// Where there were none.
    pub blind: Evidence,
}

impl Default for Calibration {
    /// The marginal as it is.
    fn default() -> Self {
        let mut weights = [0.0; EVIDENCE.len()];
        weights[MARGINAL] = 1.0;
        Self { rays: weights, blind: weights }
    }
}

/// The logarithm of the odds.
pub fn logit(probability: f64) -> f64 {
    let inside = probability.clamp(MARGIN, 1.0 - MARGIN);
    (inside / (1.0 - inside)).ln()
}

/// As weights hold it.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CalibrationFile {
    rays: BTreeMap<String, f64>,
    blind: BTreeMap<String, f64>,
}

impl CalibrationFile {
    /// # Errors
    /// Names that are no evidence or are missing, values that are not finite, a marginal that counts 0 or less.
    pub fn read(&self) -> Result<Calibration> {
        let read =
            |key: &str, named| aligned(named).map_err(|error: InputError| error.at(format!("calibration.{key}")));
        Ok(Calibration { rays: read("rays", &self.rays)?, blind: read("blind", &self.blind)? })
    }
}

fn aligned(named: &BTreeMap<String, f64>) -> Result<Evidence> {
    if !named.keys().map(String::as_str).eq(sorted_names()) {
        let names: Vec<&str> = named.keys().map(String::as_str).collect();
        return Err(InputError::new(format!("names {}", names.join(", "))).mend(EVIDENCE.join(", ")));
    }
    let values = EVIDENCE.map(|name| named[name]);
    match values.iter().position(|value| !value.is_finite()) {
        Some(at) => Err(InputError::new(format!("{} is {}", EVIDENCE[at], values[at])).mend("a finite number")),
        // Else more certain marginals would say less.
        None if values[MARGINAL] <= 0.0 => {
            Err(InputError::new(format!("marginal is {}", values[MARGINAL])).mend("a number above 0"))
        }
        None => Ok(values),
    }
}

fn sorted_names() -> impl Iterator<Item = &'static str> {
    let mut names = EVIDENCE;
    names.sort_unstable();
    names.into_iter()
}

impl Calibration {
    /// The probability that the part is right; `has_rays` says that the rays were asked.
    pub fn apply(&self, evidence: &Evidence, has_rays: bool) -> f64 {
        let weights = if has_rays { &self.rays } else { &self.blind };
        let logit: f64 = weights.iter().zip(evidence).map(|(weight, value)| weight * value).sum();
        1.0 / (1.0 + (-logit).exp())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of_marginal(marginal: f64) -> Evidence {
        let mut evidence = [0.0; EVIDENCE.len()];
        (evidence[0], evidence[MARGINAL]) = (1.0, logit(marginal));
        evidence
    }

    #[test]
    fn the_default_changes_nothing_and_more_marginal_is_more_probability() {
        let mut tilted = Calibration::default();
        (tilted.blind[0], tilted.blind[MARGINAL]) = (-0.7, 0.4);
        let marginals: Vec<f64> = (1..1000).map(|k| f64::from(k) / 1000.0).collect();
        assert_eq!(marginals.len(), 999);
        for has_rays in [true, false] {
            let told = |p: &f64| Calibration::default().apply(&of_marginal(*p), has_rays);
            assert!(marginals.iter().all(|p| (told(p) - p).abs() < 1e-12));
        }
        let told = |p: f64| tilted.apply(&of_marginal(p), false);
        assert!(marginals.windows(2).all(|w| told(w[0]) < told(w[1])));
        // By hand: the logit of 1/2 is 0, so what "one" counts is left.
        assert!((told(0.5) - 1.0 / (1.0 + 0.7f64.exp())).abs() < 1e-15);
        assert!(told(0.0) > 0.0 && told(1.0) < 1.0);
    }

    #[test]
    fn files_that_do_not_fit_are_refused_by_name() {
        let good: BTreeMap<String, f64> = EVIDENCE.iter().map(|name| ((*name).to_owned(), 1.0)).collect();
        let refusal = |blind: &BTreeMap<String, f64>| {
            CalibrationFile { rays: good.clone(), blind: blind.clone() }.read().map_err(|error| error.to_string())
        };
        assert_eq!(refusal(&good).unwrap().blind, [1.0; EVIDENCE.len()]);
        let with = |name: &str, value: f64| {
            let mut named = good.clone();
            named.insert(name.to_owned(), value);
            refusal(&named).unwrap_err()
        };
        assert!(with("luck", 1.0).contains("calibration.blind: names "), "{}", with("luck", 1.0));
        assert!(with("marginal", 0.0).contains("marginal is 0; a number above 0"), "{}", with("marginal", 0.0));
        assert!(with("one", f64::INFINITY).contains("one is inf"));
        let mut short = good.clone();
        short.remove("part_seen");
        assert!(refusal(&short).is_err());
    }
}
