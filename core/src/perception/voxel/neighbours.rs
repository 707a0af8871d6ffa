use super::lattice::Lattice;

/// Occupied cubes that touch each cube by a face, an edge or a corner, one list after another.
pub struct Neighbours {
    starts: Vec<u32>,
    ids: Vec<u32>,
}

impl Neighbours {
    /// Of cubes in ascending order of their numbers: nine rows of up to three, each found by a pointer that only moves on.
    pub fn new(keys: &[u64]) -> Self {
        let strides: [i64; 9] = std::array::from_fn(|k| Lattice::stride(k as i64 / 3 - 1, k as i64 % 3 - 1) - 1);
        let mut rows = [0usize; 9];
        let mut starts = Vec::with_capacity(keys.len() + 1);
        let mut ids = Vec::with_capacity(keys.len() * 10);
        starts.push(0);
        for (own, &key) in keys.iter().enumerate() {
            for (row, stride) in rows.iter_mut().zip(strides) {
                let first = key.wrapping_add_signed(stride);
                while *row < keys.len() && keys[*row] < first {
                    *row += 1;
                }
                let touching = (*row..keys.len().min(*row + 3)).take_while(|&k| keys[k] <= first + 2);
                ids.extend(touching.filter(|&k| k != own).map(|k| k as u32));
            }
            starts.push(ids.len() as u32);
        }
        Self { starts, ids }
    }

    #[inline]
    pub fn of(&self, cube: usize) -> &[u32] {
        &self.ids[self.starts[cube] as usize..self.starts[cube + 1] as usize]
    }
}
