use super::super::scene::EdgeKind;

/// The order in which ties are decided.
const KINDS: [EdgeKind; 4] = [EdgeKind::Edge, EdgeKind::Crease, EdgeKind::Occluded, EdgeKind::Border];

/// How many boundary readings of one segment say what of each side of its rectangle.
#[derive(Debug, Clone, Copy, Default)]
pub struct Votes {
    /// By side, then by kind as in `KINDS`.
    counts: [[u32; 4]; 4],
}

impl Votes {
    pub fn add(&mut self, side: usize, kind: EdgeKind) {
        self.counts[side][kind as usize] += 1;
    }

    /// The kind with most votes of each side, the first of `KINDS` among equals.
    pub fn winners(&self) -> [EdgeKind; 4] {
        self.counts.map(|of_side| {
            let most = (1..4).fold(0, |best, k| if of_side[k] > of_side[best] { k } else { best });
            KINDS[most]
        })
    }
}
