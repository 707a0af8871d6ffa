use super::facet::Facet;
use crate::cloud::{CloudView, Projection};
use crate::geometry::Vec3;
use crate::perception::readings::Readings;

/// Pixels of a panel that are looked at, about.
const SAMPLES: f64 = 400.0;
/// A panel's outermost strip is left out: its share of the panel's width, and at most so many metres.
const STRIP_SHARE: f64 = 0.15;
const MAX_STRIP_M: f64 = 0.008;
/// The model may be off by this much beside the sensor's noise, metres.
const MODEL_M: f64 = 0.004;

/// What the rays that should meet a panel say, in pixels of the image.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Looked {
    /// Readings on the panel.
    pub met: f64,
    /// Readings behind it: the camera looked through where it should be.
    pub through: f64,
    /// Readings before it: something hides it.
    pub hidden: f64,
    /// Pixels without a reading.
    pub blank: f64,
    /// Beyond the image's edge.
    pub outside: f64,
}

/// Looks along the rays at each panel of one body (eq. 59); `None` for a cloud without image or viewpoint.
pub fn look(cloud: &CloudView, readings: &Readings, panels: &[Facet]) -> Option<Vec<Looked>> {
    if !cloud.is_organized() || cloud.viewpoint.is_none() {
        return None;
    }
    let projection = Projection::of(cloud)?;
    let eye = Eye { cloud, readings, rays: projection.ray_from_pixel()?, projection };
    Some(panels.iter().map(|panel| eye.look_at(panel)).collect())
}

struct Eye<'a> {
    cloud: &'a CloudView<'a>,
    readings: &'a Readings<'a>,
    projection: Projection,
    rays: nalgebra::Matrix3<f64>,
}

impl Eye<'_> {
    fn look_at(&self, panel: &Facet) -> Looked {
        let mut looked = Looked::default();
        let Some([low, high]) = self.bounds(panel) else { return looked };
        let size = [0, 1].map(|k| high[k] - low[k] + 1);
        let stride = ((size[0] as f64 * size[1] as f64 / SAMPLES).sqrt() as i64).max(1);
        let pixels = (stride * stride) as f64;
        let inset_m = (STRIP_SHARE * panel.width_m()).min(MAX_STRIP_M);
        for row in (low[1]..=high[1]).step_by(stride as usize) {
            for column in (low[0]..=high[0]).step_by(stride as usize) {
                let ray = (self.rays * Vec3::new(column as f64, row as f64, 1.0)).normalize();
                let Some(range_m) = panel.hit_m(&self.projection.origin, &ray, inset_m) else { continue };
                *self.answer(column, row, &ray, range_m, panel, &mut looked) += pixels;
            }
        }
        looked
    }

    /// What a ray says that should meet the panel at this range.
    fn answer<'a>(
        &self,
        column: i64,
        row: i64,
        ray: &Vec3,
        range_m: f64,
        panel: &Facet,
        looked: &'a mut Looked,
    ) -> &'a mut f64 {
        let (width, height) = (self.cloud.width as i64, self.cloud.height as i64);
        if column < 0 || row < 0 || column >= width || row >= height {
            return &mut looked.outside;
        }
        let pixel = (row * width + column) as u32;
        if !self.readings.is_reading(pixel) {
            return &mut looked.blank;
        }
        let point = self.readings.point(pixel);
        let behind_m = (ray.dot(&(point - self.projection.origin)) - range_m) * panel.normal().dot(ray).abs();
        let tolerance_m = self.readings.tolerance_m(&point) + MODEL_M;
        if behind_m > tolerance_m {
            &mut looked.through
        } else if behind_m < -tolerance_m {
            &mut looked.hidden
        } else {
            &mut looked.met
        }
    }

    /// The panel's bounds in the image, and no farther than an image's size beyond it; `None` where it comes behind the
    /// camera.
    fn bounds(&self, panel: &Facet) -> Option<[[i64; 2]; 2]> {
        let size = [self.cloud.width as f64, self.cloud.height as f64];
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for corner in panel.corners() {
            let place = self.projection.pixel(corner)?;
            for k in 0..2 {
                let at = place[k].clamp(-size[k], 2.0 * size[k]);
                (low[k], high[k]) = (low[k].min(at), high[k].max(at));
            }
        }
        Some([low.map(|x| x.floor() as i64), high.map(|x| x.ceil() as i64)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::perception::PerceptionSettings;

    const WIDTH: usize = 160;
    const HEIGHT: usize = 120;

    /// A wall 2 m away, with a board 1 m away in the image's left half; a hole without readings at the bottom.
    fn scene() -> Vec<[f32; 3]> {
        let point = |k: usize| {
            let (column, row) = (k % WIDTH, k / WIDTH);
            let z = if row > 110 {
                f32::NAN
            } else if column < WIDTH / 2 {
                1.0
            } else {
                2.0
            };
            [(column as f32 - 80.0) / 150.0 * z, (row as f32 - 60.0) / 150.0 * z, z]
        };
        (0..WIDTH * HEIGHT).map(point).collect()
    }

    fn looked(panels: &[[[f64; 3]; 4]]) -> Vec<Looked> {
        let points = scene();
        let cloud = CloudView { points: &points, width: WIDTH, height: HEIGHT, viewpoint: Some(Vec3::zeros()) };
        let settings = PerceptionSettings::default();
        let facets: Vec<Facet> = panels.iter().map(|c| Facet::new(c.map(Vec3::from)).unwrap()).collect();
        look(&cloud, &Readings::new(&cloud, &settings), &facets).unwrap()
    }

    fn upright(x: [f64; 2], y: [f64; 2], z: f64) -> [[f64; 3]; 4] {
        [[x[0], y[0], z], [x[1], y[0], z], [x[1], y[1], z], [x[0], y[1], z]]
    }

    #[test]
    fn tells_met_from_through_from_hidden() {
        let all = looked(&[
            upright([-0.3, -0.1], [-0.2, 0.1], 1.0),
            upright([0.1, 0.3], [-0.2, 0.1], 1.0),
            upright([-0.5, -0.1], [-0.2, 0.1], 1.5),
            upright([-0.9, -0.6], [-0.2, 0.1], 1.0),
        ]);
        let counts = |l: &Looked| [l.met, l.through, l.hidden, l.outside].map(|n| n > 0.0);
        assert_eq!(counts(&all[0]), [true, false, false, false], "{all:?}");
        assert_eq!(counts(&all[1]), [false, true, false, false], "{all:?}");
        assert_eq!(counts(&all[2]), [false, false, true, false], "{all:?}");
        assert_eq!(counts(&all[3]), [false, false, false, true], "{all:?}");
        // 30 x 45 pixels, less a strip of 1.2 pixels.
        assert!((all[0].met - 30.0 * 45.0).abs() < 250.0, "{all:?}");
    }

    #[test]
    fn either_way_round_and_through_the_camera() {
        let mut turned = upright([-0.3, -0.1], [-0.2, 0.1], 1.0);
        turned.reverse();
        let around = [[-1.0, 0.2, -1.0], [1.0, 0.2, -1.0], [1.0, 0.2, 1.0], [-1.0, 0.2, 1.0]];
        let all = looked(&[upright([-0.3, -0.1], [-0.2, 0.1], 1.0), turned, around]);
        assert_eq!(all[0], all[1]);
        assert_eq!(all[2], Looked::default());
    }
}
