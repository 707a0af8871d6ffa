use super::SegmentImage;

/// Pixels compared at once where nothing ends.
const RUN: usize = 32;

/// A pixel of a segment and the step to a neighbour that is not of it, or to beyond the image.
#[derive(Debug, Clone, Copy)]
pub struct Exit {
    pub segment: usize,
    pub pixel: usize,
    pub column: usize,
    pub row: usize,
    /// One of (1, 0), (-1, 0), (0, 1), (0, -1): columns, rows.
    pub step: (isize, isize),
}

/// Ways out of a segment to one of the four neighbours of its pixels, row by row: sideways in every second row, up and
/// down in every second column. Half of the votes tell as much as all.
pub fn for_each_exit(image: &SegmentImage, mut act: impl FnMut(Exit)) {
    let (width, height) = (image.width, image.height);
    let row_of = |row: usize| &image.labels[row * width..(row + 1) * width];
    let mut leave = |label: i32, column: usize, row: usize, step: (isize, isize)| {
        if label >= 0 {
            act(Exit { segment: label as usize, pixel: row * width + column, column, row, step });
        }
    };
    for row in 0..height {
        let here = row_of(row);
        if row % 2 == 0 {
            leave(here[0], 0, row, (-1, 0));
            each_difference(here, &here[1..], |u| {
                leave(here[u], u, row, (1, 0));
                leave(here[u + 1], u + 1, row, (-1, 0));
            });
            leave(here[width - 1], width - 1, row, (1, 0));
        }
        if row + 1 < height {
            let below = row_of(row + 1);
            each_difference(here, below, |u| {
                if u % 2 == 0 {
                    leave(here[u], u, row, (0, 1));
                    leave(below[u], u, row + 1, (0, -1));
                }
            });
        }
    }
    for (row, step) in [(0, (0, -1)), (height - 1, (0, 1))] {
        row_of(row).iter().enumerate().for_each(|(u, &label)| leave(label, u, row, step));
    }
}

/// Calls `act` with each place where two rows differ, as far as the shorter goes.
fn each_difference(a: &[i32], b: &[i32], mut act: impl FnMut(usize)) {
    let (a, b) = (&a[..a.len().min(b.len())], &b[..a.len().min(b.len())]);
    for (run, (x, y)) in a.chunks(RUN).zip(b.chunks(RUN)).enumerate() {
        if x.iter().zip(y).fold(0, |differs, (p, q)| differs | (p ^ q)) == 0 {
            continue;
        }
        for (k, (p, q)) in x.iter().zip(y).enumerate() {
            if p != q {
                act(run * RUN + k);
            }
        }
    }
}
