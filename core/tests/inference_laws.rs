//! The staged search against the oracle that tries every assignment, over random problems.

mod common;

use boxwright_core::inference::{best_exhaustive, rank_staged, SearchPlan, StagedSettings};
use boxwright_core::model::{FeatureTables, SegmentSet, Template, Weights};
use common::{rectangle, scene, unit_weights, Random};

const CARTON: &str = include_str!("../../src/boxwright/models/templates/carton.toml");
/// A ring of three with a leaf and a leaf on the leaf: small enough to try all assignments of many problems.
const SMALL: &str = r#"
format = "boxwright.template"
version = 1
name = "small"
part = [{ name = "a", class = "x" }, { name = "b", class = "x" }, { name = "c", class = "x" }, { name = "leaf", class = "y" },
        { name = "leaf_on_leaf", class = "y" }]
[[feature]]
name = "level"
kind = "orientation"
parts = ["a", "b", "c"]
direction = "up"
angle_deg = 40
tolerance_deg = 30
[[feature]]
name = "leaf_near"
kind = "location"
parts = ["leaf", "leaf_on_leaf"]
reference = "group_center"
tolerance_m = 0.3
[[relation]]
name = "square"
kind = "orientation"
pairs = [["a", "b"], ["b", "c"]]
angle_deg = 90
tolerance_deg = 40
[[relation]]
name = "high"
kind = "location"
pairs = [["a", "c"]]
direction = "up"
tolerance_deg = 90
[[relation]]
name = "meets"
kind = "connectivity"
pairs = [["a", "leaf"], ["leaf", "leaf_on_leaf"]]
tolerance_m = 0.3
[accept]
min_parts = 1
"#;

fn random_tables(template: &Template, random: &mut Random, segments: usize) -> FeatureTables {
    let rectangles =
        (0..segments).map(|_| rectangle(random.vector(0.3), random.vector(0.2), random.vector(0.2))).collect();
    let scene = scene(rectangles);
    FeatureTables::new(template, &SegmentSet::new(&scene, &(0..segments).collect::<Vec<_>>()))
}

fn random_weights(template: &Template, random: &mut Random) -> Weights {
    let mut weights = Weights::from_json(&unit_weights(template, 0.0), template).unwrap();
    for (value, importance) in weights.values.iter_mut().zip(&mut weights.importance) {
        *value = random.between(-0.3, 1.0);
        *importance = random.unit();
    }
    weights
}

#[test]
fn with_every_relation_the_staged_search_is_exact() {
    let template = Template::from_toml(SMALL).unwrap();
    let settings = StagedSettings { max_exponent: 9, keep_fraction: 1.0, max_candidates: usize::MAX };
    let mut random = Random::new(1);
    let mut cases = 0;
    for _ in 0..400 {
        let segments = 1 + (random.unit() * 6.0) as usize;
        let tables = random_tables(&template, &mut random, segments);
        let weights = random_weights(&template, &mut random);
        let plan = SearchPlan::within(&template, &weights, settings.max_exponent).unwrap();
        let ranking = rank_staged(&template, &weights, &tables, &plan, &vec![false; segments], 5, &settings);
        let (oracle, _) = best_exhaustive(&template, &weights, &tables);
        let best = &ranking.candidates[0];
        assert!((best.score - oracle.score).abs() < 1e-9, "{} against {}", best.score, oracle.score);
        assert_eq!(ranking.gap, 0.0);
        cases += 1;
    }
    assert_eq!(cases, 400);
}

#[test]
fn the_carton_too() {
    let template = Template::from_toml(CARTON).unwrap();
    let settings = StagedSettings { max_exponent: 9, keep_fraction: 1.0, max_candidates: usize::MAX };
    let mut random = Random::new(2);
    let mut cases = 0;
    for _ in 0..40 {
        let tables = random_tables(&template, &mut random, 4);
        let weights = random_weights(&template, &mut random);
        let plan = SearchPlan::within(&template, &weights, settings.max_exponent).unwrap();
        let ranking = rank_staged(&template, &weights, &tables, &plan, &[false; 4], 5, &settings);
        let (oracle, _) = best_exhaustive(&template, &weights, &tables);
        assert!((ranking.candidates[0].score - oracle.score).abs() < 1e-9);
        cases += 1;
    }
    assert_eq!(cases, 40);
}

#[test]
fn the_gap_bounds_what_was_missed() {
    let template = Template::from_toml(SMALL).unwrap();
    let settings = StagedSettings { max_exponent: 2, keep_fraction: 0.1, max_candidates: usize::MAX };
    let mut random = Random::new(3);
    let (mut cases, mut missed) = (0, 0);
    for _ in 0..400 {
        let tables = random_tables(&template, &mut random, 5);
        let weights = random_weights(&template, &mut random);
        let plan = SearchPlan::within(&template, &weights, settings.max_exponent).unwrap();
        assert!(plan.exponent() <= 2);
        let ranking = rank_staged(&template, &weights, &tables, &plan, &[false; 5], 5, &settings);
        let (oracle, _) = best_exhaustive(&template, &weights, &tables);
        let best = ranking.candidates[0].score;
        assert!(best <= oracle.score + 1e-9);
        assert!(best + ranking.gap >= oracle.score - 1e-9, "{best} + {} < {}", ranking.gap, oracle.score);
        missed += usize::from(best < oracle.score - 1e-9);
        cases += 1;
    }
    assert_eq!(cases, 400);
    assert!(missed > 0, "a search that never misses does not test its gap");
}

#[test]
fn the_least_important_relations_are_dropped_first() {
    let template = Template::from_toml(CARTON).unwrap();
    let mut weights = Weights::from_json(&unit_weights(&template, 0.0), &template).unwrap();
    assert_eq!(SearchPlan::within(&template, &weights, 9).unwrap().exponent(), 5, "the paper's n^5");
    let names: Vec<String> = template.term_names().map(str::to_owned).collect();
    let unimportant = ["flap_square_to_neighbours", "opposite_sides_rectangular", "opposite_sides_parallel"];
    for (name, importance) in names.iter().zip(&mut weights.importance) {
        *importance = if unimportant.contains(&name.as_str()) { 0.1 } else { 1.0 };
    }
    let plan = SearchPlan::within(&template, &weights, 4).unwrap();
    assert_eq!(plan.exponent(), 4);
    let dropped = (0..template.relations.len()).filter(|&r| !plan.uses_relation[r]);
    let dropped_names: Vec<&str> = dropped.map(|r| template.relations[r].name.as_str()).collect();
    assert_eq!(dropped_names, unimportant);
}

#[test]
fn taken_segments_stay_out() {
    let template = Template::from_toml(CARTON).unwrap();
    let settings = StagedSettings::default();
    let mut random = Random::new(4);
    for _ in 0..20 {
        let tables = random_tables(&template, &mut random, 7);
        let weights = random_weights(&template, &mut random);
        let plan = SearchPlan::within(&template, &weights, settings.max_exponent).unwrap();
        let taken: Vec<bool> = (0..7).map(|s| s % 2 == 0).collect();
        let ranking = rank_staged(&template, &weights, &tables, &plan, &taken, 5, &settings);
        assert!(!ranking.candidates.is_empty());
        for candidate in &ranking.candidates {
            let mut used: Vec<usize> = candidate.assignment.iter().flatten().copied().collect();
            assert!(used.iter().all(|&s| !taken[s]));
            let count = used.len();
            used.sort_unstable();
            used.dedup();
            assert_eq!(used.len(), count, "a segment is used twice");
        }
    }
}
