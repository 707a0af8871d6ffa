use crate::body::{JointAnswer, ObjectAnswer, PartAnswer};
use crate::fit::Role;
use crate::model::{Body, Template};

/// An object told by another template: parts keep their roles, and what the other template lacks is left out. With it the
/// new number of each old part. `None` where one of the two is no open box.
pub fn recast(object: &ObjectAnswer, from: &Template, to: &Template) -> Option<(ObjectAnswer, Vec<Option<usize>>)> {
    let (Body::OpenBox(old_roles), Body::OpenBox(new_roles)) = (&from.body, &to.body) else { return None };
    let old_roles = Role::of_parts(old_roles);
    let mut new_number = vec![None; from.parts.len()];
    let mut parts: Vec<PartAnswer> = to.parts.iter().map(|part| PartAnswer::unseen(&part.name)).collect();
    for (new, role) in Role::of_parts(new_roles) {
        let Some(&(old, _)) = old_roles.iter().find(|(_, other)| *other == role) else { continue };
        new_number[old] = Some(new);
        parts[new] = PartAnswer { name: to.parts[new].name.clone(), ..object.parts[old].clone() };
    }
    let renamed = |name: &str| Some(to.parts[new_number[from.part_index(name)?]?].name.clone());
    let joints = object.joints.iter().filter_map(|joint| {
        let (parent, child) = (renamed(&joint.parent)?, renamed(&joint.child)?);
        Some(JointAnswer { name: format!("{child}_hinge"), parent, child, ..joint.clone() })
    });
    let mut out = ObjectAnswer { template: to.name.clone(), parts, joints: joints.collect(), ..object.clone() };
    for (_, role) in old_roles.iter().filter(|(old, _)| new_number[*old].is_none()) {
        let prefix = match role {
            Role::Flap(k) => format!("flap_{k}_"),
            Role::Tuck(k) => format!("tuck_{k}_"),
            Role::Base | Role::Side(_) => continue,
        };
        out.parameters.retain(|name, _| !name.starts_with(&prefix));
    }
    // They were the other template's.
    out.score_terms.clear();
    Some((out, new_number))
}
