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
    /// The symmetries that leave the decided parts in their places.
    group: Vec<usize>,
}

impl<'a> Search<'a> {
    pub fn new(problem: &'a Problem<'a>, factors: &'a Factors) -> Self {
        let parts = factors.unary.len();
        let choices = factors.unary.iter().map(|values| values.iter().copied().enumerate());
        let root = Level {
            decided: factors.prices.iter().sum(),
            open: (0..parts).collect(),
            tops: choices.clone().map(top).collect(),
            choices: choices.map(Iterator::collect).collect(),
            order: Vec::new(),
            group: problem.symmetries.all(),
        };
        let below = Level { choices: vec![Vec::new(); parts], tops: root.tops.clone(), ..Level::default() };
        let mut levels = vec![below; parts + 1];
        levels[0] = root;
        Self {
            problem,
            factors,
            levels,
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
            self.problem.offer(&self.problem.symmetries.leader(&self.states), shortlist);
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
        let part = most_constrained(self.factors, level, spare);
        let peers = self.problem.symmetries.orbit(&level.group, part);
        self.set_order(depth, part, spare, peers.iter().any(|&peer| peer != part));
        for k in 0..self.levels[depth].order.len() {
            let level = &self.levels[depth];
            let (place, value) = level.order[k];
            let others =
                level.decided + level.open.iter().filter(|&&p| p != part).map(|&p| level.tops[p].0).sum::<f64>();
            let slack = others + value - shortlist.threshold();
            if slack <= 0.0 {
                continue;
            }
            if self.nodes > self.budget {
                self.unseen = self.unseen.max(others + value);
                return;
            }
            let state = self.factors.domains[part][place];
            self.states[part] = state;
            if self.problem.may_allow(&self.states) {
                self.nodes += 1;
                if self.decide(depth, part, (place, value), slack) {
                    self.descend(depth + 1, shortlist);
                }
            }
            self.states[part] = UNDECIDED;
            // Every assignment that holds this state in a part of the orbit has a copy that was seen.
            for &peer in peers.iter().filter(|&&peer| peer != part) {
                self.leave_out(depth, peer, state);
            }
        }
    }

    fn leave_out(&mut self, depth: usize, part: usize, state: usize) {
        let level = &mut self.levels[depth];
        let domain = &self.factors.domains[part];
        if let Some(at) = level.choices[part].iter().position(|&(place, _)| domain[place] == state) {
            level.choices[part].remove(at);
            level.tops[part] = top(level.choices[part].iter().copied());
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

    /// The choices of `part` that can be wanted, best first; where it has peers empty comes last: when all segments were
    /// seen for the one, the others are empty too.
    fn set_order(&mut self, depth: usize, part: usize, spare: f64, has_peers: bool) {
        let level = &mut self.levels[depth];
        let least = level.tops[part].0 + spare;
        level.order.clear();
        level.order.extend(level.choices[part].iter().filter(|(_, value)| *value > least));
        let is_last = |place: usize| has_peers && self.factors.domains[part][place] == 0;
        level.order.sort_by(|a, b| is_last(a.0).cmp(&is_last(b.0)).then(b.1.total_cmp(&a.1)).then(a.0.cmp(&b.0)));
    }

    /// Fills the next level: `part` takes the choice `(place, value)`, `slack` more than is wanted at least. False: nothing
    /// wanted is left below, seen on the way.
    fn decide(&mut self, depth: usize, part: usize, (place, value): (usize, f64), mut slack: f64) -> bool {
        let state = self.states[part];
        let (above, below) = self.levels.split_at_mut(depth + 1);
        let (level, next) = (&mut above[depth], &mut below[0]);
        next.decided = level.decided + value;
        for k in 0..level.open.len() {
            let p = level.open[k];
            if p == part {
                continue;
            }
            let least = level.tops[p].0 - slack;
            let domain = &self.factors.domains[p];
            let free = level.choices[p].iter().filter(|(place, _)| state == 0 || domain[*place] != state);
            next.choices[p].clear();
            match self.factors.gains(part, place, p) {
                Some((gains, step)) => {
                    let gained = free.map(|&(place, value)| (place, value + gains[place * step]));
                    next.choices[p].extend(gained.filter(|(_, value)| *value > least));
                }
                None => next.choices[p].extend(free.filter(|(_, value)| *value > least)),
            }
            next.tops[p] = top(next.choices[p].iter().copied());
            slack -= level.tops[p].0 - next.tops[p].0;
            if next.choices[p].is_empty() || slack <= 0.0 {
                // Who ends a branch first is asked first next time.
                level.open[..=k].rotate_right(1);
                return false;
            }
        }
        next.open.clear();
        next.open.extend(level.open.iter().copied().filter(|&p| p != part));
        next.group.clear();
        next.group.extend(self.problem.symmetries.fixing(&level.group, part));
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

/// The open part with the fewest choices that can still be wanted, for each open part that it is tied to.
fn most_constrained(factors: &Factors, level: &Level, spare: f64) -> usize {
    let mut best = (f64::INFINITY, 0);
    for &p in &level.open {
        let least = level.tops[p].0 + spare;
        let count = level.choices[p].iter().filter(|(_, value)| *value > least).count();
        if count <= 1 {
            return p;
        }
        let ties = level.open.iter().filter(|&&q| factors.tied(p, q)).count();
        let cost = count as f64 / (1 + ties) as f64;
        if cost < best.0 {
            best = (cost, p);
        }
    }
    best.1
}
