//! An assignment as an object of the answer.

use std::collections::BTreeMap;

use super::answer::{
    array, corner_arrays, InferenceAnswer, JointAnswer, ObjectAnswer, PartAnswer, PoseAnswer, ScoreTermAnswer, Sums,
};
use super::box_frame::{opening_direction, BoxFrame};
use super::box_panels::{base_panel, flap_panel, side_panel, tuck_panel, Hinge, Panel};
use super::free::hinge_between;
use super::ring::{order_ring, BoxSegments};
use crate::geometry::Vec3;
use crate::inference::FoundObject;
use crate::model::{Assignment, Body, OpenBoxRoles, SegmentSet, Template, Weights};
use crate::perception::Scene;

/// Fewer seen sides than this say neither where the box is nor how large.
const SIDES_FOR_A_POSE: usize = 2;

/// The object with the assignment in its written order: symmetric templates are renumbered (docs/formats.md, "frames").
pub fn build_object(
    template: &Template,
    weights: &Weights,
    scene: &Scene,
    set: &SegmentSet,
    found: &FoundObject,
) -> (ObjectAnswer, Assignment) {
    let assignment = &found.candidate.assignment;
    let mut object = ObjectAnswer {
        template: template.name.clone(),
        template_probability: None,
        score: found.candidate.score,
        probability: found.probability,
        inference: InferenceAnswer::new(found.gap, found.alternatives, found.marginals.as_ref().map(|m| m.unsummed)),
        score_terms: score_terms(template, weights, &found.feature_vector),
        dimensions: None,
        outer_dimensions: None,
        thickness: None,
        size: None,
        pose: None,
        parameters: BTreeMap::new(),
        parts: Vec::new(),
        joints: Vec::new(),
        sums: found.marginals.as_ref().map(|marginals| Sums {
            assignment: marginals.assignment,
            unsummed: marginals.unsummed,
            calibration: weights.calibration,
        }),
    };
    match &template.body {
        Body::OpenBox(roles) if seen_sides(roles, assignment) >= SIDES_FOR_A_POSE => {
            let renumbered = fill_open_box(&mut object, template, roles, scene, set, found);
            (object, renumbered)
        }
        Body::OpenBox(_) | Body::ClosedBox(_) => {
            fill_seen_parts(&mut object, template, scene, set, found);
            (object, assignment.clone())
        }
        Body::Free => {
            fill_seen_parts(&mut object, template, scene, set, found);
            fill_free_joints(&mut object, template, set, assignment);
            (object, assignment.clone())
        }
    }
}

fn score_terms(template: &Template, weights: &Weights, feature_vector: &[f64]) -> Vec<ScoreTermAnswer> {
    let names = template.term_names().zip(template.term_symbols());
    let terms = names.zip(feature_vector.iter().zip(&weights.values));
    let answer = |((name, kind), (&value, &weight)): ((&str, &'static str), (&f64, &f64))| ScoreTermAnswer {
        name: name.to_owned(),
        kind,
        value,
        weight,
        contribution: weight * value,
    };
    terms.map(answer).collect()
}

fn seen_sides(roles: &OpenBoxRoles, assignment: &[Option<usize>]) -> usize {
    roles.sides.iter().filter(|&&p| assignment[p].is_some()).count()
}

fn fill_open_box(
    object: &mut ObjectAnswer,
    template: &Template,
    roles: &OpenBoxRoles,
    scene: &Scene,
    set: &SegmentSet,
    found: &FoundObject,
) -> Assignment {
    let unordered = BoxSegments::new(roles, &found.candidate.assignment);
    let z = opening_direction(&unordered, set);
    let (ordered, x) = order_ring(&unordered, set, &z);
    let first = BoxFrame::new(&ordered, set, scene.support.as_ref(), x, z);
    let turn = first.canonical_turn(scene.viewpoint.as_ref());
    let (frame, segments) = (first.turned(turn), ordered.rotated(turn));

    object.dimensions = Some(frame.dimensions());
    object.pose = Some(pose(&frame));
    let mut panels: Vec<Option<Panel>> = template.parts.iter().map(|_| None).collect();
    let mut hinges: Vec<Option<Hinge>> = template.parts.iter().map(|_| None).collect();
    panels[roles.base] = Some(base_panel(&frame, &segments, set));
    for k in 0..4 {
        panels[roles.sides[k]] = Some(side_panel(&frame, &segments, set, k));
        let Some((part, (flap, hinge))) = roles.flaps[k].zip(flap_panel(&frame, &segments, set, k)) else { continue };
        if let Some((tuck_part, (tuck, tuck_hinge))) = roles.tucks[k].zip(tuck_panel(&flap, &segments, set, k)) {
            panels[tuck_part] = Some(tuck);
            hinges[tuck_part] = Some(tuck_hinge);
        }
        panels[part] = Some(flap);
        hinges[part] = Some(hinge);
    }
    let renumbered = assignment_of(template, roles, &segments, &panels);
    object.parts = parts(template, scene, (set, found), &renumbered, &panels);
    object.joints = joints(template, &hinges);
    renumbered
}

/// Segments back to parts; a segment whose panel could not be placed (its flap is missing, say) is left out.
fn assignment_of(
    template: &Template,
    roles: &OpenBoxRoles,
    segments: &BoxSegments,
    panels: &[Option<Panel>],
) -> Assignment {
    let mut out = vec![None; template.parts.len()];
    out[roles.base] = segments.base;
    for k in 0..4 {
        out[roles.sides[k]] = segments.sides[k];
        for (role, segment) in [(roles.flaps[k], segments.flaps[k]), (roles.tucks[k], segments.tucks[k])] {
            if let Some(part) = role.filter(|&p| panels[p].is_some()) {
                out[part] = segment;
            }
        }
    }
    out
}

fn parts(
    template: &Template,
    scene: &Scene,
    (set, found): (&SegmentSet, &FoundObject),
    assignment: &[Option<usize>],
    panels: &[Option<Panel>],
) -> Vec<PartAnswer> {
    let part = |(p, panel): (usize, &Option<Panel>)| PartAnswer {
        name: template.parts[p].name.clone(),
        observed: panel.as_ref().is_some_and(|panel| panel.observed),
        state: None,
        seen_from: None,
        probability: None,
        marginal: assignment[p].and_then(|s| Some(found.marginals.as_ref()?.of_segment[s])),
        corners: panel.as_ref().map(|panel| corner_arrays(&panel.corners)),
        points: assignment[p].map_or(0, |s| scene.segments.points_of(set.scene_index[s]).len()),
    };
    panels.iter().enumerate().map(part).collect()
}

fn joints(template: &Template, hinges: &[Option<Hinge>]) -> Vec<JointAnswer> {
    let of = |joint: &crate::model::Joint| {
        let hinge = hinges[joint.child].as_ref()?;
        Some(joint_answer(template, joint, &hinge.origin, &hinge.axis, hinge.position_rad))
    };
    template.joints.iter().filter_map(of).collect()
}

fn joint_answer(
    template: &Template,
    joint: &crate::model::Joint,
    origin: &Vec3,
    axis: &Vec3,
    position_rad: f64,
) -> JointAnswer {
    let child = &template.parts[joint.child].name;
    JointAnswer {
        name: format!("{child}_hinge"),
        kind: "revolute",
        parent: template.parts[joint.parent].name.clone(),
        child: child.clone(),
        origin: array(origin),
        axis: array(axis),
        position: position_rad,
        limits: joint.limits_rad,
        sigma: None,
    }
}

fn pose(frame: &BoxFrame) -> PoseAnswer {
    let rotation = nalgebra::Rotation3::from_basis_unchecked(&[frame.x, frame.y, frame.z]);
    let q = nalgebra::UnitQuaternion::from_rotation_matrix(&rotation);
    PoseAnswer { position: array(&frame.origin()), orientation: [q.i, q.j, q.k, q.w] }
}

fn fill_seen_parts(
    object: &mut ObjectAnswer,
    template: &Template,
    scene: &Scene,
    set: &SegmentSet,
    found: &FoundObject,
) {
    let assignment = &found.candidate.assignment;
    let panel = |s: &Option<usize>| s.map(|s| Panel { corners: set.rectangles[s].corners, observed: true });
    let panels: Vec<Option<Panel>> = assignment.iter().map(panel).collect();
    object.parts = parts(template, scene, (set, found), assignment, &panels);
}

fn fill_free_joints(object: &mut ObjectAnswer, template: &Template, set: &SegmentSet, assignment: &[Option<usize>]) {
    for joint in &template.joints {
        let Some((parent, child)) = assignment[joint.parent].zip(assignment[joint.child]) else { continue };
        if let Some(hinge) = hinge_between(&set.rectangles[parent], &set.rectangles[child]) {
            let answer = joint_answer(template, joint, &hinge.origin, &hinge.axis, hinge.position_rad);
            object.joints.push(answer);
        }
    }
}
