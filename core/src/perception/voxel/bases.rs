use super::super::ransac::SupportBand;
use super::super::readings::Readings;
use super::super::segment::Segment;
use super::super::PerceptionSettings;
use super::surfaces::{Surface, Surfaces};
use super::things::Role;
use super::voxels::{Voxels, NONE};
use crate::cloud::CloudView;
use crate::geometry::{convex_hull, hull_contains, Plane, PlaneFrame, Point2, Vec3};

/// Upright surfaces without which nothing is enclosed.
const MIN_WALLS: usize = 2;
/// So many of them surround a base; what a flap hangs over lies outside.
const SURROUNDING_WALLS: usize = 3;

/// A base is level (cosine of 15 degrees) and so many voxels wide: less is the foot of a wall.
const LEVEL_COSINE: f64 = 0.966;
const MIN_WIDTH_VOXELS: f64 = 4.0;

/// A voxel at the support's height that belongs to no thing, and its place on the support.
struct Low {
    voxel: u32,
    place: Point2,
}

/// Gives each thing the voxels at the support's height that its walls enclose (eq. 33), as a surface of its own.
///
/// `readings` are the voxels' middles. The new surfaces come last, with the group that encloses them.
pub fn add_bases(
    surfaces: &mut Surfaces,
    voxels: &Voxels,
    readings: &Readings,
    support: &Plane,
    roles: &mut Vec<Role>,
    groups: &mut Vec<usize>,
    settings: &PerceptionSettings,
) {
    let of_voxels = voxels.settings(settings);
    let frame = PlaneFrame::new(support, &readings.point(0));
    let low = low_voxels(surfaces, readings, &frame, support, roles, settings);
    for thing in walled_things(surfaces, roles, groups, &support.normal, settings) {
        let local = around(&thing, surfaces, readings, &frame, &low, settings);
        for (base, plane) in bases_of(&thing, &local, surfaces, voxels, readings, support, &of_voxels) {
            let base = Surface::of(voxels, base, &voxels.plane_inside(&plane));
            let is_level = base.plane.normal.dot(&support.normal).abs() > LEVEL_COSINE;
            if !is_level || base.sides_m()[1] < MIN_WIDTH_VOXELS * voxels.size_m {
                continue;
            }
            surfaces.claim(voxels, base);
            roles.push(Role::Thing);
            groups.push(thing[0]);
        }
    }
}

fn low_voxels(
    surfaces: &Surfaces,
    readings: &Readings,
    frame: &PlaneFrame,
    support: &Plane,
    roles: &[Role],
    settings: &PerceptionSettings,
) -> Vec<Low> {
    let is_free = |v: &u32| {
        let owner = surfaces.owner[*v as usize];
        owner == NONE || roles[owner as usize] == Role::Support
    };
    let all = (0..surfaces.owner.len() as u32).filter(is_free).map(|voxel| (voxel, readings.point(voxel)));
    let low = all.filter(|(_, p)| support.height_of(p).abs() <= settings.base_band_m.max(readings.tolerance_m(p)));
    low.map(|(voxel, p)| Low { voxel, place: frame.to_plane(&p) }).collect()
}

/// The surfaces of each thing that has walls, first surface first.
fn walled_things(
    surfaces: &Surfaces,
    roles: &[Role],
    groups: &[usize],
    up: &Vec3,
    settings: &PerceptionSettings,
) -> Vec<Vec<usize>> {
    let mut things: Vec<Vec<usize>> = vec![Vec::new(); groups.len()];
    for s in (0..groups.len()).filter(|&s| roles[s] == Role::Thing) {
        things[groups[s]].push(s);
    }
    things.retain(|thing| walls(thing, surfaces, up, settings).len() >= MIN_WALLS);
    things
}

fn walls(thing: &[usize], surfaces: &Surfaces, up: &Vec3, settings: &PerceptionSettings) -> Vec<usize> {
    let is_wall = |s: &usize| surfaces.list[*s].plane.normal.dot(up).abs() < settings.wall_tilt_rad.sin();
    thing.iter().copied().filter(is_wall).collect()
}

/// The voxels of a thing and the low ones that its walls may enclose, by their order.
fn around(
    thing: &[usize],
    surfaces: &Surfaces,
    readings: &Readings,
    frame: &PlaneFrame,
    low: &[Low],
    settings: &PerceptionSettings,
) -> Vec<u32> {
    let voxels_of = |of: &[usize]| of.iter().flat_map(|&s| &surfaces.list[s].voxels).copied().collect::<Vec<u32>>();
    let walls = walls(thing, surfaces, &frame.normal, settings);
    let outer = voxels_of(if walls.len() >= SURROUNDING_WALLS { &walls } else { thing });
    let hull = convex_hull(&outer.iter().map(|&v| frame.to_plane(&readings.point(v))).collect::<Vec<Point2>>());
    let bound = |k: usize, pick: fn(f64, f64) -> f64| hull.iter().map(|p| p[k]).reduce(pick).unwrap_or_default();
    let (least, most) = ([0, 1].map(|k| bound(k, f64::min)), [0, 1].map(|k| bound(k, f64::max)));
    let is_within = |l: &&Low| {
        (0..2).all(|k| l.place[k] >= least[k] && l.place[k] <= most[k]) && hull_contains(&hull, &l.place, 0.0)
    };
    let mut local = voxels_of(thing);
    local.extend(low.iter().filter(is_within).map(|l| l.voxel));
    local.sort_unstable();
    local
}

/// The voxels and the plane (input's frame) of each base that the thing encloses.
fn bases_of(
    thing: &[usize],
    local: &[u32],
    surfaces: &Surfaces,
    voxels: &Voxels,
    readings: &Readings,
    support: &Plane,
    settings: &PerceptionSettings,
) -> Vec<(Vec<u32>, Plane)> {
    let points: Vec<[f32; 3]> = local.iter().map(|&v| readings.points[v as usize]).collect();
    let cloud = CloudView { points: &points, width: points.len(), height: 1, viewpoint: readings.viewpoint };
    let here = readings.of_other_points(&cloud);
    let segment = |&s: &usize| {
        let surface: &Surface = &surfaces.list[s];
        let place_of = |v: &u32| local.binary_search(v).unwrap_or_default() as u32;
        let whole = voxels.segment_of(surface);
        Segment { points: whole.points.iter().map(place_of).collect(), ..whole }
    };
    let old: Vec<Segment> = thing.iter().map(segment).collect();
    let mut free = vec![true; local.len()];
    old.iter().flat_map(|s| &s.points).for_each(|&p| free[p as usize] = false);
    let mut new = old.clone();
    SupportBand::new(&here, &free, 0, support, settings).add_base(&here, &mut new, settings);
    let is_new = |n: &Segment| !old.iter().any(|o| o.points == n.points);
    let voxels_of = |n: Segment| (n.points.iter().map(|&p| local[p as usize]).collect(), n.plane);
    new.into_iter().filter(is_new).map(voxels_of).collect()
}

impl Surfaces {
    /// A new surface, its voxels taken from whoever had them.
    fn claim(&mut self, voxels: &Voxels, new: Surface) {
        let id = self.list.len() as u32;
        let mut poorer: Vec<u32> =
            new.voxels.iter().map(|&v| std::mem::replace(&mut self.owner[v as usize], id)).collect();
        poorer.sort_unstable();
        poorer.dedup();
        for old in poorer.into_iter().filter(|&o| o != NONE) {
            let (owner, surface) = (&self.owner, &mut self.list[old as usize]);
            surface.voxels.retain(|&v| owner[v as usize] == old);
            *surface = Surface::of(voxels, std::mem::take(&mut surface.voxels), &surface.plane);
        }
        self.list.push(new);
    }
}
