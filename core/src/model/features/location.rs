use serde::Deserialize;

use crate::model::SegmentSet;

/// phi 2 (eq. 3): `tolerance - |v - L|`, metres; `v` is the centre of the segment's rectangle.
#[derive(Debug, Clone, PartialEq)]
pub struct Location {
    pub reference: Reference,
    pub tolerance_m: f64,
}

/// The reference point L.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Reference {
    /// Area-weighted centre of the segments that the search may use.
    GroupCenter,
    /// That centre dropped onto the support.
    GroupFoot,
}

impl Location {
    pub fn value(&self, set: &SegmentSet, s: usize) -> f64 {
        let reference = match self.reference {
            Reference::GroupCenter => set.center,
            Reference::GroupFoot => set.foot,
        };
        self.tolerance_m - (set.centers[s] - reference).norm()
    }
}
