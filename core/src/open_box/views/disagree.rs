//! Frames that contradict each other: one looks through the box that another shows.

use super::super::evidence::{Evidence, Sheet};
use super::super::found_box::FINE_M;
use super::super::sight::Sight;
use super::matching::Sighting;
use super::places::SURE;
use crate::fit::Role;

/// A box is looked through by so many pixels, more than are met.
const LEAST_THROUGH: f64 = 1500.0;

/// A line of each frame, and box of another that is sure of it, where the frame sees through the box's walls more than it meets them.
pub fn looked_through(sights: &[Sight], groups: &[Vec<Sighting>]) -> Vec<String> {
    let mut out = Vec::new();
    for group in groups.iter().filter(|group| group[0].probability > SURE) {
        let shows = &group[0];
        for (number, sight) in sights.iter().enumerate().filter(|(number, _)| *number != shows.view) {
            let look = |k: usize| Sheet::new(shows.body(), Role::Side(k), &sight.eye).look(sight, FINE_M);
            let walls = (0..4).map(look).fold(Evidence::default(), |sum, one| sum.and(&one));
            if walls.through > LEAST_THROUGH && walls.through > walls.met {
                let (one, other) = (number + 1, shows.view + 1);
                out.push(format!(
                    "frame {one} looks through the box that frame {other} shows; check their poses, and that nothing has moved between them"
                ));
            }
        }
    }
    out
}
