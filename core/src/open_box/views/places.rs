//! Where the cameras really stood: an arm's poses are good to millimetres, and a box that several views see tells them better.

use nalgebra::Isometry3;

use super::super::sight::Sight;
use super::joint::motions;
use super::matching::Sighting;
use super::View;
use crate::fit::FitSettings;

/// A box tells of places where two views see it, and one is so sure of it.
pub const SURE: f64 = 0.6;
/// Rounds of places and readings.
const ROUNDS: usize = 2;
/// A place that is off by more standard deviations than this is told.
const STRANGE: f64 = 3.0;

/// Views in the common level frame, moved to where the box that was seen best puts them; what a user should know of their poses.
///
/// `sights` are at the places that were given. `None` where a view has no image.
pub fn bettered<'a>(
    views: &'a [View<'a>],
    sights: Vec<Sight<'a>>,
    groups: &[Vec<Sighting>],
    settings: &FitSettings,
) -> Option<(Vec<Sight<'a>>, Vec<String>)> {
    let tells = |group: &&Vec<Sighting>| group.len() > 1 && group[0].probability > SURE;
    let Some(group) = groups.iter().find(tells) else { return Some((sights, Vec::new())) };
    let mut moved = vec![Isometry3::identity(); sights.len()];
    let mut sights = sights;
    for _ in 0..ROUNDS {
        let Some(found) = motions(&sights, group, settings) else { break };
        let mut next = Vec::with_capacity(sights.len());
        for (k, (sight, view)) in sights.into_iter().zip(views).enumerate() {
            if k == 0 {
                next.push(sight);
                continue;
            }
            let motion = found[k - 1];
            moved[k] = motion * moved[k];
            next.push(Sight::in_level(&view.cloud, &view.readings, sight.input_from_level * motion.inverse())?);
        }
        sights = next;
    }
    let warnings =
        moved.iter().enumerate().filter_map(|(k, motion)| strange(k, motion, &sights[k], &group[0], settings));
    let warnings = warnings.collect();
    Some((sights, warnings))
}

/// A line of a view whose place is off by more than is usual.
fn strange(
    number: usize,
    motion: &Isometry3<f64>,
    sight: &Sight,
    seen: &Sighting,
    settings: &FitSettings,
) -> Option<String> {
    let at = seen.body().input_from_object.translation.vector;
    let off_m = (motion.transform_point(&at.into()).coords - at).norm();
    let turn_rad = motion.rotation.angle();
    let usual_m = settings.place_sigma_m.hypot((at - sight.eye).norm() * settings.place_sigma_rad);
    let is_strange = off_m > STRANGE * usual_m || turn_rad > STRANGE * settings.place_sigma_rad;
    is_strange.then(|| {
        let (mm, degrees) = (1000.0 * off_m, turn_rad.to_degrees());
        format!(
            "frame {}: what it shows of a box lies {mm:.0} mm and {degrees:.1} deg off what the others show; check its pose",
            number + 1
        )
    })
}
