//! The exact search against an enumeration of all assignments, over random tables.

mod common;

use boxwright_core::inference::{solve, ExactSettings, Rules, Solution};
use boxwright_core::model::{Accept, FeatureTables, Relation, Template, Weights};
use common::{unit_weights, Random};

const CARTON: &str = include_str!("../../src/boxwright/models/templates/carton.toml");
const CAKE_BOX: &str = include_str!("../../src/boxwright/models/templates/cake_box.toml");
/// Parts of which no relation touches one (`alone`), two mirror each other, and one relation has a direction.
const SMALL: &str = r#"
format = "boxwright.template"
version = 1
name = "small"
part = [{ name = "root", class = "x" }, { name = "left", class = "y" }, { name = "right", class = "y" },
        { name = "alone", class = "z" }]
[[symmetry]]
name = "mirror"
[symmetry.map]
left = "right"
right = "left"
[[feature]]
name = "exists"
kind = "existence"
parts = ["root", "alone"]
[[feature]]
name = "near"
kind = "location"
parts = ["left", "right"]
reference = "group_center"
tolerance_m = 0.3
[[relation]]
name = "high"
kind = "location"
pairs = [["left", "root"], ["right", "root"]]
direction = "up"
tolerance_deg = 90
[[relation]]
name = "square"
kind = "orientation"
pairs = [["left", "right"]]
angle_deg = 90
tolerance_deg = 40
[accept]
min_parts = 2
require = [{ parts = ["left", "right"], at_least = 1 }]
"#;

/// What the random values of a problem look like.
#[derive(Clone, Copy, Debug)]
enum Kind {
    Even,
    /// Few values, so that many assignments score the same.
    Ties,
    /// Nothing is worth more than an empty part.
    Negative,
    /// Relations outweigh features, and most are bad.
    BadRelations,
}

const KINDS: [Kind; 4] = [Kind::Even, Kind::Ties, Kind::Negative, Kind::BadRelations];

fn random_tables(template: &Template, random: &mut Random, n: usize, kind: Kind) -> FeatureTables {
    let mut value = |is_relation: bool| match kind {
        Kind::Even => random.between(-1.0, 1.0),
        Kind::Ties => random.between(-2.0, 3.0).floor() * 0.1,
        Kind::Negative => random.between(-1.0, 0.0),
        Kind::BadRelations if is_relation => random.between(-5.0, 1.0),
        Kind::BadRelations => random.between(0.0, 1.0),
    };
    let unary = template.features.iter().map(|_| (0..n).map(|_| value(false)).collect()).collect();
    let mut pair: Vec<Vec<f64>> =
        template.relations.iter().map(|_| (0..n * n).map(|_| value(true)).collect()).collect();
    for (term, values) in template.relations.iter().zip(&mut pair) {
        for a in 0..n {
            for b in 0..=a {
                if a == b {
                    values[a * n + b] = 0.0;
                } else if !matches!(term.relation, Relation::Location(_)) {
                    values[a * n + b] = values[b * n + a];
                }
            }
        }
    }
    FeatureTables { segment_count: n, unary, pair }
}

fn weights_of_one(template: &Template) -> Weights {
    Weights::from_json(&unit_weights(template, 0.0), template).unwrap()
}

/// Scores of the best assignments of all, one of each class, by visiting every one; term by term, without tables of ours.
fn best_scores(
    template: &Template,
    tables: &FeatureTables,
    weights: &Weights,
    most: usize,
    accept: Option<&Accept>,
) -> Vec<f64> {
    let mut classes = std::collections::BTreeMap::new();
    let mut assignment = vec![None; template.parts.len()];
    visit(0, tables.segment_count, &mut assignment, &mut |a| {
        let copies = template.symmetries.iter().map(|map| {
            let mut copy = vec![None; a.len()];
            a.iter().zip(map).for_each(|(s, &to)| copy[to] = *s);
            copy
        });
        if accept.is_none_or(|accept| accept.allows(a)) && copies.into_iter().all(|copy| copy.as_slice() >= a) {
            classes.insert(a.to_vec(), weights.score(&tables.feature_vector(template, a)));
        }
    });
    let mut scores: Vec<f64> = classes.into_values().collect();
    scores.sort_by(|a, b| b.total_cmp(a));
    scores.truncate(most);
    scores
}

fn visit(part: usize, n: usize, assignment: &mut Vec<Option<usize>>, each: &mut impl FnMut(&[Option<usize>])) {
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

fn rules(most: usize) -> Rules<'static> {
    Rules { most, floor: f64::NEG_INFINITY, accept: None }
}

fn solved(template: &Template, tables: &FeatureTables, weights: &Weights, rules: Rules) -> Solution {
    let free = vec![false; tables.segment_count];
    solve(template, weights, tables, &free, rules, &ExactSettings::default()).unwrap()
}

/// Holds a list against the enumeration's: equal scores, each as its assignment's terms sum up, no assignment twice.
fn assert_best(solution: &Solution, expected: &[f64], template: &Template, tables: &FeatureTables, weights: &Weights) {
    assert!(solution.is_optimal && solution.gap == 0.0);
    assert_eq!(solution.candidates.len(), expected.len());
    for (candidate, score) in solution.candidates.iter().zip(expected) {
        let summed = weights.score(&tables.feature_vector(template, &candidate.assignment));
        assert!((candidate.score - score).abs() < 1e-9, "{} against {score}", candidate.score);
        assert!((candidate.score - summed).abs() < 1e-9);
        let mut used: Vec<_> = candidate.assignment.iter().flatten().collect();
        used.sort_unstable();
        assert!(used.windows(2).all(|w| w[0] != w[1]), "a segment is used twice");
    }
}

#[test]
fn small_problems_are_solved_like_an_enumeration_solves_them() {
    let template = Template::from_toml(SMALL).unwrap();
    let weights = weights_of_one(&template);
    let mut random = Random::new(11);
    let mut cases = 0;
    for k in 0..4000 {
        let n = k % 9;
        let tables = random_tables(&template, &mut random, n, KINDS[k / 9 % 4]);
        let most = [1, 3, 100][k / 36 % 3];
        let accept = (k % 5 == 0).then_some(&template.accept);
        let expected = best_scores(&template, &tables, &weights, most, accept);
        let solution = solved(&template, &tables, &weights, Rules { accept, ..rules(most) });
        assert_best(&solution, &expected, &template, &tables, &weights);
        cases += 1;
    }
    assert_eq!(cases, 4000);
}

#[test]
fn cartons_and_cake_boxes_too() {
    let mut random = Random::new(12);
    let mut cases = 0;
    for (text, sizes, count) in [(CARTON, 5, 300), (CAKE_BOX, 3, 100)] {
        let template = Template::from_toml(text).unwrap();
        let weights = weights_of_one(&template);
        for k in 0..count {
            let tables = random_tables(&template, &mut random, k % sizes, KINDS[k / sizes % 4]);
            let most = [1, 10, 100][k % 3];
            let expected = best_scores(&template, &tables, &weights, most, None);
            assert_best(&solved(&template, &tables, &weights, rules(most)), &expected, &template, &tables, &weights);
            cases += 1;
        }
    }
    assert_eq!(cases, 400);
}

/// The best score of all assignments, by visiting every one with a running sum; tables made here.
fn best_score_of_all(template: &Template, tables: &FeatureTables) -> f64 {
    let (n, parts) = (tables.segment_count, template.parts.len());
    let mut own = vec![vec![0.0; n]; parts];
    for (term, values) in template.features.iter().zip(&tables.unary) {
        term.parts.iter().for_each(|&p| own[p].iter_mut().zip(values).for_each(|(sum, v)| *sum += v));
    }
    let mut tied = vec![vec![Vec::new(); parts]; parts];
    for (term, values) in template.relations.iter().zip(&tables.pair) {
        term.pairs.iter().for_each(|&(p, q)| match p > q {
            true => tied[p][q].push((values, true)),
            false => tied[q][p].push((values, false)),
        });
    }
    let gain = |p: usize, s: usize, chosen: &[Option<usize>]| {
        let with = |(q, t): (usize, &Option<usize>)| match t {
            Some(t) => {
                tied[p][q].iter().map(|(v, first)| if *first { v[s * n + t] } else { v[t * n + s] }).sum::<f64>()
            }
            None => 0.0,
        };
        own[p][s] + chosen.iter().enumerate().map(with).sum::<f64>()
    };
    fn deepen(
        parts: usize,
        n: usize,
        score: f64,
        chosen: &mut Vec<Option<usize>>,
        gain: &impl Fn(usize, usize, &[Option<usize>]) -> f64,
    ) -> f64 {
        if chosen.len() == parts {
            return score;
        }
        chosen.push(None);
        let mut best = deepen(parts, n, score, chosen, gain);
        chosen.pop();
        for s in (0..n).filter(|&s| !chosen.contains(&Some(s))).collect::<Vec<_>>() {
            let more = gain(chosen.len(), s, chosen);
            chosen.push(Some(s));
            best = best.max(deepen(parts, n, score + more, chosen, gain));
            chosen.pop();
        }
        best
    }
    deepen(parts, n, 0.0, &mut Vec::new(), &gain)
}

/// A template of so many parts that no symmetry ties, each two of them tied by a relation as often as not.
fn drawn_template(parts: usize, random: &mut Random) -> Template {
    let names: Vec<String> = (0..parts).map(|p| format!("{{ name = \"p{p}\", class = \"x\" }}")).collect();
    let head = "format = \"boxwright.template\"\nversion = 1\nname = \"drawn\"\n";
    let mut text = format!("{head}part = [{}]\n", names.join(", "));
    for p in 0..parts {
        text += &format!("[[feature]]\nname = \"f{p}\"\nkind = \"existence\"\nparts = [\"p{p}\"]\n");
    }
    for q in 1..parts {
        for p in (0..q).filter(|_| random.between(0.0, 1.0) < 0.5).collect::<Vec<_>>() {
            let kind = match (p + q) % 2 {
                0 => "kind = \"connectivity\"\ntolerance_m = 0.1",
                _ => "kind = \"location\"\ndirection = \"up\"\ntolerance_deg = 90",
            };
            text += &format!("[[relation]]\nname = \"r{p}_{q}\"\n{kind}\npairs = [[\"p{p}\", \"p{q}\"]]\n");
        }
    }
    text += "[accept]\nmin_parts = 1\n";
    Template::from_toml(&text).unwrap()
}

/// How many assignments of `n` segments to `parts` parts there are.
fn assignment_count(n: usize, parts: usize) -> u64 {
    let choose = |a: usize, k: usize| (0..k).fold(1, |c, i| c * (a - i) as u64 / (i + 1) as u64);
    let orders = |k: usize| (1..=k as u64).product::<u64>();
    (0..=n.min(parts)).map(|k| choose(n, k) * choose(parts, k) * orders(k)).sum()
}

#[test]
fn any_template_of_up_to_nine_parts_with_up_to_eight_segments_too() {
    let mut random = Random::new(20);
    let mut cases = 0;
    for parts in 1..=9 {
        for n in 0..=8 {
            // Fewer where each takes millions.
            let count = (1_500_000 / assignment_count(n, parts)).clamp(1, 40) as usize;
            for k in 0..count {
                let template = drawn_template(parts, &mut random);
                let weights = weights_of_one(&template);
                let tables = random_tables(&template, &mut random, n, KINDS[k % 4]);
                let expected = best_score_of_all(&template, &tables);
                assert_best(&solved(&template, &tables, &weights, rules(1)), &[expected], &template, &tables, &weights);
                cases += 1;
            }
        }
    }
    assert_eq!(cases, 2937);
}

#[test]
fn cartons_of_eight_segments_too() {
    let template = Template::from_toml(CARTON).unwrap();
    let weights = weights_of_one(&template);
    let mut random = Random::new(19);
    let mut cases = 0;
    for k in 0..44 {
        let n = if k < 4 { 8 } else { 6 };
        let tables = random_tables(&template, &mut random, n, KINDS[k % 4]);
        let expected = best_score_of_all(&template, &tables);
        assert_best(&solved(&template, &tables, &weights, rules(1)), &[expected], &template, &tables, &weights);
        cases += 1;
    }
    assert_eq!(cases, 44);
}

#[test]
fn all_negative_is_empty() {
    let template = Template::from_toml(CARTON).unwrap();
    let weights = weights_of_one(&template);
    let mut random = Random::new(13);
    for n in 0..20 {
        let tables = random_tables(&template, &mut random, n, Kind::Negative);
        let best = &solved(&template, &tables, &weights, rules(1)).candidates[0];
        assert!(best.score == 0.0 && best.assignment.iter().all(Option::is_none));
    }
}

#[test]
fn what_scores_below_the_floor_is_not_listed() {
    let template = Template::from_toml(SMALL).unwrap();
    let weights = weights_of_one(&template);
    let mut random = Random::new(14);
    let mut cases = 0;
    for _ in 0..300 {
        let tables = random_tables(&template, &mut random, 5, Kind::Ties);
        let all = best_scores(&template, &tables, &weights, usize::MAX, None);
        let floor = all[all.len() / 20];
        let expected = all.iter().filter(|&&score| score >= floor - 1e-12).count();
        let listed = solved(&template, &tables, &weights, Rules { floor: floor - 1e-10, ..rules(10_000) });
        assert_eq!(listed.candidates.len(), expected);
        cases += 1;
    }
    assert_eq!(cases, 300);
}

#[test]
fn an_ended_search_bounds_what_it_missed() {
    let template = Template::from_toml(CARTON).unwrap();
    let weights = weights_of_one(&template);
    let mut random = Random::new(15);
    let (mut ended, mut missed) = (0, 0);
    for _ in 0..100 {
        let tables = random_tables(&template, &mut random, 10, Kind::Even);
        let best = solved(&template, &tables, &weights, rules(1)).candidates[0].score;
        let settings = ExactSettings { max_nodes: 10, ..ExactSettings::default() };
        let cut = solve(&template, &weights, &tables, &[false; 10], rules(1), &settings).unwrap();
        let first = cut.candidates[0].score;
        assert!(first <= best + 1e-9 && first + cut.gap >= best - 1e-9);
        assert_eq!(cut.is_optimal, cut.gap == 0.0);
        assert!(cut.nodes <= 11);
        ended += usize::from(!cut.is_optimal);
        missed += usize::from(first < best - 1e-9);
    }
    assert!(ended > 50 && missed > 10, "{ended} ended, {missed} missed");
}

#[test]
fn five_hundred_segments_end_within_the_budget_and_say_so() {
    let template = Template::from_toml(CARTON).unwrap();
    let weights = weights_of_one(&template);
    let tables = random_tables(&template, &mut Random::new(16), 500, Kind::Even);
    let settings = ExactSettings { max_nodes: 1000, max_sweeps: 2, ..ExactSettings::default() };
    let solution = solve(&template, &weights, &tables, &[false; 500], rules(1), &settings).unwrap();
    assert!(!solution.is_optimal && solution.gap > 0.0 && solution.gap.is_finite());
    assert!(solution.candidates[0].score > 0.0 && solution.nodes <= 1001);
}

#[test]
fn values_that_are_no_numbers_are_refused_by_name() {
    let template = Template::from_toml(SMALL).unwrap();
    let weights = weights_of_one(&template);
    let good = random_tables(&template, &mut Random::new(17), 3, Kind::Even);
    let refused = |tables: &FeatureTables, weights: &Weights| {
        solve(&template, weights, tables, &[false; 3], rules(1), &ExactSettings::default()).unwrap_err().to_string()
    };
    let mut tables = good.clone();
    tables.unary[1][2] = f64::NAN;
    assert!(refused(&tables, &weights).contains("near: is NaN for segment 2"), "{}", refused(&tables, &weights));
    let mut tables = good.clone();
    tables.pair[0][3] = f64::INFINITY;
    assert!(refused(&tables, &weights).contains("high: is inf for segments 1 and 0"));
    let bad = Weights { values: vec![1.0, 1.0, f64::NAN, 1.0], ..weights.clone() };
    assert!(refused(&good, &bad).contains("high: has weight NaN"));
}

#[test]
fn taken_segments_stay_out_and_equal_input_gives_equal_answers() {
    let template = Template::from_toml(CAKE_BOX).unwrap();
    let weights = weights_of_one(&template);
    let mut random = Random::new(18);
    for _ in 0..20 {
        let tables = random_tables(&template, &mut random, 9, Kind::Ties);
        let taken: Vec<bool> = (0..9).map(|s| s % 2 == 0).collect();
        let run = || solve(&template, &weights, &tables, &taken, rules(20), &ExactSettings::default()).unwrap();
        let solution = run();
        assert_eq!(solution.candidates.len(), 20);
        assert!(solution.candidates.iter().all(|c| c.assignment.iter().flatten().all(|&s| !taken[s])));
        assert_eq!(solution, run());
    }
}
