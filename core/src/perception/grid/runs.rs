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
    pub width: u32,
}

impl Runs {
    pub fn new(labels: &[u16], width: usize) -> Self {
        let mut runs = Vec::with_capacity(labels.len() / 64);
        let mut starts = vec![0];
        for (row, line) in labels.chunks_exact(width).enumerate() {
            let offset = row * width;
            let mut x = 0;
            while x < width {
                let (start, label) = (x, line[x]);
                x = end_of_run(line, x);
                if label != NONE {
                    runs.push(Run { start: (offset + start) as u32, end: (offset + x) as u32, label });
                }
            }
            starts.push(runs.len() as u32);
        }
        Self { runs, starts, width: width as u32 }
    }

    /// Of pixels in order: all of one label.
    pub fn of_one(runs: Vec<Run>, width: usize, height: usize) -> Self {
        let row_of = |run: &Run| run.start as usize / width;
        let starts = (0..=height).map(|row| runs.partition_point(|r| row_of(r) < row) as u32).collect();
        Self { runs, starts, width: width as u32 }
    }

    pub fn rows(&self) -> usize {
        self.starts.len() - 1
    }

    /// Numbers of the runs of a row.
    pub fn of_row(&self, row: usize) -> std::ops::Range<usize> {
        self.starts[row] as usize..self.starts[row + 1] as usize
    }

    /// Calls `met` with each pair of runs of two rows, the first above the second, and how many columns they share.
    pub fn for_shared(&self, upper: usize, lower: usize, mut met: impl FnMut(usize, usize, u32)) {
        let down = (lower - upper) as u32 * self.width;
        let (above, here) = (self.of_row(upper), self.of_row(lower));
        let (mut a, mut b) = (above.start, here.start);
        while a < above.end && b < here.end {
            let (one, other) = (self.runs[a], self.runs[b]);
            let (start, end) = (one.start + down, one.end + down);
            let shared = end.min(other.end).saturating_sub(start.max(other.start));
            if shared > 0 {
                met(a, b, shared);
            }
            if end < other.end {
                a += 1;
            } else {
                b += 1;
            }
        }
    }

    /// Connected runs of equal label: those that share at least `overlap` columns in neighbouring rows. The number of each
    /// run's component is that of its first run.
    pub fn components(&self, overlap: u32) -> Vec<u32> {
        let mut sets = UnionFind::new(self.runs.len());
        for row in 1..self.rows() {
            self.for_shared(row - 1, row, |a, b, shared| {
                if self.runs[a].label == self.runs[b].label && shared >= overlap {
                    sets.join(a, b);
                }
            });
        }
        (0..self.runs.len()).map(|run| sets.find(run) as u32).collect()
    }
}

/// Where the label of pixel `x` of a row ends; long runs go eight pixels at a time.
fn end_of_run(line: &[u16], x: usize) -> usize {
    const STEP: usize = 8;
    let label = line[x];
    let mut end = x + 1;
    while let Some(next) = line[end..].first_chunk::<STEP>() {
        if *next != [label; STEP] {
            break;
        }
        end += STEP;
    }
    line[end..].iter().position(|&l| l != label).map_or(line.len(), |more| end + more)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_of_any_length_end_where_their_label_does() {
        let mut cases = 0;
        for length in 1..=40 {
            for offset in 0..10 {
                let mut line = vec![NONE; offset];
                line.extend(vec![3; length]);
                line.extend([5, 5]);
                let runs = Runs::new(&line, line.len()).runs;
                let (start, end) = (offset as u32, (offset + length) as u32);
                let expected = [Run { start, end, label: 3 }, Run { start: end, end: end + 2, label: 5 }];
                assert_eq!(runs, expected);
                cases += 1;
            }
        }
        assert_eq!(cases, 400);
    }

    #[test]
    fn a_narrow_bridge_joins_only_where_it_is_wide_enough() {
        let row = |text: &str| text.bytes().map(|b| if b == b'.' { NONE } else { 0 }).collect::<Vec<u16>>();
        let labels = [row("######...."), row("....##...."), row("....######")].concat();
        let runs = Runs::new(&labels, 10);
        assert_eq!(runs.components(2), [0, 0, 0]);
        assert_eq!(runs.components(3), [0, 1, 2]);
    }
}
