use super::Vec3;

/// Angle between two vectors, 0..pi; 0 where one of them has no length.
pub fn angle_between_rad(a: &Vec3, b: &Vec3) -> f64 {
    // atan2 keeps its precision near 0 and pi, where arccos loses it.
    a.cross(b).norm().atan2(a.dot(b))
}

/// Angle between two lines (vectors without a sign), 0..pi/2.
pub fn angle_between_lines_rad(a: &Vec3, b: &Vec3) -> f64 {
    a.cross(b).norm().atan2(a.dot(b).abs())
}
