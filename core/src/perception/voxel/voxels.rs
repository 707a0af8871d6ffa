use super::bounds::Bounds;
use super::lattice::Lattice;
use super::neighbours::Neighbours;
use super::table::Table;
use crate::geometry::{Moments, Plane, Vec3};

/// Number that stands for no voxel, no surface, no segment.
pub const NONE: u32 = u32::MAX;

/// Occupied cubes in ascending order of their place, with the sums of their readings.
///
/// Places are told from the bounds' lowest corner, metres ("inside"), so that far-off clouds keep their digits.
pub struct Voxels {
    pub low: Vec3,
    pub size_m: f64,
    pub moments: Vec<Moments>,
    pub centers: Vec<Vec3>,
    pub neighbours: Neighbours,
}

impl Voxels {
    /// The voxels of these readings, and the voxel of each.
    pub fn new(points: &[[f32; 3]], bounds: &Bounds, size_m: f64) -> (Self, Vec<u32>) {
        let lattice = Lattice::new(bounds, size_m);
        let mut table = Table::new();
        let mut voxel_of: Vec<u32> = Vec::with_capacity(points.len());
        voxel_of.extend(points.iter().map(|p| {
            let (key, at) = lattice.locate(p);
            table.add(key, at)
        }));
        let mut order: Vec<(u64, u32)> = table.keys.iter().enumerate().map(|(id, &key)| (key, id as u32)).collect();
        order.sort_unstable();
        let mut rank = vec![NONE; order.len()];
        order.iter().enumerate().for_each(|(place, &(_, id))| rank[id as usize] = place as u32);
        voxel_of.iter_mut().for_each(|v| *v = rank[*v as usize]);
        let sums = order.iter().map(|&(key, id)| table.sums[id as usize].to_moments(&lattice, key));
        let moments: Vec<Moments> = sums.collect();
        let keys: Vec<u64> = order.iter().map(|&(key, _)| key).collect();
        let centers = moments.iter().map(Moments::mean).collect();
        let neighbours = Neighbours::new(&keys);
        (Self { low: bounds.low, size_m: lattice.size_m, moments, centers, neighbours }, voxel_of)
    }

    pub fn len(&self) -> usize {
        self.moments.len()
    }

    pub fn count(&self, voxel: usize) -> f64 {
        self.moments[voxel].weight
    }

    /// A point of the input, inside.
    #[inline]
    pub fn inside(&self, p: &[f32; 3]) -> Vec3 {
        Vec3::new(f64::from(p[0]), f64::from(p[1]), f64::from(p[2])) - self.low
    }

    pub fn plane_of_input(&self, inside: &Plane) -> Plane {
        Plane { normal: inside.normal, distance: inside.distance + inside.normal.dot(&self.low) }
    }

    pub fn plane_inside(&self, of_input: &Plane) -> Plane {
        Plane { normal: of_input.normal, distance: of_input.distance - of_input.normal.dot(&self.low) }
    }
}
