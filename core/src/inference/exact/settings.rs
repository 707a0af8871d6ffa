use serde::Deserialize;

/// Settings of the exact search.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ExactSettings {
    /// Nodes that the search may visit: a count, not a time, so that equal input gives equal answers on any machine.
    pub max_nodes: u64,
    /// Sweeps of the bound's descent, at most.
    pub max_sweeps: usize,
}

impl Default for ExactSettings {
    fn default() -> Self {
        Self { max_nodes: 2_000_000, max_sweeps: 40 }
    }
}
