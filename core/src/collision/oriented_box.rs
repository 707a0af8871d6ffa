use crate::geometry::{Rigid, Vec3};

/// A box that stands in the base's frame: its centre's frame, and half its sizes along that frame's axes, metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OrientedBox {
    pub base_from_box: Rigid,
    pub half_m: Vec3,
}

impl OrientedBox {
    pub fn new(base_from_box: Rigid, half_m: Vec3) -> Self {
        Self { base_from_box, half_m }
    }

    /// The board of a panel: the rectangle along its first edge that encloses its corners at mid-board, as thick as the board.
    /// `None` where the corners span no area.
    pub fn of_panel(corners: &[Vec3; 4], thickness_m: f64) -> Option<Self> {
        let x = (corners[1] - corners[0]).try_normalize(f64::EPSILON)?;
        let z = x.cross(&(corners[2] + corners[3] - corners[0] - corners[1])).try_normalize(f64::EPSILON)?;
        let rotation = nalgebra::Matrix3::from_columns(&[x, z.cross(&x), z]);
        let seen = corners.map(|corner| rotation.tr_mul(&corner));
        let low = seen.iter().fold(seen[0], |low, c| low.inf(c));
        let high = seen.iter().fold(seen[0], |high, c| high.sup(c));
        let half_m = (high - low) / 2.0 + Vec3::z() * (thickness_m / 2.0);
        Some(Self { base_from_box: Rigid::new(rotation, rotation * ((low + high) / 2.0)), half_m })
    }

    pub fn centre(&self) -> Vec3 {
        self.base_from_box.translation
    }

    pub fn corners(&self) -> [Vec3; 8] {
        std::array::from_fn(|k| {
            let sign = |bit: usize| if k >> bit & 1 == 1 { 1.0 } else { -1.0 };
            let corner = Vec3::new(sign(0), sign(1), sign(2)).component_mul(&self.half_m);
            self.base_from_box.apply(&corner)
        })
    }

    /// How far a point is from the box, squared; 0 inside.
    pub fn distance_to_point_sq_m2(&self, point: &Vec3) -> f64 {
        let seen = self.base_from_box.apply_inverse(point);
        (seen.abs() - self.half_m).sup(&Vec3::zeros()).norm_squared()
    }

    /// Half the box's extent along a unit direction.
    pub fn half_extent_m(&self, direction: &Vec3) -> f64 {
        self.base_from_box.rotation.tr_mul(direction).abs().dot(&self.half_m)
    }
}

/// Which corners (bits: x, y, z) each of a box's twelve edges joins.
pub const EDGES: [(usize, usize); 12] =
    [(0, 1), (2, 3), (4, 5), (6, 7), (0, 2), (1, 3), (4, 6), (5, 7), (0, 4), (1, 5), (2, 6), (3, 7)];
