use serde::Deserialize;
use serde_json::{Map, Value};

use super::exact::ExactSettings;
use super::staged::StagedSettings;
use crate::error::{InputError, Result};

/// How the best assignment is sought.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SearchMethod {
    /// The paper's staged inference.
    #[default]
    Staged,
    /// Branch and bound over all assignments, with probabilities.
    Exact,
}

/// Which search, and the settings of each.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SearchSettings {
    pub search: SearchMethod,
    pub staged: StagedSettings,
    pub exact: ExactSettings,
}

/// Settings by these names are the exact search's.
const OF_EXACT: [&str; 4] = ["max_nodes", "max_sweeps", "sum_tolerance", "max_sum_nodes"];

impl SearchSettings {
    /// The defaults with some values replaced by name.
    ///
    /// # Errors
    /// Names a setting that does not exist or a value of the wrong kind.
    pub fn with_overrides(mut overrides: Map<String, Value>) -> Result<Self> {
        let refused = |error: serde_json::Error| InputError::new(error.to_string()).in_source("search settings");
        let search = overrides.remove("search").map(serde_json::from_value).transpose();
        let search = search.map_err(|error| refused(error).at("search"))?;
        let (exact, staged) = overrides.into_iter().partition(|(name, _)| OF_EXACT.contains(&name.as_str()));
        Ok(Self {
            search: search.unwrap_or_default(),
            staged: StagedSettings::with_overrides(staged)?,
            exact: serde_json::from_value(Value::Object(exact)).map_err(refused)?,
        })
    }
}
