use crate::geometry::Plane;

/// A plane and its readings, in input order.
#[derive(Debug, Clone)]
pub struct Segment {
    pub plane: Plane,
    pub rms_m: f64,
    /// Of the cells that its readings are in.
    pub area_m2: f64,
    pub points: Vec<u32>,
}
