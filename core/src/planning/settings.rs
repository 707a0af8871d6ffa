use serde::Deserialize;

use super::load::Assumed;

/// What the planner takes for granted; every default of it is here and nowhere else. Metres, radians, seconds.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PlanningSettings {
    /// Kept to everything but the flap that is pushed.
    pub clearance_m: f64,
    /// By how much more is kept while searching, so that what lies between samples keeps the clearance too.
    pub search_margin_m: f64,
    /// By how much more yet, each time that it did not.
    pub wider_m: f64,
    /// A flap within this of 0 is closed.
    pub closed_rad: f64,
    /// A flap below this lies more than it stands: others come down on it, and it gives way.
    pub lying_rad: f64,
    /// Where a flap is to rest when it has sprung back: it is pushed beyond closed by what its crease gives back less this, at most
    /// by so much (a flap below -15 degrees counts as pushed in).
    pub rest_aim_rad: f64,
    pub most_overclose_rad: f64,
    /// Short of closed ends the push of a flap that comes to lie on others or carries a tuck (its edge may lie near the hinge of one
    /// below, which would be pushed in by many times as much), and of one that would come to lie on the rims beside it.
    pub short_on_others_rad: f64,
    pub short_on_rims_rad: f64,
    /// The same where flaps across from one another overlap: boards lie on boards, and the upper one's edge is near the lower's hinge.
    pub short_on_stacks_rad: f64,
    /// What cannot be pushed so far is let go where it still comes to rest closed, if that is as far from closed as this.
    pub least_lay_rad: f64,
    /// A flap that others prop up higher than this is left open, and one that would spring back from there to more than the second:
    /// up to 30 degrees a flap that lies on closed ones counts as closed.
    pub most_propped_rad: f64,
    pub most_propped_rest_rad: f64,
    /// Boards that come nearer to a flap than this on their way down are taken to stop it.
    pub rim_gap_m: f64,
    /// What is taken for granted of folds and weight, and the greatest share of what moves the box that a push may be. A flap below
    /// this angle closes even if the box slides a little: where nothing else closes it, it is pushed all the same, after the others;
    /// any other is then pushed up to what moves the box.
    pub assumed: Assumed,
    pub most_strain: f64,
    pub slides_home_rad: f64,
    /// How far below a flap that is pushed onto others those are taken to give way.
    pub under_rad: f64,
    pub fork: ForkSettings,
    /// Between two layers of the search, at most.
    pub layer_rad: f64,
    /// Between two samples of a push, at most.
    pub sample_rad: f64,
    /// States kept in each layer: a first try, one among finer contacts where it fails, and one for what all else leaves open.
    pub beams: Vec<usize>,
    /// Between contacts along and across a flap, and how many of them at most.
    pub contact_step_m: f64,
    pub most_contacts: [usize; 2],
    /// Tool points keep this from the flap's lateral ends, reach this far beyond its free edge (short of it where below 0), and keep this share of its length from
    /// the hinge.
    pub contact_inset_m: f64,
    pub contact_beyond_m: f64,
    pub least_lever: f64,
    /// What replaces these where a first search led nowhere.
    pub fine_contacts: FineContacts,
    /// The same for what all else leaves open: as fine, closer together; then as fine, but pressed less squarely.
    pub finest_step_m: f64,
    pub most_finest_contacts: [usize; 2],
    pub slanting_square: f64,
    /// The finger is planned this far off the face, so that it is not in the board between two samples.
    pub touch_gap_m: f64,
    /// How far the tool's axis may lean back over the flap's edge, as the sine.
    pub most_lean: f64,
    /// From the tip to where a hooked edge may lie on the finger, at the least.
    pub least_hook_m: f64,
    /// The least cosine between where the finger presses and the face's normal: with less it slips off the edge that it holds.
    pub least_square: f64,
    /// How far a joint may turn from one layer to the next, and from one sample to the next.
    pub most_turn_rad: f64,
    pub most_sample_turn_rad: f64,
    /// The tool stands off a flap by this before it touches it, then leaves by up to this.
    pub stand_off_m: f64,
    pub withdraw_m: f64,
    /// Where there is no room for that it slides off, at most so far.
    pub slide_off_m: f64,
    /// Between two samples of a straight line of the tool.
    pub line_step_m: f64,
    /// Between two checked postures of a motion of the joints: the widest turn of any joint.
    pub joint_step_rad: f64,
    /// Tries of the search for a way between two flaps, and the seed of its draws.
    pub transit_tries: usize,
    pub transit_seed: u64,
    pub shortcuts: usize,
    /// Shares of the joints' speeds and accelerations that are used in free space, and near or on a flap.
    pub free_share: f64,
    pub contact_share: f64,
    /// How fast a flap is turned, and how fast the point of touch moves, at most.
    pub hinge_rad_per_s: f64,
    pub contact_m_per_s: f64,
    /// Between two samples of the motion, and between two moments at which the whole of it is checked again.
    pub period_s: f64,
    pub check_s: f64,
}

/// Contacts closer together and nearer to what slips off: dearer, and for flaps that cannot be held better.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FineContacts {
    pub contact_step_m: f64,
    pub most_contacts: [usize; 2],
    /// The finger may stand over an end of the flap, or over its free edge, as far as it presses on it squarely enough.
    pub contact_inset_m: f64,
    pub contact_beyond_m: f64,
    /// Near the hinge, too, as far as the box bears what a push takes there; and hooked with the very tip.
    pub least_lever: f64,
    pub most_lean: f64,
    pub least_hook_m: f64,
}

/// How the open fingers go astride a flap that a push cannot turn without moving the box.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ForkSettings {
    /// Flaps whose push would be a greater share of what moves the box are turned so first; others where a push alone does not do.
    pub least_strain: f64,
    /// Each finger is planned this far off the board.
    pub gap_m: f64,
    /// How far the tips reach in from the free edge: at most so far and so near to the hinge, and shares of that, but never less.
    pub most_depth_m: f64,
    pub least_tip_m: f64,
    pub least_depth_m: f64,
    pub depths: [f64; 2],
    /// Where no other place does, not so deep: a flap that hangs near its side has no room for a finger behind it but at its edge.
    pub shallow: f64,
    /// By how much the tool leans ahead of the flap, and turns in its plane.
    pub leans_rad: Vec<f64>,
    pub yaws_rad: Vec<f64>,
    /// Where all else fails it turns as far as this.
    pub steep_yaws_rad: Vec<f64>,
    /// Where there is no room to come to the flap with the fingers flat, they lean by this share of it already.
    pub lean_in: f64,
    /// From the free edge's ends to the tool's middle, and how many places to either side of its middle.
    pub inset_m: f64,
    pub places: usize,
    /// From the free edge to fingers that come over an end of the flap, where it is long enough.
    pub edge_m: f64,
    /// The flap is turned down to the first, at the least to the second; a push goes on from where it springs back to.
    pub wanted_rad: f64,
    pub far_enough_rad: f64,
    /// A flap whose free edge would come down faster than this by itself is let down between the fingers as far as they follow it, to
    /// this angle at the most, and at the least to where it falls at this share of that.
    pub most_fall_m_per_s: f64,
    pub let_down_rad: f64,
    pub slower_fall: f64,
    /// So far from the free edge stay fingers over an end of a flap that a tuck hangs on.
    pub beside_tuck_m: f64,
    /// Where that is not reached at once it is turned in so many stages, each at the least so far.
    pub most_stages: usize,
    pub least_part_rad: f64,
}

impl Default for ForkSettings {
    fn default() -> Self {
        let degrees = |values: &[f64]| values.iter().map(|value| value.to_radians()).collect();
        Self {
            least_strain: 0.6,
            gap_m: 0.0001,
            most_depth_m: 0.05,
            least_tip_m: 0.008,
            least_depth_m: 0.010,
            depths: [1.0, 0.6],
            shallow: 0.4,
            leans_rad: degrees(&[20.0, 32.0, 12.0]),
            yaws_rad: degrees(&[0.0, 25.0, -25.0]),
            steep_yaws_rad: degrees(&[50.0, -50.0]),
            lean_in: 0.7,
            inset_m: 0.015,
            places: 2,
            edge_m: 0.005,
            wanted_rad: 40f64.to_radians(),
            far_enough_rad: 62f64.to_radians(),
            most_fall_m_per_s: 1.9,
            let_down_rad: 10f64.to_radians(),
            slower_fall: 0.9,
            beside_tuck_m: 0.02,
            most_stages: 2,
            least_part_rad: 30f64.to_radians(),
        }
    }
}

impl Default for FineContacts {
    fn default() -> Self {
        Self {
            contact_step_m: 0.02,
            most_contacts: [13, 9],
            contact_inset_m: -0.008,
            contact_beyond_m: 0.006,
            least_lever: 0.06,
            most_lean: 0.99,
            least_hook_m: 0.003,
        }
    }
}

impl PlanningSettings {
    /// With the fine contacts in the place of the others.
    pub fn with_fine_contacts(&self) -> Self {
        let fine = &self.fine_contacts;
        Self {
            contact_step_m: fine.contact_step_m,
            most_contacts: fine.most_contacts,
            contact_inset_m: fine.contact_inset_m,
            contact_beyond_m: fine.contact_beyond_m,
            least_lever: fine.least_lever,
            most_lean: fine.most_lean,
            least_hook_m: fine.least_hook_m,
            ..self.clone()
        }
    }

    /// With the contacts of each search but the first, one after the other; more searches than that have those of the last.
    pub fn with_finer_contacts(&self) -> [Self; 3] {
        let fine = self.with_fine_contacts();
        let (step_m, most) = (self.finest_step_m, self.most_finest_contacts);
        let finest = Self { contact_step_m: step_m, most_contacts: most, ..fine.clone() };
        let slanting = Self { least_square: self.slanting_square, ..fine.clone() };
        [fine, finest, slanting]
    }
}

impl Default for PlanningSettings {
    fn default() -> Self {
        Self {
            clearance_m: 0.005,
            search_margin_m: 0.0005,
            wider_m: 0.001,
            closed_rad: 15f64.to_radians(),
            lying_rad: 25f64.to_radians(),
            rest_aim_rad: 3f64.to_radians(),
            most_overclose_rad: 13f64.to_radians(),
            short_on_others_rad: 0.3f64.to_radians(),
            short_on_rims_rad: 0.5f64.to_radians(),
            short_on_stacks_rad: 2.5f64.to_radians(),
            least_lay_rad: 2f64.to_radians(),
            most_propped_rad: 20f64.to_radians(),
            most_propped_rest_rad: 28f64.to_radians(),
            rim_gap_m: 0.0003,
            assumed: Assumed::default(),
            most_strain: 0.85,
            slides_home_rad: 80f64.to_radians(),
            under_rad: 4f64.to_radians(),
            fork: ForkSettings::default(),
            layer_rad: 8f64.to_radians(),
            sample_rad: 1f64.to_radians(),
            beams: vec![16, 50, 100, 50],
            contact_step_m: 0.04,
            most_contacts: [7, 5],
            contact_inset_m: 0.012,
            contact_beyond_m: -0.006,
            least_lever: 0.35,
            touch_gap_m: 0.0003,
            most_lean: 0.6,
            least_hook_m: 0.018,
            least_square: 0.6,
            fine_contacts: FineContacts::default(),
            finest_step_m: 0.012,
            most_finest_contacts: [21, 15],
            slanting_square: 0.3,
            most_turn_rad: 0.9,
            most_sample_turn_rad: 0.25,
            stand_off_m: 0.015,
            withdraw_m: 0.10,
            slide_off_m: 0.15,
            line_step_m: 0.005,
            joint_step_rad: 0.05,
            transit_tries: 1000,
            transit_seed: 0x2011,
            shortcuts: 60,
            free_share: 0.8,
            contact_share: 0.4,
            hinge_rad_per_s: 1.0,
            contact_m_per_s: 0.2,
            period_s: 0.01,
            check_s: 0.005,
        }
    }
}
