//! The robot as it stands in its file: degrees and lists (docs/robots.md). `check` turns it into an [`super::Arm`].

use serde::Deserialize;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RobotFile {
    pub format: String,
    pub version: u32,
    pub name: String,
    #[serde(default, rename = "description")]
    pub _description: String,
    #[serde(default, rename = "payload_kg")]
    pub _payload_kg: Option<f64>,
    #[serde(default, rename = "repeatability_m")]
    pub _repeatability_m: Option<f64>,
    pub ready_deg: Vec<f64>,
    #[serde(default, rename = "sources")]
    pub _sources: Vec<String>,
    #[serde(default, rename = "assumptions")]
    pub _assumptions: Vec<String>,
    #[serde(default)]
    pub may_touch: Vec<[String; 2]>,
    pub opw: Option<OpwEntry>,
    #[serde(rename = "joint")]
    pub joints: Vec<JointEntry>,
    pub flange: Option<PlaceEntry>,
    #[serde(rename = "link")]
    pub links: Vec<LinkEntry>,
    pub gripper: GripperEntry,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OpwEntry {
    pub a1_m: f64,
    pub a2_m: f64,
    pub b_m: f64,
    pub c1_m: f64,
    pub c2_m: f64,
    pub c3_m: f64,
    pub c4_m: f64,
    pub offsets_deg: [f64; 6],
    pub signs: [f64; 6],
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JointEntry {
    pub name: String,
    pub limits_deg: [f64; 2],
    pub speed_deg_per_s: f64,
    pub acceleration_deg_per_s2: f64,
    pub xyz_m: Option<[f64; 3]>,
    pub rpy_deg: Option<[f64; 3]>,
    pub axis: Option<[f64; 3]>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlaceEntry {
    pub xyz_m: [f64; 3],
    pub rpy_deg: [f64; 3],
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LinkEntry {
    pub name: String,
    pub mass_kg: f64,
    #[serde(default)]
    pub capsules: Vec<CapsuleEntry>,
    #[serde(default)]
    pub boxes: Vec<BoxEntry>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CapsuleEntry {
    pub from_m: [f64; 3],
    pub to_m: [f64; 3],
    pub radius_m: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BoxEntry {
    pub centre_m: [f64; 3],
    pub size_m: [f64; 3],
    #[serde(default)]
    pub rpy_deg: [f64; 3],
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GripperEntry {
    pub mass_kg: f64,
    pub body_size_m: [f64; 3],
    pub finger_size_m: [f64; 3],
    pub opening_m: [f64; 2],
    pub tool_point_m: [f64; 3],
}
