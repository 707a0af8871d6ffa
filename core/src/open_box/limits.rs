//! How far a flap can turn: its template's limits, narrowed by what blocks it (docs/formats.md).

use crate::fit::{layout, FittedBody, Rim, Role};
use crate::geometry::Vec3;

const STEP_RAD: f64 = 0.0175;
const HALVINGS: usize = 30;
/// A flap that reaches so far into something, metres, is taken to be off it: where things are is known no better.
const GIVE_M: f64 = 0.002;

/// Limits of a flap of a body whose frame has the support at z = 0: the support below it, the base, and the side across, where the flap
/// is longer than the box is wide. Of what is no flap, or stands where it would be blocked, they stay.
pub fn narrowed(limits_rad: [f64; 2], body: &FittedBody, role: Role) -> [f64; 2] {
    let Role::Flap(k) = role else { return limits_rad };
    let turn = Turn::of(body, k);
    let [low, high] = limits_rad;
    let at = body.get(layout::flap(k) + layout::FLAP_ANGLE).clamp(low, high);
    if turn.is_blocked(at) {
        return limits_rad;
    }
    [turn.end(at, low), turn.end(at, high)]
}

/// A flap that turns about its hinge.
struct Turn<'a> {
    body: &'a FittedBody,
    rim: Rim,
    length_m: f64,
    free_corners_m: [f64; 2],
    across_m: f64,
    depth_m: f64,
}

impl<'a> Turn<'a> {
    fn of(body: &'a FittedBody, k: usize) -> Self {
        let flap = |place: usize| body.get(layout::flap(k) + place);
        let half_m = flap(layout::FLAP_WIDTH) / 2.0 - flap(layout::FLAP_TAPER);
        Self {
            body,
            rim: Rim::new(body, k),
            length_m: flap(layout::FLAP_LENGTH),
            free_corners_m: [-1.0, 1.0].map(|side| flap(layout::FLAP_OFFSET) + side * half_m),
            across_m: body.edge_m(k + 1),
            depth_m: body.get(layout::HEIGHT) - body.board_m(),
        }
    }

    fn is_blocked(&self, angle_rad: f64) -> bool {
        let (inward, above) = (self.length_m * angle_rad.cos(), self.length_m * angle_rad.sin());
        let is_in_box = inward > 0.0 && above < -GIVE_M;
        let on_base = is_in_box && -above > self.depth_m + GIVE_M;
        let on_side_across = is_in_box && inward > self.across_m + GIVE_M;
        let height_m =
            |along: f64| -> f64 { Vec3::z().dot(&self.body.to_input(&self.rim.place(along, inward, above))) };
        on_base || on_side_across || self.free_corners_m.iter().any(|&along| height_m(along) < -GIVE_M)
    }

    /// As far as it turns from an angle towards another.
    fn end(&self, from_rad: f64, to_rad: f64) -> f64 {
        let steps = ((to_rad - from_rad).abs() / STEP_RAD).ceil() as usize;
        let at = |step: usize| from_rad + (to_rad - from_rad) * step as f64 / steps as f64;
        let Some(blocked) = (1..=steps).find(|&step| self.is_blocked(at(step))) else { return to_rad };
        let (mut free, mut blocked) = (at(blocked - 1), at(blocked));
        for _ in 0..HALVINGS {
            let middle = (free + blocked) / 2.0;
            *if self.is_blocked(middle) { &mut blocked } else { &mut free } = middle;
        }
        free
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use nalgebra::Isometry3;

    use super::*;
    use crate::fit::Parameters;

    const LIMITS_RAD: [f64; 2] = [-FRAC_PI_2, 3.0 * FRAC_PI_2];

    /// A box of 0.4 x 0.3 m whose flaps are so long and stand so.
    fn body(height_m: f64, length_m: f64, angle_rad: f64) -> FittedBody {
        let mut numbers = Parameters::zeros();
        let sizes =
            [(layout::LENGTH, 0.4), (layout::WIDTH, 0.3), (layout::HEIGHT, height_m), (layout::THICKNESS, 0.004)];
        sizes.iter().for_each(|&(place, size_m)| numbers[place] = size_m);
        for k in 0..4 {
            numbers[layout::flap(k) + layout::FLAP_LENGTH] = length_m;
            numbers[layout::flap(k) + layout::FLAP_WIDTH] = 0.25;
            numbers[layout::flap(k) + layout::FLAP_ANGLE] = angle_rad;
        }
        FittedBody { input_from_object: Isometry3::new(Vec3::new(0.2, 0.1, 0.0), Vec3::z() * 0.7), numbers }
    }

    #[test]
    fn flaps_end_on_the_support_on_the_base_and_on_the_rim_across() {
        let mut cases = 0;
        for angle_rad in [0.2, 1.5, 2.8] {
            for (height_m, length_m, low, high) in [
                (0.25, 0.15, -FRAC_PI_2, 3.0 * FRAC_PI_2),
                (0.05, 0.15, -((0.046_f64 + GIVE_M) / 0.15).asin(), PI + ((0.05_f64 + GIVE_M) / 0.15).asin()),
                // Longer than the box is wide: it lies on the rim across.
                (0.25, 0.32, -(GIVE_M / 0.32_f64).asin(), PI + ((0.25_f64 + GIVE_M) / 0.32).asin()),
            ] {
                let told = narrowed(LIMITS_RAD, &body(height_m, length_m, angle_rad), Role::Flap(0));
                assert!((told[0] - low).abs() < 1e-6 && (told[1] - high).abs() < 1e-6, "{told:?} for {low} {high}");
                cases += 1;
            }
        }
        assert_eq!(cases, 9);
    }

    #[test]
    fn what_is_no_flap_or_stands_where_it_would_be_blocked_keeps_its_limits() {
        let given = body(0.05, 0.15, 1.5);
        assert_eq!(narrowed(LIMITS_RAD, &given, Role::Tuck(0)), LIMITS_RAD);
        assert_eq!(narrowed(LIMITS_RAD, &body(0.05, 0.15, 4.6), Role::Flap(0)), LIMITS_RAD);
    }
}
