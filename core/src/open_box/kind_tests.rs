use super::kind::Kinds;
use super::recast::recast;
use super::shape::{Shape, SHAPE_FEATURES};
use crate::model::Template;

const TEMPLATES: [&str; 4] = [
    include_str!("../../../src/boxwright/models/templates/exact/carton.toml"),
    include_str!("../../../src/boxwright/models/templates/exact/cake_box.toml"),
    include_str!("../../../src/boxwright/models/templates/exact/pizza_box.toml"),
    include_str!("../../../src/boxwright/models/templates/exact/tote.toml"),
];
const NAMES: [&str; 4] = ["carton", "cake_box", "pizza_box", "tote"];
const SHAPE: Shape = Shape {
    dimensions_m: [0.4, 0.3, 0.2],
    thickness_m: 0.004,
    flaps_m: [Some(0.15), None, Some(0.06), None],
    flaps_rad: [2.0, 9.0, 3.5, -9.0],
    has_tuck: [false, false, true, false],
};

fn weights(of: impl Fn(usize, usize) -> f64) -> String {
    let row = |t: usize| {
        let named = SHAPE_FEATURES.iter().enumerate().map(|(f, name)| format!("\"{name}\": {}", of(t, f)));
        format!("\"{}\": {{{}}}", NAMES[t], named.collect::<Vec<_>>().join(", "))
    };
    let rows: Vec<String> = (0..4).map(row).collect();
    format!("{{\"format\": \"boxwright.kinds\", \"version\": 1, \"weights\": {{{}}}}}", rows.join(", "))
}

/// Weights without a pattern.
fn any_weights() -> Kinds {
    Kinds::from_json(&weights(|t, f| f64::from(((7 * t + 3 * f + t * f) % 11) as u8) / 5.0 - 1.0)).unwrap()
}

#[test]
fn features_are_what_their_names_say() {
    let expected =
        [1.0, 0.0, (0.12_f64.sqrt() / 0.3).ln(), (4.0 / 3.0_f64).ln(), 4.0, 2.0, 0.0, 0.5, 0.2, 1.0, 3.5_f64.ln(), 1.5];
    let features = SHAPE.features();
    for (name, (value, wanted)) in SHAPE_FEATURES.iter().zip(features.iter().zip(expected)) {
        assert!((value - wanted).abs() < 1e-12, "{name}: {value}, not {wanted}");
    }
    let bare = Shape { flaps_m: [None; 4], has_tuck: [false; 4], ..SHAPE }.features();
    assert_eq!(bare[5..], [0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
}

#[test]
fn a_quarter_turn_is_the_same_box() {
    let [length, width, height] = SHAPE.dimensions_m;
    let mut turned = Shape { dimensions_m: [width, length, height], ..SHAPE };
    turned.flaps_m.rotate_left(1);
    turned.flaps_rad.rotate_left(1);
    turned.has_tuck.rotate_left(1);
    assert_eq!(turned.features(), SHAPE.features());
}

/// Whatever competes, the probabilities sum to one and keep their ratios.
#[test]
fn those_that_were_asked_for_share_one() {
    let kinds = any_weights();
    let all: Vec<f64> = kinds.probabilities(&SHAPE, &NAMES).into_iter().map(Option::unwrap).collect();
    let mut cases = 0;
    for subset in 1..16_usize {
        let asked: Vec<usize> = (0..4).filter(|t| subset >> t & 1 == 1).collect();
        let names: Vec<&str> = asked.iter().map(|&t| NAMES[t]).collect();
        let total: f64 = asked.iter().map(|&t| all[t]).sum();
        for (p, &t) in kinds.probabilities(&SHAPE, &names).iter().zip(&asked) {
            assert!((p.unwrap() - all[t] / total).abs() < 1e-12);
        }
        cases += 1;
    }
    assert_eq!(cases, 15);
    assert_eq!(kinds.probabilities(&SHAPE, &["table", "tote"]), [None, Some(1.0)]);
}

#[test]
fn the_most_probable_is_chosen_and_none_without_weights() {
    let templates = TEMPLATES.map(|text| Template::from_toml(text).unwrap());
    let templates: Vec<&Template> = templates.iter().collect();
    let kinds = any_weights();
    let (chosen, p) = kinds.choose(&SHAPE, &templates).unwrap();
    let all = kinds.probabilities(&SHAPE, &NAMES);
    assert_eq!(p, all[chosen]);
    assert!(all.iter().all(|other| *other <= p));
    assert_eq!(Kinds::default().choose(&SHAPE, &templates), Some((0, None)));
}

#[test]
fn what_does_not_fit_is_named() {
    let good = weights(|_, _| 0.5);
    let cases = [
        (good.replace("kinds\"", "weights\""), "format"),
        (good.replace("log_base", "colour"), "\"colour\" is no feature of a box's shape"),
        (good.replacen(", \"tuck_seen\": 0.5", "", 1), "\"tuck_seen\" is missing"),
    ];
    let mut refused = 0;
    for (text, said) in &cases {
        let error = Kinds::from_json(text).map(|_| ()).unwrap_err().to_string();
        refused += 1;
        assert!(error.contains(said), "{error}");
    }
    assert_eq!(refused, 3);
}

#[test]
fn a_tote_has_no_flaps_to_tell() {
    let [_, cake, _, tote] = TEMPLATES.map(|text| Template::from_toml(text).unwrap());
    let object = crate::body::ObjectAnswer {
        template: "cake_box".into(),
        template_probability: None,
        score: 1.0,
        probability: None,
        inference: crate::body::InferenceAnswer::new(0.0, 0, None),
        sums: None,
        score_terms: Vec::new(),
        dimensions: None,
        outer_dimensions: None,
        thickness: None,
        size: None,
        pose: None,
        parameters: ["length", "side_0_lean", "flap_0_length", "tuck_3_width"]
            .map(|name| (name.to_owned(), crate::body::ParameterAnswer { value: 0.1, sigma: None }))
            .into(),
        parts: cake.parts.iter().map(|part| crate::body::PartAnswer::unseen(&part.name)).collect(),
        joints: Vec::new(),
    };
    let (told, numbers) = recast(&object, &cake, &tote).unwrap();
    assert_eq!(told.template, "tote");
    assert_eq!(told.parameters.keys().collect::<Vec<_>>(), ["length", "side_0_lean"]);
    let names: Vec<&str> = told.parts.iter().map(|part| part.name.as_str()).collect();
    assert_eq!(names, ["base", "side_0", "side_1", "side_2", "side_3"]);
    for (old, part) in cake.parts.iter().enumerate() {
        assert_eq!(numbers[old], tote.part_index(&part.name), "{}", part.name);
    }
}
