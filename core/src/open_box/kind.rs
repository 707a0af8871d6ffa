//! Which template a fitted box is of: a multinomial logistic model over features of its shape (eq. 89).

use std::collections::BTreeMap;

use serde::Deserialize;

use super::shape::{Shape, SHAPE_FEATURES};
use crate::error::{InputError, Result};
use crate::model::{Body, Template};

const FORMAT: &str = "boxwright.kinds";
const VERSION: u32 = 1;

/// What each feature of a shape counts for each template; without weights no template is told from another.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Kinds {
    weights: BTreeMap<String, [f64; SHAPE_FEATURES.len()]>,
}

#[derive(Deserialize)]
struct KindsFile {
    format: String,
    version: u32,
    weights: BTreeMap<String, BTreeMap<String, f64>>,
}

impl Kinds {
    /// Reads weights (JSON text).
    ///
    /// # Errors
    /// Another format, missing or unknown features, values that are not finite: the key is named.
    pub fn from_json(text: &str) -> Result<Self> {
        let mend = "python -m benchmarks.kinds --learn writes weights that fit";
        let file: KindsFile =
            serde_json::from_str(text).map_err(|error| InputError::new(error.to_string()).mend(mend))?;
        if file.format != FORMAT || file.version != VERSION {
            return Err(InputError::new(format!("is \"{}\" version {}", file.format, file.version))
                .at("format")
                .mend(format!("weights of kinds say \"{FORMAT}\", version {VERSION}")));
        }
        let weights = file.weights.iter().map(|(name, of)| Ok((name.clone(), aligned(name, of)?)));
        Ok(Self { weights: weights.collect::<Result<_>>()? })
    }

    /// How probable each of these templates is, against the others of them; `None` of one that has no weights.
    pub fn probabilities(&self, shape: &Shape, templates: &[&str]) -> Vec<Option<f64>> {
        let features = shape.features();
        let score = |weights: &[f64; SHAPE_FEATURES.len()]| -> f64 {
            weights.iter().zip(&features).map(|(weight, value)| weight * value).sum()
        };
        let scores: Vec<Option<f64>> =
            templates.iter().map(|template| self.weights.get(*template).map(score)).collect();
        let highest = scores.iter().flatten().copied().fold(f64::NEG_INFINITY, f64::max);
        let odds = |score: f64| (score - highest).exp();
        let total: f64 = scores.iter().flatten().map(|score| odds(*score)).sum();
        scores.iter().map(|score| score.map(|score| odds(score) / total)).collect()
    }

    /// The most probable of the templates whose body is an open box, by its number, with its probability; the first of
    /// them, without one, where none has weights.
    pub fn choose(&self, shape: &Shape, templates: &[&Template]) -> Option<(usize, Option<f64>)> {
        let boxes: Vec<usize> = open_boxes(templates).collect();
        let names: Vec<&str> = boxes.iter().map(|&number| templates[number].name.as_str()).collect();
        let probabilities = self.probabilities(shape, &names);
        let told = boxes.iter().zip(&probabilities).filter_map(|(&number, p)| Some((number, (*p)?)));
        // Ties go to the template that was named first.
        let best = told.reduce(|best, one| if one.1 > best.1 { one } else { best });
        best.map(|(number, p)| (number, Some(p))).or_else(|| Some((*boxes.first()?, None)))
    }
}

/// Numbers of the templates whose body is an open box.
pub fn open_boxes<'a>(templates: &'a [&Template]) -> impl Iterator<Item = usize> + 'a {
    (0..templates.len()).filter(|&number| matches!(templates[number].body, Body::OpenBox(_)))
}

/// Numbers of the templates whose body is a closed box.
pub fn closed_boxes<'a>(templates: &'a [&Template]) -> impl Iterator<Item = usize> + 'a {
    (0..templates.len()).filter(|&number| matches!(templates[number].body, Body::ClosedBox(_)))
}

fn aligned(template: &str, named: &BTreeMap<String, f64>) -> Result<[f64; SHAPE_FEATURES.len()]> {
    let key = format!("weights.{template}");
    if let Some(extra) = named.keys().find(|name| !SHAPE_FEATURES.contains(&name.as_str())) {
        return Err(InputError::new(format!("\"{extra}\" is no feature of a box's shape"))
            .at(key)
            .mend(format!("its features are {}", SHAPE_FEATURES.join(", "))));
    }
    let mut out = [0.0; SHAPE_FEATURES.len()];
    for (slot, name) in out.iter_mut().zip(SHAPE_FEATURES) {
        *slot = match named.get(name) {
            Some(value) if value.is_finite() => *value,
            Some(value) => {
                return Err(InputError::new(format!("\"{name}\" is {value}")).at(key).mend("a finite number"))
            }
            None => return Err(InputError::new(format!("\"{name}\" is missing")).at(key).mend("a number")),
        };
    }
    Ok(out)
}
