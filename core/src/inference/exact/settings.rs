use serde::Deserialize;

/// Settings of the exact search and of the sums for probabilities. Nodes are counts, not times, so that equal input gives
/// equal answers on any machine.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ExactSettings {
    /// Nodes that the search may visit.
    pub max_nodes: u64,
    /// Sweeps of the bound's descent, at most.
    pub max_sweeps: usize,
    /// The share of the probability that sums may leave out; more, and an object's probability is not told.
    pub sum_tolerance: f64,
    /// Nodes that the sums may visit.
    pub max_sum_nodes: u64,
}

impl Default for ExactSettings {
    fn default() -> Self {
        Self { max_nodes: 2_000_000, max_sweeps: 40, sum_tolerance: 0.01, max_sum_nodes: 50_000 }
    }
}
