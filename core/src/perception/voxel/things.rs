use super::super::ransac::support::Ground;
use super::super::readings::Readings;
use super::super::PerceptionSettings;
use super::ground::lies_in;
use super::surfaces::{Surface, Surfaces};
use super::voxels::Voxels;
use crate::geometry::Plane;

/// What a surface is part of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    Support,
    /// Walls, floors below a table, ceilings.
    Room,
    Thing,
}

/// The role of each surface.
pub fn roles(
    surfaces: &Surfaces,
    voxels: &Voxels,
    readings: &Readings,
    ground: &Ground,
    settings: &PerceptionSettings,
) -> Vec<Role> {
    let support = ground.support.map(|plane| voxels.plane_inside(&plane));
    let room: Vec<Plane> = ground.room.iter().map(|plane| voxels.plane_inside(plane)).collect();
    let role = |surface: &Surface| {
        let middle = surface.moments.mean();
        let tolerance_m = readings.tolerance_m(&(middle + voxels.low));
        if support.is_some_and(|plane| lies_in(surface, &plane, tolerance_m)) {
            return Role::Support;
        }
        let height_m = support.map(|plane| plane.height_of(&middle));
        let is_off = height_m.is_some_and(|h| h < -tolerance_m || h > settings.tallest_thing_m);
        let in_room = room.iter().any(|plane| lies_in(surface, plane, tolerance_m));
        if is_off || in_room || surface.sides_m()[0] > settings.largest_thing_m {
            Role::Room
        } else {
            Role::Thing
        }
    };
    surfaces.list.iter().map(role).collect()
}

/// Joins the pieces of the support into the largest of them.
pub fn join_support(surfaces: &mut Surfaces, roles: &mut Vec<Role>) {
    let pieces: Vec<usize> = (0..roles.len()).filter(|&s| roles[s] == Role::Support).collect();
    let Some((&first, others)) = pieces.split_first() else { return };
    for &other in others {
        surfaces.join(first, other);
    }
    let mut place = 0..;
    let kept: Vec<bool> = surfaces.list.iter().map(|s| !s.voxels.is_empty()).collect();
    roles.retain(|_| kept[place.next().unwrap_or_default()]);
    surfaces.list.retain(|s| !s.voxels.is_empty());
    surfaces.own_anew();
}
