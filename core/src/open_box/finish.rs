//! Boxes that have won, fitted to all of their readings, again and again while more is held.

use super::assignments::Assignments;
use super::choose::Chosen;
use super::crease::with_creases;
use super::edge_on::with_edge_on_lids;
use super::evidence::{Evidence, Sheet};
use super::features;
use super::flap_scan::ScannedFlap;
use super::found_box::{FoundBox, COARSE_STRIDE, FINE_M};
use super::grow::{competing, fitted_as_it_stands, grow, sound, weigh};
use super::hanging::{
    scan_flaps, scan_flaps_into_box, scan_hidden_flaps, scan_tucks, with_flaps, with_tucks, FINE_SCAN,
};
use super::judgement::Judgement;
use super::label::label;
use super::labels::{roles, Labels, Present};
use super::moved::{moved_sides, MovedSide};
use super::patch::Patch;
use super::patch_flaps::flaps_of_patches;
use super::refit::refit;
use super::sight::Sight;
use super::slots::height_by_slots;
use super::sure::drop_unsure;
use super::thin::{thin_flaps, with_thin};
use super::told::is_told;
use crate::fit::{
    canonical_turn, layout, with_known_size, FitSettings, FittedBody, KnownSize, NotFitted, Role, Solution,
};

/// What boxes are finished by.
pub struct Finishing<'a> {
    pub sight: &'a Sight<'a>,
    pub patches: &'a [Patch],
    pub assignments: &'a Assignments<'a>,
    pub sizes: &'a [KnownSize],
    pub settings: &'a FitSettings,
    pub judgement: Option<&'a Judgement>,
}

/// A finished box is finished anew, from what it has come to, at most so often: what it now is shows flaps that it did not.
const ROUNDS: usize = 2;
/// With the same panels it must have come to rank so much higher for that: by less, readings at its panels' ends come and go.
const CHANGED: f64 = 1.01;

/// A box with flaps that stand up holds at least this share of what it held as one of higher sides.
const BELOW_SLOTS: f64 = 0.9;

/// A box with a side moved ranks so much higher.
const MOVED: f64 = 1.02;

/// A box with a flap that is seen from its edge ranks as high, but for the readings that come and go at its panels' ends.
const NO_LESS: f64 = 0.98;

impl Finishing<'_> {
    /// The box that was chosen, or of those that could take its place the one that holds more once all are finished; `others` are
    /// those of boxes beside it.
    ///
    /// # Errors
    /// As of the fit of the box that was chosen, where none takes its place.
    pub fn best(&self, chosen: Chosen, others: &[&Labels]) -> Result<FoundBox, NotFitted> {
        let first = self.finish(chosen.one);
        let instead = chosen.instead.into_iter().filter_map(|one| self.finish(one).ok());
        let best = instead.fold(first, |best, one| match best {
            Ok(best) if self.rank(&best) >= self.rank(&one) => Ok(best),
            _ => Ok(one),
        });
        let best = self.below_slots(self.with_lids(self.while_better(best?)));
        Ok(self.with_thin_flaps(self.with_moved_side(best, others)))
    }

    /// The box with lids that are seen from their edges, where it ranks higher with them.
    fn with_lids(&self, found: FoundBox) -> FoundBox {
        let (body, present) = match with_edge_on_lids(self.sight, &found.solution.body, &found.present, FINE_M) {
            Some(lids) => lids,
            None => return found,
        };
        let with = if_better(self.sight, found.clone(), &body, present, self.settings);
        if with.present == found.present {
            return found;
        }
        match self.finish(FoundBox { rivals: found.rivals, ..with }) {
            Ok(with) if self.rank(&with) > self.rank(&found) => with,
            _ => found,
        }
    }

    /// The box with sides that end where its corners open, and with the flaps that stand up on them; as it is where they do not, or
    /// where much less would be held so.
    fn below_slots(&self, found: FoundBox) -> FoundBox {
        let body = &found.solution.body;
        let Some(height_m) = height_by_slots(self.sight, body) else { return found };
        let mut lower = body.clone();
        lower.numbers[layout::HEIGHT] = height_m;
        let flaps = scan_flaps(self.sight, &lower, FINE_M, FINE_SCAN);
        if flaps.iter().all(Option::is_none) {
            return found;
        }
        let grown = grow(self.sight, &lower, &flaps, self.settings, None);
        let lower = grown.map(|grown| FoundBox { rivals: found.rivals, size: found.size, ..grown });
        match lower.map(|lower| self.finish(lower)) {
            Some(Ok(lower)) if self.rank(&lower) > BELOW_SLOTS * self.rank(&found) => self.while_better(lower),
            _ => found,
        }
    }

    fn while_better(&self, first: FoundBox) -> FoundBox {
        let mut best = first;
        for _ in 0..ROUNDS {
            let (present, rank) = (best.present, self.rank(&best));
            match self.finish(best.clone()) {
                Ok(one) if self.rank(&one) > rank => best = one,
                _ => break,
            }
            if best.present == present && self.rank(&best) < CHANGED * rank {
                break;
            }
        }
        best
    }

    /// Of a box against itself with other sides and flaps, whose probability may have changed.
    fn rank(&self, one: &FoundBox) -> f64 {
        one.rank(self.judgement.map_or(1.0, |judgement| judgement.box_probability(&one.features))) * one.slots
    }

    /// With its tuck flaps, fitted to all of its readings; it takes the size that it matches, if any.
    fn finish(&self, found: FoundBox) -> Result<FoundBox, NotFitted> {
        let (sight, settings, rivals) = (self.sight, self.settings, found.rivals);
        let (solution, present, of_fewer) = fit_to_all(sight, &found, settings)?;
        let found = look_again(sight, self.patches, weigh(sight, solution, present, 1), settings);
        self.sized(FoundBox { of_fewer, rivals, ..found })
    }

    /// With a side that shows nothing where its flap is, where the box then ranks higher. `others` are those of boxes beside it.
    fn with_moved_side(&self, found: FoundBox, others: &[&Labels]) -> FoundBox {
        let is_asked = std::array::from_fn(|k| !is_told(&found, Role::Side(k), self.judgement));
        let ways = |moved: MovedSide| {
            let flaps = scan_flaps(self.sight, &moved.body, FINE_M, FINE_SCAN);
            let as_it_stands = fitted_as_it_stands(self.sight, &moved.body, moved.present, self.settings);
            [as_it_stands, grow(self.sight, &moved.body, &flaps, self.settings, None)]
        };
        let moved = moved_sides(self.sight, self.patches, &found, others, is_asked);
        let finished = moved
            .into_iter()
            .flat_map(ways)
            .flatten()
            .filter_map(|moved| self.finish(FoundBox { rivals: found.rivals, size: found.size, ..moved }).ok());
        let best = finished.fold(None, |best: Option<FoundBox>, one| match best {
            Some(best) if self.rank(&best) >= self.rank(&one) => Some(best),
            _ => Some(one),
        });
        match best {
            Some(best) if self.rank(&best) > MOVED * self.rank(&found) => self.while_better(best),
            _ => found,
        }
    }

    /// With flaps that are seen from their edge, one after the other, where no other panel is lost.
    fn with_thin_flaps(&self, found: FoundBox) -> FoundBox {
        let is_told = |found: &FoundBox, role: Role| is_told(found, role, self.judgement);
        let is_missed = |k: usize| !is_told(&found, Role::Flap(k)) && !is_told(&found, Role::Tuck(k));
        let flaps = thin_flaps(self.sight, &found.solution.body, &found.labels, std::array::from_fn(is_missed));
        let with = |found: FoundBox, (k, flap): (usize, ScannedFlap)| {
            let with = with_thin(self.sight, &found, k, flap, self.settings).and_then(|with| {
                self.sized(FoundBox { of_fewer: found.of_fewer.clone(), rivals: found.rivals, ..with }).ok()
            });
            let is_better = |with: &FoundBox| {
                self.rank(with) > NO_LESS * self.rank(&found)
                    && roles(&found.present).into_iter().all(|role| !is_told(&found, role) || is_told(with, role))
            };
            with.filter(is_better).unwrap_or(found)
        };
        flaps.iter().enumerate().filter_map(|(k, flap)| Some((k, (*flap)?))).fold(found, with)
    }

    /// Of the size that it matches, if any, and with what it is judged by.
    ///
    /// # Errors
    /// Where a body of that size is no box.
    fn sized(&self, found: FoundBox) -> Result<FoundBox, NotFitted> {
        let (sight, settings) = (self.sight, self.settings);
        let (of_fewer, rivals) = (found.of_fewer.clone(), found.rivals);
        let (solution, size) = with_known_size(found.solution.clone(), self.sizes, settings.seen_scale.dimension);
        sound(&solution.body)?;
        let found = if size.is_some() { weigh(sight, solution, found.present, 1) } else { found };
        let mut out = FoundBox { size, of_fewer, rivals, ..found };
        let of = |(role, evidence): &(Role, Evidence)| {
            let points = out.labels.of(*role);
            (!points.is_empty())
                .then(|| (*role, features::of_part(sight, &self.assignments.owners, &out, *role, points, evidence)))
        };
        out.part_features = out.evidence.iter().filter_map(of).collect();
        out.features = features::of_box(sight, self.assignments, &out, &|role| is_told(&out, role, self.judgement));
        Ok(out)
    }
}

/// Fitted to all its readings; where they lead to no body, to fewer, as before, and why.
fn fit_to_all(
    sight: &Sight,
    found: &FoundBox,
    settings: &FitSettings,
) -> Result<(Solution, Present, Option<NotFitted>), NotFitted> {
    let turn = canonical_turn(&found.solution.body, Some(sight.eye));
    let body = found.solution.body.turned(turn);
    // Of a lid that is seen from its edge the tuck flap has them.
    let has_readings = std::array::from_fn(|k| {
        let side = (k + turn) % 4;
        [Role::Flap(side), Role::Tuck(side)].iter().any(|&role| !found.labels.of(role).is_empty())
    });
    // Flaps that were scanned and got no readings are none.
    let present = found.present.turned(turn).among(&has_readings);
    let (body, present) = with_tucks(&body, &present, &scan_tucks(sight, &body, &present, &has_readings, FINE_M));
    let mut labels = label(sight, &body, &present, FINE_M, 1);
    let (body, present) = match with_creases(sight, &body, &present, &labels) {
        Some((body, present)) => {
            labels = label(sight, &body, &present, FINE_M, 1);
            (body, present)
        }
        None => (body, present),
    };
    drop_unsure(sight, &body, &mut labels);
    let fit = |labels: &Labels, settings: &FitSettings| {
        let solution = refit(sight, &body, &present, labels, settings)?;
        sound(&solution.body).map(|()| solution)
    };
    fit(&labels, settings).map(|solution| (solution, present, None)).or_else(|why| {
        let mut labels = label(sight, &body, &present, FINE_M, COARSE_STRIDE);
        drop_unsure(sight, &body, &mut labels);
        Ok((fit(&labels, &competing(settings))?, present, Some(why)))
    })
}

/// A flap that was missed, or fitted where little lies, is taken from a scan of its edge where now more is met; one that is hidden
/// near its edge from one that looks further.
fn look_again(sight: &Sight, patches: &[Patch], found: FoundBox, settings: &FitSettings) -> FoundBox {
    let (body, present) = (&found.solution.body, found.present);
    let mut flaps = scan_flaps(sight, body, FINE_M, FINE_SCAN);
    let fitted_score = |k: usize| {
        let evidence = Sheet::new(body, Role::Flap(k), &sight.eye).look(sight, FINE_M);
        evidence.met - 2.0 * evidence.through
    };
    for (k, flap) in flaps.iter_mut().enumerate() {
        *flap = flap.filter(|flap| !present.flaps[k] || flap.score() > BETTER * fitted_score(k).max(0.0) + BETTER_PX);
    }
    let found = taken_up(sight, found, &flaps, settings);
    let is_missed = found.present.flaps.map(|is_there| !is_there);
    let hidden = scan_hidden_flaps(sight, &found.solution.body, FINE_M, is_missed);
    let found = taken_up(sight, found, &hidden, settings);
    let is_missed = found.present.flaps.map(|is_there| !is_there);
    let of_patches = flaps_of_patches(sight, patches, &found.solution.body, FINE_M, is_missed);
    let found = taken_up(sight, found, &of_patches, settings);
    // Last: what lies in a box may look like a flap that hangs into it, and takes no other flap's place.
    let is_missed = found.present.flaps.map(|is_there| !is_there);
    let into_box = scan_flaps_into_box(sight, &found.solution.body, FINE_M, is_missed);
    taken_up(sight, found, &into_box, settings)
}

/// Fitted with these flaps too, where more is held then: a flap fitted to what is none costs more than it holds.
fn taken_up(sight: &Sight, found: FoundBox, flaps: &[Option<ScannedFlap>; 4], settings: &FitSettings) -> FoundBox {
    if flaps.iter().all(Option::is_none) {
        return found;
    }
    let present = found.present;
    let (body, scanned) = with_flaps(&found.solution.body, flaps);
    let both = Present { flaps: std::array::from_fn(|k| present.flaps[k] || scanned.flaps[k]), ..present };
    if_better(sight, found, &body, both, settings)
}

/// Fitted with these parts instead, where more is held then.
fn if_better(sight: &Sight, found: FoundBox, body: &FittedBody, present: Present, settings: &FitSettings) -> FoundBox {
    let again = fitted_as_it_stands(sight, body, present, settings);
    again.filter(|again| again.score > found.score).unwrap_or(found)
}

/// A scan has this much more than the fit.
const BETTER: f64 = 1.25;
const BETTER_PX: f64 = 100.0;
