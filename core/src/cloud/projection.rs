use super::CloudView;
use crate::geometry::Vec3;
use nalgebra::{Matrix3, RowVector3, SMatrix, SymmetricEigen};

/// Readings in each direction of the image that it is read from.
const SAMPLES: usize = 24;
/// Fewer readings say nothing.
const MIN_SAMPLES: usize = 16;

/// Which pixel sees a point, and along which ray a pixel looks: read off an organized cloud (eq. 58).
#[derive(Debug, Clone, Copy)]
pub struct Projection {
    /// Where the rays begin, in the input's frame: the viewpoint, else the origin.
    pub origin: Vec3,
    /// Homogeneous place in the image, about its middle in units of its size, from a direction out of the origin.
    place_from_ray: Matrix3<f64>,
    width: f64,
    height: f64,
}

impl Projection {
    /// By the direct linear transform; `None` where there is too little to read it from.
    pub fn of(cloud: &CloudView) -> Option<Self> {
        let origin = cloud.viewpoint.unwrap_or_default();
        let (step_x, step_y) = ((cloud.width / SAMPLES).max(1), (cloud.height / SAMPLES).max(1));
        let mut normal_equations = SMatrix::<f64, 9, 9>::zeros();
        let (mut count, mut mean) = (0, Vec3::zeros());
        for y in (step_y / 2..cloud.height).step_by(step_y) {
            for x in (step_x / 2..cloud.width).step_by(step_x) {
                let [px, py, pz] = cloud.points[y * cloud.width + x].map(f64::from);
                let Some(ray) = (Vec3::new(px, py, pz) - origin).try_normalize(1e-6) else { continue };
                if !ray.iter().all(|c| c.is_finite()) {
                    continue;
                }
                // About the image's middle, in units of its size: the equations are then well scaled.
                let [u, v] = [x as f64 / cloud.width as f64 - 0.5, y as f64 / cloud.height as f64 - 0.5];
                let [a, b, c] = [ray.x, ray.y, ray.z];
                for row in
                    [[a, b, c, 0.0, 0.0, 0.0, -u * a, -u * b, -u * c], [0.0, 0.0, 0.0, a, b, c, -v * a, -v * b, -v * c]]
                {
                    let row = SMatrix::<f64, 9, 1>::from(row);
                    normal_equations += row * row.transpose();
                }
                mean += ray;
                count += 1;
            }
        }
        if count < MIN_SAMPLES {
            return None;
        }
        let eigen = SymmetricEigen::try_new(normal_equations, 1e-14, 200)?;
        let solution = eigen.eigenvectors.column(eigen.eigenvalues.imin());
        let map = Matrix3::from_row_slice(solution.as_slice());
        let axis_norm = map.row(2).norm();
        // Points before the camera have a positive third coordinate.
        let sign = if map.row(2).dot(&mean.transpose()) < 0.0 { -1.0 } else { 1.0 };
        let place_from_ray = map * (sign / axis_norm);
        let (width, height) = (cloud.width as f64, cloud.height as f64);
        let is_usable = axis_norm > 1e-9 && place_from_ray.determinant().abs() > 1e-9;
        is_usable.then_some(Self { origin, place_from_ray, width, height })
    }

    /// Unit vector out of the camera, in the input's frame.
    pub fn optical_axis(&self) -> Vec3 {
        self.place_from_ray.row(2).transpose()
    }

    /// Column and row that see a point, which may be outside the image; `None` behind the camera.
    pub fn pixel(&self, point: &Vec3) -> Option<[f64; 2]> {
        let place = self.place_from_ray * (point - self.origin);
        (place.z > 1e-6).then(|| [(place.x / place.z + 0.5) * self.width, (place.y / place.z + 0.5) * self.height])
    }

    /// Maps a direction out of the origin to its pixel's column and row, homogeneous.
    pub fn pixel_from_ray(&self) -> Matrix3<f64> {
        let pixel_from_place = Matrix3::from_rows(&[
            RowVector3::new(self.width, 0.0, 0.5 * self.width),
            RowVector3::new(0.0, self.height, 0.5 * self.height),
            RowVector3::new(0.0, 0.0, 1.0),
        ]);
        pixel_from_place * self.place_from_ray
    }

    /// Maps a pixel's column, row and 1 to its ray, of any positive length, in the input's frame.
    pub fn ray_from_pixel(&self) -> Option<Matrix3<f64>> {
        let place_from_pixel = Matrix3::from_rows(&[
            RowVector3::new(1.0 / self.width, 0.0, -0.5),
            RowVector3::new(0.0, 1.0 / self.height, -0.5),
            RowVector3::new(0.0, 0.0, 1.0),
        ]);
        Some(self.place_from_ray.try_inverse()? * place_from_pixel)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::SplitMix64;
    use nalgebra::{Rotation3, Unit};

    #[test]
    fn finds_any_camera_and_the_pixel_of_any_point() {
        let mut rng = SplitMix64::new(3);
        let mut checked = 0;
        for _ in 0..40 {
            let mut value = |scale: f64| scale * (2.0 * rng.unit() - 1.0);
            let turn = Rotation3::from_scaled_axis(Vec3::new(value(2.0), value(2.0), value(2.0)));
            let origin = Vec3::new(value(1.0), value(1.0), value(1.0));
            let (width, height, focal) = (64, 48, 60.0 + value(20.0));
            let ray = |x: f64, y: f64| turn * Vec3::new((x - 31.0) / focal, (y - 25.0) / focal, 1.0);
            let points: Vec<[f32; 3]> = (0..width * height)
                .map(|k| {
                    let at = origin + ray((k % width) as f64, (k / width) as f64) * (0.8 + (k * k % 17) as f64 * 0.05);
                    if k % 7 == 0 {
                        [f32::NAN; 3]
                    } else {
                        [at.x as f32, at.y as f32, at.z as f32]
                    }
                })
                .collect();
            let cloud = CloudView { points: &points, width, height, viewpoint: Some(origin) };
            let found = Projection::of(&cloud).unwrap();
            assert!(found.optical_axis().dot(&Unit::new_normalize(turn * Vec3::z())) > 1.0 - 1e-6);
            let rays = found.ray_from_pixel().unwrap();
            for (x, y) in [(3.0, 4.0), (60.5, 2.0), (-10.0, 70.0)] {
                let [column, row] = found.pixel(&(origin + ray(x, y) * 1.7)).unwrap();
                assert!((column - x).abs() + (row - y).abs() < 0.02, "{column} {row}");
                let cosine = (rays * Vec3::new(x, y, 1.0)).normalize().dot(&ray(x, y).normalize());
                assert!(cosine > 1.0 - 1e-8);
                checked += 1;
            }
            assert!(found.pixel(&(origin - ray(5.0, 5.0))).is_none());
        }
        assert_eq!(checked, 120);
    }
}
