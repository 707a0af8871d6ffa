//! An arm from its file: the text is parsed, then checked.

use super::check;
use super::file::RobotFile;
use super::model::Arm;
use crate::error::{InputError, Result};

impl Arm {
    /// An arm from the text of its file (docs/robots.md).
    ///
    /// # Errors
    /// Names the line or key that does not fit, and what would.
    pub fn from_toml(text: &str) -> Result<Self> {
        let file: RobotFile = toml::from_str(text).map_err(|error| InputError::of_toml(text, &error))?;
        check::arm(file)
    }

    /// An arm from the same keys as JSON.
    ///
    /// # Errors
    /// As [`Arm::from_toml`].
    pub fn from_json(text: &str) -> Result<Self> {
        let file: RobotFile = serde_json::from_str(text).map_err(|error| InputError::new(error.to_string()))?;
        check::arm(file)
    }
}
