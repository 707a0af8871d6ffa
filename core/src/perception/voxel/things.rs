use super::super::ransac::support::Ground;
use super::super::readings::Readings;
use super::super::PerceptionSettings;
use super::ground::lies_in;
use super::surfaces::{Surface, Surfaces};
use super::voxels::Voxels;
use crate::geometry::Plane;

/// Times that pieces of the support are looked for: each finds it a little more bowed.
const ROUNDS: usize = 3;

/// What a surface is part of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    Support,
    /// Walls, floors below a table, ceilings.
    Room,
    Thing,
}

/// Joins the pieces of the support into the largest of them, and makes their common plane the support's. How far a piece
/// may lie from it, metres; `None` where there is no support.
///
/// A floor that is bowed, or that the sensor sees so, scatters more than its readings do: what lies within that scatter
/// is a piece of it too.
pub fn join_support(
    surfaces: &mut Surfaces,
    voxels: &Voxels,
    readings: &Readings,
    ground: &mut Ground,
    settings: &PerceptionSettings,
) -> Option<f64> {
    let mut tolerance_m = 0.0;
    for _ in 0..ROUNDS {
        let support = ground.support?;
        let inside = voxels.plane_inside(&support);
        let is_piece = |s: &usize| {
            let surface = &surfaces.list[*s];
            let expected_m = readings.tolerance_m(&(surface.moments.mean() + voxels.low));
            let scattered_m = settings.tolerance_m(surface.variance.sqrt());
            lies_in(surface, voxels, &inside, expected_m.max(scattered_m).max(tolerance_m))
        };
        let pieces: Vec<usize> = (0..surfaces.list.len()).filter(is_piece).collect();
        let Some((&first, others)) = pieces.split_first() else { break };
        others.iter().for_each(|&other| surfaces.join(first, other));
        tolerance_m = tolerance_m.max(settings.tolerance_m(surfaces.list[first].variance.sqrt()));
        let joint = voxels.plane_of_input(&surfaces.list[first].plane);
        let plane = if joint.normal.dot(&support.normal) < 0.0 { joint.flipped() } else { joint };
        (ground.up, ground.support) = (plane.normal, Some(plane));
        surfaces.number_anew();
    }
    Some(tolerance_m)
}

/// The role of each surface, once the support's pieces are joined.
pub fn roles(
    surfaces: &Surfaces,
    voxels: &Voxels,
    readings: &Readings,
    ground: &Ground,
    support_tolerance_m: Option<f64>,
    settings: &PerceptionSettings,
) -> Vec<Role> {
    let support = ground.support.map(|plane| voxels.plane_inside(&plane));
    let room: Vec<Plane> = ground.room.iter().map(|plane| voxels.plane_inside(plane)).collect();
    let role = |surface: &Surface| {
        let middle = surface.moments.mean();
        let expected_m = readings.tolerance_m(&(middle + voxels.low));
        let tolerance_m = support_tolerance_m.map_or(expected_m, |t| t.max(expected_m));
        if support.is_some_and(|plane| lies_in(surface, voxels, &plane, tolerance_m)) {
            return Role::Support;
        }
        let height_m = support.map(|plane| plane.height_of(&middle));
        let is_off = height_m.is_some_and(|h| h < -tolerance_m || h > settings.tallest_thing_m);
        let in_room = room.iter().any(|plane| lies_in(surface, voxels, plane, expected_m));
        if is_off || in_room || surface.sides_m()[0] > settings.largest_thing_m {
            Role::Room
        } else {
            Role::Thing
        }
    };
    surfaces.list.iter().map(role).collect()
}
