//! Where a body's panels lie in the image: of a reading elsewhere it need not be asked how far it lies off them.

use super::sight::Sight;
use super::silhouette::Silhouette;
use super::surfaces::Surface;
use crate::fit::FittedBody;

/// Panels, by bits.
pub type Panels = u16;

/// Where each of a body's panels has its readings, row by row.
pub struct Footprints {
    of_panels: Vec<Footprint>,
    /// By column; those of one row.
    panels: Vec<Panels>,
}

/// `None` of a panel that reaches behind the camera, or so far that the noise is as large as it: its readings may be anywhere.
struct Footprint(Option<Outlined>);

struct Outlined {
    outline: Silhouette,
    /// First and last.
    rows: [f64; 2],
}

/// Readings lie no further beyond a panel, metres.
const MOST_OFF_M: f64 = 0.1;
/// By so much more than they may lie off it at the range of its farthest corner.
const SLACK_M: f64 = 1e-4;

impl Footprints {
    /// Of what readings may lie off panels for the noise and `model_m`.
    pub fn of(sight: &Sight, body: &FittedBody, panels: &[Surface], model_m: f64) -> Self {
        let of = |panel: &Surface| Footprint::of(sight, body, panel, model_m);
        Self { of_panels: panels.iter().map(of).collect(), panels: vec![0; sight.width] }
    }

    /// The panels that readings of a row between two columns, inclusive, may lie on; and the first and last of the columns at which
    /// there is any, none where the first is the greater.
    pub fn of_row(&mut self, row: usize, [left, right]: [usize; 2]) -> (&[Panels], [usize; 2]) {
        let (mut first, mut last) = (right + 1, left);
        self.panels[left..=right].fill(0);
        for (number, footprint) in self.of_panels.iter().enumerate() {
            let Some([from, to]) = footprint.columns(row, [left, right]) else { continue };
            self.panels[from..=to].iter_mut().for_each(|panels| *panels |= 1 << number);
            (first, last) = (first.min(from), last.max(to));
        }
        (&self.panels, [first, last])
    }
}

impl Footprint {
    fn of(sight: &Sight, body: &FittedBody, panel: &Surface, model_m: f64) -> Self {
        let at = |ends: [usize; 3], most_m: f64| body.to_input(&panel.corner(ends, most_m));
        let corners = (0..8).map(|number| at([number & 1, number >> 1 & 1, number >> 2], 0.0));
        let range_m = corners.map(|corner| (corner - sight.eye).norm()).fold(0.0, f64::max);
        let most_m = 3.0 * sight.sigma_m(range_m + 2.0 * MOST_OFF_M) + model_m + SLACK_M;
        if most_m.is_nan() || most_m > MOST_OFF_M {
            return Self(None);
        }
        Self(Silhouette::of(|ends| sight.pixel(&at(ends, most_m))).map(|outline| {
            let [_, _, top, bottom] = outline.bounds();
            Outlined { outline, rows: [top, bottom] }
        }))
    }

    /// Of a row those between two, inclusive.
    fn columns(&self, row: usize, [left, right]: [usize; 2]) -> Option<[usize; 2]> {
        let Some(Outlined { outline, rows: [top, bottom] }) = &self.0 else { return Some([left, right]) };
        let row = row as f64;
        if row < top - Silhouette::MARGIN_PX || row > bottom + Silhouette::MARGIN_PX {
            return None;
        }
        let [low, high] = outline.columns(row);
        let (low, high) = (low.ceil().max(left as f64), high.floor().min(right as f64));
        (low <= high).then_some([low as usize, high as usize])
    }
}
