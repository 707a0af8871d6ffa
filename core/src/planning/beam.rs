//! The states that a layer of the search keeps.

use std::collections::HashMap;

use crate::arm::JointPositions;

/// One state of a layer: a contact, a tool orientation and a posture of the arm.
#[derive(Debug, Clone, Copy)]
pub struct State {
    pub place: [usize; 2],
    pub orientation: usize,
    pub positions: JointPositions,
    /// Of the inverse kinematics.
    pub branch: u8,
    /// Of the path up to it.
    pub cost: f64,
    /// Its place in the layer before.
    pub before: usize,
}

/// The states of a layer so far, not too many of one orientation.
pub struct Kept {
    pub states: Vec<State>,
    most: usize,
    most_alike: usize,
    alike: HashMap<(usize, u8), usize>,
}

impl Kept {
    pub fn new(most: usize, beam: usize) -> Self {
        Self { states: Vec::new(), most, most_alike: (beam / 8).max(2), alike: HashMap::new() }
    }

    pub fn is_full(&self) -> bool {
        self.states.len() >= self.most
    }

    pub fn has_room(&self, state: &State) -> bool {
        self.alike.get(&(state.orientation, state.branch)).is_none_or(|&count| count < self.most_alike)
    }

    pub fn push(&mut self, state: State) {
        *self.alike.entry((state.orientation, state.branch)).or_default() += 1;
        self.states.push(state);
    }
}

/// The states that lead to one of the last layer.
pub fn trace(layers: &[Vec<State>], end: usize) -> Vec<State> {
    let mut number = end;
    let mut path: Vec<State> = layers
        .iter()
        .rev()
        .map(|states| {
            let state = states[number];
            number = state.before;
            state
        })
        .collect();
    path.reverse();
    path
}
