//! The open fingers astride a flap's board: where they are on it, how they lean, and how wide they are open.

use nalgebra::Matrix3;

use super::flap::Flap;
use super::load::DRAG_SHARE;
use super::settings::ForkSettings;
use crate::arm::{Arm, Shape};
use crate::collision::{signed_distance_m, OrientedBox, Solid};
use crate::geometry::rigid::{turn, Rigid};
use crate::geometry::Vec3;

/// A place of the fingers on a flap, in its frame. They come to it flat, then lean ahead of the flap as it closes, until the outer finger
/// pushes from outside near the free edge, and the inner one holds against it nearer to the hinge.
#[derive(Debug, Clone, Copy)]
pub struct Astride {
    /// flap_from_tool's rotation where it does not lean.
    flat: Matrix3<f64>,
    /// It leans by the right hand about this.
    axis: Vec3,
    pub lean_rad: f64,
    /// Where the tool's axis passes through the middle of the board, and from there to the tool point.
    pub pivot: Vec3,
    tip_m: f64,
    pub opening_m: f64,
    /// How far the flap turns between the fingers.
    pub slack_rad: f64,
    /// How much of the couple turns the box about what is square to its hinge in the board, for each of what turns the flap.
    pub twist: f64,
    /// The force along the board, towards the hinge, for each unit of the couple (1/m): the outer finger presses on the board's edge
    /// along its own side's normal, which leans.
    pub aside_per_m: f64,
    /// What friction under both fingers bears of that.
    pub borne_per_m: f64,
}

/// All of them, the likeliest first.
pub fn all_astride(arm: &Arm, flap: &Flap, thickness_m: f64, settings: &ForkSettings) -> Vec<Astride> {
    let one_sided = |found: Vec<Astride>| {
        let flipped = found.into_iter().flat_map(|astride| [astride, astride.flipped()]);
        let open = flipped.filter_map(|astride| astride.opened(arm, flap, thickness_m, settings.gap_m));
        open.collect::<Vec<_>>()
    };
    if !flap.tucks.is_empty() {
        return one_sided(over_ends(arm, flap, settings.beside_tuck_m, settings));
    }
    let deep = |is_straight: bool| {
        let yaws = settings.yaws_rad.iter().filter(move |yaw_rad| (**yaw_rad == 0.0) == is_straight);
        yaws.flat_map(|&yaw_rad| over_edge(flap, yaw_rad, &settings.depths, settings)).collect::<Vec<_>>()
    };
    let yaws = settings.yaws_rad.iter();
    let shallow = yaws.flat_map(|&yaw_rad| over_edge(flap, yaw_rad, &[settings.shallow], settings)).collect();
    let over_ends = over_ends(arm, flap, settings.edge_m, settings);
    let steep = settings.steep_yaws_rad.iter();
    let steep = steep.flat_map(|&yaw_rad| over_edge(flap, yaw_rad, &settings.depths, settings)).collect();
    [deep(true), over_ends, deep(false), shallow, steep].into_iter().flat_map(one_sided).collect()
}

/// Over the free edge, the tool's axis turned in the board by `yaw_rad` from straight to the hinge.
fn over_edge(flap: &Flap, yaw_rad: f64, depths: &[f64], settings: &ForkSettings) -> Vec<Astride> {
    let toward = Vec3::new(yaw_rad.sin(), -yaw_rad.cos(), 0.0);
    let mut found = Vec::new();
    let reach_m = (flap.length_m() - settings.least_tip_m) / yaw_rad.cos();
    for depth_m in depths.iter().map(|share| reach_m.min(settings.most_depth_m) * share) {
        if depth_m < settings.least_depth_m {
            continue;
        }
        for &lean_rad in &settings.leans_rad {
            let away_m = flap.length_m() - depth_m / 2.0 * yaw_rad.cos();
            found.extend(places(flap, settings).into_iter().map(|along_m| Astride {
                flat: Matrix3::from_columns(&[Vec3::z().cross(&toward), Vec3::z(), toward]),
                axis: Vec3::z().cross(&toward) * -1.0,
                lean_rad,
                pivot: Vec3::new(along_m, away_m, 0.0),
                tip_m: depth_m / 2.0,
                opening_m: 0.0,
                slack_rad: 2.0 * settings.gap_m / depth_m,
                twist: yaw_rad.tan(),
                aside_per_m: lean_rad.tan() / (depth_m * yaw_rad.cos().powi(2)),
                borne_per_m: 2.0 * DRAG_SHARE / (depth_m * yaw_rad.cos()),
            }));
        }
    }
    found
}

/// Over an end of the flap, the tool's axis along the hinge: across the fingers' width.
fn over_ends(arm: &Arm, flap: &Flap, edge_m: f64, settings: &ForkSettings) -> Vec<Astride> {
    let half_width_m = arm.gripper.finger_size_m.x / 2.0;
    let depth_m = 2.0 * half_width_m;
    let away_m = (flap.length_m() - half_width_m - edge_m).max(settings.least_tip_m + half_width_m);
    if away_m + half_width_m > flap.length_m() {
        return Vec::new();
    }
    let mut found = Vec::new();
    let reaches_m = settings.depths.map(|share| settings.most_depth_m * share);
    for reach_m in reaches_m.into_iter().filter(|reach_m| *reach_m >= settings.least_depth_m) {
        for &lean_rad in &settings.leans_rad {
            found.extend([1.0, -1.0].map(|side| {
                let toward = Vec3::x() * side;
                let end_m = flap.edge_m()[usize::from(side < 0.0)];
                Astride {
                    flat: Matrix3::from_columns(&[Vec3::z().cross(&toward), Vec3::z(), toward]),
                    axis: -Vec3::x(),
                    lean_rad,
                    pivot: Vec3::new(end_m + side * reach_m / 2.0, away_m, 0.0),
                    tip_m: reach_m / 2.0,
                    opening_m: 0.0,
                    slack_rad: 2.0 * settings.gap_m / depth_m,
                    twist: 0.0,
                    // Both fingers press on the board's faces.
                    aside_per_m: 0.0,
                    borne_per_m: 0.0,
                }
            }));
        }
    }
    found
}

/// Along the free edge, its middle first.
fn places(flap: &Flap, settings: &ForkSettings) -> Vec<f64> {
    let [low, high] = flap.edge_m();
    let (middle_m, half_m) = ((low + high) / 2.0, (high - low) / 2.0 - settings.inset_m);
    let count = settings.places as i32;
    let steps = (1..=count).flat_map(|k| [k, -k]).map(|k| f64::from(k) / f64::from(count));
    let shares = std::iter::once(0.0).chain(steps.filter(|_| half_m > 0.0));
    shares.map(|share| middle_m + share * half_m).collect()
}

impl Astride {
    /// flap_from_tool where it leans by a share of what it leans in the end.
    pub fn flap_from_tool(&self, share: f64) -> Rigid {
        let rotation = turn(&self.axis, share * self.lean_rad) * self.flat;
        Rigid::new(rotation, self.pivot + Vec3::from(rotation.column(2)) * self.tip_m)
    }

    /// With the other finger outside.
    fn flipped(self) -> Self {
        let half_turn = Matrix3::from_diagonal(&Vec3::new(-1.0, -1.0, 1.0));
        Self { flat: self.flat * half_turn, ..self }
    }

    /// Opened as far as leaves a gap between the board and each finger where they lean, and moved off the middle of the board by what
    /// their unlike touches take: an edge before a face, a corner on one. None where the gripper does not open so far.
    fn opened(self, arm: &Arm, flap: &Flap, thickness_m: f64, gap_m: f64) -> Option<Self> {
        let board = Solid::Box(OrientedBox::of_panel(&flap.corners(0.0), thickness_m)?);
        let base_from_flap = flap.frame(0.0).base_from_flap();
        let tool_from_flange = arm.gripper.flange_from_tool().inverse();
        let gaps_m = |astride: &Self| {
            let base_from_flange = base_from_flap.then(&astride.flap_from_tool(1.0)).then(&tool_from_flange);
            arm.gripper.fingers(astride.opening_m).map(|finger| match finger {
                Shape::Box { body_from_box, half_m } => {
                    let placed = OrientedBox::new(base_from_flange.then(&body_from_box), half_m);
                    signed_distance_m(&Solid::Box(placed), &board)
                }
                Shape::Capsule { .. } => gap_m,
            })
        };
        let [low_m, high_m] = arm.gripper.opening_m;
        // The first finger is outside, or the other.
        let side = self.flat[(2, 1)].signum();
        let mut found = Self { opening_m: high_m, ..self };
        for _ in 0..STEPS {
            let [first_m, other_m] = gaps_m(&found);
            found.opening_m = (found.opening_m - (first_m + other_m - 2.0 * gap_m)).clamp(low_m, high_m);
            found.pivot.z += side * (other_m - first_m) / 2.0;
        }
        gaps_m(&found).iter().all(|found_m| *found_m >= gap_m - ROUNDING_M).then_some(found)
    }
}

/// Each takes off nine tenths or more of what the gaps are off.
const STEPS: usize = 8;
const ROUNDING_M: f64 = 1e-6;

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::super::problem::MeasuredBox;
    use super::*;

    const VIPER: &str = include_str!("../../../src/boxwright/robots/data/viper_s850.toml");
    const THICKNESS_M: f64 = 0.004;

    /// A flap that stands upright on a hinge of 0.2 m.
    fn flap(length_m: f64) -> Flap {
        let told = json!({
            "thickness_m": THICKNESS_M, "fixed": [], "support": null,
            "flaps": [{
                "name": "flap_0", "side": "side_0", "standing": "seen", "origin": [0.1, 0.0, 0.2], "axis": [1.0, 0.0, 0.0],
                "position_rad": std::f64::consts::FRAC_PI_2,
                "corners": [[0.0, 0.0, 0.2], [0.2, 0.0, 0.2], [0.2, 0.0, 0.2 + length_m], [0.0, 0.0, 0.2 + length_m]],
            }],
        });
        let problem = serde_json::from_value::<MeasuredBox>(told).unwrap().into_problem().unwrap();
        problem.flaps.into_iter().next().unwrap()
    }

    /// How far each finger is from the board.
    fn fingers(arm: &Arm, flap: &Flap, astride: &Astride, share: f64) -> Vec<f64> {
        let board = Solid::Box(OrientedBox::of_panel(&flap.corners(0.0), THICKNESS_M).unwrap());
        let base_from_tool = flap.frame(0.0).base_from_flap().then(&astride.flap_from_tool(share));
        let base_from_flange = base_from_tool.then(&arm.gripper.flange_from_tool().inverse());
        let gaps = arm.gripper.fingers(astride.opening_m).map(|finger| match finger {
            Shape::Box { body_from_box, half_m } => {
                let placed = OrientedBox::new(base_from_flange.then(&body_from_box), half_m);
                signed_distance_m(&Solid::Box(placed), &board)
            }
            Shape::Capsule { .. } => panic!("fingers are boxes"),
        });
        gaps.to_vec()
    }

    #[test]
    fn fingers_come_flat_with_room_and_lean_until_both_nearly_touch() {
        let (arm, settings) = (Arm::from_toml(VIPER).unwrap(), ForkSettings::default());
        let (mut counted, mut aside) = ([0; 3], 0);
        for (k, length_m) in [0.026, 0.06, 0.15].into_iter().enumerate() {
            let flap = flap(length_m);
            for astride in all_astride(&arm, &flap, THICKNESS_M, &settings) {
                let (flat, leaning) = (fingers(&arm, &flap, &astride, 0.0), fingers(&arm, &flap, &astride, 1.0));
                for (before_m, gap_m) in flat.iter().zip(&leaning) {
                    assert!(*before_m > *gap_m && *gap_m >= settings.gap_m - ROUNDING_M, "{before_m} {gap_m}");
                }
                let least_m = leaning.iter().copied().fold(f64::INFINITY, f64::min);
                let most_m = leaning.iter().copied().fold(0.0, f64::max);
                assert!(
                    (least_m - settings.gap_m).abs() < 2e-6 && (most_m - settings.gap_m).abs() < 2e-6,
                    "{least_m} {most_m}"
                );
                // Half way between hinge and free edge, or nearer to the edge.
                assert!(astride.pivot.y > length_m / 2.0 && astride.pivot.y < length_m);
                // Over the free edge the outer finger presses on the board's edge, over an end on its face.
                let toward = astride.flat.column(2).y;
                let couple_m = 2.0 * astride.tip_m * -toward;
                let expected = if toward < -0.5 { astride.lean_rad.tan() / -toward / couple_m } else { 0.0 };
                let borne = if toward < -0.5 { 0.6 / couple_m } else { 0.0 };
                assert!((astride.borne_per_m - borne).abs() < 1e-9, "{toward}: {}", astride.borne_per_m);
                assert!((astride.aside_per_m - expected).abs() < 1e-9, "{toward}: {}", astride.aside_per_m);
                aside += usize::from(expected > 0.0);
                counted[k] += 1;
            }
        }
        assert!(aside > 100, "{aside}");
        assert!(counted[0] > 50 && counted[1] > 100 && counted[2] > 100, "{counted:?}");
    }

    #[test]
    fn fingers_come_over_an_end_of_a_flap_with_a_tuck_and_stay_off_that() {
        let (arm, settings) = (Arm::from_toml(VIPER).unwrap(), ForkSettings::default());
        let mut lid = flap(0.15);
        let (near, far) = (0.15, 0.2);
        let tuck = [[0.0, near], [0.2, near], [0.2, far], [0.0, far]].map(|[x, y]| Vec3::new(x, y, 0.0));
        lid.tucks.push(("tuck_0".into(), tuck));
        let half_width_m = arm.gripper.finger_size_m.x / 2.0;
        let all = all_astride(&arm, &lid, THICKNESS_M, &settings);
        for astride in &all {
            assert!(astride.flat.column(2).y.abs() < 1e-9);
            assert!(astride.pivot.y + half_width_m <= 0.15 - settings.beside_tuck_m + 1e-9, "{}", astride.pivot.y);
        }
        assert!(all.len() >= 12, "{}", all.len());
    }
}
