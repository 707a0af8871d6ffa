//! Which of the fitted boxes stand in the scene: those that together hold most readings, none of them another's.

use super::found_box::FoundBox;
use super::same::{is_higher, is_same};
use super::shells::LEAST_SCORE;

/// Readings are shared by cells of so many pixels: boxes were not asked at the same ones.
const COARSE_CELL: usize = 4;
/// Of two boxes that share one in so many of the smaller one's cells one is none.
const SHARED: usize = 4;

/// A box that stands in the scene, and those that could take its place and no other's, best first.
#[derive(Debug)]
pub struct Chosen {
    pub one: FoundBox,
    pub instead: Vec<FoundBox>,
}

/// Of those that could take its place so many are kept that rank nearly as high, by this share.
const INSTEAD: usize = 2;
const NEARLY: f64 = 0.9;

/// The set of boxes that leave each other's readings alone and rank highest together, best first.
pub fn choose(found: &[FoundBox], width: usize) -> Vec<Chosen> {
    let of_all: Vec<&FoundBox> = found.iter().filter(|one| one.score > LEAST_SCORE).collect();
    let ranked = of_all.iter().map(|one| (rank(one, &of_all), *one));
    let mut ranked: Vec<(f64, &FoundBox)> = ranked.collect();
    ranked.sort_by(|a, b| b.0.total_cmp(&a.0));
    let (ranks, found): (Vec<f64>, Vec<&FoundBox>) = ranked.into_iter().unzip();
    let cells: Vec<Vec<u32>> = found.iter().map(|one| cells(one, width)).collect();
    let excludes = |a: usize, b: usize| share(&cells[a], &cells[b]);
    let chosen = heaviest(&ranks, &excludes);
    let takes_place = |other: usize, number: usize| {
        !chosen.contains(&other)
            && ranks[other] >= NEARLY * ranks[number]
            && chosen.iter().all(|&one| excludes(one, other) == (one == number))
    };
    let instead = |number: usize| {
        let mut kept: Vec<usize> = Vec::new();
        for other in (0..found.len()).filter(|&other| takes_place(other, number)) {
            let is_new = std::iter::once(&number).chain(&kept).all(|&one| !is_same(found[one], found[other]));
            if is_new && kept.len() < INSTEAD {
                kept.push(other);
            }
        }
        kept
    };
    let rivals = |number: usize| (0..found.len()).filter(|&other| other != number && excludes(number, other)).count();
    let with_rivals = |one: &FoundBox, rivals: usize| FoundBox { rivals, ..one.clone() };
    let of = |&number: &usize| {
        let (count, others) = (rivals(number), instead(number));
        let instead = others.iter().map(|&other| with_rivals(found[other], count)).collect();
        Chosen { one: with_rivals(found[number], count), instead }
    };
    chosen.iter().map(of).collect()
}

/// What its corners say of a box's flaps (eq. 104) they say against one of higher sides, where there is such a one.
fn rank(one: &FoundBox, all: &[&FoundBox]) -> f64 {
    let is_asked = one.slots < 1.0 && all.iter().any(|other| is_higher(other, one));
    one.rank(one.probability) * if is_asked { one.slots } else { 1.0 }
}

/// Whether one of two boxes is none, since they share too many readings.
pub fn excludes(one: &FoundBox, other: &FoundBox, width: usize) -> bool {
    share(&cells(one, width), &cells(other, width))
}

fn share(a: &[u32], b: &[u32]) -> bool {
    SHARED * shared(a, b) > a.len().min(b.len())
}

/// Sorted, each once.
fn cells(one: &FoundBox, width: usize) -> Vec<u32> {
    let cell = |index: &u32| {
        let (column, row) = (*index as usize % width / COARSE_CELL, *index as usize / width / COARSE_CELL);
        (row * width + column) as u32
    };
    let mut out: Vec<u32> = one.labels.parts.iter().flat_map(|(_, points)| points).map(cell).collect();
    out.sort_unstable();
    out.dedup();
    out
}

/// How many two sorted lists have in common.
fn shared(a: &[u32], b: &[u32]) -> usize {
    let (mut i, mut j, mut count) = (0, 0, 0);
    while i < a.len() && j < b.len() {
        count += usize::from(a[i] == b[j]);
        let (x, y) = (a[i], b[j]);
        i += usize::from(x <= y);
        j += usize::from(y <= x);
    }
    count
}

/// Looked at, at most; what is best by then is taken.
const MOST_STEPS: usize = 200_000;

/// The numbers, ascending, whose weights, heaviest first, sum to most of those none of which excludes another: branch and bound, by
/// groups all of whose members exclude each other.
fn heaviest(weights: &[f64], excludes: &dyn Fn(usize, usize) -> bool) -> Vec<usize> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    let mut group_of = Vec::new();
    let table: Vec<Vec<bool>> =
        (0..weights.len()).map(|a| (0..weights.len()).map(|b| a != b && excludes(a, b)).collect()).collect();
    for (one, excluded) in table.iter().enumerate() {
        let place = groups.iter().position(|group| group.iter().all(|&other| excluded[other]));
        let place = place.unwrap_or(groups.len());
        if place == groups.len() {
            groups.push(Vec::new());
        }
        groups[place].push(one);
        group_of.push(place);
    }
    let mut search = Search { weights, table: &table, group_of: &group_of, best: (f64::MIN, Vec::new()), steps: 0 };
    search.go(0, 0.0, &mut Vec::new());
    search.best.1
}

struct Search<'a> {
    weights: &'a [f64],
    table: &'a [Vec<bool>],
    group_of: &'a [usize],
    best: (f64, Vec<usize>),
    steps: usize,
}

impl Search<'_> {
    fn go(&mut self, next: usize, sum: f64, taken: &mut Vec<usize>) {
        self.steps += 1;
        if sum > self.best.0 {
            self.best = (sum, taken.clone());
        }
        if next == self.weights.len() || self.steps > MOST_STEPS || sum + self.bound(next, taken) <= self.best.0 {
            return;
        }
        if taken.iter().all(|&other| !self.table[next][other]) {
            taken.push(next);
            self.go(next + 1, sum + self.weights[next], taken);
            taken.pop();
        }
        self.go(next + 1, sum, taken);
    }

    /// No more can be won: of each group its heaviest that is still free.
    fn bound(&self, next: usize, taken: &[usize]) -> f64 {
        let mut is_counted = vec![false; self.group_of.len()];
        let mut sum = 0.0;
        for one in next..self.weights.len() {
            if !is_counted[self.group_of[one]] && taken.iter().all(|&other| !self.table[one][other]) {
                is_counted[self.group_of[one]] = true;
                sum += self.weights[one];
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_that_hold_more_win_over_one_that_lies_across_both() {
        let across = |a: usize, b: usize| a == 0 || b == 0;
        assert_eq!(heaviest(&[5.0, 4.0, 3.0], &across), [1, 2]);
        assert_eq!(heaviest(&[8.0, 4.0, 3.0], &across), [0]);
        assert_eq!(heaviest(&[], &across), [0; 0]);
    }

    #[test]
    fn no_set_weighs_more() {
        let mut cases = 0;
        for seed in 0..200_u64 {
            let mut state = seed;
            let mut draw = || {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                (state >> 33) as f64 / f64::from(1_u32 << 31)
            };
            let count = 1 + (seed % 11) as usize;
            let mut weights: Vec<f64> = (0..count).map(|_| draw()).collect();
            weights.sort_by(|a, b| b.total_cmp(a));
            let table: Vec<Vec<bool>> = (0..count).map(|_| (0..count).map(|_| draw() < 0.4).collect()).collect();
            let excludes = |a: usize, b: usize| table[a.min(b)][a.max(b)];
            let sum = |set: &[usize]| set.iter().map(|&one| weights[one]).sum::<f64>();
            let sets = (0..1_usize << count).map(|bits| (0..count).filter(|i| bits >> i & 1 == 1).collect::<Vec<_>>());
            let free = sets.filter(|set| set.iter().all(|&a| set.iter().all(|&b| a == b || !excludes(a, b))));
            let most = free.map(|set| sum(&set)).fold(0.0, f64::max);
            assert!((sum(&heaviest(&weights, &excludes)) - most).abs() < 1e-12, "{seed}");
            cases += 1;
        }
        assert_eq!(cases, 200);
    }

    #[test]
    fn shared_cells_are_counted_once() {
        assert_eq!(shared(&[1, 3, 5, 9], &[0, 3, 4, 9, 12]), 2);
        assert_eq!(shared(&[], &[1]), 0);
    }
}
