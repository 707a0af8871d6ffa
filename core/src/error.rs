//! What can be wrong with an input, told so that a person can mend it.

use std::fmt;

/// An input that could not be used: what was wrong, where, and what would have been right.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct InputError {
    /// File, or the name of the value at fault; empty until somebody who knows it fills it in.
    pub source: String,
    /// Place inside the source: "byte 123", "line 4", a key; empty where there is none.
    pub place: String,
    /// What was wrong.
    pub problem: String,
    /// What would have been right, or the option that mends it; empty where nobody can say.
    pub mend: String,
}

impl InputError {
    pub fn new(problem: impl Into<String>) -> Self {
        Self { source: String::new(), place: String::new(), problem: problem.into(), mend: String::new() }
    }

    pub fn at(mut self, place: impl Into<String>) -> Self {
        self.place = place.into();
        self
    }

    pub fn mend(mut self, mend: impl Into<String>) -> Self {
        self.mend = mend.into();
        self
    }

    /// What a TOML text is refused for, with its line.
    pub fn of_toml(text: &str, error: &toml::de::Error) -> Self {
        let refused = Self::new(error.message().replace('\n', " "));
        match error.span() {
            Some(span) => refused.at(format!("line {}", text[..span.start.min(text.len())].matches('\n').count() + 1)),
            None => refused,
        }
    }

    pub fn in_source(mut self, source: impl Into<String>) -> Self {
        self.source = source.into();
        self
    }
}

impl fmt::Display for InputError {
    /// One line: `source: place: problem; mend`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for part in [&self.source, &self.place] {
            if !part.is_empty() {
                write!(f, "{part}: ")?;
            }
        }
        write!(f, "{}", self.problem)?;
        if !self.mend.is_empty() {
            write!(f, "; {}", self.mend)?;
        }
        Ok(())
    }
}

impl std::error::Error for InputError {}

pub type Result<T> = std::result::Result<T, InputError>;
