use super::ray_moments::{RayMoments, RayPlane};
use super::rays::Rays;
use super::runs::Run;
use crate::geometry::{
    convex_hull, convex_hull_of_sorted, minimum_rectangle, Plane, PlaneFrame, Point2, Rectangle, Vec3,
};

/// A plane segment: its pixels and its outline; input's frame, metres.
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
    moments: RayMoments,
}

impl Piece {
    /// `None` where the plane passes through the camera, or the pixels span no area on it.
    pub fn new(rays: &Rays, runs: Vec<Run>, moments: &RayMoments) -> Option<Self> {
        let (ray_plane, squares) = moments.fit()?;
        let plane = in_space(&ray_plane)?;
        let corners = hull_on_plane(rays, &runs, &ray_plane);
        let frame = PlaneFrame::new(&plane, corners.first()?);
        let flat: Vec<Point2> = corners.iter().map(|p| frame.to_plane(p)).collect();
        let hull = convex_hull(&flat);
        let rectangle = minimum_rectangle(&hull)?;
        // A step dq moves a reading by dq / q^2 in depth, and off the plane by q times the plane's distance of that.
        let q = moments.q / moments.n;
        let rms_m = (squares / moments.n).sqrt() / q * plane.distance.abs();
        let to_input = |p: Vec3| rays.input_from_camera.point(&p);
        Some(Self {
            points: runs.iter().map(|r| r.len() as usize).sum(),
            runs,
            plane: rays.input_from_camera.plane(&plane),
            rms_m,
            hull: hull.iter().map(|c| to_input(frame.to_space(c))).collect(),
            rectangle: Rectangle { corners: rectangle.corners.map(|c| to_input(frame.to_space(&c))) },
            moments: *moments,
        })
    }

    /// Several pieces as one: the plane is fitted to all their readings.
    pub fn joined(rays: &Rays, parts: &[&Self]) -> Option<Self> {
        let mut moments = RayMoments::default();
        parts.iter().for_each(|p| moments.add(&p.moments));
        let mut runs: Vec<Run> = parts.iter().flat_map(|p| p.runs.iter().copied()).collect();
        runs.sort_unstable_by_key(|r| r.start);
        Self::new(rays, runs, &moments)
    }

    /// Of pixels whose moments are not known.
    pub fn from_runs(rays: &Rays, runs: Vec<Run>) -> Option<Self> {
        let mut moments = RayMoments::default();
        for pixel in runs.iter().flat_map(|r| r.start..r.end) {
            let [u, v, q] = rays.ray(pixel as usize);
            moments.add_reading(u, v, q);
        }
        Self::new(rays, runs, &moments)
    }

    /// The same plane without some of its pixels; `None` where nothing is left.
    pub fn without(&self, rays: &Rays, lost: &[Run]) -> Option<Self> {
        let mut gone: Vec<u32> = lost.iter().map(|r| r.start).collect();
        gone.sort_unstable();
        let is_left = |r: &&Run| gone.binary_search(&r.start).is_err();
        let left: Vec<Run> = self.runs.iter().filter(is_left).copied().collect();
        Self::new(rays, left, &self.moments)
    }

    /// Of the surface that its pixels cover; `pitch` lies between the rays of neighbouring pixels.
    ///
    /// On a plane at distance d from the camera, `du dv` of rays at depth z covers `z^3 / d du dv` (eq. 57).
    pub fn area_m2(&self, pitch: f64) -> f64 {
        let Some((plane, _)) = self.moments.fit() else { return 0.0 };
        let inverse_distance = Vec3::new(plane.a, plane.b, plane.c).norm();
        let depth_m = self.moments.n / self.moments.q;
        self.points as f64 * pitch * pitch * depth_m.powi(3) * inverse_distance
    }

    /// About so many of its pixels, spread evenly over its rows.
    pub fn sample(&self, count: usize) -> impl Iterator<Item = u32> + '_ {
        self.runs.iter().step_by(1 + self.runs.len() / count).map(|r| (r.start + r.end) / 2)
    }
}

/// `1 = a x + b y + c z` on the plane; `None` where it passes through the camera.
pub fn in_space(p: &RayPlane) -> Option<Plane> {
    let n = Vec3::new(p.a, p.b, p.c);
    let length = n.norm();
    (length > 1e-9 && length.is_finite()).then(|| Plane { normal: -n / length, distance: -1.0 / length })
}

/// Corners of the pixels' convex hull, where their rays meet the plane. A view keeps hulls, so that it is found among the
/// first and last pixels of the rows, in the image.
fn hull_on_plane(rays: &Rays, runs: &[Run], plane: &RayPlane) -> Vec<Vec3> {
    let width = rays.width as u32;
    let row = |r: &Run| r.start / width;
    let place = |pixel: u32| [f64::from(pixel / width), f64::from(pixel % width)];
    let mut ends: Vec<Point2> = Vec::with_capacity(2 * rays.height);
    for line in runs.chunk_by(|a, b| row(a) == row(b)) {
        let (first, last) = (line[0].start, line[line.len() - 1].end - 1);
        ends.push(place(first));
        if last != first {
            ends.push(place(last));
        }
    }
    let meet = |&[y, x]: &Point2| {
        let [u, v, _] = rays.ray(y as usize * rays.width + x as usize);
        let q = plane.inverse_depth(u, v);
        (q > 0.0).then(|| Vec3::new(u, v, 1.0) / q)
    };
    convex_hull_of_sorted(&ends).iter().filter_map(meet).collect()
}

/// Drops pieces and their groups.
pub fn keep(pieces: &mut Vec<Piece>, group: &mut Vec<i32>, stays: impl Fn(usize) -> bool) {
    let mut p = 0..;
    pieces.retain(|_| p.next().is_none_or(&stays));
    let mut p = 0..;
    group.retain(|_| p.next().is_none_or(&stays));
}
