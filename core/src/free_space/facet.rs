use crate::geometry::{Plane, Vec3};

/// A flat panel with convex corners, going round; metres, the input's frame, at mid-board.
#[derive(Debug, Clone, PartialEq)]
pub struct Facet {
    corners: [Vec3; 4],
    plane: Plane,
    /// Unit vectors into the panel, square to its edges.
    inward: [Vec3; 4],
    /// The shorter of its two middle lines.
    width_m: f64,
}

impl Facet {
    /// `None` where the corners span no area.
    pub fn new(corners: [Vec3; 4]) -> Option<Self> {
        let [a, b, c, d] = corners;
        let normal = (c - a).cross(&(d - b)).try_normalize(1e-9)?;
        let center = (a + b + c + d) / 4.0;
        let inward = std::array::from_fn(|k| normal.cross(&(corners[(k + 1) % 4] - corners[k])).normalize());
        let width_m = ((a + b) - (c + d)).norm().min(((b + c) - (d + a)).norm()) / 2.0;
        let is_sound = inward.iter().all(|n: &Vec3| n.iter().all(|x| x.is_finite())) && width_m > 1e-6;
        is_sound.then_some(Self { corners, plane: Plane { normal, distance: normal.dot(&center) }, inward, width_m })
    }

    pub fn corners(&self) -> &[Vec3; 4] {
        &self.corners
    }

    pub fn normal(&self) -> &Vec3 {
        &self.plane.normal
    }

    pub fn width_m(&self) -> f64 {
        self.width_m
    }

    /// How far along a unit ray the panel is met, metres, at least `inset_m` within its edges.
    pub fn hit_m(&self, origin: &Vec3, ray: &Vec3, inset_m: f64) -> Option<f64> {
        let along = self.plane.normal.dot(ray);
        if along.abs() < 1e-6 {
            return None;
        }
        let range_m = -self.plane.height_of(origin) / along;
        let at = origin + ray * range_m;
        let within = |k: usize| self.inward[k].dot(&(at - self.corners[k])) >= inset_m;
        (range_m > 0.0 && (0..4).all(within)).then_some(range_m)
    }
}
