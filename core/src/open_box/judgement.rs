use std::collections::BTreeMap;

use serde::Deserialize;

use super::features::{Features, BOX_FEATURES, PART_FEATURES};
use crate::error::{InputError, Result};

/// Learned weights of what a fitted box, and each of its panels, is judged by: logistic regressions (eq. 90).
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Judgement {
    #[serde(rename = "box")]
    of_box: BTreeMap<String, f64>,
    #[serde(rename = "part")]
    of_part: BTreeMap<String, f64>,
}

impl Judgement {
    /// From the text of a judgement file.
    ///
    /// # Errors
    /// Names what is missing, what is not known, and what is no number.
    pub fn from_json(text: &str) -> Result<Self> {
        let read: Self =
            serde_json::from_str(text).map_err(|e| InputError::new(e.to_string()).in_source("judgement"))?;
        for (table, weights, known) in
            [("box", &read.of_box, &BOX_FEATURES[..]), ("part", &read.of_part, &PART_FEATURES[..])]
        {
            let wrong = known
                .iter()
                .find(|name| !weights.contains_key(**name))
                .map(|name| format!("has no weight of {name}"))
                .or_else(|| {
                    weights.keys().find(|name| !known.contains(&name.as_str())).map(|n| format!("{n} is not known"))
                });
            if let Some(wrong) = wrong {
                let mend = format!("it weighs {}", known.join(", "));
                return Err(InputError::new(format!("judgement.{table}: {wrong}")).mend(mend));
            }
        }
        Ok(read)
    }

    /// Each feature with its weight, and the sum: the log of the odds that the box is one.
    pub fn of_box(&self, features: &Features) -> (f64, Vec<(&'static str, f64, f64)>) {
        let terms: Vec<_> = features.iter().map(|&(name, value)| (name, value, self.of_box[name])).collect();
        (terms.iter().map(|(_, value, weight)| value * weight).sum(), terms)
    }

    /// The probability that a panel's readings are that panel's.
    pub fn part_probability(&self, features: &Features) -> f64 {
        probability(features.iter().map(|(name, value)| value * self.of_part[*name]).sum())
    }
}

/// Of log odds.
pub fn probability(log_odds: f64) -> f64 {
    1.0 / (1.0 + (-log_odds).exp())
}
