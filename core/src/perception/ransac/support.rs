//! Which way is up, and on which plane the things stand.

use super::super::readings::Readings;
use super::super::PerceptionSettings;
use super::draws::SitePlane;
use super::footing::{footing, seen_through, Footing};
use super::scene_planes::ScenePlanes;
use super::surfels::Surfels;
use crate::error::{InputError, Result};
use crate::geometry::{Plane, Vec3};

/// A plane of which less is free is the bottom of a container, not the ground around one.
const MIN_FREE_SHARE: f64 = 0.2;
/// Fewer cells of standing things than this say nothing.
const MIN_STANDING: f64 = 8.0;
/// Cells of standing things that are enough; more make no better ground.
const ENOUGH_STANDING: f64 = 30.0;
/// How fast a plane loses worth as its normal turns down in the image.
const UPSIDE_DOWN_RATE: f64 = 8.0;
/// How fast it does as its normal turns sideways in the image, beyond this much of it.
const SIDEWAYS_RATE: f64 = 2.0;
const MAX_SIDEWAYS: f64 = 0.3;
/// A table is as level as the floor (within 2 degrees: a flap that hangs level by chance seldom is), this high over it, and shows
/// this much around its things.
const TABLE_LEVEL_COSINE: f64 = 0.9994;
const MIN_TABLE_HEIGHT_M: f64 = 0.35;
const MIN_TABLE_M2: f64 = 0.15;
/// Of what stands on a table so much lies over it: beside a closed lid flaps begin, and lean away.
const MIN_OVER_TABLE: f64 = 0.25;
/// Where nothing is seen to stand on it, so many times more lies over a table than beside it below: the top of a box has its flaps
/// there.
const MIN_OVER_BELOW: f64 = 4.0;
/// Cells behind the support's own readings that may be seen through holes, and how many times those above it they are
/// where it is seen from the wrong side.
const MIN_THROUGH: usize = 12;
const THROUGH_FACTOR: usize = 2;
/// Two planes with no thing on them are both plausible where the lesser has this share of the other's worth.
const RIVAL_SHARE: f64 = 0.5;
/// A plane on which nothing stands is no support where it has less than this share of the largest one's cells.
const MIN_BARE_SHARE: f64 = 0.1;
/// How strongly upright surroundings speak for a plane on which nothing stands.
const CONTAINER_POWER: i32 = 4;
/// Things tell the side of a plane where they have this share of its cells.
const CLEARLY_ONE_SIDED: f64 = 0.2;
/// The origin tells the side of a plane from this distance, metres.
const CLEARLY_OFF_M: f64 = 0.2;

/// The ground of a scene.
#[derive(Debug, Clone)]
pub struct Ground {
    pub up: Vec3,
    /// `None` where the cloud shows none.
    pub support: Option<Plane>,
    /// Number of the plane that up was read from, among those of the scene.
    pub chosen: Option<usize>,
    /// Planes too large to belong to a thing (walls of the room), without the support.
    pub room: Vec<Plane>,
    pub warnings: Vec<String>,
}

/// Finds up, the support and the walls of the room.
///
/// # Errors
/// `InputError` where several directions are plausible, or the support is seen from below.
pub fn find_ground(
    readings: &mut Readings,
    indices: &[u32],
    organized: bool,
    settings: &PerceptionSettings,
) -> Result<Ground> {
    let scene = ScenePlanes::find(readings, indices, settings);
    let seen = SeenPlanes { surfels: &scene.sites.surfels, planes: &scene.planes, is_large: &scene.is_large };
    let refit = |k: usize, plane: &Plane| scene.refit(readings, k, plane);
    ground_among(&seen, refit, readings.viewpoint.as_ref(), organized, settings)
}

/// Planes of a scene, and the surface patches around them.
pub struct SeenPlanes<'a> {
    pub surfels: &'a Surfels,
    pub planes: &'a [SitePlane],
    /// Whether each plane is too large to be a thing's.
    pub is_large: &'a [bool],
}

impl SeenPlanes<'_> {
    /// Of each patch, whether it lies on a plane too large to be a thing's.
    fn in_room(&self) -> Vec<bool> {
        let mut marked = vec![false; self.surfels.len()];
        let large = self.planes.iter().zip(self.is_large).filter(|(_, &l)| l);
        large.flat_map(|(p, _)| &p.sites).for_each(|&s| marked[s as usize] = true);
        marked
    }
}

/// The ground among planes that are known; `refit` makes the chosen one's plane precise.
///
/// # Errors
/// As of `find_ground`.
pub fn ground_among(
    seen: &SeenPlanes,
    refit: impl Fn(usize, &Plane) -> Plane,
    viewpoint: Option<&Vec3>,
    organized: bool,
    settings: &PerceptionSettings,
) -> Result<Ground> {
    let candidates = footings(seen, settings, viewpoint);
    let is_whole = |(index, footing): &(usize, Footing)| {
        viewpoint.is_none_or(|viewpoint| !is_seen_through(viewpoint, seen, *index, footing))
    };
    let Some((chosen, footing)) = choose(&candidates, organized, settings, viewpoint.is_some(), is_whole)? else {
        return Ok(no_plane(organized, settings));
    };
    let plane = refit(chosen, &footing.plane);
    refuse_from_below(viewpoint, seen, chosen, &Footing { plane, ..footing.clone() }, settings)?;
    let is_ground = footing.free_cells as f64 >= MIN_FREE_SHARE * footing.ground_cells as f64;
    let is_room = |&p: &usize| p != chosen && seen.is_large[p];
    let room = (0..seen.planes.len()).filter(is_room).map(|p| seen.planes[p].plane).collect();
    let support = is_ground.then_some(plane);
    Ok(Ground { up: plane.normal, support, chosen: Some(chosen), room, warnings: vec![] })
}

/// Every plane with every upward direction that is possible: towards the viewpoint, within reach of a given `up`, else both.
fn footings(seen: &SeenPlanes, settings: &PerceptionSettings, viewpoint: Option<&Vec3>) -> Vec<(usize, Footing)> {
    let in_room = seen.in_room();
    let mut all = Vec::new();
    for (index, found) in seen.planes.iter().enumerate().filter(|(_, f)| !f.sites.is_empty()) {
        for plane in [found.plane, found.plane.flipped()] {
            let faces = viewpoint.is_none_or(|v| plane.height_of(v) > 0.0);
            let wanted = match settings.up {
                Some(up) => plane.normal.dot(&up.normalize()) >= settings.up_tolerance_rad.cos(),
                None => faces,
            };
            if wanted {
                all.push((index, footing(seen.surfels, settings, plane, &found.sites, &in_room)));
            }
        }
    }
    all
}

/// The best of the planes on which things stand; where nothing stands on any, the one plane that is largest.
fn choose(
    candidates: &[(usize, Footing)],
    organized: bool,
    settings: &PerceptionSettings,
    has_viewpoint: bool,
    is_whole: impl Fn(&(usize, Footing)) -> bool,
) -> Result<Option<(usize, Footing)>> {
    let most = candidates.iter().map(|(_, f)| f.standing).fold(0.0, f64::max);
    if most >= MIN_STANDING {
        let best = best_by(candidates.iter(), |f| bearing_worth(f, organized));
        return Ok(best.map(|floor| table_on(floor, candidates, &is_whole).clone()));
    }
    let side = |f: &Footing| if has_viewpoint || settings.up.is_some() { 1.0 } else { side_worth(f) };
    // Around a container's base every wall is upright; around one of its walls the opposite wall is not.
    let upright = |f: &Footing| f.upright_share.map_or(1.0, |share| share.powi(CONTAINER_POWER));
    let largest = candidates.iter().map(|(_, f)| f.ground_cells).max().unwrap_or(0) as f64;
    let is_large = |f: &Footing| f.ground_cells as f64 >= MIN_BARE_SHARE * largest;
    let bare = |f: &Footing| match is_large(f) {
        true => f.ground_cells as f64 * prior(f, organized) * side(f) * upright(f),
        false => 0.0,
    };
    let Some(best) = best_by(candidates.iter(), bare) else { return Ok(None) };
    if settings.up.is_none() && !organized {
        refuse_rivals(candidates, best, bare)?;
    }
    Ok(Some(table_on(best, candidates, &is_whole).clone()))
}

fn best_by<'a>(
    candidates: impl Iterator<Item = &'a (usize, Footing)>,
    worth: impl Fn(&Footing) -> f64,
) -> Option<&'a (usize, Footing)> {
    candidates.fold(None, |best: Option<&(usize, Footing)>, c| match best {
        Some(b) if worth(&b.1) >= worth(&c.1) => Some(b),
        _ => Some(c),
    })
}

/// Free ground, more where things stand on it with upright sides; many things count no more than a few.
fn bearing_worth(footing: &Footing, organized: bool) -> f64 {
    let ground = 0.7 * footing.free_cells as f64 + 0.3 * footing.ground_cells as f64;
    let bears = 0.1 + (footing.standing / ENOUGH_STANDING).min(1.0);
    let upright = 0.3 + footing.upright_share.unwrap_or(0.5);
    ground * bears * upright * prior(footing, organized)
}

/// A camera seldom hangs upside down or on its side: in its image (y down) a floor's normal points neither down nor sideways. A
/// wall's does where the camera looks down on the scene, or along the wall.
fn prior(footing: &Footing, organized: bool) -> f64 {
    if !organized {
        return 1.0;
    }
    let downwards = (footing.plane.normal.y - 0.05).max(0.0);
    let sideways = (footing.plane.normal.x.abs() - MAX_SIDEWAYS).max(0.0);
    (-UPSIDE_DOWN_RATE * downwards - SIDEWAYS_RATE * sideways).exp()
}

/// Whether things stand on a plane, or lie over it: from straight above none of their sides is seen.
fn bears(footing: &Footing) -> bool {
    let above = footing.above as f64;
    let is_stood_on = footing.standing >= MIN_STANDING && above >= MIN_OVER_TABLE * footing.standing;
    is_stood_on || above >= MIN_STANDING.max(MIN_OVER_BELOW * footing.below as f64)
}

/// The highest table that bears things over the floor, else the floor itself. Level flaps around a box's opening are none: they are
/// not whole.
fn table_on<'a>(
    floor: &'a (usize, Footing),
    candidates: &'a [(usize, Footing)],
    is_whole: impl Fn(&(usize, Footing)) -> bool,
) -> &'a (usize, Footing) {
    let height_m = |f: &Footing| f.plane.distance - floor.1.plane.distance;
    let is_table = |(_, f): &&(usize, Footing)| {
        f.plane.normal.dot(&floor.1.plane.normal) > TABLE_LEVEL_COSINE
            && height_m(f) > MIN_TABLE_HEIGHT_M
            && bears(f)
            && f.free_cells as f64 * f.cell_m.powi(2) > MIN_TABLE_M2
    };
    let tables = candidates.iter().filter(is_table).filter(|table| is_whole(table));
    tables.fold(floor, |best, t| if height_m(&t.1) > height_m(&best.1) { t } else { best })
}

/// Which side of a bare plane is up, without a viewpoint: where things are, else the origin's, else the side of +z.
fn side_worth(footing: &Footing) -> f64 {
    let things = (footing.above as f64 - footing.below as f64) / footing.ground_cells.max(1) as f64;
    let origin_m = -footing.plane.distance;
    let side = if things.abs() > CLEARLY_ONE_SIDED {
        things.signum()
    } else if origin_m.abs() > CLEARLY_OFF_M {
        origin_m.signum()
    } else {
        footing.plane.normal.z
    };
    1.0 + 0.9 * side
}

fn refuse_rivals(
    candidates: &[(usize, Footing)],
    best: &(usize, Footing),
    worth: impl Fn(&Footing) -> f64,
) -> Result<()> {
    let is_rival = |(index, f): &&(usize, Footing)| {
        let leans = f.plane.normal.dot(&best.1.plane.normal).abs() < 0.9;
        *index != best.0 && leans && worth(f) > RIVAL_SHARE * worth(&best.1)
    };
    if candidates.iter().any(|c| is_rival(&c) && best.1.plane.normal.z < 0.9) {
        return Err(InputError::new("several planes could be the support and nothing stands on any of them")
            .mend("name the direction away from the support with --up x,y,z"));
    }
    Ok(())
}

/// Whether more is seen behind a plane's readings than before them.
fn is_seen_through(viewpoint: &Vec3, seen: &SeenPlanes, index: usize, footing: &Footing) -> bool {
    let through = seen_through(seen.surfels, &seen.planes[index].sites, &footing.plane, viewpoint);
    through >= MIN_THROUGH && through >= THROUGH_FACTOR * footing.above
}

/// Refuses a support that the sensor would have had to see through: more lies behind its readings than before them.
fn refuse_from_below(
    viewpoint: Option<&Vec3>,
    seen: &SeenPlanes,
    chosen: usize,
    footing: &Footing,
    settings: &PerceptionSettings,
) -> Result<()> {
    let Some(viewpoint) = viewpoint else { return Ok(()) };
    let from_above = footing.plane.height_of(viewpoint) > 0.0;
    if from_above && !is_seen_through(viewpoint, seen, chosen, footing) {
        return Ok(());
    }
    let mend = if settings.up.is_some() {
        "the given up may point down: --up is the direction away from the support; turn it round or leave it out"
    } else {
        "if the cloud has y up and z backwards, say --frame opengl"
    };
    Err(InputError::new("the support plane's visible face looks away from the viewpoint").mend(mend))
}

/// Up where the cloud has no plane at all: as told, else as such a cloud is usually held, with a warning.
fn no_plane(organized: bool, settings: &PerceptionSettings) -> Ground {
    let (up, name) = match (settings.up, organized) {
        (Some(up), _) => (up.normalize(), "as given, check it"),
        (None, true) => (-Vec3::y(), "-y, an upright camera's"),
        (None, false) => (Vec3::z(), "+z"),
    };
    let square = if settings.up.is_some() { " square to it" } else { "" };
    let warnings = vec![format!("no plane{square} to stand on was found; up is {name}")];
    Ground { up, support: None, chosen: None, room: vec![], warnings }
}
