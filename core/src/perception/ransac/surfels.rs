use super::voxels::Neighbours;
use crate::geometry::Vec3;

/// Small patches of surface, one for each cell of a coarse grid.
#[derive(Debug, Clone)]
pub struct Surfels {
    /// Side of a cell, metres.
    pub cell_m: f64,
    /// Middle of each patch, metres.
    pub centers: Vec<Vec3>,
    /// Largest distance from a plane of a reading that belongs to it, metres.
    pub tolerance_m: Vec<f64>,
    /// Unit normal of the surroundings, zero where they are not flat; its sign means nothing.
    pub normals: Vec<Vec3>,
    pub neighbours: Neighbours,
}

impl Surfels {
    pub fn len(&self) -> usize {
        self.centers.len()
    }
}
