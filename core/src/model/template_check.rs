//! From the file's strings and degrees to a checked `Template`; every error names the key and what would fit.

use super::features::{Direction, Location, Orientation};
use super::relations::{Connectivity, Parallel, Rectangular, RelativeLocation, RelativeOrientation};
use super::template::{Accept, Body, FeatureTerm, Joint, OpenBoxRoles, Part, RelationTerm, Requirement, Template};
use super::template_file::{
    AcceptEntry, BodyEntry, FeatureEntry, FeatureKind, JointEntry, RelationEntry, RelationKind, SymmetryEntry,
    TemplateFile,
};
use super::{Feature, Relation};
use crate::error::{InputError, Result};

const FORMAT: &str = "boxwright.template";
const VERSION: u32 = 1;
/// More parts than this would make the search's structure analysis (all subsets of parts) slow.
const MAX_PARTS: usize = 16;

impl TemplateFile {
    pub fn check(self) -> Result<Template> {
        if self.format != FORMAT {
            return Err(at("format", format!("is \"{}\"", self.format)).mend(format!("a template says \"{FORMAT}\"")));
        }
        if self.version != VERSION {
            return Err(at("version", format!("is {}", self.version)).mend(format!("this program reads {VERSION}")));
        }
        let names = Names::new(self.parts.iter().map(|part| part.name.clone()).collect())?;
        let template = Template {
            joints: self.joints.iter().map(|entry| joint(entry, &names)).collect::<Result<_>>()?,
            symmetries: symmetry_group(&self.symmetries, &names)?,
            features: self.features.iter().map(|entry| feature(entry, &names)).collect::<Result<_>>()?,
            relations: self.relations.iter().map(|entry| relation(entry, &names)).collect::<Result<_>>()?,
            accept: accept(&self.accept, &names)?,
            body: body(self.body.as_ref(), &names)?,
            parts: self.parts.into_iter().map(|part| Part { name: part.name, class: part.class }).collect(),
            name: self.name,
            description: self.description,
        };
        check_terms(&template)?;
        check_symmetries(&template)?;
        Ok(template)
    }
}

fn at(key: impl Into<String>, problem: impl Into<String>) -> InputError {
    InputError::new(problem).at(key)
}

/// The template's part names, for turning a name into an index.
struct Names(Vec<String>);

impl Names {
    fn new(names: Vec<String>) -> Result<Self> {
        if names.is_empty() || names.len() > MAX_PARTS {
            return Err(
                at("part", format!("there are {} parts", names.len())).mend(format!("a template has 1 to {MAX_PARTS}"))
            );
        }
        for (k, name) in names.iter().enumerate() {
            if name.is_empty() || names[..k].contains(name) {
                return Err(at("part", format!("the name \"{name}\" is empty or stands twice"))
                    .mend("each part has a name of its own"));
            }
        }
        Ok(Self(names))
    }

    fn index(&self, key: &str, name: &str) -> Result<usize> {
        self.0.iter().position(|n| n == name).ok_or_else(|| {
            at(key, format!("\"{name}\" is no part of this template"))
                .mend(format!("its parts are {}", self.0.join(", ")))
        })
    }

    fn indices(&self, key: &str, names: &[String]) -> Result<Vec<usize>> {
        names.iter().map(|name| self.index(key, name)).collect()
    }

    fn optional_index(&self, key: &str, name: &str) -> Result<Option<usize>> {
        if name.is_empty() {
            return Ok(None);
        }
        self.index(key, name).map(Some)
    }
}

fn joint(entry: &JointEntry, names: &Names) -> Result<Joint> {
    let key = format!("joint {} to {}", entry.parent, entry.child);
    let [low, high] = entry.limits_deg.map(f64::to_radians);
    let ordered = low.is_finite() && high.is_finite() && low < high;
    if !ordered {
        return Err(at(key, format!("limits_deg are {:?}", entry.limits_deg)).mend("the lower comes first"));
    }
    Ok(Joint {
        parent: names.index(&key, &entry.parent)?,
        child: names.index(&key, &entry.child)?,
        limits_rad: [low, high],
    })
}

/// The group that the file's generators span, the identity first.
fn symmetry_group(entries: &[SymmetryEntry], names: &Names) -> Result<Vec<Vec<usize>>> {
    let generators = entries.iter().map(|entry| permutation(entry, names)).collect::<Result<Vec<_>>>()?;
    let mut group: Vec<Vec<usize>> = vec![(0..names.0.len()).collect()];
    let mut next = 0;
    while next < group.len() {
        for generator in &generators {
            let product: Vec<usize> = group[next].iter().map(|&p| generator[p]).collect();
            if !group.contains(&product) {
                group.push(product);
            }
        }
        next += 1;
    }
    Ok(group)
}

fn permutation(entry: &SymmetryEntry, names: &Names) -> Result<Vec<usize>> {
    let key = format!("symmetry {}", entry.name);
    let mut map: Vec<usize> = (0..names.0.len()).collect();
    for (from, to) in &entry.map {
        map[names.index(&key, from)?] = names.index(&key, to)?;
    }
    let mut seen = map.clone();
    seen.sort_unstable();
    if seen.iter().enumerate().any(|(k, &p)| k != p) {
        return Err(at(key, "two parts map to one").mend("a symmetry is a permutation of the parts"));
    }
    Ok(map)
}

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

fn feature(entry: &FeatureEntry, names: &Names) -> Result<FeatureTerm> {
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
    };
    Ok(FeatureTerm { parts: names.indices(&key, &entry.parts)?, name: entry.name.clone(), feature })
}

fn relation(entry: &RelationEntry, names: &Names) -> Result<RelationTerm> {
    let key = format!("relation {}", entry.name);
    let given = [
        ("direction", entry.direction.is_some()),
        ("angle_deg", entry.angle_deg.is_some()),
        ("tolerance_deg", entry.tolerance_deg.is_some()),
        ("tolerance_m", entry.tolerance_m.is_some()),
    ];
    let tolerance_rad = || number(&key, "tolerance_deg", entry.tolerance_deg).map(f64::to_radians);
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
            Relation::Connectivity(Connectivity { tolerance_m: number(&key, "tolerance_m", entry.tolerance_m)? })
        }
        RelationKind::Rectangular => {
            only(&key, &given, &["tolerance_deg"])?;
            Relation::Rectangular(Rectangular { tolerance_rad: tolerance_rad()? })
        }
        RelationKind::Parallel => {
            only(&key, &given, &["tolerance_deg"])?;
            Relation::Parallel(Parallel { tolerance_rad: tolerance_rad()? })
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

fn accept(entry: &AcceptEntry, names: &Names) -> Result<Accept> {
    if entry.min_parts == 0 {
        return Err(at("accept.min_parts", "is 0").mend("an object has at least one part"));
    }
    let mut requirements = Vec::with_capacity(entry.require.len());
    for requirement in &entry.require {
        let parts = names.indices("accept.require", &requirement.parts)?;
        requirements.push(Requirement { parts, at_least: requirement.at_least });
    }
    Ok(Accept { min_parts: entry.min_parts, requirements })
}

fn body(entry: Option<&BodyEntry>, names: &Names) -> Result<Body> {
    let Some(BodyEntry::OpenBox { base, sides, flaps, tucks }) = entry else {
        return Ok(Body::Free);
    };
    let four = |list: &[String; 4]| -> Result<[Option<usize>; 4]> {
        let mut out = [None; 4];
        for (slot, name) in out.iter_mut().zip(list) {
            *slot = names.optional_index("body", name)?;
        }
        Ok(out)
    };
    let sides = names.indices("body.sides", sides)?;
    Ok(Body::OpenBox(OpenBoxRoles {
        base: names.index("body.base", base)?,
        sides: [sides[0], sides[1], sides[2], sides[3]],
        flaps: four(flaps)?,
        tucks: four(tucks)?,
    }))
}

fn check_terms(template: &Template) -> Result<()> {
    let names: Vec<&str> = template.term_names().collect();
    for (k, name) in names.iter().enumerate() {
        if names[..k].contains(name) {
            return Err(at(*name, "two features or relations bear this name").mend("weights need a name each"));
        }
    }
    for (p, part) in template.parts.iter().enumerate() {
        let touched = template.features.iter().any(|term| term.parts.contains(&p))
            || template.relations.iter().any(|term| term.pairs.iter().any(|&(a, b)| a == p || b == p));
        if !touched {
            return Err(at(format!("part {}", part.name), "no feature and no relation touches it")
                .mend("nothing could ever speak for it: give it one, or leave the part out"));
        }
    }
    Ok(())
}

/// A symmetry that changes what a term sums over would make equal boxes score differently.
fn check_symmetries(template: &Template) -> Result<()> {
    for map in &template.symmetries {
        for term in &template.features {
            if !term.parts.iter().all(|&p| term.parts.contains(&map[p])) {
                return Err(at(format!("feature {}", term.name), "a symmetry maps its parts onto others")
                    .mend("name every part of each orbit"));
            }
        }
        for term in &template.relations {
            let directed = matches!(term.relation, Relation::Location(_));
            let has = |a, b| term.pairs.contains(&(a, b)) || (!directed && term.pairs.contains(&(b, a)));
            if !term.pairs.iter().all(|&(a, b)| has(map[a], map[b])) {
                return Err(at(format!("relation {}", term.name), "a symmetry maps its pairs onto others")
                    .mend("name every pair of each orbit"));
            }
        }
    }
    Ok(())
}
