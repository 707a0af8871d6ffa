//! How probable it is that each found part is right: what the sums over assignments say, and what the rays say.

use super::answer::{ObjectAnswer, PartAnswer};
use crate::model::{logit, Evidence};

impl ObjectAnswer {
    /// Tells every found part's probability anew: from sums, and from the states that the rays gave it by now.
    pub fn tell_probabilities(&mut self) {
        let Some(calibration) = self.sums.map(|sums| sums.calibration) else { return };
        let told: Vec<Option<f64>> = (0..self.parts.len())
            .map(|p| Some(calibration.apply(&self.evidence(p)?, self.parts[p].state.is_some())))
            .collect();
        self.parts.iter_mut().zip(told).for_each(|(part, told)| part.probability = told);
    }

    /// What is known of a part (eq. 64); `None` where it was not found or nothing was summed.
    pub fn evidence(&self, part: usize) -> Option<Evidence> {
        let sums = self.sums.as_ref()?;
        let marginal = logit(self.parts[part].marginal?);
        let [part_seen, found_absent, others_absent, others_seen] = self.seen(part).unwrap_or_default();
        let assignment = logit(sums.assignment);
        Some([1.0, marginal, assignment, sums.unsummed, part_seen, found_absent, others_absent, others_seen])
    }

    /// What the rays say of the part and of its object: how far it is seen, the mean of what the found parts are absent,
    /// sums of what all others are absent and seen though no segment is theirs.
    fn seen(&self, part: usize) -> Option<[f64; 4]> {
        let part_seen = self.parts[part].state?.seen;
        let is_found = |part: &&PartAnswer| part.marginal.is_some();
        let states = |found: bool| self.parts.iter().filter(move |p| is_found(p) == found).filter_map(|p| p.state);
        let found_absent = states(true).map(|s| s.absent).sum::<f64>() / states(true).count() as f64;
        let others_absent = states(false).map(|s| s.absent).sum();
        Some([part_seen, found_absent, others_absent, states(false).map(|s| s.seen).sum()])
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::super::answer::{InferenceAnswer, Sums};
    use super::*;
    use crate::free_space::PartState;
    use crate::model::Calibration;

    fn part(marginal: Option<f64>, state: Option<[f64; 3]>) -> PartAnswer {
        let state = state.map(|[seen, hidden, absent]| PartState { seen, hidden, absent });
        PartAnswer {
            name: String::new(),
            observed: marginal.is_some(),
            state,
            seen_from: None,
            probability: None,
            marginal,
            corners: None,
            points: 0,
        }
    }

    fn object(parts: Vec<PartAnswer>, sums: Option<Sums>) -> ObjectAnswer {
        ObjectAnswer {
            template: String::new(),
            template_probability: None,
            score: 0.0,
            probability: None,
            inference: InferenceAnswer::new(0.0, 0, None),
            score_terms: Vec::new(),
            dimensions: None,
            outer_dimensions: None,
            thickness: None,
            size: None,
            pose: None,
            parameters: BTreeMap::new(),
            parts,
            joints: Vec::new(),
            sums,
        }
    }

    #[test]
    fn evidence_by_hand() {
        let sums = Sums { assignment: 0.5, unsummed: 0.25, calibration: Calibration::default() };
        let parts = vec![
            part(Some(0.5), Some([0.9, 0.0, 0.1])),
            part(Some(0.75), Some([0.2, 0.5, 0.3])),
            part(None, Some([0.6, 0.0, 0.4])),
            part(None, Some([0.1, 0.2, 0.7])),
            part(None, None),
        ];
        let mut object = object(parts, Some(sums));
        let evidence = object.evidence(0).unwrap();
        let expected = [1.0, 0.0, 0.0, 0.25, 0.9, 0.2, 1.1, 0.7];
        assert!(evidence.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{evidence:?}");
        assert!((object.evidence(1).unwrap()[1] - 3f64.ln()).abs() < 1e-12);
        assert_eq!(object.evidence(2), None);
        object.tell_probabilities();
        let told: Vec<Option<f64>> = object.parts.iter().map(|part| part.probability).collect();
        assert!((told[1].unwrap() - 0.75).abs() < 1e-12 && told[2..].iter().all(Option::is_none));
    }

    #[test]
    fn without_rays_or_sums_nothing_is_made_up() {
        let sums = Sums { assignment: 0.5, unsummed: 0.0, calibration: Calibration::default() };
        let blind = object(vec![part(Some(0.5), None), part(None, None)], Some(sums));
        assert_eq!(blind.evidence(0).unwrap()[4..], [0.0; 4]);
        assert_eq!(object(vec![part(Some(0.5), None)], None).evidence(0), None);
    }
}
