//! The names of a template's parts.

use crate::error::{InputError, Result};

/// More parts than this would make the search's structure analysis (all subsets of parts) slow.
const MAX_PARTS: usize = 16;

pub fn at(key: impl Into<String>, problem: impl Into<String>) -> InputError {
    InputError::new(problem).at(key)
}

/// The template's part names, for turning a name into an index.
pub struct Names(Vec<String>);

impl Names {
    pub fn new(names: Vec<String>) -> Result<Self> {
        if names.is_empty() || names.len() > MAX_PARTS {
            return Err(
                at("part", format!("there are {} parts", names.len())).mend(format!("a template has 1 to {MAX_PARTS}"))
            );
        }
        for (k, name) in names.iter().enumerate() {
            if name.is_empty() || names[..k].contains(name) {
                return Err(at("part", format!("the name \"{name}\" is empty or stands twice"))
                    .mend("each part has a name of its own"));
            }
        }
        Ok(Self(names))
    }

    pub fn count(&self) -> usize {
        self.0.len()
    }

    pub fn index(&self, key: &str, name: &str) -> Result<usize> {
        self.0.iter().position(|n| n == name).ok_or_else(|| {
            at(key, format!("\"{name}\" is no part of this template"))
                .mend(format!("its parts are {}", self.0.join(", ")))
        })
    }

    pub fn indices(&self, key: &str, names: &[String]) -> Result<Vec<usize>> {
        names.iter().map(|name| self.index(key, name)).collect()
    }

    pub fn optional_index(&self, key: &str, name: &str) -> Result<Option<usize>> {
        if name.is_empty() {
            return Ok(None);
        }
        self.index(key, name).map(Some)
    }
}
