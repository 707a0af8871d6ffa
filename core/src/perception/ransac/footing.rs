use super::super::PerceptionSettings;
use super::components::{components, NONE};
use super::ring::{ring, to_cell, Cell2};
use super::surfels::Surfels;
use crate::geometry::{convex_hull, hull_contains, Plane, PlaneFrame, Point2, Vec3};
use std::collections::HashSet;
use std::hash::{BuildHasherDefault, Hasher};

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
/// Of a cell and its eight neighbours, those that must be ground amid ground: at its edge six are, and middles of cells
/// that do not lie in a lattice leave some empty.
const MIN_AMID: usize = 7;
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

/// Only asked for members, never walked in order: what the hash does, no answer shows.
type CellSet = HashSet<Cell2, BuildHasherDefault<CellHasher>>;

/// Multiplies and turns: cells are near one another, and the standard hash is made for strangers.
#[derive(Default)]
struct CellHasher(u64);

impl Hasher for CellHasher {
    fn write(&mut self, bytes: &[u8]) {
        bytes.iter().for_each(|&b| self.write_i32(i32::from(b)));
    }

    fn write_i32(&mut self, value: i32) {
        self.0 = (self.0.rotate_left(26) ^ u64::from(value as u32)).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    }

    fn write_usize(&mut self, _: usize) {}

    fn finish(&self) -> u64 {
        self.0
    }
}

/// Looks at a plane as a support: `on` are its own surfels, `room` those of planes too large to be a thing's.
pub fn footing(surfels: &Surfels, settings: &PerceptionSettings, plane: Plane, on: &[u32], room: &[bool]) -> Footing {
    let cell_m = surfels.cell_m;
    let frame = PlaneFrame::new(&plane, &surfels.centers[on[0] as usize]);
    let height: Vec<f64> = surfels.centers.iter().map(|c| plane.height_of(c)).collect();
    let cell_of = |s: usize| to_cell(&frame.to_plane(&surfels.centers[s]), cell_m);
    let ground: CellSet = on.iter().map(|&s| cell_of(s as usize)).collect();
    let over_ground = |s: usize| ground.contains(&cell_of(s));
    let is_above =
        |s: usize| height[s] > ABOVE_TOLERANCES * surfels.tolerance_m[s] && height[s] < settings.tallest_thing_m;
    let things = standing_things(surfels, settings, &height, &|s| is_above(s) && !room[s]);
    let mut footing = Footing {
        plane,
        ground_cells: ground.len(),
        cell_m,
        free_cells: 0,
        standing: 0.0,
        upright_share: None,
        above: (0..surfels.len()).filter(|&s| is_above(s) && over_ground(s)).count(),
        below: (0..surfels.len())
            .filter(|&s| height[s] < -ABOVE_TOLERANCES * surfels.tolerance_m[s] && over_ground(s))
            .count(),
    };
    let mut outlines = Vec::new();
    let (mut upright, mut oriented) = (0usize, 0usize);
    for thing in &things {
        let footprint: Vec<Point2> = thing.iter().map(|&s| frame.to_plane(&surfels.centers[s])).collect();
        if extent(&footprint) > LARGEST_HEAP * settings.largest_thing_m {
            continue;
        }
        outlines.push(convex_hull(&footprint));
        let share = ring_share(&footprint, cell_m, &ground);
        if share >= MIN_RING_SHARE {
            footing.standing += share * thing.len() as f64;
        }
        let normals = thing.iter().map(|&s| surfels.normals[s]).filter(|n| *n != Vec3::zeros());
        oriented += normals.clone().count();
        upright += normals.filter(|n| n.dot(&plane.normal).abs() < UPRIGHT_SINE).count();
    }
    footing.upright_share = (oriented > 0).then(|| upright as f64 / oriented as f64);
    footing.free_cells = free_cells(&ground, &outlines, cell_m);
    footing
}

/// Connected surfels above the plane that begin at it.
fn standing_things(
    surfels: &Surfels,
    settings: &PerceptionSettings,
    height: &[f64],
    is_thing: &dyn Fn(usize) -> bool,
) -> Vec<Vec<usize>> {
    let (component, count) = components(&surfels.neighbours, is_thing);
    let mut things = vec![Vec::new(); count];
    for (s, &c) in component.iter().enumerate().filter(|(_, &c)| c != NONE) {
        things[c as usize].push(s);
    }
    let reach = TOUCHING_CELLS * surfels.cell_m.max(settings.cluster_gap_m);
    things.retain(|thing| thing.len() >= MIN_THING_SITES && thing.iter().any(|&s| height[s] < reach));
    things
}

/// Of the cells around the footprint, the share that is ground.
fn ring_share(footprint: &[Point2], cell_m: f64, ground: &CellSet) -> f64 {
    let ring = ring(footprint, cell_m);
    let shown = ring.iter().filter(|cell| ground.contains(*cell)).count();
    shown as f64 / ring.len().max(1) as f64
}

/// Number of surfels behind the plane whose line of sight crosses it amid its own readings.
pub fn seen_through(surfels: &Surfels, on: &[u32], plane: &Plane, viewpoint: &Vec3) -> usize {
    let cell_m = surfels.cell_m;
    let frame = PlaneFrame::new(plane, &surfels.centers[on[0] as usize]);
    let ground: CellSet = on.iter().map(|&s| to_cell(&frame.to_plane(&surfels.centers[s as usize]), cell_m)).collect();
    let around = |[x, y]: Cell2| (0..9).filter(|step| ground.contains(&[x + step % 3 - 1, y + step / 3 - 1])).count();
    let amid = |cell: Cell2| around(cell) >= MIN_AMID;
    let eye_m = plane.height_of(viewpoint);
    let crosses = |s: usize| {
        let height_m = plane.height_of(&surfels.centers[s]);
        let behind = height_m * eye_m.signum() < -3.0 * surfels.tolerance_m[s];
        let at = viewpoint + (surfels.centers[s] - viewpoint) * (eye_m / (eye_m - height_m));
        behind && amid(to_cell(&frame.to_plane(&at), cell_m))
    };
    (0..surfels.len()).filter(|&s| crosses(s)).count()
}

fn free_cells(ground: &CellSet, outlines: &[Vec<Point2>], cell_m: f64) -> usize {
    let center = |c: &Cell2| [(f64::from(c[0]) + 0.5) * cell_m, (f64::from(c[1]) + 0.5) * cell_m];
    let bounds: Vec<[Point2; 2]> = outlines.iter().map(|hull| bounds(hull, cell_m)).collect();
    let covers = |k: usize, p: &Point2| {
        let [low, high] = bounds[k];
        let near = p[0] >= low[0] && p[1] >= low[1] && p[0] <= high[0] && p[1] <= high[1];
        near && hull_contains(&outlines[k], p, -cell_m)
    };
    ground.iter().filter(|c| !(0..outlines.len()).any(|k| covers(k, &center(c)))).count()
}

/// Lowest and highest corner around the points and this much more.
fn bounds(points: &[Point2], margin_m: f64) -> [Point2; 2] {
    let low = |k: usize| points.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min) - margin_m;
    let high = |k: usize| points.iter().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max) + margin_m;
    [[low(0), low(1)], [high(0), high(1)]]
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
