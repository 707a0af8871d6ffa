use nalgebra::{Isometry3, Matrix3, Translation3, UnitQuaternion};
use wide::f32x4;

use crate::cloud::{CloudView, Projection};
use crate::geometry::{Plane, Vec3};
use crate::perception::readings::Readings;
use crate::perception::Scene;

/// What a reading says of a surface that its ray should meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Says {
    Met,
    /// The reading lies behind it: the camera looked through.
    Through,
    /// The reading lies before it.
    Hidden,
    /// No reading.
    Blank,
    /// Beyond the image's edge, or behind the camera.
    Outside,
}

/// A reading in the level frame with its noise, side by side in memory.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(16))]
pub struct Reading {
    at: [f32; 3],
    noise: f32,
}

impl Reading {
    #[inline]
    pub fn at(&self) -> Vec3 {
        let [x, y, z] = self.at;
        Vec3::new(f64::from(x), f64::from(y), f64::from(z))
    }

    /// What it says of a surface that lies that far before it along the normal; `along` is the way from the eye to the surface along
    /// the normal.
    #[inline]
    pub fn says(&self, off: f64, along: f64, model_m: f64) -> Says {
        let tolerance = self.noise() * along.abs() + model_m;
        if off.abs() <= tolerance {
            Says::Met
        } else if (off > 0.0) == (along > 0.0) {
            Says::Through
        } else {
            Says::Hidden
        }
    }

    /// So many standard deviations along its ray as a reading may lie off its surface, share of the range.
    #[inline]
    pub fn noise(&self) -> f64 {
        f64::from(self.noise)
    }
}

/// Readings, or points, are looked at so many together.
pub const LANES: usize = 4;

/// Their coordinates and noise, each by itself.
#[inline(always)]
pub fn side_by_side(readings: [&Reading; LANES]) -> [f32x4; 4] {
    f32x4::transpose(readings.map(|&Reading { at: [x, y, z], noise }| f32x4::new([x, y, z, noise])))
}

/// The depth image in the level frame: z up from the support, the camera above the origin. Metres.
pub struct Sight<'a> {
    pub input_from_level: Isometry3<f64>,
    pub eye: Vec3,
    /// Row by row; a point with a coordinate that is not finite is no reading.
    pub points: Vec<[f32; 3]>,
    pub width: usize,
    pub height: usize,
    /// Angle between neighbouring pixels, rad.
    pub pixel_rad: f64,
    pub(super) place_from_level: Turn,
    pub(super) looks: Vec<Reading>,
    readings: &'a Readings<'a>,
}

impl<'a> Sight<'a> {
    /// `None` for a cloud without an image or a viewpoint.
    pub fn new(cloud: &CloudView, readings: &'a Readings<'a>, scene: &Scene) -> Option<Self> {
        cloud.viewpoint.filter(|_| cloud.is_organized())?;
        let projection = Projection::of(cloud)?;
        let input_from_level = level(&projection, &scene.up, scene.support.as_ref().unwrap_or(&lowest(scene)?));
        Self::from_projection(cloud, readings, &projection, input_from_level)
    }

    /// The same in a level frame that was found otherwise.
    pub fn in_level(cloud: &CloudView, readings: &'a Readings<'a>, input_from_level: Isometry3<f64>) -> Option<Self> {
        cloud.viewpoint.filter(|_| cloud.is_organized())?;
        Self::from_projection(cloud, readings, &Projection::of(cloud)?, input_from_level)
    }

    fn from_projection(
        cloud: &CloudView,
        readings: &'a Readings<'a>,
        projection: &Projection,
        input_from_level: Isometry3<f64>,
    ) -> Option<Self> {
        let level_from_input = input_from_level.inverse();
        let turn = level_from_input.rotation.to_rotation_matrix().cast::<f32>();
        let shift = level_from_input.translation.vector.cast::<f32>();
        let place = |p: &[f32; 3]| {
            if Readings::is_finite(p) {
                (turn * nalgebra::Vector3::from(*p) + shift).into()
            } else {
                [f32::NAN; 3]
            }
        };
        let rays = projection.ray_from_pixel()?;
        let (column, row) = (cloud.width as f64 / 2.0, cloud.height as f64 / 2.0);
        let ray = |x: f64, y: f64| (rays * Vec3::new(x, y, 1.0)).normalize();
        let step = ray(column, row).cross(&ray(column + 1.0, row)).norm();
        let eye = level_from_input.transform_point(&projection.origin.into()).coords;
        let points: Vec<[f32; 3]> = cloud.points.iter().map(place).collect();
        let from = eye.cast::<f32>();
        let look = |at: &[f32; 3]| {
            // What lies at the camera itself is no surface's reading.
            let range = (nalgebra::Vector3::from(*at) - from).norm().max(LEAST_RANGE_M);
            Reading { at: *at, noise: SIGMAS as f32 * readings.sigma_at_range_m(f64::from(range)) as f32 / range }
        };
        Some(Self {
            input_from_level,
            eye,
            looks: points.iter().map(look).collect(),
            points,
            width: cloud.width,
            height: cloud.height,
            pixel_rad: step,
            place_from_level: Turn::of(
                &(projection.pixel_from_ray() * input_from_level.rotation.to_rotation_matrix().matrix()),
            ),
            readings,
        })
    }

    pub fn to_level(&self, input: &Vec3) -> Vec3 {
        self.input_from_level.inverse_transform_point(&(*input).into()).coords
    }

    /// Column and row that see a point; `None` behind the camera.
    #[inline]
    pub fn pixel(&self, point: &Vec3) -> Option<[f64; 2]> {
        pixel_at(&self.place_from_level.times(&(point - self.eye)))
    }

    /// The pixel that sees a point, where the image has it.
    #[inline]
    pub fn index(&self, point: &Vec3) -> Option<usize> {
        self.index_at(&self.place_from_level.times(&(point - self.eye)))
    }

    /// The same of a place along the camera's axes, in pixels times depth.
    #[inline]
    pub fn index_at(&self, place: &Vec3) -> Option<usize> {
        let [x, y] = pixel_at(place)?;
        // Half a pixel further, so that the whole part is the nearest.
        let (x, y) = (x + 0.5, y + 0.5);
        let within = x >= 0.0 && y >= 0.0 && x < self.width as f64 && y < self.height as f64;
        // Signed: to unsigned numbers of that size takes twice as long.
        within.then(|| y as i32 as usize * self.width + x as i32 as usize)
    }

    /// What a pixel has, be it a reading or not.
    #[inline]
    pub fn look_or_blank(&self, index: usize) -> &Reading {
        &self.looks[index]
    }

    pub fn reading(&self, index: usize) -> Option<Vec3> {
        Some(self.look(index)?.at())
    }

    /// A reading with its noise.
    #[inline]
    pub fn look(&self, index: usize) -> Option<&Reading> {
        Some(&self.looks[index]).filter(|look| look.at[0].is_finite())
    }

    /// Standard deviation of a reading along its ray, metres.
    pub fn sigma_m(&self, range_m: f64) -> f64 {
        self.readings.sigma_at_range_m(range_m)
    }

    /// What the camera says of a point of a surface with that normal (either way round), of a model known within `model_m`; with the
    /// reading where it has one.
    pub fn ask(&self, point: &Vec3, normal: &Vec3, model_m: f64) -> (Says, Option<&Reading>) {
        let Some(index) = self.index(point) else { return (Says::Outside, None) };
        let Some(look) = self.look(index) else { return (Says::Blank, None) };
        let along = normal.dot(&(point - self.eye));
        let off = normal.dot(&(look.at() - point));
        (look.says(off, along, model_m), Some(look))
    }

    /// Pixels that a piece of surface of that area fills.
    pub fn pixels(&self, point: &Vec3, normal: &Vec3, area_m2: f64) -> f64 {
        let ray = point - self.eye;
        let range = ray.norm();
        area_m2 * (normal.dot(&ray) / range).abs() / (range * self.pixel_rad).powi(2)
    }
}

/// Column and row of a place along the camera's axes, in pixels times depth; `None` behind the camera.
#[inline]
fn pixel_at(place: &Vec3) -> Option<[f64; 2]> {
    let inverse = 1.0 / place.z;
    (place.z > 1e-3).then(|| [place.x * inverse, place.y * inverse])
}

/// A matrix whose product with a vector the compiler lays out where it stands: nalgebra's calls two functions.
#[derive(Debug, Clone, Copy)]
pub struct Turn([[f64; 3]; 3]);

impl Turn {
    pub fn of(matrix: &Matrix3<f64>) -> Self {
        Self([0, 1, 2].map(|i| [0, 1, 2].map(|j| matrix[(i, j)])))
    }

    #[inline]
    pub fn times(&self, v: &Vec3) -> Vec3 {
        let [a, b, c] = &self.0;
        Vec3::new(
            a[0] * v.x + a[1] * v.y + a[2] * v.z,
            b[0] * v.x + b[1] * v.y + b[2] * v.z,
            c[0] * v.x + c[1] * v.y + c[2] * v.z,
        )
    }
}

const LEAST_RANGE_M: f32 = 1e-3;
/// Standard deviations within which a reading is on a surface.
const SIGMAS: f64 = 3.0;

/// Of several views that are told in one level frame the readings are numbered on from view to view.
pub fn reading_of(sights: &[Sight], index: usize) -> Option<Vec3> {
    let mut index = index;
    for sight in sights {
        if index < sight.points.len() {
            return sight.reading(index);
        }
        index -= sight.points.len();
    }
    None
}

/// The support as z = 0, x the way the camera looks, the camera above the origin.
pub fn level(projection: &Projection, up: &Vec3, support: &Plane) -> Isometry3<f64> {
    let forward = projection.optical_axis();
    let flat = forward - up * up.dot(&forward);
    // Straight down: any direction does.
    let x = flat.try_normalize(1e-3).unwrap_or_else(|| {
        let other = if up.x.abs() < 0.7 { Vec3::x() } else { Vec3::y() };
        (other - up * up.dot(&other)).normalize()
    });
    let y = up.cross(&x);
    let rotation = nalgebra::Rotation3::from_basis_unchecked(&[x, y, *up]);
    let origin = projection.origin - up * support.height_of(&projection.origin);
    Isometry3::from_parts(Translation3::from(origin), UnitQuaternion::from_rotation_matrix(&rotation))
}

/// Stands in for a support that nobody saw: level, through the lowest corner of any segment.
pub fn lowest(scene: &Scene) -> Option<Plane> {
    let heights = scene.segments.hulls.iter().flatten().map(|corner| scene.up.dot(corner));
    Some(Plane { normal: scene.up, distance: heights.reduce(f64::min)? })
}
