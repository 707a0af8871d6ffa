//! Which boards meet when a flap turns, whatever the arm does.

use super::ends::run_into;
use super::flap::Flap;
use super::problem::BoxProblem;
use super::reason::Obstacle;
use super::settings::PlanningSettings;
use crate::geometry::Vec3;

/// The moving board is taken to be this much smaller all round: boards that only graze are given way by the folds, and models err
/// by millimetres.
const GRAZE_M: f64 = 0.006;
/// Of a short flap, by no more than this share of its length.
const GRAZE_SHARE: f64 = 0.1;
/// Between two angles at which boards are held against each other.
const STEP_RAD: f64 = 0.06;
/// The ends of a flap that has sprung up give way by this much to one that comes down beside them, to its free edge. Steeper than
/// this it presses them aside rather than down: flap on flap has friction (0.3, as physics assumes it), and cannot slide where its
/// tangent is steeper than 1 / friction, at 73.3 degrees; where flaps rest is told no better than what is added to that. A little below
/// it takes many times the force that presses the end down, and moves boxes: that is left for last.
const GIVING_END_M: f64 = 0.015;
const JAM_RAD: f64 = 1.2915;
const GENTLE_RAD: f64 = 1.2217;
/// Of two neighbours the one that comes below this first goes under the other, and its ends give way (docs/physics.md): counted on
/// short of the 15 mm there, as upright boards that meet by a hair jam.
const DOWN_RAD: f64 = 1.047;
const GOING_UNDER_END_M: f64 = 0.011;
/// Boards that meet this soon after the start met there already, by the model's error.
const START_RAD: f64 = 0.09;

/// How steeply a flap may come down on the end of a neighbour that sprang up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Descent {
    Gentle,
    /// As long as boards do not jam.
    Steep,
}

impl Descent {
    fn steepest_rad(self) -> f64 {
        match self {
            Self::Gentle => GENTLE_RAD,
            Self::Steep => JAM_RAD,
        }
    }
}

/// The first board that a flap meets on its way to an angle, while the others stand at `angles_rad`; None where the way is free.
///
/// It may come to lie on flaps that are closed, unless they have sprung up so far that it meets their ends where it is steep. Its own side and what hangs on itself do not count.
pub fn met(
    problem: &BoxProblem,
    angles_rad: &[f64],
    flap: usize,
    to_rad: f64,
    descent: Descent,
    settings: &PlanningSettings,
) -> Option<Obstacle> {
    let moving = &problem.flaps[flap];
    let others = problem.flaps.iter().enumerate().filter(|&(k, other)| k != flap && has_extent(other));
    let others: Vec<Beside> =
        others.flat_map(|(k, other)| beside(moving, angles_rad[flap], other, angles_rad[k], settings)).collect();
    let from_rad = angles_rad[flap];
    let across = problem.flaps.iter().enumerate().filter(|(_, other)| has_extent(other) && are_opposite(moving, other));
    let mut jamming = across.filter(|&(k, other)| run_into(moving, (from_rad, to_rad), other, angles_rad[k]));
    if let Some((_, other)) = jamming.next() {
        return Some(Obstacle::Boards { flap: moving.name.clone(), other: other.name.clone() });
    }
    let steps = ((from_rad - to_rad).abs() / STEP_RAD).ceil().max(1.0) as usize;
    let steps = (1..=steps).map(|step| (from_rad + (to_rad - from_rad) * step as f64 / steps as f64, false));
    // What lies stays there until it is pressed: what has met it by the angle where boards jam met it where it is steeper.
    let steepest_rad = descent.steepest_rad();
    let jamming = std::iter::once((steepest_rad.max(to_rad), true)).filter(|_| from_rad > steepest_rad);
    let asked = jamming.chain(steps);
    for (angle_rad, of_lying) in asked.filter(|(angle_rad, _)| (from_rad - angle_rad).abs() >= START_RAD) {
        let corners = moving.corners(angle_rad);
        let graze_m = GRAZE_M.min(GRAZE_SHARE * moving.length_m());
        let (whole, inner) = (shortened(&corners, GRAZE_M, graze_m), shortened(&corners, GOING_UNDER_END_M, 0.0));
        let meets = |other: &Beside| quads_cross(if other.is_over { &inner } else { &whole }, &other.corners);
        if let Some(other) = others.iter().filter(|other| other.gives_way == of_lying).find(|other| meets(other)) {
            return Some(Obstacle::Boards { flap: moving.name.clone(), other: other.name.to_string() });
        }
    }
    None
}

/// A board that a moving flap may meet.
struct Beside<'a> {
    name: &'a str,
    corners: [Vec3; 4],
    /// It lies, and is pressed down by what does not come down on it steeply.
    gives_way: bool,
    /// The moving flap goes under it: the ends of that give way, not its own.
    is_over: bool,
}

/// Another flap and what hangs on it.
fn beside<'a>(
    moving: &Flap,
    from_rad: f64,
    other: &'a Flap,
    at_rad: f64,
    settings: &PlanningSettings,
) -> Vec<Beside<'a>> {
    let gives_way = at_rad <= settings.lying_rad;
    if gives_way {
        let corners = shortened(&other.corners(at_rad), GIVING_END_M, 0.0);
        return vec![Beside { name: &other.name, corners, gives_way, is_over: false }];
    }
    let are_neighbours = !are_opposite(moving, other);
    // Of two that are down before anything moves the larger lies over the smaller.
    let goes_under = at_rad > DOWN_RAD || (from_rad <= DOWN_RAD && moving.area_m2() < other.area_m2());
    let gives_m = if are_neighbours && !goes_under { GOING_UNDER_END_M } else { 0.0 };
    let is_over = are_neighbours && goes_under;
    let board = (other.name.as_str(), shortened(&other.corners(at_rad), gives_m, 0.0));
    let boards = std::iter::once(board).chain(other.tuck_corners(at_rad));
    boards.map(|(name, corners)| Beside { name, corners, gives_way, is_over }).collect()
}

fn has_extent(flap: &Flap) -> bool {
    flap.standing != super::flap::Standing::Absent && flap.length_m() > 0.0
}

/// A board, hinge edge first, with its corners moved in by so much along hinge and free edge, and along the edges between.
fn shortened(corners: &[Vec3; 4], ends_m: f64, edges_m: f64) -> [Vec3; 4] {
    std::array::from_fn(|k| {
        let toward = |other: usize, by_m: f64| {
            let edge = corners[other % 4] - corners[k];
            edge * (by_m / edge.norm().max(2.0 * by_m).max(f64::MIN_POSITIVE))
        };
        // Hinge and free edge go from an even corner to the next.
        let (along, across) = if k % 2 == 0 { (k + 1, k + 3) } else { (k + 3, k + 1) };
        corners[k] + toward(along, ends_m) + toward(across, edges_m)
    })
}

/// Do two flaps hang on sides across from one another?
pub fn are_opposite(a: &Flap, b: &Flap) -> bool {
    matches!((a.number(), b.number()), (Some(p), Some(q)) if p % 2 == q % 2 && p != q)
}

/// Would two flaps lie over one another when both are closed? What only meets at a corner does.
pub fn overlap_closed(a: &Flap, b: &Flap) -> bool {
    let frame = a.frame(0.0);
    let flat = |flap: &Flap| {
        flap.corners(0.0).map(|corner| {
            let seen = frame.coordinates(&corner);
            [seen.x, seen.y]
        })
    };
    let (p, q) = (flat(a), flat(b));
    !parted(&p, &q) && !parted(&q, &p)
}

/// The angle at which a flap comes to lie on the corners of another that stands at an angle, `over_m` above its middle; the ends
/// of a neighbour give way, and its free edge too unless it lies `hard`, on what gives way no further.
pub fn propped_rad(flap: &Flap, below: &Flap, below_rad: f64, over_m: f64, hard: bool) -> f64 {
    let ends_m = if are_opposite(flap, below) { 0.0 } else { GIVING_END_M };
    let edges_m = if hard { 0.0 } else { ends_m };
    let (frame, closed) = (below.frame(below_rad), flap.frame(0.0));
    let corners = shortened(&below.corners(below_rad), ends_m, edges_m)
        .map(|corner| closed.coordinates(&(corner + frame.outward * over_m)));
    corners.iter().map(|corner| corner.z.atan2(corner.y.max(1e-6))).fold(0.0, f64::max)
}

/// Does an edge of one convex quadrilateral have all of the other on its outer side?
fn parted(p: &[[f64; 2]; 4], q: &[[f64; 2]; 4]) -> bool {
    let side = |k: usize, r: &[f64; 2]| {
        let (a, b) = (p[k], p[(k + 1) % 4]);
        (b[0] - a[0]) * (r[1] - a[1]) - (b[1] - a[1]) * (r[0] - a[0])
    };
    (0..4).any(|k| {
        let inside = side(k, &p[(k + 2) % 4]).signum();
        q.iter().all(|r| side(k, r) * inside <= 0.0)
    })
}

/// Do two flat convex quadrilaterals pass through each other?
pub fn quads_cross(a: &[Vec3; 4], b: &[Vec3; 4]) -> bool {
    edges_cross(a, b) || edges_cross(b, a)
}

fn edges_cross(a: &[Vec3; 4], b: &[Vec3; 4]) -> bool {
    let normal = (b[2] - b[0]).cross(&(b[3] - b[1]));
    (0..4).any(|k| {
        let (p, q) = (a[k], a[(k + 1) % 4]);
        let (over, under) = ((p - b[0]).dot(&normal), (q - b[0]).dot(&normal));
        if over * under >= 0.0 {
            return false;
        }
        let point = p + (q - p) * (over / (over - under));
        let turns: [f64; 4] = std::array::from_fn(|j| (b[(j + 1) % 4] - b[j]).cross(&(point - b[j])).dot(&normal));
        turns.iter().all(|turn| *turn >= 0.0) || turns.iter().all(|turn| *turn <= 0.0)
    })
}

#[cfg(test)]
mod tests {
    use super::super::sample_box::{carton, tapered};
    use super::*;

    fn quad(corners: [[f64; 3]; 4]) -> [Vec3; 4] {
        corners.map(|[x, y, z]| Vec3::new(x, y, z))
    }

    #[test]
    fn quads_cross_where_an_edge_of_one_goes_through_the_other() {
        let flat = quad([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
        let upright = |x: f64| quad([[x, 0.2, -0.5], [x, 0.8, -0.5], [x, 0.8, 0.5], [x, 0.2, 0.5]]);
        assert!(quads_cross(&flat, &upright(0.5)));
        assert!(!quads_cross(&flat, &upright(1.1)));
        assert!(!quads_cross(&flat, &flat.map(|p| p + Vec3::z())));
    }

    #[test]
    fn flaps_overlap_as_their_lengths_have_it() {
        let (short, long) = (carton(0.004, [0.1; 4]), carton(0.004, [0.16, 0.1, 0.16, 0.1]));
        let counted = (0..4).flat_map(|a| (0..4).filter(move |&b| b != a).map(move |b| (a, b))).filter(|&(a, b)| {
            let neighbours = (a + b) % 2 == 1;
            assert_eq!(are_opposite(&short.flaps[a], &short.flaps[b]), !neighbours);
            assert_eq!(overlap_closed(&short.flaps[a], &short.flaps[b]), neighbours, "{a} {b}");
            // Two of 0.16 m meet over a box of 0.3 m, two of 0.1 m over one of 0.4 m do not.
            assert_eq!(overlap_closed(&long.flaps[a], &long.flaps[b]), neighbours || a % 2 == 0, "{a} {b}");
            true
        });
        assert_eq!(counted.count(), 12);
    }

    #[test]
    fn flaps_prop_up_what_overlaps_them_near_its_hinge() {
        // 0.27 m over a box of 0.3 m: the edge is 0.03 m from the hinge across; of one of 0.1 m, 0.2 m.
        let counted = [(0.27, 0.03), (0.1, 0.2f64)].map(|(length_m, left_m)| {
            let carton = carton(0.004, [length_m; 4]);
            let propped = |below_rad, over_m| propped_rad(&carton.flaps[0], &carton.flaps[2], below_rad, over_m, true);
            assert!((propped(0.0, 0.004) - (0.004f64 / left_m).atan()).abs() < 1e-9, "{length_m}");
            assert!(propped(0.1, 0.004) > propped(0.0, 0.004) && propped(0.0, 0.0) < 1e-9);
            // Of a neighbour that lies flat, nothing.
            assert!(propped_rad(&carton.flaps[0], &carton.flaps[1], 0.0, 0.0, true) < 1e-9);
            // Of one that has sprung up, its corner 0.019 m from the hinge; as far in from its free edge where that gives way.
            let [hard, soft] =
                [true, false].map(|hard| propped_rad(&carton.flaps[0], &carton.flaps[1], 0.02, 0.0, hard));
            assert!((hard - (length_m * 0.02f64.sin() / 0.019).atan()).abs() < 1e-9, "{length_m}: {hard}");
            assert!((soft.tan() / hard.tan() - (1.0 - 0.015 / length_m)).abs() < 1e-9, "{length_m}: {soft}");
        });
        assert_eq!(counted.len(), 2);
    }

    #[test]
    fn a_flap_does_not_come_down_steeply_on_the_end_of_one_that_sprang_up() {
        let settings = PlanningSettings::default();
        let carton = carton(0.004, [0.2; 4]);
        let upright = std::f64::consts::FRAC_PI_2;
        let meets = |from_rad: f64, neighbour_rad: f64| {
            met(&carton, &[from_rad, neighbour_rad, upright, upright], 0, 0.0, Descent::Steep, &settings)
        };
        // Ends 0.019 m from the corner whose free edges stand up by 0.01, 0.049 and 0.0639 m are met at 28, 69 and 73.4 degrees, those
        // of 0.0695 and 0.082 m at 74.7 and 77: steps that the flap comes down in pass over what is between.
        let asked = [(0.05, false), (0.25, false), (0.325, false), (0.355, true), (0.42, true)];
        let counted = asked.map(|(neighbour_rad, jams)| {
            for from_rad in (0..30).map(|k| upright + 0.05 * f64::from(k)) {
                match meets(from_rad, neighbour_rad) {
                    Some(Obstacle::Boards { other, .. }) => {
                        assert!(jams && other == "flap_1", "{from_rad} {neighbour_rad}: {other}");
                    }
                    _ => assert!(!jams, "{from_rad} {neighbour_rad}"),
                }
            }
            // What is below already meets nothing there.
            assert!(meets(1.2, neighbour_rad).is_none());
        });
        assert_eq!(counted.len(), 5);
    }

    #[test]
    fn a_gentle_descent_waits_for_ends_that_a_steep_one_presses_down() {
        let settings = PlanningSettings::default();
        let carton = carton(0.004, [0.2; 4]);
        let upright = std::f64::consts::FRAC_PI_2;
        // Met at 66, 71.3 and 75.3 degrees: by both pressed down, by the steep one alone, and by neither.
        let asked = [(0.215, [false, false]), (0.285, [true, false]), (0.37, [true, true])];
        let counted = asked.map(|(neighbour_rad, waits)| {
            let waiting = [Descent::Gentle, Descent::Steep].map(|descent| {
                met(&carton, &[upright, neighbour_rad, upright, upright], 0, 0.0, descent, &settings).is_some()
            });
            assert_eq!(waiting, waits, "{neighbour_rad}");
        });
        assert_eq!(counted.len(), 3);
    }

    #[test]
    fn the_free_edge_of_a_board_that_tapers_counts_as_it_is() {
        let (settings, upright) = (PlanningSettings::default(), std::f64::consts::FRAC_PI_2);
        // Ends that give way 0.023 m from the corner: 0.0816 m are met at 74.2 degrees, 0.0779 m at 73.5.
        let counted = [(0.42, true), (0.40, false)].map(|(neighbour_rad, jams)| {
            let problem = tapered(0.004, 0.004, [0.2; 4]);
            let angles_rad = [upright, neighbour_rad, upright, upright];
            assert_eq!(
                met(&problem, &angles_rad, 0, 0.0, Descent::Steep, &settings).is_some(),
                jams,
                "{neighbour_rad}"
            );
        });
        assert_eq!(counted.len(), 2);
    }

    #[test]
    fn a_flap_waits_for_the_one_across_whose_free_edge_its_own_would_run_into() {
        let settings = PlanningSettings::default();
        let carton = carton(0.004, [0.22, 0.1, 0.22, 0.1]);
        let counted = [(0.82, true), (0.9, false)].map(|(across_rad, waits)| {
            match met(&carton, &[1.2, 2.5, across_rad, 2.5], 0, 0.0, Descent::Steep, &settings) {
                Some(Obstacle::Boards { other, .. }) => assert!(waits && other == "flap_2", "{across_rad}: {other}"),
                _ => assert!(!waits, "{across_rad}"),
            }
        });
        assert_eq!(counted.len(), 2);
    }

    #[test]
    fn ends_give_way_to_a_neighbour_that_stands() {
        let (settings, upright) = (PlanningSettings::default(), std::f64::consts::FRAC_PI_2);
        let meets = |wider_m: f64, neighbour_rad: f64| {
            let carton = carton(-wider_m, [0.2; 4]);
            met(&carton, &[upright, neighbour_rad, upright, upright], 0, 0.0, Descent::Steep, &settings).is_some()
        };
        // Flaps that reach over the rim's corners, by less and by more than ends give way; a neighbour over the opening.
        let asked = [(0.004, upright, false), (0.009, 1.67, false), (0.014, upright, true), (0.004, 0.7, true)];
        let counted = asked.map(|(wider_m, neighbour_rad, expected)| {
            assert_eq!(meets(wider_m, neighbour_rad), expected, "{wider_m} {neighbour_rad}");
        });
        assert_eq!(counted.len(), 4);
    }

    #[test]
    fn what_goes_under_a_neighbour_that_leans_over_the_opening_does_so_to_its_free_edge() {
        let settings = PlanningSettings::default();
        // A neighbour that leans in by 20 degrees is 18.2 mm in at the height of the upright flap's free edge, 16.4 mm at nine tenths of it;
        // the flap ends 6.5 or 9 mm from the corner, and 11 mm of that give way.
        let asked = [(0.0065, true), (0.009, false)].map(|(narrower_m, expected)| {
            let carton = carton(narrower_m, [0.05, 0.08, 0.05, 0.08]);
            let angles_rad = [std::f64::consts::FRAC_PI_2, 1.22, 2.5, 2.5];
            assert_eq!(
                met(&carton, &angles_rad, 0, 0.0, Descent::Steep, &settings).is_some(),
                expected,
                "{narrower_m}"
            );
        });
        assert_eq!(asked.len(), 2);
    }
}
