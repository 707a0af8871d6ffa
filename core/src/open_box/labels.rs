//! Which parts of a body have readings, and which.

use crate::fit::Role;

/// The parts of a body that readings are given to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Present {
    pub flaps: [bool; 4],
    pub tucks: [bool; 4],
    /// Those of the flaps that were found from their edge: readings lie on that as well as on a face.
    pub thin: [bool; 4],
}

impl Present {
    /// Of the same box with side `by` as side 0.
    pub fn turned(&self, by: usize) -> Self {
        let turn = |of: &[bool; 4]| std::array::from_fn(|k| of[(k + by) % 4]);
        Self { flaps: turn(&self.flaps), tucks: turn(&self.tucks), thin: turn(&self.thin) }
    }

    /// Whether it is a flap that was found from its edge.
    pub fn is_thin(&self, role: Role) -> bool {
        matches!(role, Role::Flap(k) if self.thin[k])
    }

    /// Those of them that hang on the sides told.
    pub fn among(&self, sides: &[bool; 4]) -> Self {
        let both = |of: &[bool; 4]| std::array::from_fn(|k| of[k] && sides[k]);
        Self { flaps: both(&self.flaps), tucks: both(&self.tucks), thin: both(&self.thin) }
    }
}

/// The readings of each part of a box, in the image's order.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Labels {
    pub parts: Vec<(Role, Vec<u32>)>,
    /// Every so many columns and rows were asked.
    pub stride: usize,
}

impl Labels {
    pub fn of(&self, role: Role) -> &[u32] {
        self.parts.iter().find(|(r, _)| *r == role).map_or(&[], |(_, points)| points)
    }
}

impl Labels {
    /// Readings of the whole image that a part's stand for.
    pub fn count(&self, points: &[u32]) -> usize {
        points.len() * self.stride * self.stride
    }

    /// Marks its readings in an image that is so wide; of every `stride`-th column and row each stands for those up to the next.
    pub fn mark(&self, width: usize, is_taken: &mut [bool]) {
        let height = is_taken.len() / width;
        for &point in self.parts.iter().flat_map(|(_, points)| points) {
            let (row, column) = (point as usize / width, point as usize % width);
            for row in row..(row + self.stride).min(height) {
                is_taken[row * width + column..row * width + (column + self.stride).min(width)].fill(true);
            }
        }
    }

    pub fn clear(&mut self, role: Role) {
        self.parts.iter_mut().filter(|(r, _)| *r == role).for_each(|(_, points)| points.clear());
    }
}

/// Roles in the order of places.
pub fn roles(present: &Present) -> Vec<Role> {
    let mut out = vec![Role::Base];
    out.extend((0..4).map(Role::Side));
    out.extend((0..4).filter(|&k| present.flaps[k]).map(Role::Flap));
    out.extend((0..4).filter(|&k| present.tucks[k]).map(Role::Tuck));
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn readings_of_coarse_labels_stand_for_their_neighbours() {
        let labels = |points: &[u32], stride: usize| Labels { parts: vec![(Role::Base, points.to_vec())], stride };
        let mut out = vec![false; 64 * 48];
        [labels(&[65, 47 * 64 + 62], 3), labels(&[5], 1)].iter().for_each(|labels| labels.mark(64, &mut out));
        let set: Vec<usize> = (0..out.len()).filter(|&i| out[i]).collect();
        assert_eq!(set, [5, 65, 66, 67, 129, 130, 131, 193, 194, 195, 3070, 3071]);
    }
}
