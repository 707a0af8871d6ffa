//! What a box bears: what a fold takes to turn and gives back, and how hard a box may be pushed before it slides or tips.

use serde::Deserialize;

use super::flap::{Flap, Standing};
use super::problem::{Board, BoxProblem};
use crate::geometry::Vec3;

/// What nobody sees of a box and has to be assumed; the same figures as physics assumes by default (docs/physics.md), told to it apart.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Assumed {
    /// What folds a metre of crease on, in board of `crease_board_m`; in other board in proportion to its thickness. N m/m.
    pub crease_n_m_per_m: f64,
    pub crease_board_m: f64,
    /// How far a flap that is let go comes back, rad.
    pub crease_return_rad: f64,
    pub board_kg_per_m2: f64,
    /// What fills the box; `mass_kg`, box and contents together, goes before it.
    pub contents_kg_per_m3: f64,
    pub mass_kg: Option<f64>,
    /// Of the box on its support.
    pub friction: f64,
}

impl Default for Assumed {
    fn default() -> Self {
        Self {
            crease_n_m_per_m: 0.6,
            crease_board_m: 0.004,
            crease_return_rad: 12f64.to_radians(),
            board_kg_per_m2: 0.55,
            contents_kg_per_m3: 100.0,
            mass_kg: None,
            friction: 0.4,
        }
    }
}

const GRAVITY_M_PER_S2: f64 = 9.80665;
/// A crease that holds a flap's weight where it stands is taken to need no more than this share of its moment for it.
const HELD_SHARE: f64 = 0.8;
/// A footprint's friction resists a turn as if all of the weight stood this share of its diagonal from its middle.
const SPIN_SHARE: f64 = 0.27;

/// A finger that slips along the board drags it aside with this share of what it pushes with.
pub const DRAG_SHARE: f64 = 0.3;

/// From where a flap rests to where it was held, at the most.
const HELD_STEPS: usize = 4;

/// Places along and across, and angles, that `is_bearable` asks about.
const PLACES: usize = 10;
const BEARABLE_STEP_RAD: f64 = 0.0873;

/// One flap's crease and weight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fold {
    /// What folds it on.
    pub crease_n_m: f64,
    /// Of the flap's own weight about the hinge where it is level.
    pub weight_n_m: f64,
    pub return_rad: f64,
}

impl Fold {
    fn of(flap: &Flap, thickness_m: f64, assumed: &Assumed) -> Self {
        let newtons_per_m2 = assumed.board_kg_per_m2 * GRAVITY_M_PER_S2;
        let tucks_n_m: f64 = flap
            .tucks
            .iter()
            .map(|(_, corners)| newtons_per_m2 * area_m2(corners) * corners.iter().map(|p| p.y).sum::<f64>() / 4.0)
            .sum();
        let weight_n_m = newtons_per_m2 * flap.area_m2() * flap.length_m() / 2.0 + tucks_n_m;
        let told_n_m = assumed.crease_n_m_per_m * flap.hinge_length_m().max(0.0) * thickness_m / assumed.crease_board_m;
        // A flap that stands has a crease that can hold it.
        let holds_n_m = (weight_n_m * flap.position_rad.cos()).abs() / HELD_SHARE;
        Self { crease_n_m: told_n_m.max(holds_n_m), weight_n_m, return_rad: assumed.crease_return_rad }
    }

    /// What turns it inward at an angle; below 0 where it falls by itself (eq. 96).
    pub fn closing_n_m(&self, angle_rad: f64) -> f64 {
        self.crease_n_m - self.weight_n_m * angle_rad.cos()
    }

    /// How fast the free edge of a flap of this length comes down to closed when it is pushed down from an angle: it falls from where it
    /// is heavier than its crease bears; 0 where it is nowhere (eq. 96).
    pub fn fall_m_per_s(&self, length_m: f64, from_rad: f64) -> f64 {
        let share = self.crease_n_m / self.weight_n_m.max(f64::MIN_POSITIVE);
        if share >= 1.0 {
            return 0.0;
        }
        let falls_rad = share.acos().min(from_rad);
        (3.0 * GRAVITY_M_PER_S2 * length_m * (falls_rad.sin() - share * falls_rad)).max(0.0).sqrt()
    }

    /// Where it rests after it was held at an angle and let go: the crease gives back what the flap's weight lets it.
    pub fn rest_rad(&self, hold_rad: f64) -> f64 {
        hold_rad + self.given_back_rad(hold_rad)
    }

    /// Where it was held that rests at an angle.
    pub fn held_rad(&self, rest_rad: f64) -> f64 {
        // The weight's share hardly changes over the few degrees between.
        (0..HELD_STEPS).fold(rest_rad, |held_rad, _| rest_rad - self.given_back_rad(held_rad))
    }

    fn given_back_rad(&self, hold_rad: f64) -> f64 {
        let share = 1.0 - self.weight_n_m * hold_rad.cos() / self.crease_n_m.max(f64::MIN_POSITIVE);
        self.return_rad * share.clamp(0.0, 1.0)
    }
}

/// How a box stands: its weight, and the base that it stands on.
#[derive(Debug, Clone, PartialEq)]
pub struct Stand {
    weight_n: f64,
    up: Vec3,
    friction: f64,
    /// The middle of the base.
    centre: Vec3,
    /// Where the friction of the base resists a turn as if all of it were so far from the middle.
    spin_m: f64,
    /// Of each edge of the base: an end, the unit vector out of the base, and how far it is from the base's middle.
    edges: [(Vec3, Vec3, f64); 4],
}

impl Stand {
    fn of(problem: &BoxProblem, assumed: &Assumed) -> Option<Self> {
        let base = &problem.fixed.iter().find(|board| board.name == "base")?.corners;
        let up = problem.support.map_or(Vec3::z(), |(normal, _)| normal);
        let own = |board: &&Board| board.name == "base" || board.name.starts_with("side_");
        let boards_m2: f64 = problem.fixed.iter().filter(own).map(|board| area_m2(&board.corners)).sum();
        let flaps_m2: f64 = problem.flaps.iter().map(flap_area_m2).sum();
        let rims = problem.fixed.iter().filter(own).flat_map(|board| board.corners);
        let height_m = rims.map(|corner| (corner - base[0]).dot(&up)).fold(0.0, f64::max);
        let contents_kg = assumed.contents_kg_per_m3 * area_m2(base) * height_m;
        let mass_kg = assumed.mass_kg.unwrap_or((boards_m2 + flaps_m2) * assumed.board_kg_per_m2 + contents_kg);
        Some(Self::on(base, up, mass_kg * GRAVITY_M_PER_S2, assumed.friction))
    }

    /// On a base whose corners are told going round; what every push of a search asks for is reckoned here once.
    pub(super) fn on(base: &[Vec3; 4], up: Vec3, weight_n: f64, friction: f64) -> Self {
        let centre = base.iter().sum::<Vec3>() / 4.0;
        let edges = std::array::from_fn(|k| {
            let (p, q) = (base[k], base[(k + 1) % 4]);
            let outward = (q - p).cross(&up).normalize();
            let outward = if outward.dot(&(centre - p)) > 0.0 { -outward } else { outward };
            (p, outward, (p - centre).dot(&outward))
        });
        Self { weight_n, up, friction, centre, spin_m: SPIN_SHARE * (base[2] - base[0]).norm(), edges }
    }

    /// The share that a force (N) at a point is of what moves the box: slides it, turns it on the spot, or tips it over an edge of
    /// its base (eq. 97).
    pub fn strain(&self, at: &Vec3, force_n: &Vec3) -> f64 {
        self.strain_with_couple(at, force_n, &Vec3::zeros())
    }

    /// The same of a force and a couple (N m), which turns the box on the spot and tips it.
    pub fn strain_with_couple(&self, at: &Vec3, force_n: &Vec3, couple_n_m: &Vec3) -> f64 {
        let lift_n = force_n.dot(&self.up);
        let level_n = force_n - self.up * lift_n;
        let turn_n = ((at - self.centre).cross(&level_n) + couple_n_m).dot(&self.up) / self.spin_m;
        let drag_n = DRAG_SHARE * force_n.norm();
        let along_n = (level_n.norm_squared() + turn_n.powi(2) + drag_n.powi(2)).sqrt();
        let slides = (along_n + self.friction * lift_n) / (self.friction * self.weight_n);
        self.edges.iter().fold(slides, |worst, (p, outward, lever_m)| {
            let over_n_m = level_n.dot(outward) * (at - p).dot(&self.up)
                + lift_n * (p - at).dot(outward)
                + couple_n_m.dot(&self.up.cross(outward));
            worst.max(over_n_m / (self.weight_n * lever_m))
        })
    }

    /// The share that a push square to a flap's face is which turns it on at an angle, at the best place of it.
    pub fn least_strain(&self, fold: &Fold, flap: &Flap, half_board_m: f64, angle_rad: f64) -> f64 {
        let frame = flap.frame(angle_rad);
        let places = (0..PLACES * PLACES).map(|k| [k % PLACES, k / PLACES].map(|k| (k + 1) as f64 / PLACES as f64));
        let strains = places.map(|[along, away]| {
            let lever_m = away * flap.length_m();
            let at = frame.at(along * flap.hinge_length_m(), lever_m, half_board_m);
            let push_n = fold.closing_n_m(angle_rad).max(0.0) / lever_m;
            self.strain(&at, &(frame.push() * push_n))
        });
        strains.fold(f64::INFINITY, f64::min)
    }
}

/// A box's folds, in the order of its flaps, and its stand; None where it has no base.
#[derive(Debug, Clone, PartialEq)]
pub struct Load {
    pub folds: Vec<Fold>,
    pub stand: Option<Stand>,
}

impl Load {
    pub fn of(problem: &BoxProblem, assumed: &Assumed) -> Self {
        let folds = problem.flaps.iter().map(|flap| Fold::of(flap, problem.thickness_m, assumed)).collect();
        Self { folds, stand: Stand::of(problem, assumed) }
    }

    /// Is there at every angle, from where a flap stands to closed, some place on it where a push square to its face turns it and
    /// leaves the box standing? Statics alone, whatever the arm can reach.
    pub fn is_bearable(&self, problem: &BoxProblem, flap: usize) -> bool {
        self.worst_strain(problem, flap) <= 1.0
    }

    /// The share of what moves the box that such a push is, at the best place of the worst angle (eq. 97).
    pub fn worst_strain(&self, problem: &BoxProblem, flap: usize) -> f64 {
        let open_rad = problem.flaps[flap].position_rad;
        let steps = (open_rad / BEARABLE_STEP_RAD).ceil().max(1.0) as usize;
        let angles_rad = (0..=steps).map(|step| open_rad * (1.0 - step as f64 / steps as f64));
        angles_rad.map(|angle_rad| self.strain_at(problem, flap, angle_rad)).fold(0.0, f64::max)
    }

    /// The same at one angle.
    pub fn strain_at(&self, problem: &BoxProblem, flap: usize, angle_rad: f64) -> f64 {
        let (Some(stand), fold) = (&self.stand, &self.folds[flap]) else { return 0.0 };
        stand.least_strain(fold, &problem.flaps[flap], problem.thickness_m / 2.0, angle_rad)
    }
}

fn flap_area_m2(flap: &Flap) -> f64 {
    if flap.standing == Standing::Absent {
        return 0.0;
    }
    flap.area_m2() + flap.tucks.iter().map(|(_, corners)| area_m2(corners)).sum::<f64>()
}

fn area_m2(corners: &[Vec3; 4]) -> f64 {
    (corners[2] - corners[0]).cross(&(corners[3] - corners[1])).norm() / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stand() -> Stand {
        let base = [[-0.1, -0.05], [0.1, -0.05], [0.1, 0.05], [-0.1, 0.05]].map(|[x, y]| Vec3::new(x, y, 0.0));
        Stand::on(&base, Vec3::z(), 10.0, 0.4)
    }

    #[test]
    fn a_level_force_low_down_slides_at_friction_times_weight() {
        // With the drag of the finger across it.
        let force_n = 4.0 / f64::hypot(1.0, DRAG_SHARE);
        let strain = stand().strain(&Vec3::new(-0.1, 0.0, 0.001), &Vec3::new(force_n, 0.0, 0.0));
        assert!((strain - 1.0).abs() < 1e-9, "{strain}");
    }

    #[test]
    fn a_level_force_high_up_tips_before_it_slides() {
        // 2 N at 0.5 m over an edge 0.1 m away, against 10 N times 0.1 m.
        let strain = stand().strain(&Vec3::new(-0.1, 0.0, 0.5), &Vec3::new(2.0, 0.0, 0.0));
        assert!((strain - 1.0).abs() < 1e-9, "{strain}");
    }

    #[test]
    fn a_force_from_above_holds_the_box_and_one_from_below_lifts_it() {
        let at = Vec3::new(0.0, 0.0, 0.2);
        assert!(stand().strain(&at, &Vec3::new(0.0, 0.0, -50.0)) <= 0.0);
        // A box lifted whole slides first, as the finger drags it: (3 + 4) / 4.
        assert!((stand().strain(&at, &Vec3::new(0.0, 0.0, 10.0)) - 1.75).abs() < 1e-9);
    }

    #[test]
    fn a_couple_tips_and_spins_but_does_not_slide() {
        // 10 N with levers of 0.1 and 0.05 m; the base's friction of 4 N at a share of the diagonal.
        let spin_m = SPIN_SHARE * f64::hypot(0.2, 0.1);
        let strain_of_couple =
            |couple_n_m: &Vec3| stand().strain_with_couple(&Vec3::new(0.03, 0.02, 0.1), &Vec3::zeros(), couple_n_m);
        let asked = [
            (Vec3::new(0.0, 0.5, 0.0), 0.5),
            (Vec3::new(0.0, -0.5, 0.0), 0.5),
            (Vec3::new(0.5, 0.0, 0.0), 1.0),
            (Vec3::new(0.0, 0.0, 0.1), 0.1 / (4.0 * spin_m)),
        ];
        let counted = asked.map(|(couple_n_m, share)| {
            let strain = strain_of_couple(&couple_n_m);
            assert!((strain - share).abs() < 1e-9, "{couple_n_m:?}: {strain}");
        });
        assert_eq!(counted.len(), 4);
        // The same as two opposite forces at either end of an arm, one over the other, but for what slides.
        let (up, down) = (Vec3::new(0.0, 0.0, 0.3), Vec3::new(0.0, 0.0, 0.1));
        let force_n = Vec3::new(2.0, 0.0, 0.0);
        let couple = (up - down).cross(&force_n);
        assert!((strain_of_couple(&couple) - 0.4).abs() < 1e-9);
        // With a force that tips it the same way, 1 N at 0.2 m, against 10 N times 0.1 m.
        let both = stand().strain_with_couple(&Vec3::new(0.0, 0.0, 0.2), &Vec3::x(), &couple);
        assert!((both - 0.6).abs() < 1e-9, "{both}");
    }

    #[test]
    fn a_flap_falls_as_fast_as_its_weight_has_left_of_its_crease() {
        let fold = Fold { crease_n_m: 0.0, weight_n_m: 0.2, return_rad: 0.2 };
        // Upright on no crease at all: a stick of 0.3 m that falls by 90 degrees.
        let upright = std::f64::consts::FRAC_PI_2;
        assert!((fold.fall_m_per_s(0.3, upright) - (3.0 * GRAVITY_M_PER_S2 * 0.3).sqrt()).abs() < 1e-9);
        // From where the crease no longer bears it, 60 degrees, however far it stood open; from below that, more slowly.
        let borne = Fold { crease_n_m: 0.1, ..fold };
        let sixty = std::f64::consts::FRAC_PI_3;
        let expected = (3.0 * GRAVITY_M_PER_S2 * 0.3 * (sixty.sin() - sixty / 2.0)).sqrt();
        assert!((borne.fall_m_per_s(0.3, upright) - expected).abs() < 1e-9);
        assert!(borne.fall_m_per_s(0.3, 0.3) < 0.7 * expected && borne.fall_m_per_s(0.3, 0.3) > 0.0);
        assert_eq!(Fold { crease_n_m: 0.2, ..fold }.fall_m_per_s(0.3, upright), 0.0);
    }

    #[test]
    fn a_flap_springs_back_by_what_its_weight_leaves() {
        let fold = Fold { crease_n_m: 0.1, weight_n_m: 0.0, return_rad: 0.2 };
        assert!((fold.rest_rad(-0.1) - 0.1).abs() < 1e-12);
        let heavy = Fold { weight_n_m: 0.2, ..fold };
        assert_eq!(heavy.rest_rad(0.0), 0.0);
        let some = Fold { weight_n_m: 0.06, ..fold };
        let held = [-0.15, 0.0, 0.1, 0.3].map(|hold_rad| some.held_rad(some.rest_rad(hold_rad)) - hold_rad);
        assert!(held.iter().all(|off_rad| off_rad.abs() < 1e-4), "{held:?}");
        assert!(heavy.closing_n_m(0.1) < 0.0 && heavy.closing_n_m(3.0) > 0.29);
    }
}
