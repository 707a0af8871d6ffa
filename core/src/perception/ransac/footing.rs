use super::super::PerceptionSettings;
use super::components::{components, NONE};
use super::sites::Sites;
use crate::geometry::{convex_hull, hull_contains, Plane, PlaneFrame, Point2, Vec3};
use std::collections::HashSet;

/// Things that stand on a plane begin within this many cells of it.
const TOUCHING_CELLS: f64 = 1.5;
/// What is above a plane is so by this many tolerances.
const ABOVE_TOLERANCES: f64 = 1.5;
/// A heap of things reaches no farther than this many of the largest.
const LARGEST_HEAP: f64 = 2.0;
/// Cells of one standing thing, at least.
const MIN_THING_SITES: usize = 6;
/// Of the cells around a thing's footprint, the share that must show the plane.
const MIN_RING_SHARE: f64 = 0.2;
/// Surfaces within this of upright: sine of the angle.
const UPRIGHT_SINE: f64 = 0.2;

/// What speaks for a plane as the one that things stand on; its normal is the upward direction in question.
#[derive(Debug, Clone)]
pub struct Footing {
    pub plane: Plane,
    /// Cells of ground, and of these the ones that no thing's outline covers.
    pub ground_cells: usize,
    /// Side of a cell, metres.
    pub cell_m: f64,
    pub free_cells: usize,
    /// Cells of things that stand on it, each thing counted by the share of ground around it.
    pub standing: f64,
    /// Share of the surfaces of things that touch it that is upright; `None` where no thing does.
    pub upright_share: Option<f64>,
    /// Cells above and below that lie over the ground.
    pub above: usize,
    pub below: usize,
}

/// Integer coordinates of a footprint cell.
type Cell2 = [i32; 2];

/// Looks at a plane as a support: `on` are its own sites, `room` those of planes too large to be a thing's.
pub fn footing(sites: &Sites, settings: &PerceptionSettings, plane: Plane, on: &[u32], room: &[bool]) -> Footing {
    let cell_m = sites.voxels.size_m;
    let frame = PlaneFrame::new(&plane, &sites.centers[on[0] as usize]);
    let height: Vec<f64> = sites.centers.iter().map(|c| plane.height_of(c)).collect();
    let cell_of = |s: usize| to_cell(&frame.to_plane(&sites.centers[s]), cell_m);
    let ground: HashSet<Cell2> = on.iter().map(|&s| cell_of(s as usize)).collect();
    let over_ground = |s: usize| ground.contains(&cell_of(s));
    let is_above =
        |s: usize| height[s] > ABOVE_TOLERANCES * sites.tolerance_m[s] && height[s] < settings.tallest_thing_m;
    let things = standing_things(sites, settings, &height, &|s| is_above(s) && !room[s]);
    let mut footing = Footing {
        plane,
        ground_cells: ground.len(),
        cell_m,
        free_cells: 0,
        standing: 0.0,
        upright_share: None,
        above: (0..sites.len()).filter(|&s| is_above(s) && over_ground(s)).count(),
        below: (0..sites.len())
            .filter(|&s| height[s] < -ABOVE_TOLERANCES * sites.tolerance_m[s] && over_ground(s))
            .count(),
    };
    let mut outlines = Vec::new();
    let (mut upright, mut oriented) = (0usize, 0usize);
    for thing in &things {
        let footprint: Vec<Point2> = thing.iter().map(|&s| frame.to_plane(&sites.centers[s])).collect();
        if extent(&footprint) > LARGEST_HEAP * settings.largest_thing_m {
            continue;
        }
        outlines.push(convex_hull(&footprint));
        let share = ring_share(&footprint, cell_m, &ground);
        if share >= MIN_RING_SHARE {
            footing.standing += share * thing.len() as f64;
        }
        let normals = thing.iter().map(|&s| sites.normals[s]).filter(|n| *n != Vec3::zeros());
        oriented += normals.clone().count();
        upright += normals.filter(|n| n.dot(&plane.normal).abs() < UPRIGHT_SINE).count();
    }
    footing.upright_share = (oriented > 0).then(|| upright as f64 / oriented as f64);
    footing.free_cells = free_cells(&ground, &outlines, cell_m);
    footing
}

/// Connected sites above the plane that begin at it.
fn standing_things(
    sites: &Sites,
    settings: &PerceptionSettings,
    height: &[f64],
    is_thing: &dyn Fn(usize) -> bool,
) -> Vec<Vec<usize>> {
    let (component, count) = components(&sites.neighbours, is_thing);
    let mut things = vec![Vec::new(); count];
    for (s, &c) in component.iter().enumerate().filter(|(_, &c)| c != NONE) {
        things[c as usize].push(s);
    }
    let reach = TOUCHING_CELLS * sites.voxels.size_m.max(settings.cluster_gap_m);
    things.retain(|thing| thing.len() >= MIN_THING_SITES && thing.iter().any(|&s| height[s] < reach));
    things
}

/// Of the cells within two of the footprint, the share that is ground.
fn ring_share(footprint: &[Point2], cell_m: f64, ground: &HashSet<Cell2>) -> f64 {
    let covered: HashSet<Cell2> = footprint.iter().map(|p| to_cell(p, cell_m)).collect();
    let mut seen = covered.clone();
    let (mut ring, mut shown) = (0usize, 0usize);
    for p in footprint {
        let [x, y] = to_cell(p, cell_m);
        for step in 0..25 {
            let cell = [x + step % 5 - 2, y + step / 5 - 2];
            if seen.insert(cell) {
                ring += 1;
                shown += usize::from(ground.contains(&cell));
            }
        }
    }
    shown as f64 / ring.max(1) as f64
}

/// Number of sites behind the plane whose line of sight crosses it amid its own readings.
pub fn seen_through(sites: &Sites, on: &[u32], plane: &Plane, viewpoint: &Vec3) -> usize {
    let cell_m = sites.voxels.size_m;
    let frame = PlaneFrame::new(plane, &sites.centers[on[0] as usize]);
    let ground: HashSet<Cell2> =
        on.iter().map(|&s| to_cell(&frame.to_plane(&sites.centers[s as usize]), cell_m)).collect();
    let amid = |[x, y]: Cell2| (0..9).all(|step| ground.contains(&[x + step % 3 - 1, y + step / 3 - 1]));
    let eye_m = plane.height_of(viewpoint);
    let crosses = |s: usize| {
        let height_m = plane.height_of(&sites.centers[s]);
        let behind = height_m * eye_m.signum() < -3.0 * sites.tolerance_m[s];
        let at = viewpoint + (sites.centers[s] - viewpoint) * (eye_m / (eye_m - height_m));
        behind && amid(to_cell(&frame.to_plane(&at), cell_m))
    };
    (0..sites.len()).filter(|&s| crosses(s)).count()
}

fn free_cells(ground: &HashSet<Cell2>, outlines: &[Vec<Point2>], cell_m: f64) -> usize {
    let center = |c: &Cell2| [(f64::from(c[0]) + 0.5) * cell_m, (f64::from(c[1]) + 0.5) * cell_m];
    ground.iter().filter(|c| !outlines.iter().any(|hull| hull_contains(hull, &center(c), -cell_m))).count()
}

fn to_cell(p: &Point2, cell_m: f64) -> Cell2 {
    [(p[0] / cell_m).floor() as i32, (p[1] / cell_m).floor() as i32]
}

/// Diagonal of the axis-parallel bounds, metres.
pub fn extent(points: &[Point2]) -> f64 {
    let spread = |k: usize| {
        let all = points.iter().map(|p| p[k]);
        all.clone().fold(f64::NEG_INFINITY, f64::max) - all.fold(f64::INFINITY, f64::min)
    };
    if points.is_empty() {
        0.0
    } else {
        spread(0).hypot(spread(1))
    }
}
