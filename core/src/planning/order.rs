//! In which order flaps are closed.

use std::collections::HashMap;

use super::boards::{are_opposite, Descent};
use super::closing::Closer;
use super::effort::Effort;
use super::flap::Flap;
use super::guard::{Guard, Moment};
use super::known::Tried;
use super::push::PushMotion;
use super::reason::WhyNot;

/// The order that closes most flaps, their pushes, and why the others stay open.
pub struct Ordered {
    pub order: Vec<usize>,
    pub pushes: Vec<PushMotion>,
    pub why_not: Vec<(usize, WhyNot)>,
    /// Whether a flap waited anywhere that could have come down steeply.
    has_waited: bool,
}

/// The order that closes most with the first effort; where that is not all, with a greater one, of a pair what the first did not close
/// last: it takes stages and couples, and where one of those goes wrong the arm may stop. Then what is left, with the greatest effort.
/// An order with steep descents on the way only where it closes more.
pub fn search<G: Guard>(closer: &Closer<'_, G>, open: &[usize], angles_rad: &[f64]) -> Ordered {
    let ranked = likeliest_first(closer, open, &[]);
    let quick = with_effort(closer, &ranked, angles_rad, Effort::Quick, Descent::Gentle);
    if quick.why_not.is_empty() || closer.quick {
        return quick;
    }
    let hard: Vec<usize> = quick.why_not.iter().map(|(flap, _)| *flap).collect();
    let ranked = likeliest_first(closer, open, &hard);
    let thorough = |descent: Descent| {
        let mut ordered = with_effort(closer, &ranked, angles_rad, Effort::Thorough, descent);
        add_left(closer, &mut ordered, angles_rad);
        ordered
    };
    let gentle = thorough(Descent::Gentle);
    if gentle.why_not.is_empty() || !gentle.has_waited {
        return gentle;
    }
    let steep = thorough(Descent::Steep);
    if steep.order.len() > gentle.order.len() {
        steep
    } else {
        gentle
    }
}

/// Depth first over orders, as ranked, each push planned once for each set of flaps closed before it. The first order that closes all
/// ends the search; else the first of those that close most.
fn with_effort<G: Guard>(
    closer: &Closer<'_, G>,
    ranked: &[usize],
    angles_rad: &[f64],
    effort: Effort,
    descent: Descent,
) -> Ordered {
    let mut search = Search {
        closer,
        effort,
        descent,
        known: HashMap::new(),
        best: Vec::new(),
        wanted: ranked.len(),
        hopeless: Vec::new(),
        has_waited: false,
        searches: vec![0; angles_rad.len()],
    };
    search.extend(&mut Vec::new(), ranked, angles_rad);
    let best = search.best.clone();
    let mut pushes = Vec::new();
    for k in 0..best.len() {
        if let Some(Ok(motion)) = search.known.remove(&(best[k], closed_set(&best[..k]))) {
            pushes.push(motion);
        }
    }
    let left = ranked.iter().filter(|flap| !best.contains(flap));
    let why_not = left.filter_map(|&flap| Some((flap, search.why_not(flap, &best)?))).collect();
    Ordered { order: best, pushes, why_not, has_waited: search.has_waited }
}

/// Adds what the greatest effort closes; puts last what may move the box, so that no other flap is missed for it; after each what only
/// that kept open.
fn add_left<G: Guard>(closer: &Closer<'_, G>, ordered: &mut Ordered, angles_rad: &[f64]) {
    let mut angles_rad = angles_rad.to_vec();
    for (&flap, push) in ordered.order.iter().zip(&ordered.pushes) {
        angles_rad[flap] = closer.rest_rad(flap, push);
    }
    let mut asked = Vec::new();
    while let Some((place, push)) = ordered
        .first_deep(closer, &angles_rad, &mut asked)
        .or_else(|| ordered.first_steep(closer, &angles_rad))
        .or_else(|| ordered.first_sliding(closer, &angles_rad))
    {
        ordered.add(closer, place, push, &mut angles_rad);
        while let Some((place, push)) = ordered.first_freed(closer, &angles_rad) {
            ordered.add(closer, place, push, &mut angles_rad);
        }
    }
}

impl Ordered {
    /// Of the flaps left, where the first is that closes with the greatest effort, and its push; each is `asked` about once.
    fn first_deep<G: Guard>(
        &self,
        closer: &Closer<'_, G>,
        angles_rad: &[f64],
        asked: &mut Vec<usize>,
    ) -> Option<(usize, PushMotion)> {
        let moment = Moment::resting(angles_rad);
        self.why_not.iter().enumerate().find_map(|(place, &(flap, ref why))| {
            if !why.searched || asked.contains(&flap) {
                return None;
            }
            asked.push(flap);
            Some((place, closer.push(flap, &moment, Effort::Deep, Descent::Gentle).ok()?))
        })
    }

    /// Of the flaps left, where the first is that closes if it may come down steeply, and its push; of those before it, what else keeps
    /// them open.
    fn first_steep<G: Guard>(&mut self, closer: &Closer<'_, G>, angles_rad: &[f64]) -> Option<(usize, PushMotion)> {
        let moment = Moment::resting(angles_rad);
        let waiting = self.why_not.iter_mut().enumerate().filter(|(_, (_, why))| why.is_steep);
        for (place, (flap, why)) in waiting {
            match closer.push(*flap, &moment, Effort::Thorough, Descent::Steep) {
                Ok(push) => return Some((place, push)),
                Err(other) => *why = WhyNot { is_steep: true, ..other },
            }
        }
        None
    }

    /// Of the flaps left, where the first is that closes if the box may move, and its push.
    fn first_sliding<G: Guard>(&self, closer: &Closer<'_, G>, angles_rad: &[f64]) -> Option<(usize, PushMotion)> {
        let moment = Moment::resting(angles_rad);
        let mut moving = self.why_not.iter().enumerate().filter(|(_, (_, why))| why.moves_box);
        moving.find_map(|(place, &(flap, _))| Some((place, closer.push_home(flap, &moment)?)))
    }

    /// The same of those that other flaps kept open.
    fn first_freed<G: Guard>(&self, closer: &Closer<'_, G>, angles_rad: &[f64]) -> Option<(usize, PushMotion)> {
        let moment = Moment::resting(angles_rad);
        let mut kept = self.why_not.iter().enumerate().filter(|(_, (_, why))| why.by_flaps);
        kept.find_map(|(place, &(flap, _))| {
            Some((place, closer.push(flap, &moment, Effort::Thorough, Descent::Gentle).ok()?))
        })
    }

    fn add<G: Guard>(&mut self, closer: &Closer<'_, G>, place: usize, push: PushMotion, angles_rad: &mut [f64]) {
        let (flap, _) = self.why_not.remove(place);
        angles_rad[flap] = closer.rest_rad(flap, &push);
        self.order.push(flap);
        self.pushes.push(push);
    }
}

/// As the paper closes them: by area, ties by number, each once, whatever becomes of the others.
pub fn ascending_area<G: Guard>(closer: &Closer<'_, G>, open: &[usize], angles_rad: &[f64]) -> Ordered {
    let mut ranked = open.to_vec();
    let area = |flap: usize| closer.problem.flaps[flap].area_m2();
    ranked.sort_by(|&a, &b| area(a).total_cmp(&area(b)).then(a.cmp(&b)));
    let mut angles_rad = angles_rad.to_vec();
    let mut found = Ordered { order: Vec::new(), pushes: Vec::new(), why_not: Vec::new(), has_waited: false };
    for flap in ranked {
        match closer.push(flap, &Moment::resting(&angles_rad), Effort::Quick, Descent::Steep) {
            Ok(push) => {
                angles_rad[flap] = closer.rest_rad(flap, &push);
                found.order.push(flap);
                found.pushes.push(push);
            }
            Err(why) => found.why_not.push((flap, why)),
        }
    }
    found
}

/// What goes under goes first: short hinges carry the minor flaps of a carton, short flaps lie under long ones, and what carries a
/// tuck goes in last. Of two across from one another the one that is `hard` goes last.
fn likeliest_first<G: Guard>(closer: &Closer<'_, G>, open: &[usize], hard: &[usize]) -> Vec<usize> {
    let flaps = &closer.problem.flaps;
    let rank = |k: usize| {
        let across = open.iter().map(|&other| &flaps[other]).filter(|other| are_opposite(&flaps[k], other));
        let pair_m2 = across.map(Flap::area_m2).fold(flaps[k].area_m2(), f64::min);
        (!flaps[k].tucks.is_empty(), pair_m2, hard.contains(&k), flaps[k].area_m2())
    };
    let mut order = open.to_vec();
    order.sort_by(|&a, &b| {
        let ((a_tuck, a_pair_m2, a_hard, a_m2), (b_tuck, b_pair_m2, b_hard, b_m2)) = (rank(a), rank(b));
        let by_pair = a_tuck.cmp(&b_tuck).then(a_pair_m2.total_cmp(&b_pair_m2));
        by_pair.then(a_hard.cmp(&b_hard)).then(a_m2.total_cmp(&b_m2)).then(a.cmp(&b))
    });
    order
}

struct Search<'a, 'b, G: Guard> {
    closer: &'a Closer<'b, G>,
    effort: Effort,
    descent: Descent,
    known: HashMap<(usize, u32), Tried>,
    best: Vec<usize>,
    wanted: usize,
    /// Flaps that nothing but themselves, the arm and what stands still keeps open, and why.
    hopeless: Vec<(usize, WhyNot)>,
    has_waited: bool,
    /// For each flap, in the problem's order: how many searches of the arm's ways found none.
    searches: Vec<usize>,
}

/// A flap for which so many searches found nothing, after different others, is not tried again.
const MOST_SEARCHES: usize = 2;

impl<G: Guard> Search<'_, '_, G> {
    /// True when all are closed.
    fn extend(&mut self, order: &mut Vec<usize>, rest: &[usize], angles_rad: &[f64]) -> bool {
        if order.len() > self.best.len() {
            self.best.clone_from(order);
        }
        if order.len() + self.hopeless.len() == self.wanted {
            return true;
        }
        for &flap in rest {
            if !self.can_push(flap, order, angles_rad) {
                continue;
            }
            let rest_rad = self.rest_rad(flap, order);
            order.push(flap);
            let others: Vec<usize> = rest.iter().copied().filter(|&other| other != flap).collect();
            let mut after = angles_rad.to_vec();
            after[flap] = rest_rad;
            if self.extend(order, &others, &after) {
                return true;
            }
            order.pop();
        }
        false
    }

    /// Why a flap cannot be closed after those of an order, or before any.
    fn why_not(&self, flap: usize, order: &[usize]) -> Option<WhyNot> {
        if let Some((_, why)) = self.hopeless.iter().find(|(hopeless, _)| *hopeless == flap) {
            return Some(why.clone());
        }
        let sets = (0..=order.len()).rev().map(|count| closed_set(&order[..count]));
        let mut tried = sets.filter_map(|set| self.known.get(&(flap, set)));
        tried.find_map(|tried| tried.as_ref().err().cloned())
    }

    /// Where a flap whose push is known rests after it.
    fn rest_rad(&self, flap: usize, before: &[usize]) -> f64 {
        let push = self.known.get(&(flap, closed_set(before))).and_then(|tried| tried.as_ref().ok());
        push.map_or(0.0, |push| self.closer.rest_rad(flap, push))
    }

    fn can_push(&mut self, flap: usize, before: &[usize], angles_rad: &[f64]) -> bool {
        if self.hopeless.iter().any(|(hopeless, _)| *hopeless == flap) {
            return false;
        }
        let key = (flap, closed_set(before));
        if !self.known.contains_key(&key) {
            let tried = self.closer.push(flap, &Moment::resting(angles_rad), self.effort, self.descent);
            if let Err(why) = &tried {
                self.has_waited |= why.is_steep;
                self.searches[flap] += usize::from(why.searched);
                if !why.by_flaps || self.searches[flap] >= MOST_SEARCHES {
                    self.hopeless.push((flap, why.clone()));
                }
            }
            self.known.insert(key, tried);
        }
        self.known[&key].is_ok()
    }
}

fn closed_set(flaps: &[usize]) -> u32 {
    flaps.iter().map(|flap| 1 << flap).sum()
}
