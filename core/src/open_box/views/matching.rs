use nalgebra::Isometry3;

use super::super::found_box::FoundBox;
use super::super::judgement::{probability, Judgement};
use super::super::labels::Present;
use crate::fit::{layout, FittedBody, Rim};
use crate::geometry::Vec3;

/// A box as one view found it, in the level frame of all.
pub struct Sighting {
    pub view: usize,
    pub found: FoundBox,
    /// That it is a box, by its view alone.
    pub probability: f64,
}

impl Sighting {
    /// `found` in the view's own level frame.
    pub fn new(
        view: usize,
        level_from_own: &Isometry3<f64>,
        mut found: FoundBox,
        judgement: Option<&Judgement>,
    ) -> Self {
        let odds = judgement.map(|judgement| judgement.of_box(&found.features).0);
        let body = &mut found.solution.body;
        body.input_from_object = level_from_own * body.input_from_object;
        Self { view, found, probability: odds.map_or(1.0, probability) }
    }

    pub fn body(&self) -> &FittedBody {
        &self.found.solution.body
    }

    fn rank(&self) -> f64 {
        self.found.score * self.probability
    }

    /// The body, and what it has, with its sides numbered as those of another that stands where it does.
    pub fn numbered_as(&self, other: &FittedBody) -> (FittedBody, Present) {
        let x = |body: &FittedBody| body.input_from_object.rotation * Vec3::x();
        let alike = |turn: usize| x(&self.body().turned(turn)).dot(&x(other));
        let turn = (1..4).fold(0, |best, turn| if alike(turn) > alike(best) { turn } else { best });
        (self.body().turned(turn), self.found.present.turned(turn))
    }
}

/// Sightings of one box together, the best first; each view has at most one of each box.
pub fn groups(mut sightings: Vec<Sighting>) -> Vec<Vec<Sighting>> {
    sightings.sort_by(|a, b| b.rank().total_cmp(&a.rank()));
    let mut out: Vec<Vec<Sighting>> = Vec::new();
    for one in sightings {
        let is_own = |group: &&mut Vec<Sighting>| {
            group.iter().all(|other| other.view != one.view) && are_one(group[0].body(), one.body())
        };
        match out.iter_mut().find(is_own) {
            Some(group) => group.push(one),
            None => out.push(vec![one]),
        }
    }
    out
}

/// Places along each direction of a box that are asked whether they lie in the other.
const PLACES: usize = 6;
const LEAST_SHARE: f64 = 0.5;

/// Whether half of one box lies in the other.
fn are_one(a: &FittedBody, b: &FittedBody) -> bool {
    share_within(a, b) >= LEAST_SHARE || share_within(b, a) >= LEAST_SHARE
}

fn share_within(a: &FittedBody, b: &FittedBody) -> f64 {
    let share = |i: usize| (i as f64 + 0.5) / PLACES as f64;
    let rim = Rim::new(a, 0);
    let rims = [0, 1, 2, 3].map(|k| Rim::new(b, k));
    let mut within = 0;
    for i in 0..PLACES.pow(3) {
        let [x, y, z] = [i % PLACES, i / PLACES % PLACES, i / PLACES.pow(2)].map(share);
        let (along, inward) = ((x - 0.5) * a.get(layout::LENGTH), y * a.get(layout::WIDTH));
        let q = b.to_object(&a.to_input(&rim.place(along, inward, (z - 1.0) * a.get(layout::HEIGHT))));
        let is_inside = (0.0..=b.get(layout::HEIGHT)).contains(&q.z) && rims.iter().all(|r| r.locate(q).inward >= 0.0);
        within += usize::from(is_inside);
    }
    within as f64 / PLACES.pow(3) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::Parameters;

    fn body(x_m: f64, yaw_rad: f64, length_m: f64) -> FittedBody {
        let mut numbers = Parameters::zeros();
        (numbers[layout::LENGTH], numbers[layout::WIDTH], numbers[layout::HEIGHT]) = (length_m, 0.3, 0.2);
        FittedBody { input_from_object: Isometry3::new(Vec3::new(x_m, 0.1, 0.0), Vec3::z() * yaw_rad), numbers }
    }

    #[test]
    fn boxes_that_share_half_their_room_are_one() {
        let one = body(0.0, 0.2, 0.4);
        // Itself, numbered from another side, half as long, beside it, and turned half across it.
        assert!(are_one(&one, &one.turned(3)));
        assert!(are_one(&one, &body(0.0, 0.2, 0.15)) && are_one(&body(0.0, 0.2, 0.15), &one));
        assert!(!are_one(&one, &body(0.42, 0.2, 0.4)));
        assert!((share_within(&one, &body(0.2, 0.0, 0.4)) - 0.5).abs() < 0.15);
        assert_eq!(share_within(&one, &one), 1.0);
    }
}
