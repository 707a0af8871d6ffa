use super::*;
use crate::geometry::{SplitMix64, Vec3};
use crate::perception::{PerceptionSettings, BACKGROUND};
use EdgeKind::{Border, Crease, Edge, Occluded};

const WIDTH: usize = 160;
const HEIGHT: usize = 120;
const FOCAL_PX: f64 = 140.0;

/// What a pinhole camera at the origin, x right, y down, z forward, sees of rectangles.
struct Frame {
    points: Vec<[f32; 3]>,
    labels: Vec<i32>,
    planes: Vec<Plane>,
    rectangles: Vec<Rectangle>,
}

impl Frame {
    fn of(panels: &[[[f64; 3]; 3]], noise_m: f64) -> Self {
        let rectangles: Vec<Rectangle> = panels.iter().map(rectangle).collect();
        let planes: Vec<Plane> = rectangles.iter().map(plane).collect();
        let mut rng = SplitMix64::new(3);
        let mut frame = Self { points: vec![], labels: vec![], planes, rectangles };
        for pixel in 0..WIDTH * HEIGHT {
            let ray =
                Vec3::new(((pixel % WIDTH) as f64 - 79.5) / FOCAL_PX, ((pixel / WIDTH) as f64 - 59.5) / FOCAL_PX, 1.0);
            let (depth, label) = frame.hit(&ray);
            let p = ray * (depth + noise_m * (rng.unit() + rng.unit() - rng.unit() - rng.unit()));
            frame.points.push([p.x as f32, p.y as f32, p.z as f32]);
            frame.labels.push(label);
        }
        frame.rectangles = (0..panels.len()).map(|s| frame.seen_of(s)).collect();
        frame
    }

    /// The part of a rectangle that is seen.
    fn seen_of(&self, s: usize) -> Rectangle {
        let [a, b, c, _] = self.rectangles[s].corners;
        let axes = [(b - a).normalize(), (c - b).normalize()];
        let mine = self.points.iter().zip(&self.labels).filter(|(_, label)| **label == s as i32);
        let seen: Vec<Vec3> = mine.map(|(p, _)| Vec3::from(p.map(f64::from))).collect();
        let [x, y] = axes.map(|axis| {
            let along = seen.iter().map(|p| (p - a).dot(&axis));
            along.fold((f64::MAX, f64::MIN), |(low, high), t| (low.min(t), high.max(t)))
        });
        let corner = |x: f64, y: f64| a + axes[0] * x + axes[1] * y;
        Rectangle { corners: [corner(x.0, y.0), corner(x.1, y.0), corner(x.1, y.1), corner(x.0, y.1)] }
    }

    fn hit(&self, ray: &Vec3) -> (f64, i32) {
        let mut nearest = (f64::NAN, -1);
        for (s, (plane, rectangle)) in self.planes.iter().zip(&self.rectangles).enumerate() {
            let depth = plane.distance / plane.normal.dot(ray);
            let [a, b, c, _] = rectangle.corners;
            let within = |edge: Vec3| (0.0..=1.0).contains(&((ray * depth - a).dot(&edge) / edge.norm_squared()));
            if depth > 0.0 && within(b - a) && within(c - b) && (nearest.1 < 0 || depth < nearest.0) {
                nearest = (depth, s as i32);
            }
        }
        nearest
    }

    /// Leaves out a segment's label: its plane is that of the support, which is no segment.
    fn as_support(&mut self, s: i32) -> Plane {
        self.labels.iter_mut().filter(|l| **l == s).for_each(|l| *l = -1);
        self.planes[s as usize]
    }

    fn kinds(&self, support: Option<&Plane>) -> Vec<[EdgeKind; 4]> {
        let settings = PerceptionSettings::default();
        let cloud = CloudView { points: &self.points, width: WIDTH, height: HEIGHT, viewpoint: Some(Vec3::zeros()) };
        let image = SegmentImage { labels: &self.labels, width: WIDTH, height: HEIGHT };
        side_kinds(&Readings::new(&cloud, &settings), &image, &self.planes, &self.rectangles, support)
    }
}

/// From a corner and the two next to it.
fn rectangle(corners: &[[f64; 3]; 3]) -> Rectangle {
    let [before, corner, after] = corners.map(Vec3::from);
    Rectangle { corners: [before, corner, after, before + after - corner] }
}

fn plane(rectangle: &Rectangle) -> Plane {
    let normal = rectangle.normal().expect("an area");
    Plane { normal, distance: normal.dot(&rectangle.corners[0]) }
}

/// A wall across the frame at z = 2, an upright panel on the floor at z = 1 (sides: top, right, bottom, left).
const WALL: [[f64; 3]; 3] = [[-2.0, -2.0, 2.0], [2.0, -2.0, 2.0], [2.0, 2.0, 2.0]];
const PANEL: [[f64; 3]; 3] = [[-0.2, -0.1, 1.0], [0.2, -0.1, 1.0], [0.2, 0.2, 1.0]];
const FLOOR: [[f64; 3]; 3] = [[-2.0, 0.2, 0.5], [2.0, 0.2, 0.5], [2.0, 0.2, 2.0]];

#[test]
fn a_panel_before_a_wall_ends_by_itself_and_goes_on_in_the_floor() {
    let mut frame = Frame::of(&[PANEL, WALL, FLOOR], 0.0015);
    let kinds = frame.kinds(None);
    assert_eq!(kinds[0], [Edge, Edge, Crease, Edge]);
    let floor = frame.as_support(2);
    assert_eq!(frame.kinds(Some(&floor))[0], [Edge, Edge, Crease, Edge], "the support is a surface that goes on");
    assert_eq!(frame.kinds(None)[0], [Edge, Edge, Occluded, Edge], "what is nearer and no segment may hide the rest");
}

#[test]
fn folds_either_way_are_creases() {
    let mut cases = 0;
    for degrees in (-150..=150).step_by(10).filter(|d| *d != 0) {
        let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
        // Hinged on the panel's right side, positive towards the camera.
        let (x, z) = (0.2 + 0.15 * cos, 1.0 - 0.15 * sin);
        let flap = [[0.2, -0.1, 1.0], [x, -0.1, z], [x, 0.2, z]];
        let frame = Frame::of(&[PANEL, flap, WALL], 0.0015);
        let pixels = frame.labels.iter().filter(|l| **l == 1).count();
        if pixels < 60 || frame.labels.iter().filter(|l| **l == 0).count() < 60 {
            continue;
        }
        let kinds = frame.kinds(None);
        // Turned in before the panel, the flap hides the hinge's other half.
        let hides = sin > 0.0 && x < 0.2 * z;
        assert_eq!(kinds[0][1], if hides { Occluded } else { Crease }, "{degrees} degrees: the panel");
        assert_eq!(kinds[1][3], if hides { Edge } else { Crease }, "{degrees} degrees: the flap");
        cases += 1;
    }
    assert!(cases > 15, "{cases}");
}

#[test]
fn a_panel_behind_another_is_occluded_and_one_at_the_image_corner_is_cut() {
    let behind = [[0.0, -0.05, 1.3], [0.5, -0.05, 1.3], [0.5, 0.15, 1.3]];
    let cut = [[-1.5, -1.5, 1.2], [-0.4, -1.5, 1.2], [-0.4, -0.2, 1.2]];
    let frame = Frame::of(&[PANEL, behind, cut, WALL], 0.0015);
    let kinds = frame.kinds(None);
    assert_eq!(kinds[0], [Edge; 4]);
    assert_eq!(kinds[1], [Edge, Edge, Edge, Occluded]);
    assert_eq!(kinds[2], [Border, Edge, Edge, Border]);
}

#[test]
fn readings_that_are_missing_or_hang_in_the_air_hide_nothing() {
    let mut frame = Frame::of(&[PANEL, WALL], 0.0015);
    // Right of the panel lies the projector's shadow; above it each reading hangs between panel and wall.
    for pixel in 0..WIDTH * HEIGHT {
        let (u, v) = (pixel % WIDTH, pixel / WIDTH);
        let panel = |u: usize, v: usize| frame.labels.get(v * WIDTH + u) == Some(&0);
        if frame.labels[pixel] == 1 && (1..8).any(|k| u >= k && panel(u - k, v)) {
            frame.points[pixel] = [f32::NAN; 3];
            frame.labels[pixel] = -1;
        } else if frame.labels[pixel] == 1 && panel(u, v + 1) {
            frame.points[pixel] = frame.points[pixel].map(|c| 0.6 * c);
            frame.labels[pixel] = -1;
        }
    }
    assert_eq!(frame.kinds(None)[0], [Edge; 4]);
    frame.points.fill([f32::NAN; 3]);
    frame.points[7] = [0.0, 0.0, 1.0];
    assert_eq!(frame.kinds(None).len(), 2, "a frame with hardly a reading");
}

#[test]
fn images_of_any_shape() {
    let settings = PerceptionSettings::default();
    let points = [[0.0, 0.0, 1.0]; 12];
    let square = rectangle(&[[0.0, 0.0, 1.0], [0.1, 0.0, 1.0], [0.1, 0.1, 1.0]]);
    let mut cases = 0;
    for (width, height) in [(12, 1), (1, 12), (3, 4), (0, 5), (5, 0)] {
        let points = &points[..width * height];
        let labels = vec![0; points.len()];
        let cloud = CloudView { points, width, height, viewpoint: Some(Vec3::zeros()) };
        let image = SegmentImage { labels: &labels, width, height };
        let readings = Readings::new(&cloud, &settings);
        let kinds = side_kinds(&readings, &image, &[plane(&square)], &[square], None);
        assert_eq!(kinds[0][0], if labels.is_empty() { Edge } else { Border });
        cases += 1;
    }
    assert_eq!(cases, 5);
}

#[test]
fn without_an_image_hulls_that_adjoin_are_creases() {
    let shapes = [PANEL, [[-0.2, 0.2, 1.0], [0.2, 0.2, 1.0], [0.2, 0.25, 1.3]], WALL];
    let rectangles: Vec<Rectangle> = shapes.iter().map(rectangle).collect();
    let segments = Segments {
        planes: rectangles.iter().map(plane).collect(),
        hulls: rectangles.iter().map(|r| r.corners.to_vec()).collect(),
        rectangles,
        rms: vec![0.001; 3],
        group: vec![0, 0, BACKGROUND],
        ..Segments::default()
    };
    let kinds = hulls::side_kinds(&segments, None, 0.02);
    assert_eq!(kinds[0], [Edge, Edge, Crease, Edge]);
    assert_eq!(kinds[1], [Crease, Edge, Edge, Edge]);
    assert_eq!(kinds[2], [Edge; 4]);
    let beside = Plane { normal: Vec3::x(), distance: 0.21 };
    assert_eq!(hulls::side_kinds(&segments, Some(&beside), 0.02)[0], [Edge, Crease, Crease, Edge]);
}
