use std::fmt;

/// A scene or a parameter that cannot be simulated: one line, what was wrong and what would have been right.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SensorError(String);

impl SensorError {
    pub fn new(message: impl Into<String>) -> Self {
        Self(message.into())
    }
}

impl fmt::Display for SensorError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for SensorError {}
