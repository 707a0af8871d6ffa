//! Boxes that segments propose: two walls' places along each of two directions, and a rim's height.

use super::patch::Patch;
use crate::geometry::Vec3;

/// A box without flaps, in the level frame: `axes` are its directions square to its own `up`, `spans` where its outer faces
/// lie along them (low, high), `heights` those of underside and rim. Metres.
#[derive(Debug, Clone, PartialEq)]
pub struct Proposal {
    pub axes: [Vec3; 2],
    pub up: Vec3,
    pub spans: [[f64; 2]; 2],
    pub heights: [f64; 2],
    /// Readings of segments that would be its flaps, shares that lie along its walls.
    pub on_flaps: f64,
}

/// Where a wall's outer face may lie along a direction.
#[derive(Debug, Clone, Copy)]
struct Place {
    at_m: f64,
    shown_by: ShownBy,
}

/// What shows where a wall is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ShownBy {
    Wall(usize),
    /// Its upper edge alone.
    Rim(usize),
    /// A flap that hangs on it.
    Flap(usize),
    /// Where walls across end.
    Nothing,
}

/// Board taken for what is seen from inside, metres.
const BOARD_M: f64 = 0.004;
pub const SIZES_M: [f64; 2] = [0.05, 1.0];
pub const HEIGHTS_M: [f64; 2] = [0.025, 0.8];
/// Walls are within this of square to the box's directions (cosine).
pub const LEAST_COS: f64 = 0.985;
/// Places nearer than this are one.
const SAME_M: f64 = 0.008;
/// A rim stands where its wall does; what is within the box near a wall has none.
const SAME_RIM_PLACE_M: f64 = 0.004;
/// A wall reaches this far, or this share of it, beyond its neighbours: what is more belongs to something else.
const OVERHANG_M: f64 = 0.03;
const OVERHANG_SHARE: f64 = 0.25;
/// A wall is seen over at least this share of its width.
const LEAST_COVER: f64 = 0.2;
/// Proposals for each direction, and rims for each of them, at most.
const MOST: usize = 600;
const MOST_RIMS: usize = 5;
const SAME_RIM_M: f64 = 0.010;
/// A panel's readings count up to here.
pub const MOST_READINGS: f64 = 6000.0;
/// A flap shows a wall's place less well.
pub const OF_FLAPS: f64 = 0.5;

/// The frame turned about its third axis.
pub fn turned([x, y, up]: &[Vec3; 3], yaw: f64) -> [Vec3; 3] {
    let (sin, cos) = yaw.sin_cos();
    [x * cos + y * sin, y * cos - x * sin, *up]
}

/// All that patches, and rims as the walls below them, propose for boxes that stand in this direction.
pub fn proposals(patches: &[Patch], rims: &[Patch], frame: &[Vec3; 3], yaw: f64) -> Vec<Proposal> {
    let axes = turned(frame, yaw);
    let first_rim = patches.len();
    let patches: &Vec<Along> = &patches.iter().chain(rims).map(|patch| Along::new(patch, &axes)).collect();
    let found = [0, 1].map(|a| pairs(patches, first_rim, &axes, a));
    let mut plans: Vec<Plan> = Vec::new();
    for first in &found[0] {
        for second in &found[1] {
            plans.extend(plan(patches, &axes[2], [first, second]));
        }
    }
    plans.sort_by(|a, b| b.score.total_cmp(&a.score));
    plans.truncate(MOST);
    plans.iter().flat_map(|plan| with_rims(patches, &plan.proposal(&axes))).collect()
}

/// A patch, and how it lies along a box's directions and its up.
struct Along {
    patch: Patch,
    spans: [[f64; 2]; 3],
    is_upright: bool,
    /// Of its normal along the directions.
    leans: [f64; 2],
    rise: f64,
    /// Of its level direction along them, if it has one.
    runs: Option<[f64; 2]>,
}

impl Along {
    fn new(patch: &Patch, axes: &[Vec3; 3]) -> Self {
        let [x, y, up] = axes;
        Self {
            patch: patch.clone(),
            spans: axes.each_ref().map(|axis| patch.span(axis)),
            is_upright: patch.is_upright(up),
            leans: [patch.normal.dot(x), patch.normal.dot(y)],
            rise: patch.normal.dot(up),
            runs: patch.level_direction(up).map(|along| [along.dot(x), along.dot(y)]),
        }
    }
}

/// A box of two pairs of walls, whose rim is still to come.
struct Plan {
    score: f64,
    spans: [[f64; 2]; 2],
    bottom_m: f64,
    on_flaps: f64,
}

impl Plan {
    fn proposal(&self, [x, y, up]: &[Vec3; 3]) -> Proposal {
        let Self { spans, bottom_m, on_flaps, .. } = *self;
        Proposal { axes: [*x, *y], up: *up, spans, heights: [bottom_m, bottom_m], on_flaps }
    }
}

/// Two opposite walls: low and high.
type Pair = [Place; 2];

fn pairs(patches: &[Along], first_rim: usize, axes: &[Vec3; 3], a: usize) -> Vec<Pair> {
    let axis = &axes[a];
    let [mut low, mut high]: [Vec<Place>; 2] = [Vec::new(), Vec::new()];
    for (number, Along { spans, is_upright, leans, .. }) in patches.iter().enumerate() {
        if *is_upright && leans[a].abs() > LEAST_COS {
            let [from, to] = spans[a];
            let at_m = (from + to) / 2.0;
            let shown_by = if number < first_rim { ShownBy::Wall(number) } else { ShownBy::Rim(number) };
            let shown = |at_m: f64| Place { at_m, shown_by };
            // Seen from outside it is the wall on the camera's side, from inside the one across.
            if leans[a] > 0.0 {
                low.push(shown(at_m - BOARD_M));
                high.push(shown(at_m));
            } else {
                low.push(shown(at_m));
                high.push(shown(at_m + BOARD_M));
            }
        }
    }
    for (number, Along { patch, spans, is_upright, runs, .. }) in patches.iter().enumerate() {
        let runs = |direction: usize| runs.is_none_or(|runs| runs[direction].abs() > LEAST_COS);
        // Walls across end where these stand; flaps hang on them with one of their edges.
        let shown_by = if *is_upright && runs(a) {
            ShownBy::Nothing
        } else if !is_upright && runs(1 - a) && patch.span(&Vec3::z())[1] > HEIGHTS_M[0] {
            ShownBy::Flap(number)
        } else {
            continue;
        };
        for at_m in spans[a] {
            low.push(Place { at_m, shown_by });
            high.push(Place { at_m, shown_by });
        }
    }
    if axis.z > LEAST_COS {
        // The side on which a box lies is on the support.
        low.push(Place { at_m: 0.0, shown_by: ShownBy::Nothing });
    }
    let (low, high) = (distinct(low), distinct(high));
    let fits = |l: &Place, h: &Place| (SIZES_M[0]..=SIZES_M[1]).contains(&(h.at_m - l.at_m));
    let with = |l: Place| high.iter().filter(move |h| fits(&l, h)).map(move |h| [l, *h]);
    low.iter()
        .flat_map(|l| with(*l))
        .filter(|[l, h]| l.shown_by == ShownBy::Nothing || l.shown_by != h.shown_by)
        .collect()
}

/// Without those that lie where one lies that is shown better, or an earlier one.
fn distinct(places: Vec<Place>) -> Vec<Place> {
    let rank = |place: &Place| match place.shown_by {
        ShownBy::Wall(_) => 0,
        ShownBy::Rim(_) => 1,
        ShownBy::Flap(_) => 2,
        ShownBy::Nothing => 3,
    };
    let mut out: Vec<Place> = places.iter().filter(|place| rank(place) == 0).copied().collect();
    for (wanted, same_m) in [(1, SAME_RIM_PLACE_M), (2, SAME_M), (3, SAME_M)] {
        for place in &places {
            if rank(place) == wanted && out.iter().all(|other| (other.at_m - place.at_m).abs() > same_m) {
                out.push(*place);
            }
        }
    }
    out
}

/// A box of two pairs of walls, where they fit each other, and how much of it is shown; its rim is still to come.
fn plan(patches: &[Along], up: &Vec3, pairs: [&Pair; 2]) -> Option<Plan> {
    let spans = pairs.map(|pair| [pair[0].at_m, pair[1].at_m]);
    let (mut walls, mut flaps, mut shown, mut by_flaps, mut lowest) = (0, 0, 0.0, 0.0, f64::INFINITY);
    for wall in 0..4 {
        let (number, is_wall) = match pairs[wall / 2][wall % 2].shown_by {
            ShownBy::Wall(number) | ShownBy::Rim(number) => (number, true),
            ShownBy::Flap(number) => (number, false),
            ShownBy::Nothing => continue,
        };
        let Along { patch, spans: along, .. } = &patches[number];
        let other = 1 - wall / 2;
        let [from, to] = along[other];
        let [low, high] = spans[other];
        let overhang = (low - from).max(0.0) + (to - high).max(0.0);
        let overlap = to.min(high) - from.max(low);
        if overhang > OVERHANG_M.max(OVERHANG_SHARE * (to - from)) || overlap < LEAST_COVER * (high - low) {
            continue;
        }
        let readings = patch.readings.min(MOST_READINGS) * (overlap / (high - low));
        if is_wall {
            walls += 1;
            lowest = along[2][0].min(lowest);
            shown += readings;
        } else {
            flaps += 1;
            by_flaps += readings;
        }
    }
    // What stands level stands on the support; what leans ends where its walls do.
    let bottom_m = if up.z > 0.9999 { 0.0 } else { lowest };
    let count = walls + flaps;
    let is_enough = bottom_m.is_finite() && (walls >= 2 || count >= 3);
    is_enough.then_some(Plan { score: shown + OF_FLAPS * by_flaps, spans, bottom_m, on_flaps: by_flaps })
}

/// The plan with each height at which its rim may be: where its walls end, where tilted panels meet its walls.
fn with_rims(patches: &[Along], plan: &Proposal) -> Vec<Proposal> {
    let mut rims: Vec<(f64, f64)> = Vec::new();
    for wall in 0..4 {
        for patch in patches {
            rims.extend(rim(patch, plan, wall));
        }
    }
    rims.retain(|(at_m, _)| (HEIGHTS_M[0]..=HEIGHTS_M[1]).contains(&(at_m - plan.heights[0])));
    let mut out = Vec::new();
    while out.len() < MOST_RIMS {
        let votes = |z: f64| rims.iter().filter(|r| (r.0 - z).abs() < SAME_RIM_M).map(|r| r.1).sum::<f64>();
        let best = rims.iter().map(|r| (votes(r.0), r.0)).fold((0.0, 0.0), |a, b| if b.0 > a.0 { b } else { a });
        if best.0 <= 0.0 {
            break;
        }
        let near: Vec<_> = rims.iter().filter(|r| (r.0 - best.1).abs() < SAME_RIM_M).collect();
        let at_m = near.iter().map(|r| r.0 * r.1).sum::<f64>() / best.0;
        rims.retain(|r| (r.0 - best.1).abs() >= SAME_RIM_M);
        out.push(Proposal { heights: [plan.heights[0], at_m], ..plan.clone() });
    }
    out
}

/// The height at which a patch says that a wall ends, and how loudly.
fn rim(
    Along { patch, spans, is_upright, leans, rise, runs }: &Along,
    plan: &Proposal,
    wall: usize,
) -> Option<(f64, f64)> {
    let (a, is_high) = (wall / 2, wall % 2 == 1);
    let (axis, across) = (&plan.axes[a], &plan.axes[1 - a]);
    let at_m = plan.spans[a][usize::from(is_high)];
    let ([from, to], [low, high]) = (spans[1 - a], plan.spans[1 - a]);
    let overlap = (to.min(high) - from.max(low)) / (high - low);
    if overlap < LEAST_COVER || overlap * (high - low) < 0.5 * (to - from) {
        return None;
    }
    let [near, far] = spans[a];
    if *is_upright && leans[a].abs() > LEAST_COS {
        let inside = at_m - 0.015..=at_m + 0.015;
        return inside.contains(&((near + far) / 2.0)).then(|| (spans[2][1], overlap * OF_TOPS));
    }
    // A flap: its plane meets the wall's at the hinge, which is where it ends too.
    if runs.is_some_and(|runs| runs[1 - a].abs() < LEAST_COS) || rise.abs() < 0.2 {
        return None;
    }
    let middle = across * ((from + to) / 2.0) + axis * at_m;
    let z = (patch.distance_m - patch.normal.dot(&middle)) / rise;
    let ends_there = [near, far].iter().any(|end| (end - at_m).abs() < 0.03);
    ends_there.then_some((z, overlap))
}

/// A wall's top may be a flap's that goes on in its plane.
const OF_TOPS: f64 = 0.7;
