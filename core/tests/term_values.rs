//! Features and relations on segments made by hand, with values worked out by hand (eqs. 2-9 of docs/maths.md).

mod common;

use boxwright_core::geometry::Rectangle;
use boxwright_core::model::{FeatureTables, SegmentSet, Template};
use boxwright_core::perception::{EdgeKind, Scene};
use common::{rectangle, scene};

/// The value of a relation between segments 0 and 1.
fn relation(kind: &str, parameters: &str, scene: &Scene) -> f64 {
    value_of(
        &format!("[[relation]]\nname = \"term\"\nkind = \"{kind}\"\npairs = [[\"a\", \"b\"]]\n{parameters}"),
        scene,
    )
}

/// The value of a feature of segment 0.
fn feature(kind: &str, parameters: &str, scene: &Scene) -> f64 {
    value_of(&format!("[[feature]]\nname = \"term\"\nkind = \"{kind}\"\nparts = [\"a\"]\n{parameters}"), scene)
}

fn value_of(term: &str, scene: &Scene) -> f64 {
    let template = Template::from_toml(&format!(
        "format = \"boxwright.template\"\nversion = 1\nname = \"two\"\n\
         part = [{{ name = \"a\", class = \"x\" }}, {{ name = \"b\", class = \"x\" }}]\n{term}\n\
         [[feature]]\nname = \"others\"\nkind = \"existence\"\nparts = [\"a\", \"b\"]\n[accept]\nmin_parts = 1\n"
    ))
    .unwrap();
    let tables = FeatureTables::new(&template, &SegmentSet::new(scene, &[0, 1]));
    let place = template.term_names().position(|name| name == "term").unwrap();
    tables.feature_vector(&template, &[Some(0), Some(1)])[place]
}

fn radians(degrees: f64) -> f64 {
    degrees.to_radians()
}

/// A 2 x 1 rectangle about `center` that leans `degrees` from level, about the x axis.
fn leaning(center: [f64; 3], degrees: f64) -> Rectangle {
    let (s, c) = radians(degrees).sin_cos();
    rectangle(center, [1.0, 0.0, 0.0], [0.0, 0.5 * c, 0.5 * s])
}

fn two(a: Rectangle, b: Rectangle) -> Scene {
    scene(vec![a, b])
}

fn assert_values(cases: &[(f64, f64)]) {
    for (k, (value, expected)) in cases.iter().enumerate() {
        assert!((value - expected).abs() < 1e-8, "case {k}: {value} is not {expected}");
    }
}

#[test]
fn phi_1_is_the_angle_to_up() {
    let far = leaning([9.0, 9.0, 9.0], 0.0);
    let phi = |degrees: f64, parameters: &str| {
        let text = format!("direction = \"up\"\ntolerance_deg = 15\n{parameters}");
        feature("orientation", &text, &two(leaning([0.0, 0.0, 0.5], degrees), far))
    };
    assert_values(&[
        (phi(0.0, "angle_deg = 0"), radians(15.0)),
        (phi(10.0, "angle_deg = 0"), radians(5.0)),
        (phi(40.0, "angle_deg = 0"), radians(-25.0)),
        (phi(-40.0, "angle_deg = 0"), radians(-25.0)),
        (phi(90.0, "angle_deg = 90"), radians(15.0)),
        (phi(80.0, "angle_deg = 90"), radians(5.0)),
        // Unsigned: leaning by 150 degrees is leaning by 30.
        (phi(150.0, "angle_deg = 0"), radians(-15.0)),
    ]);
}

#[test]
fn phi_1_tells_the_faces_apart_only_where_a_viewpoint_does() {
    let far = leaning([9.0, 9.0, 9.0], 0.0);
    let oriented = "direction = \"up\"\ntolerance_deg = 15\nangle_deg = 0\noriented = true";
    // The viewpoint is 1.5 above the ground: one board is seen from above, one from below.
    let (below_eye, above_eye) = (leaning([0.0, 0.0, 0.5], 0.0), leaning([0.0, 0.0, 2.5], 0.0));
    let mut blind = two(above_eye, far);
    blind.viewpoint = None;
    assert_values(&[
        (feature("orientation", oriented, &two(below_eye, far)), radians(15.0)),
        (feature("orientation", oriented, &two(above_eye, far)), radians(15.0 - 180.0)),
        (feature("orientation", oriented, &blind), radians(15.0)),
    ]);
}

#[test]
fn phi_2_is_the_distance_from_the_groups_centre_or_foot() {
    // Equal areas: the group's centre is halfway, at (0, 0, 2); its foot is on the support, z = 0.
    let pair = two(leaning([-3.0, 0.0, 2.0], 0.0), leaning([3.0, 0.0, 2.0], 0.0));
    let mut floating = pair.clone();
    floating.support = None;
    let (center, foot) = ("reference = \"group_center\"", "reference = \"group_foot\"");
    let phi = |reference: &str, scene: &Scene| feature("location", &format!("tolerance_m = 0.5\n{reference}"), scene);
    let (small, large) = (leaning([-3.0, 0.0, 2.0], 0.0), rectangle([3.0, 0.0, 2.0], [3.0, 0.0, 0.0], [0.0, 0.5, 0.0]));
    assert_values(&[
        (phi(center, &pair), 0.5 - 3.0),
        (phi(foot, &pair), 0.5 - 13f64.sqrt()),
        // No support: the lowest corner's height, here that of both boards.
        (phi(foot, &floating), 0.5 - 3.0),
        // Three times the area pulls three times as strongly: the centre is at x = 1.5.
        (phi(center, &two(small, large)), 0.5 - 4.5),
    ]);
}

#[test]
fn phi_3_counts_and_an_empty_part_counts_nothing() {
    let pair = two(leaning([0.0; 3], 0.0), leaning([1.0; 3], 0.0));
    assert_values(&[(feature("existence", "", &pair), 1.0)]);
    let template = Template::from_toml(include_str!("../../src/boxwright/models/templates/carton.toml")).unwrap();
    let tables = FeatureTables::new(&template, &SegmentSet::new(&pair, &[0, 1]));
    let zeros = tables.feature_vector(&template, &vec![None; template.parts.len()]);
    assert!(zeros.iter().all(|value| *value == 0.0));
    let mut only_base = vec![None; template.parts.len()];
    only_base[0] = Some(0);
    let values = tables.feature_vector(&template, &only_base);
    assert!(values[template.features.len()..].iter().all(|value| *value == 0.0), "a relation needs both parts");
}

#[test]
fn gamma_1_and_gamma_5_are_angles_of_planes_without_a_sign() {
    let square = |a: f64, b: f64| {
        let pair = two(leaning([0.0; 3], a), leaning([0.0, 3.0, 1.0], b));
        relation("orientation", "angle_deg = 90\ntolerance_deg = 15", &pair)
    };
    let parallel = |a: f64, b: f64| {
        relation("parallel", "tolerance_deg = 15", &two(leaning([0.0; 3], a), leaning([0.0, 3.0, 1.0], b)))
    };
    assert_values(&[
        (square(0.0, 90.0), radians(15.0)),
        (square(5.0, 85.0), radians(5.0)),
        (square(0.0, 130.0), radians(15.0 - 40.0)),
        (square(20.0, 20.0), radians(15.0 - 90.0)),
        (parallel(20.0, 20.0), radians(15.0)),
        (parallel(20.0, 200.0), radians(15.0)),
        (parallel(-10.0, 30.0), radians(15.0 - 40.0)),
        (parallel(0.0, 90.0), radians(15.0 - 90.0)),
    ]);
}

#[test]
fn gamma_2_has_a_direction() {
    let low = leaning([0.0; 3], 0.0);
    let gamma = |center: [f64; 3]| {
        relation("location", "direction = \"up\"\ntolerance_deg = 60", &two(leaning(center, 30.0), low))
    };
    assert_values(&[
        (gamma([0.0, 0.0, 2.0]), radians(60.0)),
        (gamma([1.0, 0.0, 1.0]), radians(15.0)),
        (gamma([0.0, -5.0, 0.0]), radians(-30.0)),
        (gamma([0.0, 0.0, -2.0]), radians(-120.0)),
    ]);
}

#[test]
fn gamma_3_is_the_distance_of_the_nearest_edges() {
    // Edges of a 2 x 1 board at the origin lie at y = -0.5 and 0.5, x = -1 and 1.
    let board = leaning([0.0; 3], 0.0);
    let gamma = |other: Rectangle| relation("connectivity", "tolerance_m = 0.05", &two(board, other));
    assert_values(&[
        // A flap that stands on the edge y = 0.5, shorter than it.
        (gamma(rectangle([0.2, 0.5, 0.3], [0.6, 0.0, 0.0], [0.0, 0.0, 0.3])), 0.05),
        // The same, 0.2 beside it.
        (gamma(rectangle([0.2, 0.7, 0.3], [0.6, 0.0, 0.0], [0.0, 0.0, 0.3])), 0.05 - 0.2),
        // Turned on the edge: one end lies on it, the other 0.4 off.
        (gamma(rectangle([0.0, 0.7, 1.0], [0.3, 0.2, 0.0], [0.0, 0.0, 1.0])), 0.05 - 0.2),
        // Two edges of length 1 and 2 that only meet in a corner: 0 and 1 from it.
        (gamma(rectangle([2.0, 0.5, 0.5], [1.0, 0.0, 0.0], [0.0, 0.0, 0.5])), 0.05 - 0.5),
        // Through the middle of the board: far from its edges.
        (gamma(rectangle([0.0, 0.0, 0.0], [0.1, 0.0, 0.0], [0.0, 0.0, 0.1])), 0.05 - 0.26f64.sqrt()),
    ]);
}

#[test]
fn gamma_4_holds_the_joining_vectors_against_both_normals() {
    let tolerance = "tolerance_deg = 30";
    // Two upright walls, 2 wide and 1 high, 3 apart along y.
    let wall = |x: f64, y: f64, z: f64| rectangle([x, y, z], [1.0, 0.0, 0.0], [0.0, 0.0, 0.5]);
    let gamma = |b: Rectangle| relation("rectangular", tolerance, &two(wall(0.0, 0.0, 0.0), b));
    let opposite = wall(0.0, 3.0, 0.0);
    // Corners told from another one on, or the other way round, are the same wall.
    let mut turned = opposite;
    turned.corners.rotate_left(1);
    let mut mirrored = opposite;
    mirrored.corners.reverse();
    // Leaning by 20 degrees about its middle: vectors change, so compare with the formula written out for one pairing.
    let (s, c) = radians(20.0).sin_cos();
    let leaning_wall = rectangle([0.0, 3.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.5 * s, 0.5 * c]);
    let lower = (0.5 * c - 0.5).atan2(3.0 + 0.5 * s);
    let upper = (0.5 * c - 0.5).atan2(3.0 - 0.5 * s);
    // The wall's normal leans the same 20 degrees: one pair of vectors turns with it, one against it.
    let angles = [lower.abs(), upper.abs(), (radians(20.0) + lower).abs(), (radians(20.0) - upper).abs()];
    let by_hand = radians(30.0) - angles.iter().sum::<f64>() / 4.0;
    assert_values(&[
        (gamma(opposite), radians(30.0)),
        (gamma(turned), radians(30.0)),
        (gamma(mirrored), radians(30.0)),
        (gamma(wall(1.0, 3.0, 0.0)), radians(30.0) - (1.0f64 / 3.0).atan()),
        (gamma(wall(0.0, 3.0, 0.5)), radians(30.0) - (0.5f64 / 3.0).atan()),
        // So far beside that crosswise pairs, 5 and 1 aside, fit better than 3 and 3.
        (gamma(wall(3.0, 3.0, 0.0)), radians(30.0) - ((5.0f64 / 3.0).atan() + (1.0f64 / 3.0).atan()) / 2.0),
        (gamma(leaning_wall), by_hand),
    ]);
}

#[test]
fn a_terms_value_is_the_sum_over_its_pairs() {
    let template = Template::from_toml(include_str!("../../src/boxwright/models/templates/carton.toml")).unwrap();
    let scene = scene(common::carton_rectangles(radians(120.0)));
    let tables = FeatureTables::new(&template, &SegmentSet::new(&scene, &(0..9).collect::<Vec<_>>()));
    let values = tables.feature_vector(&template, &(0..9).map(Some).collect::<Vec<_>>());
    let value = |name: &str| values[template.term_names().position(|n| n == name).unwrap()];
    assert_values(&[
        (value("base_level"), radians(15.0)),
        (value("side_upright"), 4.0 * radians(15.0)),
        (value("base_exists"), 1.0),
        (value("flap_exists"), 4.0),
        (value("sides_square"), 4.0 * radians(15.0)),
        (value("side_square_to_base"), 4.0 * radians(15.0)),
        // A flap turns about its side's edge: square to both neighbours, whatever its angle.
        (value("flap_square_to_neighbours"), 8.0 * radians(15.0)),
        (value("sides_meet"), 4.0 * 0.05),
        (value("side_meets_base"), 4.0 * 0.05),
        (value("flap_meets_side"), 4.0 * 0.05),
        (value("opposite_sides_rectangular"), 2.0 * radians(30.0)),
        (value("opposite_sides_parallel"), 2.0 * radians(15.0)),
    ]);
}

/// An upright wall 2 wide and 1 high across y, its lower edge at height `low`.
fn standing(y: f64, low: f64) -> Rectangle {
    rectangle([0.0, y, low + 0.5], [1.0, 0.0, 0.0], [0.0, 0.0, 0.5])
}

#[test]
fn phi_4_is_the_height_of_the_lowest_edge_where_it_was_seen() {
    let far = leaning([9.0, 9.0, 9.0], 0.0);
    let phi = |scene: &Scene| feature("clearance", "tolerance_m = 0.03", scene);
    let mut hidden = two(standing(0.0, 0.02), far);
    let lowest = hidden.segments.rectangles[0].lowest_edge(&hidden.up);
    hidden.segments.edges[0][lowest] = EdgeKind::Occluded;
    assert_values(&[
        (phi(&two(standing(0.0, 0.0), far)), 0.03),
        (phi(&two(standing(0.0, 0.02), far)), 0.01),
        // Never below minus the tolerance.
        (phi(&two(standing(0.0, 0.5), far)), -0.03),
        (phi(&hidden), 0.0),
    ]);
}

#[test]
fn phi_5_and_phi_6_are_shares_of_areas() {
    // 2 x 1 beside 2 x 2.
    let mut scene = two(leaning([0.0, 0.0, 0.0], 0.0), rectangle([5.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]));
    let full = feature("fill", "", &scene);
    // A triangle of half the rectangle.
    scene.segments.hulls[0].pop();
    assert_values(&[(full, 1.0), (feature("fill", "", &scene), 0.5), (feature("share", "", &scene), 2.0 / 6.0)]);
}

#[test]
fn gamma_6_and_7_know_the_rim() {
    let level = |b: Rectangle| relation("level", "tolerance_m = 0.03", &two(standing(0.0, 0.0), b));
    // The flap comes first: its nearest edge against the top edge of the side, which is 2 long at height 1.
    let hinge = |a: Rectangle| relation("hinge", "tolerance_m = 0.03", &two(a, standing(0.0, 0.0)));
    assert_values(&[
        (level(standing(3.0, 0.0)), 0.03),
        (level(standing(3.0, 0.01)), 0.02),
        (level(standing(3.0, -0.5)), -0.03),
        (hinge(rectangle([0.0, 0.2, 1.0], [1.0, 0.0, 0.0], [0.0, 0.2, 0.0])), 0.03),
        (hinge(rectangle([0.0, 0.21, 1.0], [1.0, 0.0, 0.0], [0.0, 0.2, 0.0])), 0.02),
        // At the side's foot an edge is near, but not that of the rim.
        (hinge(rectangle([0.0, 0.2, 0.0], [1.0, 0.0, 0.0], [0.0, 0.2, 0.0])), -0.03),
    ]);
}

#[test]
fn gamma_8_compares_level_edges_and_gamma_9_forbids_to_cross() {
    let wide = |half: f64, up: f64| rectangle([0.0, 3.0, up], [half, 0.0, 0.0], [0.0, 0.0, up]);
    let width = |b: Rectangle| relation("width", "", &two(standing(0.0, 0.0), b));
    let aside = |b: Rectangle| relation("aside", "tolerance_m = 0.03", &two(standing(0.0, 0.0), b));
    // A wall along y that begins at `start`; the first wall's plane is y = 0.
    let along = |start: f64| rectangle([1.0, start + 1.0, 0.5], [0.0, 1.0, 0.0], [0.0, 0.0, 0.5]);
    assert_values(&[
        (width(wide(1.0, 2.0)), 1.0),
        (width(wide(0.5, 2.0)), 0.5),
        (aside(along(0.0)), 0.03),
        // It lies in the plane's other half by a centimetre; the first wall only touches its plane.
        (aside(along(-0.01)), 0.02),
        (aside(along(-1.0)), -0.03),
        (aside(standing(2.0, 0.0)), 0.03),
    ]);
}
