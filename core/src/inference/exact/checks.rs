//! What the exact search refuses.

use crate::error::{InputError, Result};
use crate::model::{FeatureTables, Template, Weights};

/// # Errors
/// Names a feature, relation or weight that is not a finite number, and its segments.
pub fn require_finite(template: &Template, weights: &Weights, tables: &FeatureTables) -> Result<()> {
    let (n, features) = (tables.segment_count, template.features.len());
    for (k, (name, values)) in template.term_names().zip(tables.unary.iter().chain(&tables.pair)).enumerate() {
        if let Some(at) = values.iter().position(|value| !value.is_finite()) {
            let of = if k < features { format!("segment {at}") } else { format!("segments {} and {}", at / n, at % n) };
            return Err(InputError::new(format!("is {} for {of}", values[at]))
                .at(name)
                .mend("every value of a feature or relation is a finite number"));
        }
    }
    match template.term_names().zip(&weights.values).find(|(_, weight)| !weight.is_finite()) {
        Some((name, weight)) => Err(InputError::new(format!("has weight {weight}")).at(name).mend("a finite number")),
        None => Ok(()),
    }
}
