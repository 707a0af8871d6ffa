use std::ops::{Deref, DerefMut};

/// Axes of an arm, at most.
pub const MAX_AXES: usize = 7;

/// The position of every joint, rad, first joint first; reads as a slice, lives on the stack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointPositions {
    values: [f64; MAX_AXES],
    axes: usize,
}

impl JointPositions {
    pub fn zeros(axes: usize) -> Self {
        Self { values: [0.0; MAX_AXES], axes: axes.min(MAX_AXES) }
    }

    /// Takes the first [`MAX_AXES`].
    pub fn from_slice(values: &[f64]) -> Self {
        let mut made = Self::zeros(values.len());
        let axes = made.axes;
        made.copy_from_slice(&values[..axes]);
        made
    }
}

impl Deref for JointPositions {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        &self.values[..self.axes]
    }
}

impl DerefMut for JointPositions {
    fn deref_mut(&mut self) -> &mut [f64] {
        &mut self.values[..self.axes]
    }
}
