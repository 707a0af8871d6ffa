//! Object models as data: a template names parts, hinges, features and relations; weights say what each counts.
//!
//! The engine knows no boxes: everything about an object stands in its template (TOML).

mod calibration;
mod features;
mod relations;
mod segment_set;
mod tables;
mod template;
mod template_check;
mod template_file;
mod template_names;
mod template_terms;
mod weights;

pub use calibration::{logit, Calibration, Evidence, EVIDENCE};
pub use features::Feature;
pub use relations::Relation;
pub use segment_set::SegmentSet;
pub use tables::{Assignment, FeatureTables};
pub use template::{Accept, Body, FeatureTerm, Joint, OpenBoxRoles, Part, RelationTerm, Requirement, Template};
pub use weights::Weights;
