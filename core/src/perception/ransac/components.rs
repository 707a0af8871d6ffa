use super::voxels::Neighbours;

/// Number that stands for "in no component".
pub const NONE: u32 = u32::MAX;

/// Connected components of the cells that are `inside`, numbered in order of their first cell; `NONE` outside.
pub fn components(neighbours: &Neighbours, inside: impl Fn(usize) -> bool) -> (Vec<u32>, usize) {
    let mut component = vec![NONE; neighbours.len()];
    let mut count = 0;
    let mut stack = Vec::new();
    for start in 0..neighbours.len() {
        if component[start] != NONE || !inside(start) {
            continue;
        }
        component[start] = count;
        stack.push(start);
        while let Some(cell) = stack.pop() {
            for &next in neighbours.of(cell) {
                let next = next as usize;
                if component[next] == NONE && inside(next) {
                    component[next] = count;
                    stack.push(next);
                }
            }
        }
        count += 1;
    }
    (component, count as usize)
}

/// Sets that merge; the smallest member names the set.
#[derive(Debug, Clone)]
pub struct UnionFind {
    parent: Vec<u32>,
}

impl UnionFind {
    pub fn new(len: usize) -> Self {
        Self { parent: (0..len as u32).collect() }
    }

    pub fn find(&mut self, mut a: usize) -> usize {
        while self.parent[a] as usize != a {
            self.parent[a] = self.parent[self.parent[a] as usize];
            a = self.parent[a] as usize;
        }
        a
    }

    pub fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.find(a), self.find(b));
        self.parent[a.max(b)] = a.min(b) as u32;
    }
}
