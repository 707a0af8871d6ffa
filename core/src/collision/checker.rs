use arrayvec::ArrayVec;

use super::nearest::{Nearest, Other};
use super::pair::{clear_by, distance_unless_above_m};
use super::pieces::{ArmPieces, Placed, MAX_PIECES};
use super::rules::{Rules, IGNORED};
use super::solid::Solid;
use super::world::{Ball, World};
use crate::arm::Arm;

/// An arm with its fingers at one opening, in a world.
#[derive(Debug, Clone, Copy)]
pub struct Checker<'a> {
    pub arm: &'a Arm,
    pub pieces: &'a ArmPieces,
    pub world: &'a World,
}

impl Checker<'_> {
    /// Whether everything is at least as far apart as the rules say, at these positions (rad). The quick question.
    pub fn is_clear(&self, positions: &[f64], rules: &Rules) -> bool {
        self.conflict(positions, rules).is_none()
    }

    /// The first pair that is nearer than the rules allow, the tool's before the arm's; costs what [`Checker::is_clear`] does.
    pub fn conflict(&self, positions: &[f64], rules: &Rules) -> Option<(usize, Other)> {
        let frames = self.arm.link_frames(positions);
        let mut placed = ArrayVec::<Placed, MAX_PIECES>::new();
        for piece in &self.pieces.shapes {
            let piece = piece.place(&frames);
            if let Some(obstacle) = self.obstacle_in_the_way(&piece, rules) {
                return Some((piece.body, Other::Obstacle(obstacle)));
            }
            placed.push(piece);
        }
        self.bodies_that_meet(&placed, rules)
    }

    /// The pair that has least to spare at these positions (rad); `None` where the rules ignore everything.
    pub fn nearest(&self, positions: &[f64], rules: &Rules) -> Option<Nearest> {
        let placed = self.pieces.place(self.arm, positions);
        let pairs = || self.world_pairs(&placed, rules).chain(self.own_pairs(&placed, rules));
        // The pair that is nearest by its bounds is measured first: few others then can be nearer.
        let first = pairs().min_by(|a, b| a.least_spare_m.total_cmp(&b.least_spare_m))?;
        let mut nearest = first.measured(f64::INFINITY);
        for pair in pairs() {
            if pair.least_spare_m < nearest.spare_m {
                let measured = pair.measured(nearest.spare_m);
                if measured.spare_m < nearest.spare_m {
                    nearest = measured;
                }
            }
        }
        Some(nearest)
    }

    pub fn other_name(&self, other: Other) -> &str {
        match other {
            Other::Obstacle(k) => &self.world.obstacles()[k].name,
            Other::Body(body) => self.arm.body_name(body),
        }
    }

    fn obstacle_in_the_way(&self, piece: &Placed, rules: &Rules) -> Option<usize> {
        let mut things = self.world.obstacles().iter().zip(self.world.bounds()).enumerate();
        let in_the_way = things.find(|(k, (obstacle, bounds))| {
            let asked_m = rules.of(piece.body, *k);
            let clear = asked_m == IGNORED
                || piece.ball.clear_by(bounds, asked_m)
                || ball_is_clear(&piece.ball, &obstacle.solid, asked_m)
                || clear_by(&piece.solid, &obstacle.solid, asked_m);
            !clear
        });
        in_the_way.map(|(k, _)| k)
    }

    fn bodies_that_meet(&self, placed: &[Placed], rules: &Rules) -> Option<(usize, Other)> {
        let asked_m = rules.self_clearance_m;
        if asked_m == IGNORED {
            return None;
        }
        let mut pairs = self.pieces.pairs.iter().map(|&(i, j)| (&placed[i], &placed[j]));
        let meet = pairs.find(|(a, b)| !a.ball.clear_by(&b.ball, asked_m) && !clear_by(&a.solid, &b.solid, asked_m))?;
        Some((meet.0.body, Other::Body(meet.1.body)))
    }

    fn world_pairs<'p>(&'p self, placed: &'p [Placed], rules: &'p Rules) -> impl Iterator<Item = Pair<'p>> {
        let things = move || self.world.obstacles().iter().zip(self.world.bounds()).enumerate();
        let all = placed.iter().flat_map(move |piece| things().map(move |thing| (piece, thing)));
        all.filter_map(move |(piece, (k, (obstacle, bounds)))| {
            let asked_m = rules.of(piece.body, k);
            (asked_m != IGNORED).then(|| Pair {
                piece,
                solid: &obstacle.solid,
                other: Other::Obstacle(k),
                asked_m,
                least_spare_m: piece.ball.least_gap_m(&obstacle.solid, bounds) - asked_m,
            })
        })
    }

    fn own_pairs<'p>(&'p self, placed: &'p [Placed], rules: &'p Rules) -> impl Iterator<Item = Pair<'p>> {
        let asked_m = rules.self_clearance_m;
        let pairs = self.pieces.pairs.iter().filter(move |_| asked_m != IGNORED);
        pairs.map(move |&(i, j)| Pair {
            piece: &placed[i],
            solid: &placed[j].solid,
            other: Other::Body(placed[j].body),
            asked_m,
            least_spare_m: placed[i].ball.least_gap_m(&placed[j].solid, &placed[j].ball) - asked_m,
        })
    }
}

/// Two things that are held against each other, and what they have to spare at the least.
struct Pair<'a> {
    piece: &'a Placed,
    solid: &'a Solid,
    other: Other,
    asked_m: f64,
    least_spare_m: f64,
}

impl Pair<'_> {
    /// Exact where it is less than `best_spare_m`, else no less than that.
    fn measured(&self, best_spare_m: f64) -> Nearest {
        let distance_m = distance_unless_above_m(&self.piece.solid, self.solid, best_spare_m + self.asked_m);
        Nearest { body: self.piece.body, other: self.other, distance_m, spare_m: distance_m - self.asked_m }
    }
}

/// A panel's own ball is far wider than the panel: the piece's ball against the box tells more, and costs little.
fn ball_is_clear(ball: &Ball, solid: &Solid, asked_m: f64) -> bool {
    let reach_m = ball.radius_m + asked_m;
    match solid {
        Solid::Box(thing) => reach_m <= 0.0 || thing.distance_to_point_sq_m2(&ball.centre) >= reach_m * reach_m,
        _ => false,
    }
}
