//! Made-up scenes for tests: rectangles as segments.
#![allow(dead_code)]

use boxwright_core::geometry::{Plane, Rectangle, Vec3};
use boxwright_core::perception::{EdgeKind, Scene, Segments};

pub fn rectangle(center: [f64; 3], half_a: [f64; 3], half_b: [f64; 3]) -> Rectangle {
    let (c, a, b) = (Vec3::from(center), Vec3::from(half_a), Vec3::from(half_b));
    Rectangle { corners: [c - a - b, c + a - b, c + a + b, c - a + b] }
}

/// A scene, z up, of the given rectangles in one group, seen from above the origin; each has ten points of its own.
pub fn scene(rectangles: Vec<Rectangle>) -> Scene {
    let viewpoint = Vec3::new(0.3, -1.0, 1.5);
    let mut segments = Segments { point_starts: vec![0], ..Segments::default() };
    for (k, rectangle) in rectangles.into_iter().enumerate() {
        let [a, b, c, _] = rectangle.corners;
        let normal = (b - a).cross(&(c - b)).normalize();
        let plane = Plane { normal, distance: normal.dot(&a) };
        segments.planes.push(if plane.height_of(&viewpoint) < 0.0 { plane.flipped() } else { plane });
        segments.hulls.push(rectangle.corners.to_vec());
        segments.rectangles.push(rectangle);
        segments.rms.push(0.001);
        segments.edges.push([EdgeKind::Edge; 4]);
        segments.group.push(0);
        segments.point_indices.extend((0..10).map(|p| (k * 10 + p) as u32));
        segments.point_starts.push(segments.point_indices.len() as u32);
    }
    Scene {
        up: Vec3::z(),
        support: Some(Plane { normal: Vec3::z(), distance: 0.0 }),
        viewpoint: Some(viewpoint),
        segments,
        warnings: Vec::new(),
        stage_seconds: Vec::new(),
    }
}

/// An open carton 0.4 x 0.3 x 0.2 m at the origin, side 0 towards -y, all flaps at `flap_angle_rad`; the order is that of
/// the carton template's parts.
pub fn carton_rectangles(flap_angle_rad: f64) -> Vec<Rectangle> {
    let (l, w, h, f) = (0.2, 0.15, 0.1, 0.07);
    let mut out = vec![rectangle([0.0, 0.0, 0.0], [l, 0.0, 0.0], [0.0, w, 0.0])];
    let outward = [[0.0, -1.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]];
    let along = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
    let (distance, half) = ([w, l, w, l], [l, w, l, w]);
    for k in 0..4 {
        let at = outward[k].map(|c| c * distance[k]);
        out.push(rectangle([at[0], at[1], h], along[k].map(|c| c * half[k]).into_vec3(), [0.0, 0.0, h]));
    }
    for k in 0..4 {
        // 0 lies inward over the opening, pi/2 stands up.
        let (out_run, up_run) = (-f * flap_angle_rad.cos(), f * flap_angle_rad.sin());
        let run = [outward[k][0] * out_run, outward[k][1] * out_run, up_run];
        let at = outward[k].map(|c| c * distance[k]);
        let center = [at[0] + run[0], at[1] + run[1], 2.0 * h + run[2]];
        out.push(rectangle(center, along[k].map(|c| c * half[k] * 0.95).into_vec3(), run));
    }
    out
}

trait IntoVec3 {
    fn into_vec3(self) -> [f64; 3];
}

impl IntoVec3 for [f64; 2] {
    fn into_vec3(self) -> [f64; 3] {
        [self[0], self[1], 0.0]
    }
}

/// A small generator with a fixed seed, for tests only.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Uniform in 0..1.
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    pub fn vector(&mut self, size: f64) -> [f64; 3] {
        [0; 3].map(|_| self.between(-size, size))
    }
}

/// Weights that make a sensible score for the shipped templates: 1 for each term, JSON text.
pub fn unit_weights(template: &boxwright_core::model::Template, accept_score: f64) -> String {
    let each =
        |value: &str| template.term_names().map(|name| format!("\"{name}\": {value}")).collect::<Vec<_>>().join(", ");
    format!(
        "{{\"format\": \"boxwright.weights\", \"version\": 1, \"template\": \"{}\", \"weights\": {{{}}}, \
         \"importance\": {{{}}}, \"accept_score\": {accept_score}}}",
        template.name,
        each("1.0"),
        each("1.0")
    )
}
