//! The engine knows no boxes: a table and a laptop, defined in TOML here, are inferred from made-up segments.

mod common;

use boxwright_core::geometry::Rectangle;
use boxwright_core::inference::{ObjectModel, SearchSettings};
use boxwright_core::model::{Template, Weights};
use boxwright_core::pipeline::{understand, Answer, Bodies};
use common::{rectangle, scene, unit_weights};

const TABLE: &str = r#"
format = "boxwright.template"
version = 1
name = "table"
part = [{ name = "top", class = "top" }, { name = "leg_0", class = "leg" }, { name = "leg_1", class = "leg" },
        { name = "leg_2", class = "leg" }, { name = "leg_3", class = "leg" }]
[[symmetry]]
name = "swap two neighbours"
[symmetry.map]
leg_0 = "leg_1"
leg_1 = "leg_0"
[[symmetry]]
name = "round"
[symmetry.map]
leg_0 = "leg_1"
leg_1 = "leg_2"
leg_2 = "leg_3"
leg_3 = "leg_0"
[[feature]]
name = "top_level"
kind = "orientation"
parts = ["top"]
direction = "up"
angle_deg = 0
tolerance_deg = 15
[[feature]]
name = "leg_upright"
kind = "orientation"
parts = ["leg_0", "leg_1", "leg_2", "leg_3"]
direction = "up"
angle_deg = 90
tolerance_deg = 15
[[relation]]
name = "leg_square"
kind = "orientation"
pairs = [["leg_0", "top"], ["leg_1", "top"], ["leg_2", "top"], ["leg_3", "top"]]
angle_deg = 90
tolerance_deg = 15
[[relation]]
name = "top_over_leg"
kind = "location"
pairs = [["top", "leg_0"], ["top", "leg_1"], ["top", "leg_2"], ["top", "leg_3"]]
direction = "up"
tolerance_deg = 60
[accept]
min_parts = 3
require = [{ parts = ["top"], at_least = 1 }]
"#;

const LAPTOP: &str = r#"
format = "boxwright.template"
version = 1
name = "laptop"
part = [{ name = "keyboard", class = "panel" }, { name = "screen", class = "panel" }]
joint = [{ parent = "keyboard", child = "screen", limits_deg = [0, 180] }]
[[feature]]
name = "keyboard_level"
kind = "orientation"
parts = ["keyboard"]
direction = "up"
angle_deg = 0
tolerance_deg = 10
[[feature]]
name = "exists"
kind = "existence"
parts = ["screen"]
[[relation]]
name = "screen_on_keyboard"
kind = "connectivity"
pairs = [["screen", "keyboard"]]
tolerance_m = 0.03
[[relation]]
name = "screen_over_keyboard"
kind = "location"
pairs = [["screen", "keyboard"]]
direction = "up"
tolerance_deg = 80
[accept]
min_parts = 2
"#;

fn infer(template: &str, rectangles: Vec<Rectangle>) -> Answer {
    let template = Template::from_toml(template).unwrap();
    let weights = Weights::from_json(&unit_weights(&template, 0.5), &template).unwrap();
    let settings = SearchSettings::default();
    let model = ObjectModel::new(template, weights, &settings.staged);
    let count = 10 * rectangles.len();
    understand(&scene(rectangles), count, &[model], &settings, Bodies::Rectangles).unwrap()
}

#[test]
fn a_table_is_found_with_its_legs() {
    let leg = |x: f64, y: f64| rectangle([x, y, 0.35], [0.03, 0.0, 0.0], [0.0, 0.0, 0.35]);
    let rectangles = vec![
        rectangle([1.5, 0.2, 0.3], [0.1, 0.0, 0.02], [0.0, 0.05, 0.1]),
        leg(0.5, 0.3),
        leg(-0.5, 0.3),
        rectangle([0.0, 0.0, 0.7], [0.6, 0.0, 0.0], [0.0, 0.4, 0.0]),
        leg(0.5, -0.3),
        leg(-0.5, -0.3),
    ];
    let answer = infer(TABLE, rectangles);
    assert_eq!(answer.objects.len(), 1);
    let object = &answer.objects[0];
    assert_eq!(object.inference.status, "optimal");
    assert!(object.parts.iter().all(|part| part.observed));
    assert!(object.joints.is_empty());
    // The crooked board stays out; the top is the top.
    assert!(answer.object_of_point[..10].iter().all(|&o| o == -1));
    assert!(answer.part_of_point[30..40].iter().all(|&p| p == 0));
}

#[test]
fn a_laptop_is_found_at_every_angle() {
    let mut cases = 0;
    for angle_deg in (30..=160).step_by(10) {
        let angle = f64::from(angle_deg).to_radians();
        // Hinge along x at y = 0.1; the keyboard runs towards -y; 0 lies on it.
        let run = [0.0, -0.1 * angle.cos(), 0.1 * angle.sin()];
        let screen = rectangle([0.0, 0.1 + run[1], 0.02 + run[2]], [0.15, 0.0, 0.0], run);
        let keyboard = rectangle([0.0, 0.0, 0.02], [0.15, 0.0, 0.0], [0.0, 0.1, 0.0]);
        let object = infer(LAPTOP, vec![screen, keyboard]).objects.remove(0);
        let joint = &object.joints[0];
        assert_eq!((joint.parent.as_str(), joint.child.as_str()), ("keyboard", "screen"));
        assert!((joint.position - angle).abs() < 1e-9, "{} at {angle_deg} degrees", joint.position.to_degrees());
        assert!((joint.origin[1] - 0.1).abs() < 1e-9 && joint.axis[0].abs() > 0.999);
        cases += 1;
    }
    assert_eq!(cases, 14);
}
