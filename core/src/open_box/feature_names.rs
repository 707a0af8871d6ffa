//! The names of what a fitted box, and each of its panels, is judged by, and values by these names.

/// Named values, always in the same order.
pub type Features = Vec<(&'static str, f64)>;

/// Their names, in order.
pub const BOX_FEATURES: [&str; 35] = [
    "one",
    "on_walls",
    "on_inner_faces",
    "looked_inside",
    "closed_over",
    "on_open_flaps",
    "on_closed_flaps",
    "looked_through",
    "walls_hidden",
    "sides_seen",
    "flaps_seen",
    "base_seen",
    "shorter_edge",
    "height",
    "slimness",
    "held",
    "flaps_go_on",
    "hidden_and_closed",
    "flaps_and_inside",
    "walls_by_height",
    "hidden_behind_flaps",
    "hidden_by_size",
    "lid_and_inside",
    "rims_free",
    "rims_go_on",
    "rims_looked_through",
    "sides_go_on",
    "assignment",
    "lies",
    "range",
    "off_support",
    "score",
    "longest_flap",
    "flaps_unlike",
    "side_absent",
];
pub const PART_FEATURES: [&str; 19] = [
    "one",
    "is_base",
    "is_flap",
    "is_tuck",
    "readings",
    "lean",
    "looked_through",
    "hidden",
    "covered",
    "length",
    "is_inner",
    "few_and_hidden",
    "held",
    "goes_on",
    "off_lid",
    "range",
    "angle",
    "unlike",
    "of_box",
];

/// The value of a feature, 0 where it was not asked.
pub fn named(features: &Features, name: &str) -> f64 {
    features.iter().find(|(other, _)| *other == name).map_or(0.0, |(_, value)| *value)
}
