//! The assignments that a fitted box may start from: against the search for objects, and of a made-up carton.

mod common;

use boxwright_core::fit::FittedBody;
use boxwright_core::inference::{
    find_objects, likely_assignments, ExactSettings, ObjectModel, SearchMethod, SearchSettings, StagedSettings,
};
use boxwright_core::model::{FeatureTables, SegmentSet, Template, Weights};
use boxwright_core::open_box::Assignments;
use common::{carton_rectangles, rectangle, scene, unit_weights, Random};

const CARTON: &str = include_str!("../../src/boxwright/models/templates/exact/carton.toml");
const CARTON_WEIGHTS: &str = include_str!("../../src/boxwright/models/weights/exact/carton.json");
const TOTE: &str = include_str!("../../src/boxwright/models/templates/exact/tote.toml");
/// A pair, and a leaf on either.
const SMALL: &str = r#"
format = "boxwright.template"
version = 1
name = "small"
part = [{ name = "a", class = "x" }, { name = "b", class = "x" }, { name = "leaf", class = "y" }]
[[feature]]
name = "level"
kind = "orientation"
parts = ["a", "b"]
direction = "up"
angle_deg = 40
tolerance_deg = 30
[[feature]]
name = "leaf_near"
kind = "location"
parts = ["leaf"]
reference = "group_center"
tolerance_m = 0.3
[[relation]]
name = "square"
kind = "orientation"
pairs = [["a", "b"], ["b", "leaf"]]
angle_deg = 90
tolerance_deg = 40
[accept]
min_parts = 2
"#;

fn random_model(random: &mut Random) -> ObjectModel {
    let template = Template::from_toml(SMALL).unwrap();
    let mut weights = Weights::from_json(&unit_weights(&template, 0.0), &template).unwrap();
    weights.values.iter_mut().for_each(|value| *value = random.between(0.1, 1.0));
    weights.accept_score = random.between(0.2, 1.2);
    ObjectModel::new(template, weights, &StagedSettings::default())
}

#[test]
fn the_best_of_each_object_is_the_one_that_the_search_takes() {
    let mut random = Random::new(5);
    let settings = SearchSettings { search: SearchMethod::Exact, ..SearchSettings::default() };
    let (mut objects, mut followed, mut several) = (0, 0, 0);
    for _ in 0..200 {
        let models = [random_model(&mut random), random_model(&mut random)];
        let segments = 3 + (random.unit() * 6.0) as usize;
        let made = (0..segments).map(|_| rectangle(random.vector(0.3), random.vector(0.2), random.vector(0.2)));
        let set = SegmentSet::new(&scene(made.collect()), &(0..segments).collect::<Vec<_>>());
        let tables: Vec<FeatureTables> = models.iter().map(|m| FeatureTables::new(&m.template, &set)).collect();
        let found = find_objects(&models, &set, &settings).unwrap().objects;
        let by_model = [&models[0], &models[1]];
        let likely = |most| likely_assignments(&by_model, &tables, &ExactSettings::default(), most).unwrap();
        let taken: Vec<_> = found.into_iter().map(|one| (one.model, one.candidate)).collect();
        assert_eq!(likely(1), taken);
        let more = likely(4);
        // Those that the search takes come in their order, among others that are no better.
        let mut places = taken.iter().map(|one| more.iter().position(|other| other == one).unwrap());
        let mut last = places.next().unwrap_or(0);
        assert_eq!(last, 0);
        for place in places.by_ref() {
            assert!(place > last && place <= last + 4);
            last = place;
        }
        for (number, candidate) in &more {
            assert!(candidate.score >= models[*number].weights.accept_score);
        }
        objects += taken.len();
        followed += more.len();
        several += usize::from(taken.len() > 1);
    }
    assert!(objects > 250 && several > 60 && followed > 2 * objects, "{objects} {several} {followed}");
}

#[test]
fn an_assignment_gives_the_body_of_its_rectangles() {
    let mut cases = 0;
    for flap_angle_rad in [0.6, 1.2, 2.2, 3.0] {
        let scene = scene(carton_rectangles(flap_angle_rad));
        let template = Template::from_toml(CARTON).unwrap();
        let weights = Weights::from_json(CARTON_WEIGHTS, &template).unwrap();
        let model = ObjectModel::new(template, weights, &StagedSettings::default());
        let tote = Template::from_toml(TOTE).unwrap();
        let unweighted = Weights::from_json(&unit_weights(&tote, 0.0), &tote).unwrap();
        // A box without flaps is one whose flaps nobody sees, and proposes nothing of its own.
        let models = [ObjectModel::new(tote, unweighted, &StagedSettings::default()), model];
        let assignments = Assignments::new(&scene, 90, &models).unwrap();
        assert!((1..=3).contains(&assignments.bodies.len()), "{}", assignments.bodies.len());
        let FittedBody { input_from_object, numbers } = &assignments.bodies[0];
        // Length, width and height follow the six of the pose.
        for (number, expected_m) in numbers.iter().skip(6).zip([0.4, 0.3, 0.2]) {
            assert!((number - expected_m).abs() < 1e-6, "{numbers}");
        }
        assert!(input_from_object.translation.vector.norm() < 1e-6);
        cases += 1;
    }
    assert_eq!(cases, 4);
}
