use super::look::Looked;
use serde::Serialize;

/// Neighbouring readings err together: so many count as one.
const CORRELATED: f64 = 25.0;
/// Of the rays that reach a panel, the share that meets it, where it is there and where it is not.
const MET_IF_THERE: f64 = 0.85;
const MET_IF_ABSENT: f64 = 0.15;
/// So much is a panel expected to be there before anything is looked at.
const PRIOR: f64 = 0.9;
/// Readings of a panel that is in the cloud (docs/formats.md, "The figures of merit").
const SEEN_READINGS: f64 = 400.0;

/// Probabilities of a part's state; they sum to one.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PartState {
    pub seen: f64,
    pub hidden: f64,
    pub absent: f64,
}

impl PartState {
    /// Of a part that something else proves to be there.
    pub const HIDDEN: Self = Self { seen: 0.0, hidden: 1.0, absent: 0.0 };

    /// From what the rays say (eq. 60).
    pub fn of(looked: &Looked) -> Self {
        let for_met = (MET_IF_THERE / MET_IF_ABSENT).ln();
        let for_through = ((1.0 - MET_IF_THERE) / (1.0 - MET_IF_ABSENT)).ln();
        let log_odds =
            (PRIOR / (1.0 - PRIOR)).ln() + (looked.met * for_met + looked.through * for_through) / CORRELATED;
        let there = 1.0 / (1.0 + (-log_odds).exp());
        let seen = there * (looked.met / SEEN_READINGS).min(1.0);
        Self { seen, hidden: there - seen, absent: 1.0 - there }
    }

    /// Of a part that is told as seen with that probability: the rays share out the rest.
    pub fn seen_with(looked: &Looked, probability: f64) -> Self {
        let otherwise = Self::unseen(looked);
        let rest = 1.0 - probability;
        Self { seen: probability, hidden: rest * otherwise.hidden, absent: rest * otherwise.absent }
    }

    /// Of a part that nothing is told to be: readings that it would meet belong to something else, and say nothing.
    pub fn unseen(looked: &Looked) -> Self {
        Self::of(&Looked { met: 0.0, ..*looked })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn state(met: f64, through: f64, hidden: f64) -> PartState {
        PartState::of(&Looked { met, through, hidden, ..Looked::default() })
    }

    #[test]
    fn rays_tell_seen_from_hidden_from_absent() {
        assert!(state(3000.0, 40.0, 0.0).seen > 0.99);
        assert!(state(60.0, 900.0, 100.0).absent > 0.99);
        let unseen = state(0.0, 0.0, 2000.0);
        assert!((unseen.hidden - PRIOR).abs() < 1e-12 && unseen.seen == 0.0);
        for probability in [0.0, 0.5, 0.93, 1.0] {
            let looked = Looked { met: 500.0, through: 90.0, hidden: 4000.0, ..Looked::default() };
            let told = PartState::seen_with(&looked, probability);
            assert!((told.seen + told.hidden + told.absent - 1.0).abs() < 1e-12 && told.seen == probability);
            assert_eq!(PartState::unseen(&looked).seen, 0.0);
        }
        for s in [state(10.0, 10.0, 10.0), state(0.0, 0.0, 0.0), state(1e6, 1e6, 0.0)] {
            assert!((s.seen + s.hidden + s.absent - 1.0).abs() < 1e-12 && s.absent >= 0.0);
        }
    }
}
