//! Ways of the arm through free space: RRT-Connect (Kuffner and LaValle, ICRA 2000), then shortcuts.

use super::guard::{Guard, Moment};
use super::settings::PlanningSettings;
use crate::arm::{Arm, JointPositions};
use crate::geometry::SplitMix64;

/// Looks for ways between postures while nothing but the arm moves.
pub struct Transit<'a, G: Guard> {
    pub arm: &'a Arm,
    pub guard: &'a G,
    pub settings: &'a PlanningSettings,
    pub moment: &'a Moment,
    /// Between two checked postures: the widest turn of any joint.
    pub step_rad: f64,
}

/// A tree of postures, each with the one it was reached from.
struct Tree {
    nodes: Vec<(JointPositions, usize)>,
}

/// How many times finer than the settings' the steps of a search are, one search after the other.
const FINER: [f64; 3] = [1.0, 4.0, 8.0];
/// How much finer than the settings' a way is looked at again.
const AGAIN: f64 = 4.0;
/// How far a tree grows towards a drawn posture at once, in steps of `joint_step_rad`.
const GROWTH: usize = 8;
/// Postures are drawn within this of the box of both ends in every second draw, else within the joints' limits: ways are mostly near.
const AROUND_RAD: f64 = 0.6;

impl<G: Guard> Transit<'_, G> {
    /// Postures from one to the other, the straight lines between which are clear, by way of `via` where none was found without;
    /// None where no way was found.
    pub fn way(&self, from: &JointPositions, to: &JointPositions, via: &JointPositions) -> Option<Vec<JointPositions>> {
        self.leg(from, to, via).or_else(|| {
            let (first, second) = (self.leg(from, via, via)?, self.leg(via, to, via)?);
            Some([&first[..], &second[1..]].concat())
        })
    }

    fn leg(&self, from: &JointPositions, to: &JointPositions, via: &JointPositions) -> Option<Vec<JointPositions>> {
        // Fine steps take long and are seldom needed: a way found with coarse ones is looked at again with fine ones.
        for finer in FINER {
            let search = Self { step_rad: self.step_rad / finer, ..*self };
            // Where coarse steps find nothing, finer ones, which see more that is in the way, do not either.
            let way = search.any_way(from, to, via)?;
            let fine = Self { step_rad: self.step_rad / AGAIN, ..*self };
            let is_clear = |way: &[JointPositions]| way.windows(2).all(|pair| fine.is_clear(&pair[0], &pair[1]));
            // Shortcuts lead nearer to things than what they cut short.
            let short = search.shortened(way.clone());
            if let Some(mut way) = [short, way].into_iter().find(|way| is_clear(way)) {
                // Leaving out nodes that are one but for rounding may have left out an end.
                let last = way.len() - 1;
                (way[0], way[last]) = (*from, *to);
                return Some(way);
            }
        }
        None
    }

    /// Is any way found from one to the other, looked at in the settings' steps alone?
    pub fn is_connected(&self, from: &JointPositions, to: &JointPositions) -> bool {
        self.is_clear(from, to) || self.connect(from, to).is_some()
    }

    fn any_way(&self, from: &JointPositions, to: &JointPositions, via: &JointPositions) -> Option<Vec<JointPositions>> {
        if self.is_clear(from, to) {
            return Some(vec![*from, *to]);
        }
        if self.is_clear(from, via) && self.is_clear(via, to) {
            return Some(vec![*from, *via, *to]);
        }
        self.connect(from, to)
    }

    /// Is every posture between two on the straight line in joint space clear, the second included?
    pub fn is_clear(&self, from: &JointPositions, to: &JointPositions) -> bool {
        let steps = self.steps_between(from, to);
        // The middle first: where a line is not clear it is mostly there.
        let mut order: Vec<usize> = (1..=steps).collect();
        order.sort_by_key(|&step| std::cmp::Reverse((step as u64).trailing_zeros()));
        order.into_iter().all(|step| self.is_free(&between(from, to, step as f64 / steps as f64)))
    }

    fn steps_between(&self, from: &JointPositions, to: &JointPositions) -> usize {
        (widest_turn(from, to) / self.step_rad).ceil().max(1.0) as usize
    }

    fn is_free(&self, positions: &JointPositions) -> bool {
        let clearance_m = self.settings.clearance_m + self.settings.search_margin_m;
        self.guard.conflict(positions, self.moment, clearance_m).is_none()
    }

    fn connect(&self, from: &JointPositions, to: &JointPositions) -> Option<Vec<JointPositions>> {
        let mut rng = SplitMix64::new(self.settings.transit_seed);
        let (mut one, mut other) = (Tree::at(from), Tree::at(to));
        let mut swapped = false;
        for tries in 0..self.settings.transit_tries {
            let drawn = self.draw(&mut rng, from, to, tries % 2 == 0);
            if let Some(new) = self.grow(&mut one, &drawn) {
                let target = one.nodes[new].0;
                if let Some(met) = self.grow_all_the_way(&mut other, &target) {
                    let (mut way, mut rest) = (one.back(new), other.back(met));
                    if swapped {
                        std::mem::swap(&mut way, &mut rest);
                    }
                    way.reverse();
                    way.extend(rest.into_iter().skip(1));
                    return Some(way);
                }
            }
            std::mem::swap(&mut one, &mut other);
            swapped = !swapped;
        }
        None
    }

    fn draw(&self, rng: &mut SplitMix64, from: &JointPositions, to: &JointPositions, near: bool) -> JointPositions {
        let mut drawn = *from;
        for (k, joint) in self.arm.joints.iter().enumerate() {
            let (mut low, mut high) = (joint.lower_rad, joint.upper_rad);
            if near {
                low = low.max(from[k].min(to[k]) - AROUND_RAD);
                high = high.min(from[k].max(to[k]) + AROUND_RAD);
            }
            drawn[k] = low + (high - low) * rng.unit();
        }
        drawn
    }

    /// Grows towards a posture by so far at most; the new node, if the tree grew.
    fn grow(&self, tree: &mut Tree, toward: &JointPositions) -> Option<usize> {
        let near = tree.nearest(toward);
        let from = tree.nodes[near].0;
        let steps = self.steps_between(&from, toward);
        let mut reached = None;
        for step in 1..=steps.min(GROWTH) {
            let next = between(&from, toward, step as f64 / steps as f64);
            if !self.is_free(&next) {
                break;
            }
            reached = Some(next);
        }
        reached.map(|posture| tree.add(posture, near))
    }

    fn grow_all_the_way(&self, tree: &mut Tree, toward: &JointPositions) -> Option<usize> {
        loop {
            let new = self.grow(tree, toward)?;
            if widest_turn(&tree.nodes[new].0, toward) < 1e-12 {
                return Some(new);
            }
        }
    }

    /// Leaves out corners while the lines that cut them are clear: between drawn places of the way, then whole nodes.
    fn shortened(&self, mut way: Vec<JointPositions>) -> Vec<JointPositions> {
        let mut rng = SplitMix64::new(self.settings.transit_seed);
        for _ in 0..self.settings.shortcuts {
            if way.len() < 3 {
                break;
            }
            let (a, b) = (rng.unit() * (way.len() - 1) as f64, rng.unit() * (way.len() - 1) as f64);
            let (low, high) = (a.min(b), a.max(b));
            let (i, j) = (low as usize, high as usize);
            if i == j {
                continue;
            }
            let p = between(&way[i], &way[i + 1], low - i as f64);
            let q = between(&way[j], &way[j + 1], high - j as f64);
            let old: f64 = length(&way[i..=j + 1]);
            let cut = [&way[..=i], &[p, q], &way[j + 1..]].concat();
            if length(&cut[i..i + 4]) < old - 1e-9 && self.is_clear(&p, &q) {
                way = cut;
            }
        }
        way.dedup_by(|next, last| widest_turn(next, last) < 1e-9);
        let mut k = 1;
        while k + 1 < way.len() {
            if self.is_clear(&way[k - 1], &way[k + 1]) {
                way.remove(k);
            } else {
                k += 1;
            }
        }
        way
    }
}

impl Tree {
    fn at(root: &JointPositions) -> Self {
        Self { nodes: vec![(*root, 0)] }
    }

    fn add(&mut self, posture: JointPositions, from: usize) -> usize {
        self.nodes.push((posture, from));
        self.nodes.len() - 1
    }

    fn nearest(&self, to: &JointPositions) -> usize {
        let far_sq =
            |posture: &JointPositions| posture.iter().zip(to.iter()).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
        let all = self.nodes.iter().enumerate().map(|(k, (posture, _))| (far_sq(posture), k));
        all.min_by(|a, b| a.0.total_cmp(&b.0)).map_or(0, |(_, k)| k)
    }

    /// From a node to the root.
    fn back(&self, from: usize) -> Vec<JointPositions> {
        let mut found = vec![self.nodes[from].0];
        let mut node = from;
        while node != 0 {
            node = self.nodes[node].1;
            found.push(self.nodes[node].0);
        }
        found
    }
}

pub fn between(from: &JointPositions, to: &JointPositions, share: f64) -> JointPositions {
    let mut made = *from;
    for (value, goal) in made.iter_mut().zip(to.iter()) {
        *value += (goal - *value) * share;
    }
    made
}

pub fn widest_turn(from: &JointPositions, to: &JointPositions) -> f64 {
    from.iter().zip(to.iter()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

fn length(way: &[JointPositions]) -> f64 {
    way.windows(2).map(|pair| widest_turn(&pair[0], &pair[1])).sum()
}

#[cfg(test)]
mod tests {
    use super::super::reason::Obstacle;
    use super::*;
    use crate::geometry::Rigid;

    const VIPER: &str = include_str!("../../../src/boxwright/robots/data/viper_s850.toml");
    /// What rounding leaves between two postures that are one.
    const HAIR_RAD: f64 = 5e-10;

    /// Lets nothing pass whose second joint is between the two of a hair.
    struct HairWall;

    impl Guard for HairWall {
        fn conflict(&self, positions_rad: &[f64], _: &Moment, _: f64) -> Option<Obstacle> {
            (positions_rad[1] > 0.0 && positions_rad[1] < HAIR_RAD).then_some(Obstacle::Something)
        }

        fn tool_conflict(&self, _: &Rigid, _: &Moment, _: f64) -> Option<Obstacle> {
            None
        }

        fn with_opening(&self, _: f64) -> Self {
            Self
        }
    }

    #[test]
    fn a_way_ends_where_it_was_to_end_though_its_last_corner_is_that_but_for_rounding() {
        let arm = Arm::from_toml(VIPER).unwrap();
        let (settings, moment) = (PlanningSettings::default(), Moment::resting(&[]));
        let transit = Transit { arm: &arm, guard: &HairWall, settings: &settings, moment: &moment, step_rad: 0.05 };
        let posture = |q: [f64; 2]| JointPositions::from_slice(&[q[0], q[1], 1.0, 0.0, 0.5, 0.0]);
        let (from, via, to) = (posture([0.0, 0.0]), posture([0.5, 0.0]), posture([0.5, HAIR_RAD]));
        assert!(!transit.is_clear(&from, &to));
        let way = transit.way(&from, &to, &via).unwrap();
        assert_eq!((way[0], way[way.len() - 1]), (from, to));
    }
}
