use super::ray_moments::{RayMoments, RayPlane};
use super::rays::Rays;
use super::runs::Run;
use crate::geometry::{convex_hull, minimum_rectangle, Plane, PlaneFrame, Point2, Rectangle, Vec3};

/// A plane segment: its pixels and its outline, camera frame, metres.
#[derive(Debug, Clone)]
pub struct Piece {
    /// In the image's order.
    pub runs: Vec<Run>,
    pub points: usize,
    /// The normal looks at the camera.
    pub plane: Plane,
    pub rms_m: f64,
    pub hull: Vec<Vec3>,
    pub rectangle: Rectangle,
}

impl Piece {
    /// `None` where the runs span no plane that the camera could see.
    pub fn new(rays: &Rays, runs: Vec<Run>, moments: &RayMoments) -> Option<Self> {
        let (ray_plane, squares) = moments.fit()?;
        let plane = in_space(&ray_plane)?;
        let corners = outermost(rays, &runs, &ray_plane);
        let frame = PlaneFrame::new(&plane, corners.first()?);
        let flat: Vec<Point2> = corners.iter().map(|p| frame.to_plane(p)).collect();
        let hull = convex_hull(&flat);
        let rectangle = minimum_rectangle(&hull)?;
        // A step in q at inverse depth q moves the reading by dq / q^2 along its ray, and off the plane by d/z of that.
        let q = moments.q / moments.n;
        let rms_m = (squares / moments.n).sqrt() / q * -plane.distance;
        Some(Self {
            points: runs.iter().map(|r| r.len() as usize).sum(),
            runs,
            plane,
            rms_m,
            hull: hull.iter().map(|c| frame.to_space(c)).collect(),
            rectangle: Rectangle { corners: rectangle.corners.map(|c| frame.to_space(&c)) },
        })
    }

    /// Of pixels whose moments are not known yet.
    pub fn from_runs(rays: &Rays, runs: Vec<Run>) -> Option<Self> {
        let mut moments = RayMoments::default();
        for pixel in runs.iter().flat_map(|r| r.start..r.end) {
            let [u, v, q] = rays.ray(pixel as usize);
            moments.add_reading(u, v, q);
        }
        Self::new(rays, runs, &moments)
    }

    pub fn pixels(&self) -> impl Iterator<Item = u32> + '_ {
        self.runs.iter().flat_map(|r| r.start..r.end)
    }
}

/// `1 = a x + b y + c z` on the plane; `None` where it passes through the camera.
fn in_space(p: &RayPlane) -> Option<Plane> {
    let n = Vec3::new(p.a, p.b, p.c);
    let length = n.norm();
    (length > 1e-9 && length.is_finite()).then(|| Plane { normal: -n / length, distance: -1.0 / length })
}

/// Where the rays of the first and last pixel of each row meet the plane: the convex hull needs no others.
fn outermost(rays: &Rays, runs: &[Run], plane: &RayPlane) -> Vec<Vec3> {
    let width = rays.width as u32;
    let row = |r: &Run| r.start / width;
    let meet = |pixel: u32| {
        let [u, v, _] = rays.ray(pixel as usize);
        let q = plane.inverse_depth(u, v);
        (q > 0.0).then(|| Vec3::new(u, v, 1.0) / q)
    };
    let rows = runs.chunk_by(|a, b| row(a) == row(b));
    rows.flat_map(|line| [line[0].start, line[line.len() - 1].end - 1]).filter_map(meet).collect()
}
