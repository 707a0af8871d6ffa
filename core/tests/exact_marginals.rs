//! Probabilities against a sum over all assignments, over random tables.

mod common;

use boxwright_core::inference::{marginals, solve, ExactSettings, Marginals, Rules};
use boxwright_core::model::{Assignment, FeatureTables, Relation, Template, Weights};
use common::{unit_weights, Random};

const CARTON: &str = include_str!("../../src/boxwright/models/templates/carton.toml");

fn random_tables(template: &Template, random: &mut Random, n: usize) -> FeatureTables {
    let unary = template.features.iter().map(|_| (0..n).map(|_| random.between(-1.0, 1.0)).collect()).collect();
    let mut pair = Vec::new();
    for term in &template.relations {
        let mut values: Vec<f64> = (0..n * n).map(|_| random.between(-1.0, 1.0)).collect();
        if !matches!(term.relation, Relation::Location(_)) {
            (0..n).for_each(|a| (0..a).for_each(|b| values[a * n + b] = values[b * n + a]));
        }
        pair.push(values);
    }
    FeatureTables { segment_count: n, unary, pair }
}

fn weights_of_one(template: &Template) -> Weights {
    Weights::from_json(&unit_weights(template, 0.0), template).unwrap()
}

fn best_of(template: &Template, weights: &Weights, tables: &FeatureTables) -> Assignment {
    let rules = Rules { most: 1, floor: f64::NEG_INFINITY, accept: None };
    let free = vec![false; tables.segment_count];
    let solution = solve(template, weights, tables, &free, rules, &ExactSettings::default()).unwrap();
    solution.candidates[0].assignment.clone()
}

/// The reference's probability and the marginals, by visiting every assignment.
fn by_enumeration(
    template: &Template,
    weights: &Weights,
    tables: &FeatureTables,
    temperature: f64,
) -> (f64, Vec<Vec<f64>>) {
    let best = best_of(template, weights, tables);
    let mut parts = vec![vec![0.0; tables.segment_count + 1]; best.len()];
    let (mut total, mut of_best) = (0.0, 0.0);
    let mut assignment = vec![None; best.len()];
    visit(0, tables.segment_count, &mut assignment, &mut |a| {
        let weight = (weights.score(&tables.feature_vector(template, a)) / temperature).exp();
        let copies = template.symmetries.iter().map(|map| {
            let mut copy = vec![None; a.len()];
            a.iter().zip(map).for_each(|(s, &to)| copy[to] = *s);
            let agreement = copy.iter().zip(&best).filter(|(s, t)| s.is_some() && s == t).count();
            (agreement, copy)
        });
        let (_, turned) = copies.max().unwrap();
        total += weight;
        of_best += if turned == best { weight } else { 0.0 };
        turned.iter().zip(&mut parts).for_each(|(s, row)| row[s.map_or(0, |s| s + 1)] += weight);
    });
    parts.iter_mut().flatten().for_each(|mass| *mass /= total);
    (of_best / total, parts)
}

fn visit(part: usize, n: usize, assignment: &mut Assignment, each: &mut impl FnMut(&Assignment)) {
    if part == assignment.len() {
        return each(assignment);
    }
    for choice in std::iter::once(None).chain((0..n).map(Some)) {
        if choice.is_none() || !assignment[..part].contains(&choice) {
            assignment[part] = choice;
            visit(part + 1, n, assignment, each);
        }
    }
    assignment[part] = None;
}

fn summed(
    template: &Template,
    weights: &Weights,
    tables: &FeatureTables,
    temperature: f64,
    tolerance: f64,
) -> Marginals {
    let settings = ExactSettings { sum_tolerance: tolerance, max_sum_nodes: 10_000_000, ..ExactSettings::default() };
    let best = best_of(template, weights, tables);
    marginals(template, weights, tables, &vec![false; tables.segment_count], &best, temperature, &settings).unwrap()
}

/// The farthest that any probability is off.
fn farthest(found: &Marginals, probability: f64, parts: &[Vec<f64>]) -> f64 {
    let pairs = found.parts.iter().flatten().zip(parts.iter().flatten());
    pairs.map(|(a, b)| (a - b).abs()).fold((found.probability - probability).abs(), f64::max)
}

#[test]
fn sums_that_leave_nothing_out_equal_the_enumeration() {
    let template = Template::from_toml(CARTON).unwrap();
    let weights = weights_of_one(&template);
    let mut random = Random::new(31);
    let mut cases = 0;
    for k in 0..120 {
        let tables = random_tables(&template, &mut random, k % 5);
        let temperature = [0.05, 0.3, 1.0, 10.0][k / 5 % 4];
        let (probability, parts) = by_enumeration(&template, &weights, &tables, temperature);
        let found = summed(&template, &weights, &tables, temperature, 0.0);
        assert!(found.unseen == 0.0 && farthest(&found, probability, &parts) < 1e-9);
        assert!(found.parts.iter().all(|row| (row.iter().sum::<f64>() - 1.0).abs() < 1e-9));
        cases += 1;
    }
    assert_eq!(cases, 120);
}

#[test]
fn what_is_left_out_is_bounded() {
    let template = Template::from_toml(CARTON).unwrap();
    let weights = weights_of_one(&template);
    let mut random = Random::new(32);
    let (mut cases, mut left_out) = (0, 0);
    for k in 0..60 {
        let tables = random_tables(&template, &mut random, 4);
        let temperature = [0.1, 0.3, 1.0][k % 3];
        let (probability, parts) = by_enumeration(&template, &weights, &tables, temperature);
        let found = summed(&template, &weights, &tables, temperature, 0.05);
        assert!(found.unseen <= 0.05);
        assert!(farthest(&found, probability, &parts) <= found.unseen + 1e-9);
        left_out += usize::from(found.unseen > 1e-6);
        cases += 1;
    }
    assert_eq!(cases, 60);
    assert!(left_out > 20, "sums that leave nothing out do not test their bound: {left_out}");
}

#[test]
fn a_probability_alone_is_as_far_off_as_it_says() {
    let template = Template::from_toml(CARTON).unwrap();
    let weights = weights_of_one(&template);
    let mut random = Random::new(34);
    let (mut cases, mut uncertain) = (0, 0);
    for k in 0..60 {
        let tables = random_tables(&template, &mut random, 4);
        let temperature = [0.1, 0.3, 1.0][k % 3];
        let (probability, _) = by_enumeration(&template, &weights, &tables, temperature);
        let best = best_of(&template, &weights, &tables);
        let settings = ExactSettings { max_sum_nodes: [5, 50, 5000][k / 3 % 3], ..ExactSettings::default() };
        let told = marginals(&template, &weights, &tables, &[false; 4], &best, temperature, &settings).unwrap();
        let (value, error) = (told.probability, told.probability_error);
        assert!((value - probability).abs() <= error + 1e-9, "{value} within {error} against {probability}");
        uncertain += usize::from(error > settings.sum_tolerance);
        cases += 1;
    }
    assert_eq!(cases, 60);
    assert!((5..50).contains(&uncertain), "{uncertain}");
}

#[test]
fn spent_nodes_are_told() {
    let template = Template::from_toml(CARTON).unwrap();
    let weights = weights_of_one(&template);
    let tables = random_tables(&template, &mut Random::new(33), 30);
    let best = best_of(&template, &weights, &tables);
    let settings = ExactSettings { max_sum_nodes: 2000, ..ExactSettings::default() };
    let found = marginals(&template, &weights, &tables, &[false; 30], &best, 1.0, &settings).unwrap();
    assert!(found.unseen > 0.5 && found.unseen <= 1.0 && found.nodes < 100_000);
    let refused = marginals(&template, &weights, &tables, &[false; 30], &best, 0.0, &settings).unwrap_err();
    assert!(refused.to_string().contains("temperature: is 0"), "{refused}");
}
