//! A fitted body as `model.json` tells it.

use std::collections::BTreeMap;

use super::body::{FittedBody, Parameters};
use super::forward::{corners, hinge, FittedHinge};
use super::layout::{flap_names, shape_names, tuck_names, HEIGHT, LENGTH, PARAMETER_COUNT, RACK, THICKNESS, WIDTH};
use super::roles::Role;
use super::settings::{FitSettings, SigmaScales};
use super::solve::Solution;
use crate::body::{JointAnswer, JointSigma, ObjectAnswer, ParameterAnswer, PoseAnswer};
use crate::model::Template;

/// Step of the differences that carry the covariance to hinges, in rad or m: hinges are smooth over millimetres.
const STEP: f64 = 1e-5;

/// Fills in what the fit says. `roles` tells what each part is, `seen` which parts have readings.
pub fn fill(
    object: &mut ObjectAnswer,
    template: &Template,
    roles: &[(usize, Role)],
    seen: &[bool],
    solution: &Solution,
    settings: &FitSettings,
) {
    let body = &solution.body;
    let (length, width, height) = (body.get(LENGTH), body.get(WIDTH), body.get(HEIGHT));
    let board = body.board_m();
    // Both pairs of walls stand a board farther out, square to themselves.
    let grown = board / body.get(RACK).cos();
    object.dimensions = Some([length, width, height]);
    object.outer_dimensions = Some([length + grown, width + grown, height]);
    object.thickness = Some(board);
    object.pose = Some(pose(body));
    let known = known(roles, seen);
    object.parameters = parameters(roles, seen, &known, solution, settings);
    for &(part, role) in roles {
        let is_fixed = matches!(role, Role::Base | Role::Side(_));
        let answer = &mut object.parts[part];
        answer.observed = seen[part];
        answer.corners = (known[part] || is_fixed).then(|| corners(body, role).map(Into::into));
    }
    object.joints = joints(template, roles, seen, &known, solution, settings);
}

/// Parts that were seen, and flaps whose tuck flaps were: they hang on something.
fn known(roles: &[(usize, Role)], seen: &[bool]) -> Vec<bool> {
    let mut out = seen.to_vec();
    for &(part, role) in roles {
        let Role::Flap(k) = role else { continue };
        out[part] |= roles.iter().any(|&(other, role)| role == Role::Tuck(k) && seen[other]);
    }
    out
}

fn pose(body: &FittedBody) -> PoseAnswer {
    let q = body.input_from_object.rotation;
    PoseAnswer { position: body.input_from_object.translation.vector.into(), orientation: [q.i, q.j, q.k, q.w] }
}

/// Less than this, in metres, radians or 1/m, is rounding.
const ROUNDED: f64 = 1e-12;

/// Of the shape, and of the flaps and tuck flaps that are known.
fn parameters(
    roles: &[(usize, Role)],
    seen: &[bool],
    known: &[bool],
    solution: &Solution,
    settings: &FitSettings,
) -> BTreeMap<String, ParameterAnswer> {
    let mut names = shape_names();
    for &(_, role) in roles.iter().filter(|(part, _)| known[*part]) {
        match role {
            Role::Flap(k) => names.extend(flap_names(k)),
            Role::Tuck(k) => names.extend(tuck_names(k)),
            _ => {}
        }
    }
    let answer = |place: usize| {
        let scale = if is_bounded(place, roles, seen) { settings.seen_scale } else { settings.unseen_scale };
        let sigma = solution.covariance[(place, place)].sqrt() * scale.dimension;
        let value = if place == THICKNESS { solution.body.board_m() } else { solution.body.get(place) };
        // What nothing was seen of is 0 but for rounding.
        let value = if value.abs() < ROUNDED { 0.0 } else { value };
        ParameterAnswer { value, sigma: Some(sigma) }
    };
    names.into_iter().map(|(place, name)| (name, answer(place))).collect()
}

/// Whether what bounds it was seen: both walls that a length lies between, any wall for the height.
fn is_bounded(place: usize, roles: &[(usize, Role)], seen: &[bool]) -> bool {
    let wall = |k: usize| roles.iter().any(|&(part, role)| role == Role::Side(k) && seen[part]);
    match place {
        LENGTH => wall(1) && wall(3),
        WIDTH => wall(0) && wall(2),
        HEIGHT => (0..4).any(wall),
        _ => true,
    }
}

fn joints(
    template: &Template,
    roles: &[(usize, Role)],
    seen: &[bool],
    known: &[bool],
    solution: &Solution,
    settings: &FitSettings,
) -> Vec<JointAnswer> {
    let role_of = |part: usize| roles.iter().find(|(p, _)| *p == part).map(|(_, role)| *role);
    let of = |joint: &crate::model::Joint| {
        let role = role_of(joint.child).filter(|_| known[joint.child])?;
        let found = hinge(&solution.body, role)?;
        let child = &template.parts[joint.child].name;
        let is_seen = seen[joint.parent] && seen[joint.child];
        let scale = if is_seen { settings.seen_scale } else { settings.unseen_scale };
        Some(JointAnswer {
            name: format!("{child}_hinge"),
            kind: "revolute",
            parent: template.parts[joint.parent].name.clone(),
            child: child.clone(),
            origin: found.origin.into(),
            axis: found.axis.into(),
            position: found.position_rad,
            limits: joint.limits_rad,
            sigma: Some(hinge_sigma(solution, role, &found, scale)),
        })
    };
    template.joints.iter().filter_map(of).collect()
}

/// The covariance carried over to a hinge (eq. 83): C' = D C D^T.
fn hinge_sigma(solution: &Solution, role: Role, at: &FittedHinge, scale: SigmaScales) -> JointSigma {
    let moved = |place: usize, step: f64| {
        let mut by = Parameters::zeros();
        by[place] = step;
        hinge(&solution.body.moved(&by), role).unwrap_or(*at)
    };
    // Rows: origin x, y, z, axis x, y, z, position.
    let mut by = nalgebra::DMatrix::zeros(7, PARAMETER_COUNT);
    for place in 0..PARAMETER_COUNT {
        let (ahead, behind) = (moved(place, STEP), moved(place, -STEP));
        let origin = (ahead.origin - behind.origin) / (2.0 * STEP);
        let axis = (ahead.axis - behind.axis) / (2.0 * STEP);
        by.fixed_view_mut::<3, 1>(0, place).copy_from(&origin);
        by.fixed_view_mut::<3, 1>(3, place).copy_from(&axis);
        by[(6, place)] = (ahead.position_rad - behind.position_rad) / (2.0 * STEP);
    }
    let spread = &by * &*solution.covariance * by.transpose();
    let sigma = |i: usize, scale: f64| spread[(i, i)].max(0.0).sqrt() * scale;
    // Of the axis the larger of the two ways it can lean would do; the root of both is on the safe side.
    let axis = (spread[(3, 3)] + spread[(4, 4)] + spread[(5, 5)]).max(0.0).sqrt() * scale.axis;
    JointSigma { position: sigma(6, scale.position), origin: [0, 1, 2].map(|i| sigma(i, scale.origin)), axis }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flap_is_known_by_its_tuck_flap() {
        let roles = [(0, Role::Base), (1, Role::Flap(2)), (2, Role::Tuck(2)), (3, Role::Flap(3)), (4, Role::Tuck(3))];
        let cases = [
            ([false, false, true, false, false], [false, true, true, false, false]),
            ([true, true, false, false, false], [true, true, false, false, false]),
            ([false, true, true, false, true], [false, true, true, true, true]),
            ([false; 5], [false; 5]),
        ];
        for (seen, expected) in cases {
            assert_eq!(known(&roles, &seen), expected, "{seen:?}");
        }
    }

    #[test]
    fn a_length_is_bounded_by_the_walls_across_it() {
        let roles: Vec<(usize, Role)> = (0..4).map(|k| (k, Role::Side(k))).collect();
        let cases = [
            ([true, false, true, false], [false, true, true]),
            ([false, true, false, true], [true, false, true]),
            ([true, true, false, false], [false, false, true]),
            ([false; 4], [false; 3]),
        ];
        for (seen, expected) in cases {
            assert_eq!([LENGTH, WIDTH, HEIGHT].map(|place| is_bounded(place, &roles, &seen)), expected, "{seen:?}");
        }
        assert!(is_bounded(THICKNESS, &roles, &[false; 4]));
    }
}
