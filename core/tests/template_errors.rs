//! A template that does not fit is refused with one line: the key, what was wrong, what would fit.

use boxwright_core::model::Template;

const FITTING: &str = r#"format = "boxwright.template"
version = 1
name = "thing"
part = [{ name = "a", class = "x" }, { name = "b", class = "x" }, { name = "c", class = "y" }]
joint = [{ parent = "a", child = "b", limits_deg = [0, 90] }]
[[symmetry]]
name = "swap"
[symmetry.map]
a = "b"
b = "a"
[[feature]]
name = "level"
kind = "orientation"
parts = ["a", "b"]
direction = "up"
angle_deg = 0
tolerance_deg = 10
[[feature]]
name = "near"
kind = "location"
parts = ["c"]
reference = "group_center"
tolerance_m = 0.1
[[feature]]
name = "there"
kind = "existence"
parts = ["c"]
[[relation]]
name = "square"
kind = "orientation"
pairs = [["a", "b"]]
angle_deg = 90
tolerance_deg = 20
[[relation]]
name = "over"
kind = "location"
pairs = [["a", "c"], ["b", "c"]]
direction = "up"
tolerance_deg = 60
[[relation]]
name = "meet"
kind = "connectivity"
pairs = [["a", "c"], ["b", "c"]]
tolerance_m = 0.05
[accept]
min_parts = 2
require = [{ parts = ["a"], at_least = 1 }]
"#;

/// What is replaced, by what, and the whole line that is told.
const MISFITS: &[(&str, &str, &str)] = &[
    ("boxwright.template", "boxwright.model", "format: is \"boxwright.model\"; a template says \"boxwright.template\""),
    ("version = 1", "version = 7", "version: is 7; this program reads 1"),
    ("name = \"thing\"", "name = \"thing\"\ncolour = 3", "line 4: unknown field `colour`, expected one of"),
    ("version = 1\n", "", "line 1: missing field `version`"),
    ("version = 1", "version = \"one\"", "line 2: invalid type: string \"one\", expected u32"),
    ("version = 1", "version = ", "line 2: "),
    (
        "{ name = \"b\", class = \"x\" }",
        "{ name = \"a\", class = \"x\" }",
        "part: the name \"a\" is empty or stands twice; each part has a name of its own",
    ),
    (
        "{ name = \"b\", class = \"x\" }",
        "{ name = \"\", class = \"x\" }",
        "part: the name \"\" is empty or stands twice; each part has a name of its own",
    ),
    (
        "limits_deg = [0, 90] }]",
        "limits_deg = [0, 90] }, { parent = \"c\", child = \"b\", limits_deg = [0, 90] }]",
        "joint c to b: another joint has this child already; each part hangs on one other at most",
    ),
    (
        "limits_deg = [0, 90] }]",
        "limits_deg = [0, 90] }, { parent = \"b\", child = \"a\", limits_deg = [0, 90] }]",
        "joint a to b: it goes round in a circle; joints form trees",
    ),
    ("child = \"b\"", "child = \"lid\"", "joint a to lid: \"lid\" is no part of this template; its parts are a, b, c"),
    ("[0, 90]", "[90, 0]", "joint a to b: limits_deg are [90.0, 0.0]; the lower comes first"),
    ("[0, 90]", "[0, inf]", "joint a to b: limits_deg are [0.0, inf]; the lower comes first"),
    ("b = \"a\"", "c = \"a\"", "symmetry swap: two parts map to one; a symmetry is a permutation of the parts"),
    ("b = \"a\"", "lid = \"a\"", "symmetry swap: \"lid\" is no part of this template; its parts are a, b, c"),
    (
        "parts = [\"a\", \"b\"]",
        "parts = [\"a\"]",
        "feature level: a symmetry maps its parts onto others; name every part of each orbit",
    ),
    (
        "[\"a\", \"c\"], [\"b\", \"c\"]]\ndirection",
        "[\"a\", \"c\"]]\ndirection",
        "relation over: a symmetry maps its pairs onto others; name every pair of each orbit",
    ),
    ("kind = \"existence\"", "kind = \"colour\"", "line 26: unknown variant `colour`, expected one of"),
    (
        "parts = [\"a\", \"b\"]",
        "parts = [\"a\", \"lid\"]",
        "feature level: \"lid\" is no part of this template; its parts are a, b, c",
    ),
    ("direction = \"up\"\nangle_deg = 0", "angle_deg = 0", "feature level: direction is missing; direction = \"up\""),
    (
        "direction = \"up\"\nangle_deg = 0",
        "direction = \"left\"\nangle_deg = 0",
        "line 15: unknown variant `left`, expected `up`",
    ),
    ("angle_deg = 0\n", "", "feature level: angle_deg is missing; this kind needs angle_deg"),
    ("tolerance_deg = 10", "tolerance_deg = nan", "feature level: tolerance_deg is NaN; a finite number"),
    (
        "tolerance_deg = 10",
        "tolerance_m = 10",
        "feature level: tolerance_m means nothing to this kind; it reads direction, angle_deg, tolerance_deg, oriented",
    ),
    ("reference = \"group_center\"\n", "", "feature near: reference is missing; group_center or group_foot"),
    ("tolerance_m = 0.1\n", "", "feature near: tolerance_m is missing; this kind needs tolerance_m"),
    (
        "kind = \"existence\"\n",
        "kind = \"existence\"\noriented = true\n",
        "feature there: oriented means nothing to this kind; leave it out",
    ),
    ("[[\"a\", \"b\"]]", "[[\"a\", \"a\"]]", "relation square: \"a\" is paired with itself; a relation ties two parts"),
    (
        "[[\"a\", \"b\"]]",
        "[[\"a\", \"lid\"]]",
        "relation square: \"lid\" is no part of this template; its parts are a, b, c",
    ),
    ("[[\"a\", \"b\"]]", "[[\"a\"]]", "line 31: "),
    ("angle_deg = 90\n", "", "relation square: angle_deg is missing; this kind needs angle_deg"),
    ("tolerance_deg = 20", "tolerance_deg = -inf", "relation square: tolerance_deg is -inf; a finite number"),
    (
        "direction = \"up\"\ntolerance_deg = 60",
        "tolerance_deg = 60",
        "relation over: direction is missing; direction = \"up\"",
    ),
    (
        "tolerance_m = 0.05",
        "tolerance_m = 0.05\nangle_deg = 3",
        "relation meet: angle_deg means nothing to this kind; it reads tolerance_m",
    ),
    (
        "name = \"meet\"",
        "name = \"square\"",
        "square: two features or relations bear this name; weights need a name each",
    ),
    ("min_parts = 2", "min_parts = 0", "accept.min_parts: is 0; an object has at least one part"),
    ("min_parts = 2", "min_parts = -1", "line 46: invalid value: integer `-1`"),
    (
        "require = [{ parts = [\"a\"]",
        "require = [{ parts = [\"lid\"]",
        "accept.require: \"lid\" is no part of this template; its parts are a, b, c",
    ),
    ("[accept]\nmin_parts = 2\nrequire = [{ parts = [\"a\"], at_least = 1 }]\n", "", "line 1: missing field `accept`"),
    (
        "class = \"y\" }]",
        "class = \"y\" }, { name = \"d\", class = \"y\" }]",
        "part d: no feature and no relation touches it; nothing could ever speak for it",
    ),
];

fn refusal(text: &str) -> String {
    Template::from_toml(text).expect_err("refused").to_string()
}

#[test]
fn the_one_that_they_were_made_from_fits() {
    let template = Template::from_toml(FITTING).unwrap();
    assert_eq!(template.term_count(), 6);
    assert_eq!(template.symmetries.len(), 2);
}

#[test]
fn every_misfit_names_key_and_mend_in_one_line() {
    let mut cases = 0;
    for (from, to, told) in MISFITS {
        assert!(FITTING.contains(from), "{from:?} is not in the template");
        let text = refusal(&FITTING.replacen(from, to, 1));
        assert!(text.starts_with(told), "{to:?} gave {text:?}, not {told:?}");
        assert!(!text.contains('\n'), "{text:?}");
        cases += 1;
    }
    assert_eq!(cases, MISFITS.len());
    assert_eq!(cases, 40);
}

#[test]
fn an_open_box_needs_the_parts_that_it_names() {
    let body = |text: &str| refusal(&format!("{FITTING}[body]\nkind = \"open_box\"\n{text}"));
    let rest = "flaps = [\"\", \"\", \"\", \"\"]\ntucks = [\"\", \"\", \"\", \"\"]\n";
    let parts = "\"lid\" is no part of this template; its parts are a, b, c";
    let sides = "sides = [\"a\", \"b\", \"c\", \"lid\"]";
    let cases = [
        (body(&format!("base = \"lid\"\nsides = [\"a\", \"b\", \"a\", \"b\"]\n{rest}")), format!("body.base: {parts}")),
        (body(&format!("base = \"c\"\n{sides}\n{rest}")), format!("body.sides: {parts}")),
        (body(&format!("base = \"c\"\nsides = [\"a\", \"b\", \"a\"]\n{rest}")), "line ".to_owned()),
        (
            body(&format!(
                "base = \"c\"\nsides = [\"a\", \"b\", \"a\", \"b\"]\n{}",
                rest.replacen("\"\"", "\"lid\"", 1)
            )),
            format!("body: {parts}"),
        ),
    ];
    for (text, told) in &cases {
        assert!(text.starts_with(told.as_str()), "{text:?}, not {told:?}");
    }
    assert_eq!(cases.len(), 4);
}

#[test]
fn too_many_parts_and_no_parts_are_refused() {
    let parts: Vec<String> = (0..17).map(|k| format!("{{ name = \"p{k}\", class = \"x\" }}")).collect();
    let start = "format = \"boxwright.template\"\nversion = 1\nname = \"many\"\n";
    let text = |parts: &str| format!("{start}part = [{parts}]\n[accept]\nmin_parts = 1\n");
    assert_eq!(refusal(&text(&parts.join(", "))), "part: there are 17 parts; a template has 1 to 16");
    assert_eq!(refusal(&text("")), "part: there are 0 parts; a template has 1 to 16");
}

#[test]
fn generators_that_span_too_many_symmetries_are_refused() {
    let names: Vec<String> = (0..9).map(|k| format!("leg_{k}")).collect();
    let parts: Vec<String> = names.iter().map(|name| format!("{{ name = \"{name}\", class = \"leg\" }}")).collect();
    let round: Vec<String> = (0..9).map(|k| format!("{} = \"{}\"", names[k], names[(k + 1) % 9])).collect();
    let text = format!(
        "format = \"boxwright.template\"\nversion = 1\nname = \"spider\"\npart = [{}]\n[[symmetry]]\nname = \"round\"\n\
         [symmetry.map]\n{}\n[[symmetry]]\nname = \"swap\"\n[symmetry.map]\nleg_0 = \"leg_1\"\nleg_1 = \"leg_0\"\n\
         [accept]\nmin_parts = 1\n",
        parts.join(", "),
        round.join("\n")
    );
    let error = Template::from_toml(&text).unwrap_err().to_string();
    assert!(error.starts_with("symmetry: the generators span more than 1000 symmetries"), "{error}");
}
