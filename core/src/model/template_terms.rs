//! A template's features and relations, from the file's strings and degrees; every error names the key and what would fit.

use super::features::{Clearance, Direction, Location, Orientation};
use super::relations::{
    Aside, Connectivity, Hinge, Level, Parallel, Rectangular, RelativeLocation, RelativeOrientation,
};
use super::template::{FeatureTerm, RelationTerm};
use super::template_file::{FeatureEntry, FeatureKind, RelationEntry, RelationKind};
use super::template_names::{at, Names};
use super::{Feature, Relation};
use crate::error::Result;

fn number(key: &str, name: &str, value: Option<f64>) -> Result<f64> {
    match value {
        Some(value) if value.is_finite() => Ok(value),
        Some(value) => Err(at(key, format!("{name} is {value}")).mend("a finite number")),
        None => Err(at(key, format!("{name} is missing")).mend(format!("this kind needs {name}"))),
    }
}

/// Refuses parameters that the kind does not read, so that a typing error is not passed over.
fn only(key: &str, given: &[(&str, bool)], read: &[&str]) -> Result<()> {
    match given.iter().find(|(name, is_given)| *is_given && !read.contains(name)) {
        Some((name, _)) => {
            let mend =
                if read.is_empty() { "leave it out".to_owned() } else { format!("it reads {}", read.join(", ")) };
            Err(at(key, format!("{name} means nothing to this kind")).mend(mend))
        }
        None => Ok(()),
    }
}

fn direction(key: &str, value: Option<Direction>) -> Result<Direction> {
    value.ok_or_else(|| at(key, "direction is missing").mend("direction = \"up\""))
}

pub fn feature(entry: &FeatureEntry, names: &Names) -> Result<FeatureTerm> {
    let key = format!("feature {}", entry.name);
    let given = [
        ("direction", entry.direction.is_some()),
        ("angle_deg", entry.angle_deg.is_some()),
        ("tolerance_deg", entry.tolerance_deg.is_some()),
        ("tolerance_m", entry.tolerance_m.is_some()),
        ("oriented", entry.oriented.is_some()),
        ("reference", entry.reference.is_some()),
    ];
    let feature = match entry.kind {
        FeatureKind::Orientation => {
            only(&key, &given, &["direction", "angle_deg", "tolerance_deg", "oriented"])?;
            Feature::Orientation(Orientation {
                direction: direction(&key, entry.direction)?,
                angle_rad: number(&key, "angle_deg", entry.angle_deg)?.to_radians(),
                tolerance_rad: number(&key, "tolerance_deg", entry.tolerance_deg)?.to_radians(),
                oriented: entry.oriented == Some(true),
            })
        }
        FeatureKind::Location => {
            only(&key, &given, &["reference", "tolerance_m"])?;
            Feature::Location(Location {
                reference: entry
                    .reference
                    .ok_or_else(|| at(&key, "reference is missing").mend("group_center or group_foot"))?,
                tolerance_m: number(&key, "tolerance_m", entry.tolerance_m)?,
            })
        }
        FeatureKind::Existence => {
            only(&key, &given, &[])?;
            Feature::Existence
        }
        FeatureKind::Clearance => {
            only(&key, &given, &["tolerance_m"])?;
            Feature::Clearance(Clearance { tolerance_m: number(&key, "tolerance_m", entry.tolerance_m)? })
        }
        FeatureKind::Fill => {
            only(&key, &given, &[])?;
            Feature::Fill
        }
        FeatureKind::Share => {
            only(&key, &given, &[])?;
            Feature::Share
        }
    };
    Ok(FeatureTerm { parts: names.indices(&key, &entry.parts)?, name: entry.name.clone(), feature })
}

pub fn relation(entry: &RelationEntry, names: &Names) -> Result<RelationTerm> {
    let key = format!("relation {}", entry.name);
    let given = [
        ("direction", entry.direction.is_some()),
        ("angle_deg", entry.angle_deg.is_some()),
        ("tolerance_deg", entry.tolerance_deg.is_some()),
        ("tolerance_m", entry.tolerance_m.is_some()),
    ];
    let tolerance_rad = || number(&key, "tolerance_deg", entry.tolerance_deg).map(f64::to_radians);
    let tolerance_m = || number(&key, "tolerance_m", entry.tolerance_m);
    let relation = match entry.kind {
        RelationKind::Orientation => {
            only(&key, &given, &["angle_deg", "tolerance_deg"])?;
            let angle_rad = number(&key, "angle_deg", entry.angle_deg)?.to_radians();
            Relation::Orientation(RelativeOrientation { angle_rad, tolerance_rad: tolerance_rad()? })
        }
        RelationKind::Location => {
            only(&key, &given, &["direction", "tolerance_deg"])?;
            let direction = direction(&key, entry.direction)?;
            Relation::Location(RelativeLocation { direction, tolerance_rad: tolerance_rad()? })
        }
        RelationKind::Connectivity => {
            only(&key, &given, &["tolerance_m"])?;
            Relation::Connectivity(Connectivity { tolerance_m: tolerance_m()? })
        }
        RelationKind::Rectangular => {
            only(&key, &given, &["tolerance_deg"])?;
            Relation::Rectangular(Rectangular { tolerance_rad: tolerance_rad()? })
        }
        RelationKind::Parallel => {
            only(&key, &given, &["tolerance_deg"])?;
            Relation::Parallel(Parallel { tolerance_rad: tolerance_rad()? })
        }
        RelationKind::Level => {
            only(&key, &given, &["tolerance_m"])?;
            Relation::Level(Level { tolerance_m: tolerance_m()? })
        }
        RelationKind::Hinge => {
            only(&key, &given, &["tolerance_m"])?;
            Relation::Hinge(Hinge { tolerance_m: tolerance_m()? })
        }
        RelationKind::Width => {
            only(&key, &given, &[])?;
            Relation::Width
        }
        RelationKind::Aside => {
            only(&key, &given, &["tolerance_m"])?;
            Relation::Aside(Aside { tolerance_m: tolerance_m()? })
        }
    };
    Ok(RelationTerm { pairs: pairs(&key, &entry.pairs, names)?, name: entry.name.clone(), relation })
}

fn pairs(key: &str, entries: &[(String, String)], names: &Names) -> Result<Vec<(usize, usize)>> {
    let mut out = Vec::with_capacity(entries.len());
    for (first, second) in entries {
        let pair = (names.index(key, first)?, names.index(key, second)?);
        if pair.0 == pair.1 {
            return Err(at(key, format!("\"{first}\" is paired with itself")).mend("a relation ties two parts"));
        }
        out.push(pair);
    }
    Ok(out)
}
