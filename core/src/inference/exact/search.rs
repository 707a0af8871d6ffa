//! Depth first, the most constrained part first, its best state first; a branch ends where its bound (eq. 44) does.

use super::factors::Factors;
use super::problem::Problem;
use super::shortlist::Shortlist;
use super::symmetry::UNDECIDED;

/// Branch and bound over the tables of `factors`.
pub struct Search<'a> {
    problem: &'a Problem<'a>,
    factors: &'a Factors,
    levels: Vec<Level>,
    states: Vec<usize>,
    nodes: u64,
    budget: u64,
    /// No assignment that was left unseen scores more.
    unseen: f64,
}

/// What the undecided parts can add, given the decided ones. Only what can still be wanted is carried from level to level.
#[derive(Debug, Clone, Default)]
struct Level {
    decided: f64,
    open: Vec<usize>,
    /// `choices[p]`: places in the domain of `p` with what they add.
    choices: Vec<Vec<(usize, f64)>>,
    /// The best choice of each part: what it adds, and its place.
    tops: Vec<(f64, usize)>,
    /// Choices of the part that is decided at this level, best first.
    order: Vec<(usize, f64)>,
}

impl<'a> Search<'a> {
    pub fn new(problem: &'a Problem<'a>, factors: &'a Factors) -> Self {
        let parts = factors.unary.len();
        let choices = factors.unary.iter().map(|values| values.iter().copied().enumerate());
        let root = Level {
            decided: 0.0,
            open: (0..parts).collect(),
            tops: choices.clone().map(top).collect(),
            choices: choices.map(Iterator::collect).collect(),
            order: Vec::new(),
        };
        Self {
            problem,
            factors,
            levels: vec![root; parts + 1],
            states: vec![UNDECIDED; parts],
            nodes: 0,
            budget: 0,
            unseen: f64::NEG_INFINITY,
        }
    }

    /// Searches for at most `budget` nodes; the nodes it took, and a bound on the score of what it has not seen.
    pub fn run(mut self, budget: u64, shortlist: &mut Shortlist) -> (u64, f64) {
        self.budget = budget;
        self.descend(0, shortlist);
        (self.nodes, self.unseen)
    }

    fn descend(&mut self, depth: usize, shortlist: &mut Shortlist) {
        let level = &self.levels[depth];
        if level.open.is_empty() {
            self.problem.offer(&self.states, shortlist);
            return;
        }
        let loose = level.decided + level.open.iter().map(|&p| level.tops[p].0).sum::<f64>();
        let bound = loose - self.conflict(level);
        if bound <= shortlist.threshold() {
            return;
        }
        if self.nodes > self.budget {
            self.unseen = self.unseen.max(bound);
            return;
        }
        // A choice that adds no more than this below its part's best cannot be wanted, and never will deeper down.
        let spare = shortlist.threshold() - loose;
        let part = most_constrained(level, spare);
        let others = loose - level.tops[part].0;
        self.set_order(depth, part, spare);
        for k in 0..self.levels[depth].order.len() {
            let (place, value) = self.levels[depth].order[k];
            if others + value <= shortlist.threshold() {
                return;
            }
            if self.nodes > self.budget {
                self.unseen = self.unseen.max(others + value);
                return;
            }
            self.states[part] = self.factors.domains[part][place];
            if self.problem.is_open(&self.states) {
                self.nodes += 1;
                let slack = others + value - shortlist.threshold();
                if self.decide(depth, part, (place, value), spare, slack) {
                    self.descend(depth + 1, shortlist);
                }
            }
            self.states[part] = UNDECIDED;
        }
    }

    /// The least that is lost because parts want the same segment: all but one of them must do without it.
    fn conflict(&self, level: &Level) -> f64 {
        let wanted = |p: usize| self.factors.domains[p][level.tops[p].1];
        let mut lost = 0.0;
        for (k, &p) in level.open.iter().enumerate() {
            let segment = wanted(p);
            if segment == 0
                || level.open[..k].iter().any(|&q| wanted(q) == segment)
                || level.open[k + 1..].iter().all(|&q| wanted(q) != segment)
            {
                continue;
            }
            let rivals = level.open[k..].iter().filter(|&&q| wanted(q) == segment);
            let regrets = rivals.map(|&q| regret(&level.choices[q]));
            let (sum, most) = regrets.fold((0.0, 0.0f64), |(sum, most), r| (sum + r, most.max(r)));
            lost += sum - most;
        }
        lost
    }

    /// The choices of `part` that can be wanted, best first.
    fn set_order(&mut self, depth: usize, part: usize, spare: f64) {
        let level = &mut self.levels[depth];
        let least = level.tops[part].0 + spare;
        level.order.clear();
        level.order.extend(level.choices[part].iter().filter(|(_, value)| *value > least));
        level.order.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    }

    /// Fills the next level: `part` takes the choice `(place, value)`. False: nothing wanted is left below, seen on the way.
    fn decide(&mut self, depth: usize, part: usize, (place, value): (usize, f64), spare: f64, mut slack: f64) -> bool {
        let (above, below) = self.levels.split_at_mut(depth + 1);
        let (level, next) = (&mut above[depth], &mut below[0]);
        next.decided = level.decided + value;
        for k in 0..level.open.len() {
            let p = level.open[k];
            if p == part {
                continue;
            }
            let (gains, step) = self.factors.gains(part, place, p);
            let least = level.tops[p].0 + spare;
            let live = level.choices[p].iter().filter(|(_, value)| *value > least);
            next.choices[p].clear();
            next.choices[p].extend(live.map(|&(place, value)| (place, value + gains[place * step])));
            next.tops[p] = top(next.choices[p].iter().copied());
            slack -= level.tops[p].0 - next.tops[p].0;
            if slack <= 0.0 {
                // Who ends a branch first is asked first next time.
                level.open[..=k].rotate_right(1);
                return false;
            }
        }
        next.open.clear();
        next.open.extend(level.open.iter().copied().filter(|&p| p != part));
        true
    }
}

/// The best of some choices: what it adds, and its place.
pub fn top(choices: impl Iterator<Item = (usize, f64)>) -> (f64, usize) {
    choices.fold((f64::NEG_INFINITY, 0), |best, (place, value)| if value > best.0 { (value, place) } else { best })
}

/// What the best of some choices is better than the next.
pub fn regret(choices: &[(usize, f64)]) -> f64 {
    let (best, place) = top(choices.iter().copied());
    let (second, _) = top(choices.iter().copied().filter(|choice| choice.0 != place));
    if best > second {
        best - second
    } else {
        0.0
    }
}

/// The open part with the fewest choices that can still be wanted.
fn most_constrained(level: &Level, spare: f64) -> usize {
    let count = |p: usize| {
        let least = level.tops[p].0 + spare;
        level.choices[p].iter().filter(|(_, value)| *value > least).count()
    };
    let counted = level.open.iter().map(|&p| (count(p), p));
    counted.min().map_or(0, |(_, p)| p)
}
