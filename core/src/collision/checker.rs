use super::nearest::{Nearest, Other};
use super::pair::{clear_by, signed_distance_m};
use super::pieces::{ArmPieces, Placed};
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
        let placed = self.pieces.place(self.arm, positions);
        placed.iter().all(|piece| self.piece_is_clear(piece, rules)) && self.clear_of_itself(&placed, rules)
    }

    /// The pair that has least to spare at these positions (rad); `None` where the rules ignore everything.
    pub fn nearest(&self, positions: &[f64], rules: &Rules) -> Option<Nearest> {
        let placed = self.pieces.place(self.arm, positions);
        let mut nearest = None;
        for piece in &placed {
            for (k, (obstacle, bound)) in self.world.obstacles().iter().zip(self.world.bounds()).enumerate() {
                let asked_m = rules.of(piece.body, k);
                if may_be_nearer(&nearest, piece, bound, asked_m) {
                    let distance_m = signed_distance_m(&piece.solid, &obstacle.solid);
                    keep_nearer(&mut nearest, piece.body, Other::Obstacle(k), distance_m, asked_m);
                }
            }
        }
        for &(i, j) in &self.pieces.pairs {
            let (a, b) = (&placed[i], &placed[j]);
            if may_be_nearer(&nearest, a, &b.ball, rules.self_clearance_m) {
                let distance_m = signed_distance_m(&a.solid, &b.solid);
                keep_nearer(&mut nearest, a.body, Other::Body(b.body), distance_m, rules.self_clearance_m);
            }
        }
        nearest
    }

    pub fn other_name(&self, other: Other) -> &str {
        match other {
            Other::Obstacle(k) => &self.world.obstacles()[k].name,
            Other::Body(body) => self.arm.body_name(body),
        }
    }

    fn piece_is_clear(&self, piece: &Placed, rules: &Rules) -> bool {
        let things = self.world.obstacles().iter().zip(self.world.bounds()).enumerate();
        things.map(|(k, thing)| (rules.of(piece.body, k), thing)).all(|(asked_m, (obstacle, bound))| {
            asked_m == IGNORED
                || gap_m(&piece.ball, bound) >= asked_m
                || ball_is_clear(&piece.ball, &obstacle.solid, asked_m)
                || clear_by(&piece.solid, &obstacle.solid, asked_m)
        })
    }

    fn clear_of_itself(&self, placed: &[Placed], rules: &Rules) -> bool {
        let asked_m = rules.self_clearance_m;
        self.pieces.pairs.iter().map(|&(i, j)| (&placed[i], &placed[j])).all(|(a, b)| {
            asked_m == IGNORED || gap_m(&a.ball, &b.ball) >= asked_m || clear_by(&a.solid, &b.solid, asked_m)
        })
    }
}

fn gap_m(a: &Ball, b: &Ball) -> f64 {
    (a.centre - b.centre).norm() - a.radius_m - b.radius_m
}

/// A panel's own ball is far wider than the panel: the piece's ball against the box tells more, and costs little.
fn ball_is_clear(ball: &Ball, solid: &Solid, asked_m: f64) -> bool {
    match solid {
        Solid::Box(thing) => thing.distance_to_point_m(&ball.centre) - ball.radius_m >= asked_m,
        _ => false,
    }
}

fn may_be_nearer(nearest: &Option<Nearest>, piece: &Placed, bound: &Ball, asked_m: f64) -> bool {
    asked_m != IGNORED && nearest.is_none_or(|nearest| gap_m(&piece.ball, bound) - asked_m < nearest.spare_m)
}

fn keep_nearer(nearest: &mut Option<Nearest>, body: usize, other: Other, distance_m: f64, asked_m: f64) {
    let spare_m = distance_m - asked_m;
    if nearest.is_none_or(|nearest| spare_m < nearest.spare_m) {
        *nearest = Some(Nearest { body, other, distance_m, spare_m });
    }
}
