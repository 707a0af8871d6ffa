//! From the file's strings and degrees to a checked `Template`; every error names the key and what would fit.

use super::template::{Accept, Body, Joint, OpenBoxRoles, Part, Requirement, Template};
use super::template_file::{AcceptEntry, BodyEntry, JointEntry, SymmetryEntry, TemplateFile};
use super::template_names::{at, Names};
use super::template_terms::{feature, relation};
use super::Relation;
use crate::error::Result;

const FORMAT: &str = "boxwright.template";
const VERSION: u32 = 1;
/// Six legs in any order make 720; a group far beyond is a slip, and every search would pay for it.
const MAX_SYMMETRIES: usize = 1000;

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
        check_joints(&template)?;
        check_terms(&template)?;
        check_symmetries(&template)?;
        Ok(template)
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
    let mut group: Vec<Vec<usize>> = vec![(0..names.count()).collect()];
    let mut next = 0;
    while next < group.len() {
        for generator in &generators {
            let product: Vec<usize> = group[next].iter().map(|&p| generator[p]).collect();
            if !group.contains(&product) {
                group.push(product);
            }
            if group.len() > MAX_SYMMETRIES {
                return Err(at("symmetry", format!("the generators span more than {MAX_SYMMETRIES} symmetries"))
                    .mend("name fewer, or fewer parts that change places"));
            }
        }
        next += 1;
    }
    Ok(group)
}

fn permutation(entry: &SymmetryEntry, names: &Names) -> Result<Vec<usize>> {
    let key = format!("symmetry {}", entry.name);
    let mut map: Vec<usize> = (0..names.count()).collect();
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
    let four = |list: &[String; 4]| -> Result<[Option<usize>; 4]> {
        let mut out = [None; 4];
        for (slot, name) in out.iter_mut().zip(list) {
            *slot = names.optional_index("body", name)?;
        }
        Ok(out)
    };
    let roles = |base: &str, sides: &[String; 4], flaps: [Option<usize>; 4], tucks: [Option<usize>; 4]| {
        let sides = names.indices("body.sides", sides)?;
        let sides = [sides[0], sides[1], sides[2], sides[3]];
        Ok(OpenBoxRoles { base: names.index("body.base", base)?, sides, flaps, tucks })
    };
    match entry {
        None => Ok(Body::Free),
        Some(BodyEntry::OpenBox { base, sides, flaps, tucks }) => {
            Ok(Body::OpenBox(roles(base, sides, four(flaps)?, four(tucks)?)?))
        }
        Some(BodyEntry::ClosedBox { base, sides, top }) => {
            let top = names.index("body.top", top)?;
            Ok(Body::ClosedBox(roles(base, sides, [Some(top), None, None, None], [None; 4])?))
        }
    }
}

/// Joints form trees: one parent for each child, and nothing hangs on itself.
fn check_joints(template: &Template) -> Result<()> {
    let parent_of = |part: usize| template.joints.iter().find(|joint| joint.child == part).map(|joint| joint.parent);
    for (k, joint) in template.joints.iter().enumerate() {
        let key = || {
            let [parent, child] = [joint.parent, joint.child].map(|p| &template.parts[p].name);
            format!("joint {parent} to {child}")
        };
        if template.joints[..k].iter().any(|other| other.child == joint.child) {
            return Err(at(key(), "another joint has this child already").mend("each part hangs on one other at most"));
        }
        let mut above = Some(joint.parent);
        for _ in &template.parts {
            above = above.and_then(parent_of);
        }
        if above.is_some() {
            return Err(at(key(), "it goes round in a circle").mend("joints form trees"));
        }
    }
    Ok(())
}

fn check_terms(template: &Template) -> Result<()> {
    let names: Vec<&str> = template.term_names().collect();
    for (k, name) in names.iter().enumerate() {
        if names[..k].contains(name) {
            return Err(at(*name, "two features or relations bear this name").mend("weights need a name each"));
        }
    }
    // Rays speak for closed boxes, not segments.
    let is_scored = !matches!(template.body, Body::ClosedBox(_));
    for (p, part) in template.parts.iter().enumerate().filter(|_| is_scored) {
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
