//! The template as it stands in the file: strings and degrees. `template_check` turns it into a `Template`.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::features::{Direction, Reference};

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TemplateFile {
    pub format: String,
    pub version: u32,
    pub name: String,
    #[serde(default)]
    pub description: String,
    #[serde(rename = "part")]
    pub parts: Vec<PartEntry>,
    #[serde(rename = "joint", default)]
    pub joints: Vec<JointEntry>,
    /// Generators of the symmetry group.
    #[serde(rename = "symmetry", default)]
    pub symmetries: Vec<SymmetryEntry>,
    #[serde(rename = "feature", default)]
    pub features: Vec<FeatureEntry>,
    #[serde(rename = "relation", default)]
    pub relations: Vec<RelationEntry>,
    pub accept: AcceptEntry,
    pub body: Option<BodyEntry>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PartEntry {
    pub name: String,
    pub class: String,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JointEntry {
    pub parent: String,
    pub child: String,
    pub limits_deg: [f64; 2],
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SymmetryEntry {
    pub name: String,
    /// Part to part; parts that are not named stay.
    pub map: BTreeMap<String, String>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FeatureEntry {
    pub name: String,
    pub kind: FeatureKind,
    pub parts: Vec<String>,
    pub direction: Option<Direction>,
    pub angle_deg: Option<f64>,
    pub tolerance_deg: Option<f64>,
    pub tolerance_m: Option<f64>,
    pub oriented: Option<bool>,
    pub reference: Option<Reference>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FeatureKind {
    Orientation,
    Location,
    Existence,
    Clearance,
    Fill,
    Share,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RelationEntry {
    pub name: String,
    pub kind: RelationKind,
    pub pairs: Vec<(String, String)>,
    pub direction: Option<Direction>,
    pub angle_deg: Option<f64>,
    pub tolerance_deg: Option<f64>,
    pub tolerance_m: Option<f64>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RelationKind {
    Orientation,
    Location,
    Connectivity,
    Rectangular,
    Parallel,
    Level,
    Hinge,
    Width,
    Aside,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AcceptEntry {
    pub min_parts: usize,
    #[serde(default)]
    pub require: Vec<RequirementEntry>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RequirementEntry {
    pub parts: Vec<String>,
    pub at_least: usize,
}

#[derive(Debug, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum BodyEntry {
    OpenBox {
        base: String,
        sides: [String; 4],
        /// "" where a side bears none.
        flaps: [String; 4],
        tucks: [String; 4],
    },
    ClosedBox {
        base: String,
        sides: [String; 4],
        top: String,
    },
}
