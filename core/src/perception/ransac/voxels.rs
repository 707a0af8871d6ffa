use super::super::readings::Readings;
use crate::geometry::Vec3;

/// Cells along one axis: 21 bits each in a key.
const MAX_CELLS_PER_AXIS: f64 = 2_000_000.0;
const EMPTY: u32 = u32::MAX;

/// Occupied cells of a regular grid, numbered in order of their first reading.
#[derive(Debug, Clone)]
pub struct Voxels {
    pub size_m: f64,
    /// Integer coordinates of each cell.
    pub cells: Vec<[i32; 3]>,
    /// Readings of cell `c`: `members[starts[c]..starts[c + 1]]`, in input order.
    pub starts: Vec<u32>,
    pub members: Vec<u32>,
    slots: Vec<u32>,
    mask: usize,
}

impl Voxels {
    /// Sorts the readings `indices` (not empty) into cells of `size_m`, doubled until there are no more than `max_cells`.
    pub fn new(readings: &Readings, indices: &[u32], size_m: f64, max_cells: usize) -> Self {
        let (low, high) = bounds(readings, indices);
        let mut size_m = size_m.max((high - low).max() / MAX_CELLS_PER_AXIS);
        loop {
            if let Some(voxels) = Self::try_new(readings, indices, &low, size_m, max_cells) {
                return voxels;
            }
            size_m *= 2.0;
        }
    }

    fn try_new(readings: &Readings, indices: &[u32], low: &Vec3, size_m: f64, max_cells: usize) -> Option<Self> {
        let mut voxels =
            Self { size_m, cells: vec![], starts: vec![], members: vec![], slots: vec![EMPTY; 1024], mask: 1023 };
        let mut cell_of = Vec::with_capacity(indices.len());
        for &i in indices {
            let q = (readings.point(i) - low) / size_m;
            cell_of.push(voxels.find_or_add([q.x as i32, q.y as i32, q.z as i32]));
            if voxels.cells.len() > max_cells {
                return None;
            }
        }
        voxels.gather(indices, &cell_of);
        Some(voxels)
    }

    fn gather(&mut self, indices: &[u32], cell_of: &[u32]) {
        let mut counts = vec![0u32; self.cells.len() + 1];
        for &c in cell_of {
            counts[c as usize + 1] += 1;
        }
        for c in 1..counts.len() {
            counts[c] += counts[c - 1];
        }
        self.starts = counts.clone();
        self.members = vec![0; indices.len()];
        for (&i, &c) in indices.iter().zip(cell_of) {
            self.members[counts[c as usize] as usize] = i;
            counts[c as usize] += 1;
        }
    }

    pub fn len(&self) -> usize {
        self.cells.len()
    }

    pub fn members_of(&self, cell: usize) -> &[u32] {
        &self.members[self.starts[cell] as usize..self.starts[cell + 1] as usize]
    }

    /// Number of the cell at these coordinates, if a reading is in it.
    pub fn find(&self, cell: [i32; 3]) -> Option<u32> {
        let found = self.slots[self.slot_of(&cell)];
        (found != EMPTY).then_some(found)
    }

    /// Cells that touch each cell by a face, an edge or a corner: those of `c` are `ids[starts[c]..starts[c + 1]]`.
    pub fn neighbours(&self) -> Neighbours {
        let mut starts = vec![0u32];
        let mut ids = Vec::with_capacity(self.cells.len() * 9);
        for &[x, y, z] in &self.cells {
            for step in 0..27 {
                let [dx, dy, dz] = [step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1];
                if step != 13 {
                    ids.extend(self.find([x + dx, y + dy, z + dz]));
                }
            }
            starts.push(ids.len() as u32);
        }
        Neighbours { starts, ids }
    }

    fn find_or_add(&mut self, cell: [i32; 3]) -> u32 {
        let slot = self.slot_of(&cell);
        if self.slots[slot] != EMPTY {
            return self.slots[slot];
        }
        let id = self.cells.len() as u32;
        self.cells.push(cell);
        self.slots[slot] = id;
        if self.cells.len() * 2 > self.slots.len() {
            self.grow();
        }
        id
    }

    fn grow(&mut self) {
        self.slots = vec![EMPTY; self.slots.len() * 4];
        self.mask = self.slots.len() - 1;
        for id in 0..self.cells.len() {
            let slot = self.slot_of(&self.cells[id]);
            self.slots[slot] = id as u32;
        }
    }

    /// The slot that holds this cell, or the empty one where it would go (open addressing, linear probing).
    fn slot_of(&self, cell: &[i32; 3]) -> usize {
        let key = (cell[0] as u64) << 42 ^ ((cell[1] as u64) & 0x1F_FFFF) << 21 ^ (cell[2] as u64 & 0x1F_FFFF);
        let mut slot = (key.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 32) as usize & self.mask;
        while self.slots[slot] != EMPTY && self.cells[self.slots[slot] as usize] != *cell {
            slot = (slot + 1) & self.mask;
        }
        slot
    }
}

/// Lists of adjacent cells, one after another.
#[derive(Debug, Clone)]
pub struct Neighbours {
    starts: Vec<u32>,
    ids: Vec<u32>,
}

impl Neighbours {
    /// From one list for each cell, in order.
    pub fn new(lists: impl Iterator<Item = impl Iterator<Item = u32>>) -> Self {
        let (mut starts, mut ids) = (vec![0], Vec::new());
        for list in lists {
            ids.extend(list);
            starts.push(ids.len() as u32);
        }
        Self { starts, ids }
    }

    pub fn of(&self, cell: usize) -> &[u32] {
        &self.ids[self.starts[cell] as usize..self.starts[cell + 1] as usize]
    }

    pub fn len(&self) -> usize {
        self.starts.len() - 1
    }
}

fn bounds(readings: &Readings, indices: &[u32]) -> (Vec3, Vec3) {
    let first = readings.point(indices[0]);
    indices.iter().fold((first, first), |(low, high), &i| {
        let p = readings.point(i);
        (low.inf(&p), high.sup(&p))
    })
}
