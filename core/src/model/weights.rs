use std::collections::BTreeMap;

use serde::Deserialize;

use super::calibration::CalibrationFile;
use super::{Calibration, Template};
use crate::error::{InputError, Result};

const FORMAT: &str = "boxwright.weights";
const VERSION: u32 = 1;

/// What each term of a template counts, aligned with `Template::term_names`.
#[derive(Debug, Clone, PartialEq)]
pub struct Weights {
    pub values: Vec<f64>,
    /// How much each term matters by learning; the search drops the least important relations first.
    pub importance: Vec<f64>,
    /// An assignment below this score is no object.
    pub accept_score: f64,
    /// T of P(G) proportional to exp(J(G) / T) (eq. 49), in units of the score.
    pub temperature: f64,
    pub calibration: Calibration,
}

impl Weights {
    /// Of weights that nobody has calibrated.
    pub const UNCALIBRATED_TEMPERATURE: f64 = 1.0;
}

#[derive(Debug, Deserialize)]
struct WeightsFile {
    format: String,
    version: u32,
    template: String,
    weights: BTreeMap<String, f64>,
    importance: BTreeMap<String, f64>,
    accept_score: f64,
    temperature: Option<f64>,
    calibration: Option<CalibrationFile>,
}

impl Weights {
    /// Reads weights (JSON text) for `template`.
    ///
    /// # Errors
    /// Weights of another template, missing or unknown names, values that are not finite: the key is named.
    pub fn from_json(text: &str, template: &Template) -> Result<Self> {
        let file: WeightsFile = serde_json::from_str(text)
            .map_err(|error| InputError::new(error.to_string()).mend("boxwright train writes weights that fit"))?;
        if file.format != FORMAT || file.version != VERSION {
            return Err(InputError::new(format!("is \"{}\" version {}", file.format, file.version))
                .at("format")
                .mend(format!("weights say \"{FORMAT}\", version {VERSION}")));
        }
        if file.template != template.name {
            return Err(InputError::new(format!("weights of \"{}\" do not fit \"{}\"", file.template, template.name))
                .at("template")
                .mend("name the weights that were trained for this template"));
        }
        if !file.accept_score.is_finite() {
            return Err(InputError::new("is not a finite number").at("accept_score"));
        }
        let temperature = file.temperature.unwrap_or(Self::UNCALIBRATED_TEMPERATURE);
        if !(temperature.is_finite() && temperature > 0.0) {
            return Err(InputError::new(format!("is {temperature}")).at("temperature").mend("a finite number above 0"));
        }
        let calibration = file.calibration.map(|calibration| calibration.read()).transpose()?.unwrap_or_default();
        Ok(Self {
            values: aligned("weights", &file.weights, template)?,
            importance: aligned("importance", &file.importance, template)?,
            accept_score: file.accept_score,
            temperature,
            calibration,
        })
    }

    /// J(G) of eq. 1.
    pub fn score(&self, feature_vector: &[f64]) -> f64 {
        self.values.iter().zip(feature_vector).map(|(w, f)| w * f).sum()
    }
}

fn aligned(key: &str, named: &BTreeMap<String, f64>, template: &Template) -> Result<Vec<f64>> {
    let names: Vec<&str> = template.term_names().collect();
    if let Some(extra) = named.keys().find(|name| !names.contains(&name.as_str())) {
        return Err(InputError::new(format!("\"{extra}\" is no feature or relation of \"{}\"", template.name))
            .at(key)
            .mend(format!("its names are {}", names.join(", "))));
    }
    names
        .iter()
        .map(|&name| match named.get(name) {
            Some(value) if value.is_finite() => Ok(*value),
            Some(value) => Err(InputError::new(format!("\"{name}\" is {value}")).at(key).mend("a finite number")),
            None => {
                Err(InputError::new(format!("\"{name}\" is missing")).at(key).mend("train again for this template"))
            }
        })
        .collect()
}
