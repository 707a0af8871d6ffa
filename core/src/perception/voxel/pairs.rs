use super::table::spread;

const FIRST_BITS: u32 = 8;
const EMPTY: u32 = u32::MAX;

/// What is summed up for pairs of surfaces.
pub struct Pairs<T> {
    found: Vec<((u32, u32), T)>,
    slots: Vec<u32>,
    bits: u32,
}

impl<T: Default> Pairs<T> {
    pub fn new() -> Self {
        Self { found: vec![], slots: vec![EMPTY; 1 << FIRST_BITS], bits: FIRST_BITS }
    }

    /// The sum of a pair, nothing at first.
    pub fn of(&mut self, a: u32, b: u32) -> &mut T {
        let slot = self.slot_of((a, b));
        if self.slots[slot] == EMPTY {
            self.slots[slot] = self.found.len() as u32;
            self.found.push(((a, b), T::default()));
            if 2 * self.found.len() > self.slots.len() {
                self.grow();
            }
            let last = self.found.len() - 1;
            return &mut self.found[last].1;
        }
        &mut self.found[self.slots[slot] as usize].1
    }

    /// All pairs, ascending.
    pub fn sorted(mut self) -> Vec<((u32, u32), T)> {
        self.found.sort_unstable_by_key(|f| f.0);
        self.found
    }

    fn slot_of(&self, pair: (u32, u32)) -> usize {
        let mask = self.slots.len() - 1;
        let mut slot = spread(u64::from(pair.0) << 32 | u64::from(pair.1), self.bits);
        while self.slots[slot] != EMPTY && self.found[self.slots[slot] as usize].0 != pair {
            slot = (slot + 1) & mask;
        }
        slot
    }

    fn grow(&mut self) {
        self.bits += 1;
        self.slots = vec![EMPTY; 1 << self.bits];
        for id in 0..self.found.len() {
            let slot = self.slot_of(self.found[id].0);
            self.slots[slot] = id as u32;
        }
    }
}
