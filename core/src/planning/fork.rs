//! Turns a flap with the fingers astride its free edge. A couple loads the box far less than a push that turns the flap as far (eq. 97):
//! it slides nothing, and tips with less of a lever. What slides the box is the outer finger alone, as it leans on the board's edge.

use std::cell::Cell;

use super::astride::{all_astride, Astride};
use super::contact::Grip;
use super::flap::Flap;
use super::guard::{Guard, Moment};
use super::line::Lines;
use super::load::{Fold, Stand};
use super::posture::nearest;
use super::push::{layers_between, PushMotion};
use super::searches::{comes_and_goes, MOST_CAUGHT_IN_ALL};
use super::settings::PlanningSettings;
use crate::arm::{Arm, JointPositions};
use crate::geometry::Rigid;

/// One flap before one arm.
pub struct Fork<'a, G: Guard> {
    pub arm: &'a Arm,
    pub guard: &'a G,
    pub settings: &'a PlanningSettings,
    pub flap: &'a Flap,
    pub number: usize,
    pub thickness_m: f64,
    pub fold: Fold,
    pub stand: Option<&'a Stand>,
    /// Where all flaps are before it.
    pub before: &'a Moment,
    /// Down to where it is to be turned at the least, rad.
    pub until_rad: f64,
    /// Motions so far after which the arm was caught.
    pub caught: Cell<usize>,
}

/// The fingers at one opening.
struct Held<'a, G: Guard> {
    fork: &'a Fork<'a, G>,
    guard: G,
    astride: Astride,
}

impl<G: Guard> Fork<'_, G> {
    /// The first way that turns the flap down from where it stands to where a push can go on, and where it rests then (rad): rather one
    /// that asks nothing of the friction under the fingers.
    pub fn plan(&self) -> Option<(PushMotion, f64)> {
        let all = all_astride(self.arm, self.flap, self.thickness_m, &self.settings.fork);
        let (slipping, holding): (Vec<Astride>, Vec<Astride>) =
            all.into_iter().partition(|astride| self.moves_box(astride, astride.aside_per_m));
        let borne = |astride: &Astride| (astride.aside_per_m - astride.borne_per_m).max(0.0);
        let gripping = slipping.into_iter().filter(|astride| !self.moves_box(astride, borne(astride)));
        let mut asked = holding.into_iter().chain(gripping).take_while(|_| !self.is_caught());
        asked.find_map(|astride| Held { fork: self, guard: self.guard.with_opening(astride.opening_m), astride }.plan())
    }

    /// Do the fingers move the box, where the flap stands or where it is left: with their couple, and with what the outer one, where
    /// it leans, presses along the board?
    fn moves_box(&self, astride: &Astride, aside_per_m: f64) -> bool {
        let Some(stand) = self.stand else { return false };
        let couple_n_m = self.fold.crease_n_m + self.fold.weight_n_m;
        [self.start_rad(), self.until_rad].iter().any(|&angle_rad| {
            let frame = self.flap.frame(angle_rad);
            let couple = (frame.away * astride.twist - frame.along) * couple_n_m;
            let force_n = -frame.away * (couple_n_m * aside_per_m);
            let at = frame.at(astride.pivot.x, astride.pivot.y, astride.pivot.z);
            stand.strain_with_couple(&at, &force_n, &couple) > self.settings.most_strain
        })
    }

    /// Was the arm caught so often that it will be again? To find that out takes long.
    fn is_caught(&self) -> bool {
        self.caught.get() > MOST_CAUGHT_IN_ALL
    }

    fn start_rad(&self) -> f64 {
        self.before.angles_rad[self.number]
    }
}

impl<G: Guard> Held<'_, G> {
    fn plan(&self) -> Option<(PushMotion, f64)> {
        let fork = self.fork;
        let start_rad = fork.start_rad();
        let is_near = |angle_rad: f64, lean: f64| {
            self.guard.tool_conflict(&self.pose(angle_rad, lean), &self.at(angle_rad), self.clearance_m()).is_some()
        };
        if is_near(start_rad, 1.0) || is_near(fork.until_rad, 1.0) {
            return None;
        }
        // Flat where there is room for it.
        let lean_in = [0.0, fork.settings.fork.lean_in].into_iter().find(|&lean| !is_near(start_rad, lean))?;
        let solutions = fork.arm.inverse(&self.pose(start_rad, lean_in));
        let mut solutions = solutions.iter().take_while(|_| !fork.is_caught());
        solutions.find_map(|solution| self.with_ends(self.turned(&solution.positions, lean_in)?, lean_in))
    }

    /// Leaning, down as far as the arm can follow, and flat again on the flap as it springs back: first in wide steps, then in close
    /// ones.
    fn turned(&self, start: &JointPositions, lean_in: f64) -> Option<PushMotion> {
        let settings = self.fork.settings;
        let wide = self.places(settings.fork.wanted_rad, settings.layer_rad, (lean_in, false));
        let found = self.followed(start, &wide, settings.most_turn_rad);
        let last = found.len().checked_sub(1).map_or((f64::INFINITY, 0.0), |last| wide[last]);
        let mut to_rad = if last.1 < 1.0 { f64::INFINITY } else { last.0 };
        while to_rad <= self.fork.until_rad {
            let close = self.places(to_rad, settings.sample_rad, (lean_in, true));
            let push = self.followed(start, &close, settings.most_sample_turn_rad);
            if push.len() == close.len() {
                return Some(self.motion(push, close.iter().map(|place| place.0).collect()));
            }
            to_rad += settings.layer_rad;
        }
        None
    }

    fn motion(&self, push: Vec<JointPositions>, hinge_rad: Vec<f64>) -> PushMotion {
        let edge = (self.astride.pivot.x, self.fork.flap.length_m(), self.fork.thickness_m / 2.0);
        let contact = |&angle_rad: &f64| self.fork.flap.frame(angle_rad).at(edge.0, edge.1, edge.2);
        PushMotion {
            contact: hinge_rad.iter().map(contact).collect(),
            push,
            hinge_rad,
            opening_m: self.astride.opening_m,
            meanwhile_rad: self.fork.before.angles_rad.clone(),
            ..PushMotion::default()
        }
    }

    /// The flap's angles, and what share of its lean the tool leans by then.
    fn places(&self, to_rad: f64, step_rad: f64, (lean_in, to_end): (f64, bool)) -> Vec<(f64, f64)> {
        let start_rad = self.fork.start_rad();
        let leans = |from: f64| layers_between(from, 1.0, step_rad / self.astride.lean_rad);
        let leaning = leans(lean_in).into_iter().map(|lean| (start_rad, lean));
        let turning = layers_between(start_rad, to_rad, step_rad).into_iter().skip(1).map(|angle_rad| (angle_rad, 1.0));
        // Fingers that stay behind where the flap springs back to are pressed on, and drag the box with them as they leave.
        let sprung_rad = self.rest_rad(to_rad) - to_rad;
        let back = leans(0.0).into_iter().rev().skip(1).filter(|_| to_end);
        let back = back.map(|lean| (to_rad + sprung_rad * (1.0 - lean), lean));
        leaning.chain(turning).chain(back).collect()
    }

    /// Where a flap rests that is let go at an angle: it follows the fingers' slack, then springs back.
    fn rest_rad(&self, held_rad: f64) -> f64 {
        self.fork.fold.rest_rad(held_rad + self.astride.slack_rad)
    }

    /// Postures place by place, as far as they are clear and the arm need not jump.
    fn followed(&self, start: &JointPositions, places: &[(f64, f64)], most_turn_rad: f64) -> Vec<JointPositions> {
        let mut found: Vec<JointPositions> = Vec::new();
        for &(angle_rad, lean) in places {
            let last = found.last().unwrap_or(start);
            let solutions = self.fork.arm.inverse_near(&self.pose(angle_rad, lean), last);
            match nearest(&solutions, last).filter(|(_, turn)| *turn <= most_turn_rad) {
                Some((positions, _)) if self.is_clear(&positions, angle_rad) => found.push(positions),
                _ => break,
            }
        }
        found
    }

    fn is_clear(&self, positions: &JointPositions, angle_rad: f64) -> bool {
        self.guard.conflict(positions, &self.at(angle_rad), self.clearance_m()).is_none()
    }

    /// With the ways to it and away from it, and where the flap rests then.
    fn with_ends(&self, mut motion: PushMotion, lean_in: f64) -> Option<(PushMotion, f64)> {
        let fork = self.fork;
        let lines = Lines { arm: fork.arm, guard: &self.guard, settings: fork.settings };
        let (start_rad, rest_rad) = (motion.hinge_rad[0], motion.hinge_rad[motion.hinge_rad.len() - 1]);
        let after = fork.before.left(fork.number, rest_rad);
        let frame = |angle_rad: f64| fork.flap.frame(angle_rad);
        let grip = |angle_rad: f64, lean: f64| Grip {
            base_from_tool: self.pose(angle_rad, lean),
            contact: motion.contact[0],
            strain: 0.0,
            penalty: 0.0,
        };
        let (first, last) = (motion.push[0], motion.push[motion.push.len() - 1]);
        let mut approach = lines
            .draw_off(&first, &grip(start_rad, lean_in), &frame(start_rad), &self.at(start_rad), fork.before)
            .ok()?;
        approach.reverse();
        let retreat = lines.draw_off(&last, &grip(rest_rad, 0.0), &frame(rest_rad), &self.at(rest_rad), &after).ok()?;
        motion = PushMotion { approach, retreat, ..motion };
        if !comes_and_goes(fork.arm, &self.guard, fork.settings, &motion, (fork.before, &after)) {
            fork.caught.set(fork.caught.get() + 1);
            return None;
        }
        Some((motion, rest_rad))
    }

    fn pose(&self, angle_rad: f64, lean: f64) -> Rigid {
        self.fork.flap.frame(angle_rad).base_from_flap().then(&self.astride.flap_from_tool(lean))
    }

    fn at(&self, angle_rad: f64) -> Moment {
        self.fork.before.pushing(self.fork.number, angle_rad)
    }

    fn clearance_m(&self) -> f64 {
        self.fork.settings.clearance_m + self.fork.settings.search_margin_m
    }
}

#[cfg(test)]
mod tests {
    use super::super::flap::Standing;
    use super::super::reason::Obstacle;
    use super::*;
    use crate::geometry::Vec3;

    const VIPER: &str = include_str!("../../../src/boxwright/robots/data/viper_s850.toml");

    /// Lets the arm be everywhere but near one posture, which it may not come to.
    #[derive(Clone)]
    struct Around(Option<JointPositions>);

    impl Guard for Around {
        fn conflict(&self, positions_rad: &[f64], _: &Moment, _: f64) -> Option<Obstacle> {
            let kept = self.0?;
            let is_near = positions_rad.iter().zip(kept.iter()).all(|(a, b)| (a - b).abs() < 0.2);
            is_near.then_some(Obstacle::Something)
        }

        fn tool_conflict(&self, _: &Rigid, _: &Moment, _: f64) -> Option<Obstacle> {
            None
        }

        fn with_opening(&self, _: f64) -> Self {
            self.clone()
        }
    }

    /// The way that was found and where the flap rests after it, the flap, and after how many motions the arm was caught.
    fn planned(arm: &Arm, kept: Option<JointPositions>) -> (Option<(PushMotion, f64)>, Flap, usize) {
        planned_on(arm, kept, (0.08, 100.0), None)
    }

    fn planned_on(
        arm: &Arm,
        kept: Option<JointPositions>,
        (length_m, at_degrees): (f64, f64),
        stand: Option<&Stand>,
    ) -> (Option<(PushMotion, f64)>, Flap, usize) {
        let flap = Flap {
            name: "flap_0".into(),
            side: "side_0".into(),
            standing: Standing::Seen,
            hinge: Vec3::new(0.4, 0.1, 0.15),
            axis: -Vec3::y(),
            inward: Vec3::x(),
            outline: [[0.0, 0.0], [0.2, 0.0], [0.2, length_m], [0.0, length_m]],
            tucks: Vec::new(),
            position_rad: at_degrees.to_radians(),
        };
        let fork = Fork {
            arm,
            guard: &Around(kept),
            settings: &PlanningSettings::default(),
            flap: &flap,
            number: 0,
            thickness_m: 0.003,
            fold: Fold { crease_n_m: 0.1, weight_n_m: 0.0, return_rad: RETURN_RAD },
            stand,
            before: &Moment::resting(&[flap.position_rad]),
            until_rad: UNTIL_RAD,
            caught: Cell::new(0),
        };
        let (found, caught) = (fork.plan(), fork.caught.get());
        (found, flap, caught)
    }

    const RETURN_RAD: f64 = 0.1;
    const UNTIL_RAD: f64 = 1.08;

    #[test]
    fn fingers_go_back_with_the_flap_and_leave_it_flat_where_it_rests() {
        let arm = Arm::from_toml(VIPER).unwrap();
        let (found, flap, _) = planned(&arm, None);
        let (motion, rest_rad) = found.unwrap();
        let least_rad = motion.hinge_rad.iter().copied().fold(f64::INFINITY, f64::min);
        assert!(least_rad <= UNTIL_RAD, "{least_rad}");
        assert!((rest_rad - least_rad - RETURN_RAD).abs() < 0.03, "{rest_rad} after {least_rad}");
        let (last, end_rad) = (motion.push[motion.push.len() - 1], motion.hinge_rad[motion.hinge_rad.len() - 1]);
        assert!((end_rad - rest_rad).abs() < 1e-9, "{end_rad}");
        let base_from_tool = arm.forward(&last);
        let pointing = Vec3::from(base_from_tool.rotation.column(2));
        let off_board = pointing.dot(&flap.frame(rest_rad).outward);
        assert!(off_board.abs() < 1e-6, "{off_board}");
    }

    #[test]
    fn an_arm_that_is_caught_again_and_again_is_not_tried_at_every_place() {
        let arm = Arm::from_toml(VIPER).unwrap();
        let asked = [(None, true, 0), (Some(arm.ready), false, MOST_CAUGHT_IN_ALL + 1)];
        let counted = asked.map(|(kept, is_found, times)| {
            let (found, _, caught) = planned(&arm, kept);
            assert_eq!((found.is_some(), caught), (is_found, times));
        });
        assert_eq!(counted.len(), 2);
    }

    #[test]
    fn fingers_hold_a_light_box_by_their_friction_where_a_couple_does_not_tip_it() {
        let arm = Arm::from_toml(VIPER).unwrap();
        let base = [[0.4, -0.1], [0.6, -0.1], [0.6, 0.1], [0.4, 0.1]].map(|[x, y]| Vec3::new(x, y, 0.0));
        // Too short for fingers over its ends. 0.1 N m tip 2 N half as much as they bear; with 18 mm between tip and edge 1.2 N are
        // pressed along the board, which slide 2 N.
        let asked = [(10.0, true), (2.0, true), (0.5, false)].map(|(weight_n, expected)| {
            let stand = Stand::on(&base, Vec3::z(), weight_n, 0.4);
            let (found, ..) = planned_on(&arm, None, (0.026, 150.0), Some(&stand));
            assert_eq!(found.is_some(), expected, "{weight_n} N");
        });
        assert_eq!(asked.len(), 3);
    }
}
