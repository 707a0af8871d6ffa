//! Corners and hinges of a fitted body, input's frame, by the conventions of docs/formats.md.

use super::body::FittedBody;
use super::layout::{self, FLAP_ANGLE, FLAP_CURL, FLAP_LENGTH, FLAP_OFFSET, FLAP_TAPER, FLAP_WIDTH, HEIGHT};
use super::layout::{THICKNESS, TUCK_ANGLE, TUCK_LENGTH, TUCK_WIDTH};
use super::rim::Rim;
use super::roles::Role;
use super::sheet::FlapSection;
use crate::geometry::Vec3;

/// A hinge: the middle of its edge, its unit axis, and the position, rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FittedHinge {
    pub origin: Vec3,
    pub axis: Vec3,
    pub position_rad: f64,
}

/// The panel's corners at mid-board.
pub fn corners(body: &FittedBody, role: Role) -> [Vec3; 4] {
    let local = match role {
        Role::Base => base_corners(body),
        Role::Side(k) => side_corners(body, k),
        Role::Flap(k) => flap_corners(body, k),
        Role::Tuck(k) => tuck_corners(body, k),
    };
    local.map(|corner| body.to_input(&corner))
}

/// The hinge of a flap or tuck flap; sides and base have none.
pub fn hinge(body: &FittedBody, role: Role) -> Option<FittedHinge> {
    let (k, toward_end, position_rad) = match role {
        Role::Flap(k) => (k, 1.0, body.get(layout::flap(k) + FLAP_ANGLE)),
        Role::Tuck(k) => (k, -1.0, body.get(layout::tuck(k) + TUCK_ANGLE)),
        Role::Base | Role::Side(_) => return None,
    };
    let [start, end, ..] = corners(body, role);
    let (along, _) = Rim::new(body, k).directions();
    Some(FittedHinge { origin: (start + end) / 2.0, axis: body.input_from_object * along * toward_end, position_rad })
}

fn base_corners(body: &FittedBody) -> [Vec3; 4] {
    let middle = body.get(THICKNESS) / 2.0 - body.get(HEIGHT);
    [0, 1, 2, 3].map(|k| Rim::new(body, k).place(-body.edge_m(k) / 2.0, 0.0, middle))
}

fn side_corners(body: &FittedBody, k: usize) -> [Vec3; 4] {
    let (rim, half) = (Rim::new(body, k), body.edge_m(k) / 2.0);
    let bottom = body.get(THICKNESS) / 2.0 - body.get(HEIGHT);
    [rim.place(-half, 0.0, 0.0), rim.place(half, 0.0, 0.0), rim.place(half, 0.0, bottom), rim.place(-half, 0.0, bottom)]
}

/// Of the flat flap along the tangent at its hinge.
fn flap_corners(body: &FittedBody, k: usize) -> [Vec3; 4] {
    let of = |place: usize| body.get(layout::flap(k) + place);
    let (sin, cos) = of(FLAP_ANGLE).sin_cos();
    let (offset, half) = (of(FLAP_OFFSET), of(FLAP_WIDTH) / 2.0);
    let (rim, free_half) = (Rim::new(body, k), half - of(FLAP_TAPER));
    let (inward, above) = (cos * of(FLAP_LENGTH), sin * of(FLAP_LENGTH));
    [
        rim.place(offset - half, 0.0, 0.0),
        rim.place(offset + half, 0.0, 0.0),
        rim.place(offset + free_half, inward, above),
        rim.place(offset - free_half, inward, above),
    ]
}

/// Where flap `k` ends, bent or not, in its rim's frame: inward, above.
pub fn flap_end(body: &FittedBody, k: usize) -> [f64; 2] {
    let of = |place: usize| body.get(layout::flap(k) + place);
    FlapSection::new(of(FLAP_ANGLE), of(FLAP_LENGTH), of(FLAP_CURL)).end_at_rim().into()
}

/// From where the flap really ends, bent or not.
fn tuck_corners(body: &FittedBody, k: usize) -> [Vec3; 4] {
    let of = |place: usize| body.get(layout::flap(k) + place);
    let own = |place: usize| body.get(layout::tuck(k) + place);
    let [inward, above] = flap_end(body, k);
    let (sin, cos) = (of(FLAP_ANGLE) - own(TUCK_ANGLE)).sin_cos();
    let (offset, half) = (of(FLAP_OFFSET), own(TUCK_WIDTH) / 2.0);
    let (rim, length) = (Rim::new(body, k), own(TUCK_LENGTH));
    let free = (inward + cos * length, above + sin * length);
    [
        rim.place(offset - half, inward, above),
        rim.place(offset + half, inward, above),
        rim.place(offset + half, free.0, free.1),
        rim.place(offset - half, free.0, free.1),
    ]
}
