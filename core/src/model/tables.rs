use super::{SegmentSet, Template};

/// For each part of a template, the member of the segment set that plays it, or none.
pub type Assignment = Vec<Option<usize>>;

/// All feature and relation values of a segment set under a template, measured once; every score is a sum over these.
#[derive(Debug, Clone)]
pub struct FeatureTables {
    pub segment_count: usize,
    /// `unary[f][s]`: value of feature `f` for segment `s`.
    pub unary: Vec<Vec<f64>>,
    /// `pair[r][a * segment_count + b]`: value of relation `r` for segments `a`, `b` as first and second part.
    pub pair: Vec<Vec<f64>>,
}

impl FeatureTables {
    pub fn new(template: &Template, set: &SegmentSet) -> Self {
        let n = set.len();
        let unary = template.features.iter().map(|term| (0..n).map(|s| term.feature.value(set, s)).collect());
        let pair = template.relations.iter().map(|term| {
            let pairs = (0..n).flat_map(|a| (0..n).map(move |b| (a, b)));
            pairs.map(|(a, b)| if a == b { 0.0 } else { term.relation.value(set, a, b) }).collect()
        });
        Self { segment_count: n, unary: unary.collect(), pair: pair.collect() }
    }

    /// The tables of the segments `kept` alone, in that order.
    pub fn only(&self, kept: &[usize]) -> Self {
        let n = self.segment_count;
        let pairs = |table: &Vec<f64>| kept.iter().flat_map(|&a| kept.iter().map(move |&b| table[a * n + b])).collect();
        Self {
            segment_count: kept.len(),
            unary: self.unary.iter().map(|values| kept.iter().map(|&s| values[s]).collect()).collect(),
            pair: self.pair.iter().map(pairs).collect(),
        }
    }

    /// The feature vector f(G) of eq. 1, in the order of `Template::term_names`; J(G) = w . f(G).
    pub fn feature_vector(&self, template: &Template, assignment: &[Option<usize>]) -> Vec<f64> {
        let unary = template
            .features
            .iter()
            .zip(&self.unary)
            .map(|(term, values)| term.parts.iter().filter_map(|&p| assignment[p]).map(|s| values[s]).sum::<f64>());
        let pair = template.relations.iter().zip(&self.pair).map(|(term, values)| {
            let filled = term.pairs.iter().filter_map(|&(p, q)| Some((assignment[p]?, assignment[q]?)));
            filled.map(|(a, b)| values[a * self.segment_count + b]).sum::<f64>()
        });
        unary.chain(pair).collect()
    }
}
