//! How a finger may touch a flap: places on its outer face, tool orientations, and what is good about them.

use nalgebra::{Matrix3, UnitQuaternion};

use super::flap::{Flap, FlapFrame};
use super::load::{Fold, Stand, DRAG_SHARE};
use super::orientations::OrientationGrid;
use super::settings::PlanningSettings;
use super::touch::{flap_from_tool, Finger, TurnedFinger};
use crate::geometry::{Rigid, Vec3};

/// A tool pose in which the finger touches the flap, and what speaks against it.
#[derive(Debug, Clone, Copy)]
pub struct Grip {
    pub base_from_tool: Rigid,
    /// The point of touch, base frame.
    pub contact: Vec3,
    /// The share of what moves the box that the push is (eq. 97).
    pub strain: f64,
    /// Eq. 85: 0 for a push on the middle of the free edge, square to the face; grows as the lever shortens and the tool leans.
    pub penalty: f64,
}

/// A finger's orientation before a flap at some angle.
pub struct Turned {
    base_from_tool: Matrix3<f64>,
    finger: TurnedFinger,
    /// The cosine between the tool's axis and the push direction.
    into_face: f64,
    /// What turns the flap inward at that angle; 0 where it falls by itself.
    closing_n_m: f64,
}

/// The contacts of one flap with one finger.
pub struct Contacts<'a> {
    pub flap: &'a Flap,
    pub finger: Finger,
    pub half_board_m: f64,
    pub settings: &'a PlanningSettings,
    pub fold: Fold,
    pub stand: Option<&'a Stand>,
    pub grid: &'static OrientationGrid,
    /// Tool points over the flap's plane, along the hinge and away from it.
    pub along_m: Vec<f64>,
    pub away_m: Vec<f64>,
    closed_from_base: UnitQuaternion<f64>,
}

impl<'a> Contacts<'a> {
    pub fn new(
        flap: &'a Flap,
        finger: Finger,
        half_board_m: f64,
        settings: &'a PlanningSettings,
        (fold, stand): (Fold, Option<&'a Stand>),
        grid: &'static OrientationGrid,
    ) -> Self {
        let inset = settings.contact_inset_m;
        let [most_along, most_away] = settings.most_contacts;
        let least_away = settings.least_lever * flap.length_m();
        let frame = flap.frame(0.0).base_from_flap();
        let rotation = nalgebra::Rotation3::from_matrix_unchecked(frame.rotation);
        Self {
            flap,
            finger,
            half_board_m,
            settings,
            fold,
            stand,
            grid,
            along_m: spread(inset, flap.hinge_length_m() - inset, settings.contact_step_m, most_along),
            away_m: spread(least_away, flap.length_m() + settings.contact_beyond_m, settings.contact_step_m, most_away),
            closed_from_base: UnitQuaternion::from_rotation_matrix(&rotation),
        }
    }

    /// The same with other settings and all orientations.
    pub fn finer<'b>(&self, settings: &'b PlanningSettings) -> Contacts<'b>
    where
        'a: 'b,
    {
        let grid = OrientationGrid::fine();
        Contacts::new(self.flap, self.finger, self.half_board_m, settings, (self.fold, self.stand), grid)
    }

    /// base_from_tool's rotation of an orientation of the grid.
    pub fn rotation(&self, orientation: usize) -> UnitQuaternion<f64> {
        self.closed_from_base * self.grid.rotations[orientation]
    }

    /// The tool pose at which a finger so turned, over the place `at` of the flap's plane, touches the flap at an angle. None where
    /// it misses the flap or holds it badly: too near its hinge, too near its own tip or end, or leaning too far over.
    pub fn grip(&self, frame: &FlapFrame, at: [f64; 2], base_from_tool: &UnitQuaternion<f64>) -> Option<Grip> {
        self.grip_turned(frame, at, &self.turned(frame, base_from_tool)?)
    }

    /// A finger so turned before a flap; None where it leans too far over.
    pub fn turned(&self, frame: &FlapFrame, base_from_tool: &UnitQuaternion<f64>) -> Option<Turned> {
        let base_from_tool = base_from_tool.to_rotation_matrix().into_inner();
        let finger = TurnedFinger::new(self.finger, flap_from_tool(frame, &base_from_tool));
        let into_face = -finger.flap_from_tool[(2, 2)];
        let cos = frame.away.dot(&self.flap.inward).clamp(-1.0, 1.0);
        let closing_n_m = self.fold.closing_n_m(cos.acos()).max(0.0);
        (into_face >= -self.settings.most_lean).then_some(Turned { base_from_tool, finger, into_face, closing_n_m })
    }

    /// As [`Contacts::grip`], of a finger that is turned already.
    pub fn grip_turned(&self, frame: &FlapFrame, at: [f64; 2], turned: &Turned) -> Option<Grip> {
        let Turned { base_from_tool, finger, into_face, closing_n_m } = turned;
        let touch = finger.touch(&self.flap.outline, self.half_board_m, at)?;
        let lever = touch.contact[1] / self.flap.length_m();
        let tool = Vec3::new(at[0], at[1], touch.tool_outward_m + self.settings.touch_gap_m);
        let contact = Vec3::new(touch.contact[0], touch.contact[1], self.half_board_m);
        let from_tip_m = (tool - contact).dot(&finger.flap_from_tool.column(2));
        let hooks = *into_face < 0.0;
        let held = from_tip_m >= self.settings.least_hook_m && from_tip_m <= self.finger.length_m - 0.01;
        let square = touch.normal.z;
        if lever < self.settings.least_lever || square < self.settings.least_square || (hooks && !held) {
            return None;
        }
        let aside = (touch.contact[0] / self.flap.hinge_length_m() - 0.5).abs();
        let contact = frame.at(contact.x, contact.y, contact.z);
        let push = |normal: &Vec3| self.strain(frame, closing_n_m / (touch.contact[1] * normal.z), &contact, normal);
        let strain = push(&touch.normal);
        let dragging = dragged(&touch.normal).map_or(strain, |normal| push(&normal));
        let penalty = (1.0 - lever).max(0.0)
            + 0.6 * aside
            + (0.7 - into_face).max(0.0).powi(2)
            + (-into_face).max(0.0)
            + SLANT_WEIGHT * (1.0 - square)
            + STRAIN_WEIGHT * dragging.powi(2);
        Some(Grip {
            base_from_tool: Rigid::new(*base_from_tool, frame.at(tool.x, tool.y, tool.z)),
            contact,
            strain,
            penalty,
        })
    }

    /// Of a push against a direction; of what it presses aside nothing turns the flap.
    fn strain(&self, frame: &FlapFrame, push_n: f64, contact: &Vec3, normal: &Vec3) -> f64 {
        let Some(stand) = self.stand else { return 0.0 };
        let pressed = frame.along * normal.x + frame.away * normal.y + frame.outward * normal.z;
        stand.strain(contact, &(pressed * -push_n)).max(0.0)
    }
}

/// A touch's normal with the drag of a finger that slips on an edge: the further the way that its side leans already. None where it
/// does not lean.
fn dragged(normal: &Vec3) -> Option<Vec3> {
    let aside = Vec3::new(normal.x, normal.y, 0.0);
    let lean = aside.norm();
    if lean < LEAST_LEAN {
        return None;
    }
    Some(normal + (aside * (normal.z / lean) - Vec3::z() * lean) * DRAG_SHARE)
}

/// The sine of a lean that is none.
const LEAST_LEAN: f64 = 0.05;

/// What the strain squared counts in eq. 85.
const STRAIN_WEIGHT: f64 = 1.5;
/// What a push that slants off the face's normal counts, by one less the cosine.
const SLANT_WEIGHT: f64 = 1.0;

/// Values from low to high a step apart, at most so many, both ends among them; the middle alone where they pass each other.
fn spread(low: f64, high: f64, step: f64, most: usize) -> Vec<f64> {
    if high <= low {
        return vec![(low + high) / 2.0];
    }
    let count = (((high - low) / step).ceil() as usize + 1).clamp(2, most);
    (0..count).map(|k| low + (high - low) * k as f64 / (count - 1) as f64).collect()
}
