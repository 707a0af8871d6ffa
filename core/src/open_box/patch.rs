use super::sight::Sight;
use crate::geometry::Vec3;
use crate::perception::{Scene, BACKGROUND};

/// A segment in the level frame.
#[derive(Debug, Clone)]
pub struct Patch {
    /// Towards the camera.
    pub normal: Vec3,
    /// normal . p
    pub distance_m: f64,
    pub hull: Vec<Vec3>,
    pub readings: f64,
}

/// Walls lean less than this: the sine of a tilted box's tilt, with what bulges and noise add.
const MOST_WALL_LEAN: f64 = 0.24;
/// The hinge of a flap that lies flatter than this has no direction.
const LEAST_FLAP_LEAN: f64 = 0.12;

impl Patch {
    /// Those of things; the room and the support are no part of a box.
    pub fn of_things(scene: &Scene, sight: &Sight) -> Vec<Self> {
        let segments = &scene.segments;
        let things = (0..segments.len()).filter(|&s| segments.group[s] != BACKGROUND);
        let turn = sight.input_from_level.rotation.inverse();
        let patch = |s: usize| {
            let normal = turn * segments.planes[s].normal;
            let hull: Vec<Vec3> = segments.hulls[s].iter().map(|corner| sight.to_level(corner)).collect();
            let center = sight.to_level(&segments.rectangles[s].center());
            let normal = if normal.dot(&(sight.eye - center)) < 0.0 { -normal } else { normal };
            let distance_m = normal.dot(&center);
            Self { normal, distance_m, hull, readings: segments.points_of(s).len() as f64 }
        };
        things.map(patch).collect()
    }

    /// Whether it may be a wall of a box that stands this way up.
    pub fn is_upright(&self, up: &Vec3) -> bool {
        self.normal.dot(up).abs() < MOST_WALL_LEAN
    }

    /// The direction in it that is square to `up`: that of its hinge, were it a flap.
    pub fn level_direction(&self, up: &Vec3) -> Option<Vec3> {
        let direction = up.cross(&self.normal);
        let lean = direction.norm();
        (lean > LEAST_FLAP_LEAN).then(|| direction / lean)
    }

    /// How far it reaches along a direction: lowest and highest.
    pub fn span(&self, direction: &Vec3) -> [f64; 2] {
        let along = self.hull.iter().map(|corner| corner.dot(direction));
        along.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
    }
}
