//! Each rim edge is scanned for its flap: at every angle the readings are asked whether a board leaves the edge there.

use super::hinge_line::HingeLine;
use super::rows::Rows;
use super::sight::Sight;
use crate::geometry::Vec3;

/// A flap as the scan sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScannedFlap {
    pub angle_rad: f64,
    /// 1/m.
    pub curl: f64,
    pub length_m: f64,
    /// Readings on it, through it and before it, pixels.
    pub met: f64,
    pub through: f64,
    pub hidden: f64,
}

impl ScannedFlap {
    pub fn score(&self) -> f64 {
        self.met - 2.0 * self.through
    }
}

/// What a scan may find. Radians, metres.
#[derive(Debug, Clone, Copy)]
pub struct ScanRange {
    pub angles_rad: [f64; 2],
    pub longest_m: f64,
    /// How well the hinge is known.
    pub model_m: f64,
    /// Angles that are followed, at most, and places along the edge at which they are.
    pub peaks: usize,
    pub columns: usize,
    /// Whether a board is looked for beyond what hides it near its hinge.
    pub over_hidden: bool,
}

impl ScanRange {
    /// Ways from the hinge at which all angles are asked.
    fn reaches(&self) -> impl Iterator<Item = f64> {
        let far = if self.over_hidden { &FAR_M[..] } else { &[] };
        NEAR_M.iter().chain(far).copied()
    }

    /// A board turns so far that its far end, where it is asked, moves by about the noise.
    fn step_rad(&self) -> f64 {
        if self.over_hidden {
            FAR_STEP_RAD
        } else {
            STEP_RAD
        }
    }

    /// How far a board is followed before its angle is bettered.
    fn looks(&self) -> &'static [f64] {
        if self.over_hidden {
            &[0.2]
        } else {
            &[0.05, 0.1]
        }
    }
}

const STEP_RAD: f64 = 0.06;
/// Of angles that lie this near to each other the best is followed.
const SAME_RAD: f64 = 0.09;
const FAR_STEP_RAD: f64 = 0.03;
/// Where a board is seen from its edge, and to either side so many of them.
const EDGE_ON_STEP_RAD: f64 = 0.01;
const EDGE_ON_STEPS: i32 = 8;
const NEAR_M: [f64; 4] = [0.013, 0.021, 0.032, 0.047];
const FAR_M: [f64; 5] = [0.065, 0.085, 0.11, 0.14, 0.18];
/// Places along the edge at which all angles are asked.
const NEAR_COLUMNS: usize = 6;
/// Left out at each end of the edge, share of its half.
const END_SHARE: f64 = 0.08;
/// Rows by which a board is followed from its hinge.
const ROW_M: f64 = 0.005;
const LEAST_MET_SHARE: f64 = 0.4;
/// A board is given up after so much of its way without a reading on it.
const MOST_GAP_M: f64 = 0.03;
const LEAST_ROWS_M: f64 = 0.012;

/// The best flap on an edge, `None` where no angle has more readings for it than against it.
pub fn scan(sight: &Sight, hinge: &HingeLine, range: &ScanRange) -> Option<ScannedFlap> {
    follow_best(sight, hinge, peaks(sight, hinge, range).into_iter(), range)
}

/// The angles at which most speaks for a board near its hinge, so many as are followed, best first.
pub fn peaks(sight: &Sight, hinge: &HingeLine, range: &ScanRange) -> Vec<f64> {
    let angles = angles(hinge, &sight.eye, range);
    let near = Board::new(sight, hinge, range, NEAR_COLUMNS);
    let scores: Vec<f64> = angles.iter().map(|&angle| near.near_score(angle)).collect();
    let is_peak = |i: usize| {
        let of = |j: usize| scores.get(j).copied().unwrap_or(f64::NEG_INFINITY);
        scores[i] > 0.0 && scores[i] >= of(i + 1) && (i == 0 || scores[i] > of(i - 1))
    };
    let mut peaks: Vec<usize> = (0..angles.len()).filter(|&i| is_peak(i)).collect();
    peaks.sort_by(|&a, &b| scores[b].total_cmp(&scores[a]));
    apart(peaks.into_iter().map(|i| angles[i]), range)
}

/// Of the flaps that are followed from these angles the best.
pub fn follow_best(
    sight: &Sight,
    hinge: &HingeLine,
    angles: impl Iterator<Item = f64>,
    range: &ScanRange,
) -> Option<ScannedFlap> {
    let board = Board::new(sight, hinge, range, range.columns);
    let followed = angles.filter_map(|angle| board.follow(angle));
    followed.filter(|flap| flap.score() > 0.0).fold(None, |best: Option<ScannedFlap>, flap| match best {
        Some(best) if best.score() >= flap.score() => Some(best),
        _ => Some(flap),
    })
}

/// The first of these angles, so many as are followed; of those that lie side by side, as they do where a board is seen from its
/// edge, one.
fn apart(angles: impl Iterator<Item = f64>, range: &ScanRange) -> Vec<f64> {
    let mut out: Vec<f64> = Vec::new();
    for angle in angles {
        let is_new = |other: &f64| !range.over_hidden || (angle - other).abs() > SAME_RAD;
        if out.len() < range.peaks && out.iter().all(is_new) {
            out.push(angle);
        }
    }
    out
}

/// The angles that are asked, ascending; where something is missed, more of those at which a board is seen from its edge: a little
/// further it is seen elsewhere.
fn angles(hinge: &HingeLine, eye: &Vec3, range: &ScanRange) -> Vec<f64> {
    let step = range.step_rad();
    let steps = ((range.angles_rad[1] - range.angles_rad[0]) / step).ceil() as usize;
    let mut out: Vec<f64> = (0..=steps).map(|i| range.angles_rad[0] + i as f64 * step).collect();
    if range.over_hidden {
        out.extend(hinge.edge_on_angles(eye, EDGE_ON_STEPS, EDGE_ON_STEP_RAD, range.angles_rad));
        out.sort_by(f64::total_cmp);
    }
    out
}

/// A board on an edge, asked for at places in columns along it.
struct Board<'a> {
    sight: &'a Sight<'a>,
    rows: Rows<'a>,
    hinge: &'a HingeLine,
    range: &'a ScanRange,
}

impl<'a> Board<'a> {
    fn new(sight: &'a Sight, hinge: &'a HingeLine, range: &'a ScanRange, count: usize) -> Self {
        let half = hinge.half_m * (1.0 - END_SHARE);
        let columns_m = (0..count).map(|i| half * ((2 * i + 1) as f64 / count as f64 - 1.0)).collect();
        Self { sight, rows: Rows::new(sight, hinge, range.model_m, columns_m), hinge, range }
    }

    /// More places on the board than through it; where that can no longer be, it is not asked by how many less.
    fn near_score(&self, angle: f64) -> f64 {
        let (way, normal) = self.hinge.directions(angle);
        let reaches = || self.range.reaches().filter(|reach| *reach < self.range.longest_m);
        let count = self.rows.columns() as i32;
        let (mut score, mut left) = (0, reaches().count() as i32 * count);
        for reach in reaches() {
            if score + left <= 0 {
                break;
            }
            left -= count;
            let said = self.rows.ask(&(self.hinge.middle + way * reach), &normal);
            score += said.met.count_ones() as i32 - said.through.count_ones() as i32;
        }
        f64::from(score)
    }

    /// Followed from the hinge outwards, its angle and curl fitted to what is met on the way.
    fn follow(&self, angle: f64) -> Option<ScannedFlap> {
        let range = self.range;
        let mut flap = ScannedFlap { angle_rad: angle, curl: 0.0, length_m: 0.0, met: 0.0, through: 0.0, hidden: 0.0 };
        for &reach in range.looks().iter().chain([&range.longest_m]) {
            let walk = self.walk(&flap, reach.min(range.longest_m));
            flap = walk.fitted(&flap)?;
            if reach >= range.longest_m {
                break;
            }
        }
        let last = self.walk(&flap, range.longest_m);
        let [least, most] = range.angles_rad;
        let within = (least - STEP_RAD..=most + STEP_RAD).contains(&flap.angle_rad);
        (within && last.length_m >= LEAST_ROWS_M).then_some(ScannedFlap {
            length_m: last.length_m,
            met: last.met,
            through: last.through,
            hidden: last.hidden,
            ..flap
        })
    }

    fn walk(&self, flap: &ScannedFlap, longest_m: f64) -> Walk {
        let (hinge, range) = (self.hinge, self.range);
        let (way, normal) = hinge.directions(flap.angle_rad);
        let mut out = Walk::default();
        let mut pending = [0.0; 3];
        let (mut reach, mut last_met) = (0.010, 0.010);
        let column_m = 2.0 * hinge.half_m * (1.0 - END_SHARE) / range.columns as f64;
        while reach < longest_m && reach - last_met < MOST_GAP_M {
            let height = flap.curl * reach * reach / 2.0;
            let tilted = normal - way * (flap.curl * reach);
            let (mut met, mut through, mut hidden) = (0.0, 0.0, 0.0);
            let middle = hinge.middle + way * reach + normal * height;
            let pixels = self.sight.pixels(&middle, &normal, ROW_M * column_m);
            let said = self.rows.ask(&middle, &tilted);
            for (sum, of) in [(&mut met, said.met), (&mut through, said.through), (&mut hidden, said.hidden)] {
                (0..of.count_ones()).for_each(|_| *sum += pixels);
            }
            let mut left = said.met;
            while left != 0 {
                let column = left.trailing_zeros() as usize;
                left &= left - 1;
                let Some(reading) = self.sight.reading(said.indices[column] as usize) else { continue };
                let from = reading - hinge.middle;
                let (x, y) = (way.dot(&from), normal.dot(&from));
                let (q, y) = (x * x / 2.0, y - flap.curl * x * x / 2.0);
                for (sum, term) in out.sums.iter_mut().zip([x * x, x * q, q * q, x * y, q * y]) {
                    *sum += term;
                }
            }
            for (sum, term) in pending.iter_mut().zip([met, through, hidden]) {
                *sum += term;
            }
            if met > LEAST_MET_SHARE * (met + through) && met > 0.15 * (met + through + hidden) {
                out.met += pending[0];
                out.through += pending[1];
                out.hidden += pending[2];
                pending = [0.0; 3];
                last_met = reach;
                out.length_m = reach + ROW_M / 2.0;
            } else if range.over_hidden && hidden > met + through {
                // Nothing says that it ends here.
                last_met += ROW_M;
            }
            reach += ROW_M;
        }
        out
    }
}

/// What is met on a board of a given angle and curl.
#[derive(Default)]
struct Walk {
    length_m: f64,
    met: f64,
    through: f64,
    hidden: f64,
    /// Sums over met readings for y = a x + b x^2 / 2: x x, x x^2, x^2 x^2, x y, x^2 y.
    sums: [f64; 5],
}

impl Walk {
    /// Angle and curl bettered by what was met.
    fn fitted(&self, flap: &ScannedFlap) -> Option<ScannedFlap> {
        let [xx, xq, qq, xy, qy] = self.sums;
        if xx <= 0.0 {
            return None;
        }
        // Boards bend by some degrees over their length: without readings far out the curl stays 0.
        let qq = qq + CURL_PRIOR;
        let determinant = xx * qq - xq * xq;
        let (slope, bend) = ((xy * qq - qy * xq) / determinant, (xx * qy - xq * xy) / determinant);
        Some(ScannedFlap {
            angle_rad: flap.angle_rad + slope.atan(),
            curl: (flap.curl + bend).clamp(-MOST_CURL, MOST_CURL),
            ..*flap
        })
    }
}

/// In the units of the sums: (x^2/2)^2 summed over readings of 0.1 m reach.
const CURL_PRIOR: f64 = 2e-5;
const MOST_CURL: f64 = 2.5;
