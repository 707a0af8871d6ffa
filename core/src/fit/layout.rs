//! Which number of the parameter vector is what. The first six are a small motion of the object in its own frame.

/// Turn about x, y, z (rad), then shift along them (m), object's frame.
pub const TURN: usize = 0;
pub const SHIFT: usize = 3;
pub const POSE_COUNT: usize = 6;

pub const LENGTH: usize = 6;
pub const WIDTH: usize = 7;
pub const HEIGHT: usize = 8;
/// By how much the base's corners are off square, rad: positive leans the width's direction towards +x.
pub const RACK: usize = 9;
pub const THICKNESS: usize = 10;
pub const BULGE: usize = 11;
const FLAP: usize = 15;
const TUCK: usize = 39;
pub const PARAMETER_COUNT: usize = 51;

/// How far the middle of side `k` stands out, m.
pub const fn bulge(k: usize) -> usize {
    BULGE + k
}

/// The first of the numbers of flap `k`; those below are counted from there.
pub const fn flap(k: usize) -> usize {
    FLAP + FLAP_COUNT * k
}

/// From hinge to free edge along the board, m.
pub const FLAP_LENGTH: usize = 0;
/// Along the hinge, m.
pub const FLAP_WIDTH: usize = 1;
/// By how much each end of the free edge is drawn in, m.
pub const FLAP_TAPER: usize = 2;
/// Of the hinge's middle from the middle of its side, along the side, m.
pub const FLAP_OFFSET: usize = 3;
/// Of the tangent at the hinge, rad.
pub const FLAP_ANGLE: usize = 4;
/// Curvature, 1/m; positive opens further.
pub const FLAP_CURL: usize = 5;
pub const FLAP_COUNT: usize = 6;

/// The first of the numbers of the tuck flap on flap `k`.
pub const fn tuck(k: usize) -> usize {
    TUCK + TUCK_COUNT * k
}

pub const TUCK_ANGLE: usize = 0;
pub const TUCK_LENGTH: usize = 1;
pub const TUCK_WIDTH: usize = 2;
pub const TUCK_COUNT: usize = 3;

/// What a reading of side, flap or tuck `k` can depend on: the numbers that all parts share, then those of its own.
pub const SLOT_COUNT: usize = 21;
pub const SLOT_BULGE: usize = 11;
pub const SLOT_FLAP: usize = 12;
pub const SLOT_TUCK: usize = SLOT_FLAP + FLAP_COUNT;

/// The place in the parameter vector of a slot of part `k`.
pub const fn place_of_slot(slot: usize, k: usize) -> usize {
    if slot < SLOT_BULGE {
        slot
    } else if slot == SLOT_BULGE {
        bulge(k)
    } else if slot < SLOT_TUCK {
        flap(k) + slot - SLOT_FLAP
    } else {
        tuck(k) + slot - SLOT_TUCK
    }
}

/// What `model.json` calls the parameters that tell the shape; angles of flaps are positions of joints.
pub fn shape_names() -> Vec<(usize, String)> {
    let mut names: Vec<(usize, String)> =
        [(LENGTH, "length"), (WIDTH, "width"), (HEIGHT, "height"), (RACK, "rack"), (THICKNESS, "thickness")]
            .map(|(place, name)| (place, name.to_owned()))
            .to_vec();
    names.extend((0..4).map(|k| (bulge(k), format!("side_{k}_bulge"))));
    names
}

/// What `model.json` calls the lean of side `k`'s own readings.
pub fn lean_name(k: usize) -> String {
    format!("side_{k}_lean")
}

pub fn flap_names(k: usize) -> Vec<(usize, String)> {
    let own = [
        (FLAP_LENGTH, "length"),
        (FLAP_WIDTH, "width"),
        (FLAP_TAPER, "taper"),
        (FLAP_OFFSET, "offset"),
        (FLAP_CURL, "curl"),
    ];
    own.map(|(place, name)| (flap(k) + place, format!("flap_{k}_{name}"))).to_vec()
}

pub fn tuck_names(k: usize) -> Vec<(usize, String)> {
    [(TUCK_LENGTH, "length"), (TUCK_WIDTH, "width")].map(|(p, name)| (tuck(k) + p, format!("tuck_{k}_{name}"))).to_vec()
}
