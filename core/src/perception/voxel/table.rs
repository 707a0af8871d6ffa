use super::fixed::FixedMoments;

const FIRST_BITS: u32 = 12;
const EMPTY: u32 = u32::MAX;
/// Spreads numbers that differ in few bits (2^64 over the golden ratio).
const SPREAD: u64 = 0x9E37_79B9_7F4A_7C15;

/// Sums for each occupied cube, found by its number: open addressing, linear probing.
pub struct Table {
    /// Number of each cube, in order of its first reading.
    pub keys: Vec<u64>,
    pub sums: Vec<FixedMoments>,
    slots: Vec<(u64, u32)>,
    bits: u32,
}

impl Table {
    pub fn new() -> Self {
        Self { keys: vec![], sums: vec![], slots: vec![(0, EMPTY); 1 << FIRST_BITS], bits: FIRST_BITS }
    }

    /// Adds a reading; the position of its cube in `keys`.
    #[inline]
    pub fn add(&mut self, key: u64, at: [u32; 3]) -> u32 {
        let slot = self.slot_of(key);
        let mut id = self.slots[slot].1;
        if id == EMPTY {
            id = self.insert(key, slot);
        }
        self.sums[id as usize].add(at);
        id
    }

    #[inline]
    fn slot_of(&self, key: u64) -> usize {
        let mask = self.slots.len() - 1;
        let mut slot = spread(key, self.bits);
        while self.slots[slot].1 != EMPTY && self.slots[slot].0 != key {
            slot = (slot + 1) & mask;
        }
        slot
    }

    #[cold]
    fn insert(&mut self, key: u64, slot: usize) -> u32 {
        let id = self.keys.len() as u32;
        self.keys.push(key);
        self.sums.push(FixedMoments::default());
        self.slots[slot] = (key, id);
        if 2 * self.keys.len() > self.slots.len() {
            self.grow();
        }
        id
    }

    fn grow(&mut self) {
        self.bits += 1;
        self.slots = vec![(0, EMPTY); 1 << self.bits];
        for id in 0..self.keys.len() {
            let slot = self.slot_of(self.keys[id]);
            self.slots[slot] = (self.keys[id], id as u32);
        }
    }
}

/// The highest `bits` bits of a number well mixed.
#[inline]
pub fn spread(key: u64, bits: u32) -> usize {
    (key.wrapping_mul(SPREAD) >> (64 - bits)) as usize
}
