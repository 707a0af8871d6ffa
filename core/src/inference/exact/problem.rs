//! What is searched: scores, symmetries, and which assignments are wanted.

use super::rules::Rules;
use super::shortlist::Shortlist;
use super::symmetry::{Symmetries, UNDECIDED};
use crate::inference::potentials::Potentials;

pub struct Problem<'a> {
    pub potentials: &'a Potentials,
    pub symmetries: &'a Symmetries,
    /// Segments that may be used.
    pub segments: usize,
    pub rules: Rules<'a>,
}

impl Problem<'_> {
    /// Puts a complete assignment on the list, if it is wanted.
    pub fn offer(&self, states: &[usize], shortlist: &mut Shortlist) {
        if self.rules.accept.is_none_or(|accept| accept.allows(&assignment(states))) {
            shortlist.offer(self.potentials.score(states), states);
        }
    }

    /// False: whatever the undecided parts take, the assignment is not wanted.
    pub fn may_allow(&self, states: &[usize]) -> bool {
        let Some(accept) = self.rules.accept else { return true };
        let filled = states.iter().filter(|&&state| state != 0 && state != UNDECIDED).count();
        let undecided = states.iter().filter(|&&state| state == UNDECIDED).count();
        let reach = |parts: &[usize]| parts.iter().filter(|&&p| states[p] != 0).count();
        filled + undecided.min(self.segments - filled) >= accept.min_parts
            && accept.requirements.iter().all(|r| reach(&r.parts) >= r.at_least)
    }
}

/// The segments that a complete vector of states means.
pub fn assignment(states: &[usize]) -> Vec<Option<usize>> {
    states.iter().map(|state| state.checked_sub(1)).collect()
}
