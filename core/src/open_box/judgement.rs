use std::collections::BTreeMap;

use serde::Deserialize;

use super::feature_names::{named, Features, BOX_FEATURES, PART_FEATURES};
use super::trees::{Forest, Tree};
use crate::error::{InputError, Result};

/// Learned weights, and trees, of what a fitted box, and each of its panels, is judged by (eq. 90).
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Judgement {
    #[serde(rename = "box")]
    of_box: Odds,
    /// Of boxes that lie on a side: shelves, stools and what leans on a wall look like them from more places.
    #[serde(rename = "lying")]
    of_lying: Odds,
    #[serde(rename = "part")]
    of_part: Odds,
}

/// Log odds of named features: their weighted sum, and what trees of the same features add.
#[derive(Debug, Clone, PartialEq, Deserialize)]
struct Odds {
    weights: BTreeMap<String, f64>,
    /// As they are written, until the forest is made of them.
    trees: Vec<Tree>,
    #[serde(skip)]
    forest: Forest,
    /// The features' names, in the order of the forest's numbers.
    #[serde(skip)]
    known: &'static [&'static str],
    /// The least probability of what is told.
    told_from: f64,
    /// Where more is asked.
    #[serde(default)]
    doubts: Vec<Doubt>,
}

/// From which probability on boxes are told of which a feature is less, or more, than a bound.
#[derive(Debug, Clone, PartialEq, Deserialize)]
struct Doubt {
    feature: String,
    #[serde(default)]
    below: Option<f64>,
    #[serde(default)]
    above: Option<f64>,
    told_from: f64,
}

/// The term that is the sum of all trees.
const TREES: &str = "trees";

impl Judgement {
    /// From the text of a judgement file.
    ///
    /// # Errors
    /// Names what is missing, what is not known, and what is no number or tree.
    pub fn from_json(text: &str) -> Result<Self> {
        let mut read: Self =
            serde_json::from_str(text).map_err(|e| InputError::new(e.to_string()).in_source("judgement"))?;
        for (table, odds, known) in [
            ("box", &mut read.of_box, &BOX_FEATURES[..]),
            ("lying", &mut read.of_lying, &BOX_FEATURES[..]),
            ("part", &mut read.of_part, &PART_FEATURES[..]),
        ] {
            odds.bind(known).map_err(|wrong| {
                let mend = format!("it weighs {}", known.join(", "));
                InputError::new(format!("judgement.{table}: {wrong}")).mend(mend)
            })?;
        }
        Ok(read)
    }

    /// Each feature with its weight, the trees' sum with the weight 1, and the sum of all: the log of the odds that the box is one.
    pub fn of_box(&self, features: &Features) -> (f64, Vec<(&'static str, f64, f64)>) {
        let terms = self.of_box_that_is(features).terms(features);
        (terms.iter().map(|(_, value, weight)| value * weight).sum(), terms)
    }

    /// The probability that it is one (eq. 90).
    pub fn box_probability(&self, features: &Features) -> f64 {
        probability(self.of_box(features).0)
    }

    /// The least probability of a box with these features that is told.
    pub fn box_told_from(&self, features: &Features) -> f64 {
        let odds = self.of_box_that_is(features);
        let doubts = odds.doubts.iter().filter(|doubt| doubt.holds(features));
        doubts.map(|doubt| doubt.told_from).fold(odds.told_from, f64::max)
    }

    /// The same where nothing speaks for doubt.
    pub fn box_told_from_at_best(&self, features: &Features) -> f64 {
        self.of_box_that_is(features).told_from
    }

    fn of_box_that_is(&self, features: &Features) -> &Odds {
        if named(features, "lies") > 0.5 {
            &self.of_lying
        } else {
            &self.of_box
        }
    }

    /// The least probability of a panel that is told.
    pub fn part_told_from(&self) -> f64 {
        self.of_part.told_from
    }

    /// The probability that a panel's readings are that panel's.
    pub fn part_probability(&self, features: &Features) -> f64 {
        probability(self.of_part.terms(features).iter().map(|(_, value, weight)| value * weight).sum())
    }
}

impl Odds {
    /// To features of these names.
    ///
    /// # Errors
    /// What is wrong where the features have these names.
    fn bind(&mut self, known: &'static [&'static str]) -> std::result::Result<(), String> {
        if let Some(missing) = known.iter().find(|name| !self.weights.contains_key(**name)) {
            return Err(format!("has no weight of {missing}"));
        }
        let is_unknown = |name: &String| format!("{name} is not known");
        if let Some(unknown) = self.weights.keys().find(|name| !known.contains(&name.as_str())) {
            return Err(is_unknown(unknown));
        }
        self.forest = Forest::new(&std::mem::take(&mut self.trees), known).map_err(|name| is_unknown(&name))?;
        self.known = known;
        if let Some(wrong) = self.doubts.iter().find_map(|doubt| doubt.wrong(known)) {
            return Err(wrong);
        }
        let mut bounds = std::iter::once(self.told_from).chain(self.doubts.iter().map(|doubt| doubt.told_from));
        match bounds.find(|bound| !(0.0..=1.0).contains(bound)) {
            Some(bound) => Err(format!("told_from: {bound} is no probability")),
            None => Ok(()),
        }
    }

    fn terms(&self, features: &Features) -> Vec<(&'static str, f64, f64)> {
        let weighed = features.iter().map(|&(name, value)| (name, value, self.weights[name]));
        let is_at = |number: usize, name: &str| features.get(number).is_some_and(|(other, _)| *other == name);
        let value = |(number, name): (usize, &&str)| {
            if is_at(number, name) {
                features[number].1
            } else {
                named(features, name)
            }
        };
        let values: Vec<f64> = self.known.iter().enumerate().map(value).collect();
        weighed.chain([(TREES, self.forest.sum(&values), 1.0)]).collect()
    }
}

impl Doubt {
    fn holds(&self, features: &Features) -> bool {
        let value = named(features, &self.feature);
        self.below.is_some_and(|bound| value < bound) || self.above.is_some_and(|bound| value > bound)
    }

    /// What is wrong with it where the features have these names.
    fn wrong(&self, known: &[&str]) -> Option<String> {
        if !known.contains(&self.feature.as_str()) {
            return Some(format!("doubts: {} is not known", self.feature));
        }
        let is_bounded =
            self.below.or(self.above).is_some_and(f64::is_finite) && self.below.is_some() != self.above.is_some();
        (!is_bounded).then(|| format!("doubts: {} has not one of the bounds below and above", self.feature))
    }
}

/// Of log odds.
pub fn probability(log_odds: f64) -> f64 {
    1.0 / (1.0 + (-log_odds).exp())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Odds without trees whose weights are all nothing.
    fn odds(known: &[&str], doubts: &str) -> String {
        let weights: Vec<String> = known.iter().map(|name| format!("\"{name}\": 0.0")).collect();
        format!(r#"{{"weights": {{{}}}, "trees": [], "told_from": 0.3, "doubts": [{doubts}]}}"#, weights.join(", "))
    }

    #[test]
    fn more_is_asked_of_a_box_without_an_inside_and_of_one_that_lacks_a_side() {
        let doubts = r#"{"feature": "on_inner_faces", "below": 0.2, "told_from": 0.7},
            {"feature": "side_absent", "above": 0.9, "told_from": 0.8}"#;
        let (standing, lying) = (odds(&BOX_FEATURES, doubts), odds(&BOX_FEATURES, ""));
        let text = format!(r#"{{"box": {standing}, "lying": {lying}, "part": {}}}"#, odds(&PART_FEATURES, ""));
        let judgement = Judgement::from_json(&text).unwrap();
        for (inner, absent, lies, told_from) in [
            (1.0, 0.5, 0.0, 0.3),
            (0.1, 0.5, 0.0, 0.7),
            (1.0, 0.95, 0.0, 0.8),
            (0.1, 0.95, 0.0, 0.8),
            (0.2, 0.9, 0.0, 0.3),
            (0.1, 0.95, 1.0, 0.3),
        ] {
            let features = vec![("on_inner_faces", inner), ("side_absent", absent), ("lies", lies)];
            assert_eq!(judgement.box_told_from(&features), told_from, "{features:?}");
        }
    }
}
