//! What the rays say of a box's walls, and what that counts.

/// What the rays say of a box's four walls, in pixels of the image; walls as in `Proposal`.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ShellLook {
    /// Readings on outer faces and on inner ones.
    pub met: [[f64; 2]; 4],
    pub through: f64,
    pub hidden: f64,
    /// Readings that close the opening, and those below it.
    pub lid: f64,
    pub inside: f64,
}

/// Flaps that are shut close a part of an opening: so much of it for each reading below.
const INSIDE_TO_LID: f64 = 0.6;

impl ShellLook {
    /// What speaks for the box. What hides it says little: of two boxes that are seen alike the smaller.
    pub fn score(&self) -> f64 {
        self.met.iter().flatten().sum::<f64>()
            - 2.0 * self.through
            - (self.lid - INSIDE_TO_LID * self.inside).max(0.0)
            - 0.05 * self.hidden
    }

    /// The score if so much more were on its walls, and below its opening.
    pub fn most(&self, left_over: f64) -> f64 {
        Self { inside: self.inside + left_over, ..*self }.score() + left_over
    }
}
