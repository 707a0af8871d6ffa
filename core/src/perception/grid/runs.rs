use super::regions::NONE;
use crate::perception::ransac::components::UnionFind;

/// Pixels of one row with one label.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Run {
    /// First pixel, and the one after the last.
    pub start: u32,
    pub end: u32,
    pub label: u16,
}

impl Run {
    pub fn len(&self) -> u32 {
        self.end - self.start
    }
}

/// The label image as runs, row by row; pixels without label are in none.
pub struct Runs {
    pub runs: Vec<Run>,
    /// The runs of row `y` are `runs[starts[y]..starts[y + 1]]`.
    starts: Vec<u32>,
    width: u32,
}

impl Runs {
    pub fn new(labels: &[u16], width: usize) -> Self {
        let mut runs = Vec::new();
        let mut starts = vec![0];
        for (row, line) in labels.chunks_exact(width).enumerate() {
            let offset = (row * width) as u32;
            let mut x = 0;
            for same in line.chunk_by(|a, b| a == b) {
                let end = x + same.len() as u32;
                if same[0] != NONE {
                    runs.push(Run { start: offset + x, end: offset + end, label: same[0] });
                }
                x = end;
            }
            starts.push(runs.len() as u32);
        }
        Self { runs, starts, width: width as u32 }
    }

    /// Connected runs of equal label: those that share at least `overlap` columns in neighbouring rows. The number of each
    /// run's component is that of its first run.
    pub fn components(&self, overlap: u32) -> Vec<u32> {
        let mut sets = UnionFind::new(self.runs.len());
        for row in 1..self.starts.len() - 1 {
            let (mut above, above_end) = (self.starts[row - 1] as usize, self.starts[row] as usize);
            let (mut here, here_end) = (above_end, self.starts[row + 1] as usize);
            while above < above_end && here < here_end {
                let (a, b) = (self.runs[above], self.runs[here]);
                let (a_start, a_end) = (a.start + self.width, a.end + self.width);
                let shared = a_end.min(b.end).saturating_sub(a_start.max(b.start));
                if a.label == b.label && shared >= overlap {
                    sets.join(above, here);
                }
                if a_end < b.end {
                    above += 1;
                } else {
                    here += 1;
                }
            }
        }
        (0..self.runs.len()).map(|run| sets.find(run) as u32).collect()
    }
}
