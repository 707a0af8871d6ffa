use nalgebra::Isometry3;

use super::block::{cauchy_ratio, Block};
use super::body::FittedBody;
use super::layout::{LENGTH, SHIFT, TURN, WIDTH};
use super::layout::{SLOT_BULGE, SLOT_COUNT, SLOT_FLAP, SLOT_TUCK};
use super::linearized::Linearized;
use super::other_view::OtherView;
use super::panel::Panel;
use super::priors::Prior;
use super::readings::PartReadings;
use super::roles::Role;
use super::row::Row;
use super::settings::FitSettings;
use crate::geometry::{Plane, Vec3};

/// What a box stands on, normal up: with its whole base, or, where something tilts it, over it with every corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Support {
    pub plane: Plane,
    pub is_level: bool,
}

/// Everything that a body is held against.
#[derive(Debug, Clone)]
pub struct Problem {
    pub parts: Vec<PartReadings>,
    /// Further views of the same body, whose places are known only so well.
    pub others: Vec<OtherView>,
    pub support: Option<Support>,
    pub priors: Vec<Prior>,
    pub settings: FitSettings,
}

/// The support says as much of boxes that would sink into it, however deep.
const FIRM: f64 = 100.0;

impl Problem {
    /// At `body`, residuals beyond `cut` standard deviations losing their say.
    pub fn linearize(&self, body: &FittedBody, cut: f64) -> Linearized {
        self.linearize_from(body, &vec![Isometry3::identity(); self.others.len()], cut)
    }

    /// The same, the motions of other views' readings found from these.
    pub fn linearize_from(&self, body: &FittedBody, motions: &[Isometry3<f64>], cut: f64) -> Linearized {
        let mut sums = Linearized::zeros();
        for part in &self.parts {
            add_part(&mut sums, part, body, None, cut);
        }
        for (view, start) in self.others.iter().zip(motions) {
            let motion = view.motion(body, start, cut);
            view.add_to(&mut sums, body, &motion, cut);
            sums.motions.push(motion);
        }
        self.add_support(&mut sums, body, cut);
        for prior in &self.priors {
            let (residual, terms) = prior.residual(&body.numbers);
            sums.cost += 0.5 * residual * residual;
            for (place, by) in terms {
                sums.gradient[place] += residual * by;
                for (other, by_other) in terms {
                    if other <= place {
                        sums.curvature[(place, other)] += by * by_other;
                    }
                }
            }
        }
        sums
    }

    fn add_support(&self, sums: &mut Linearized, body: &FittedBody, cut: f64) {
        let Some(support) = self.support else { return };
        let settings = &self.settings;
        let normal = body.input_from_object.inverse_transform_vector(&support.plane.normal);
        let mut block = Block::<SLOT_BULGE>::default();
        // A box may stand on something else, but in nothing.
        let height_cut = |height: &Row| if height.value < 0.0 { FIRM * cut } else { cut };
        if support.is_level {
            let height = height_row(&support.plane, &normal, body, [0.0, 0.0]);
            block.add(&height, settings.support_sigma_m, 1.0, height_cut(&height));
            for lean in lean_rows(&normal) {
                block.add(&lean, settings.support_sigma_rad, 1.0, cut);
            }
        } else {
            let corners = CORNERS.map(|corner| height_row(&support.plane, &normal, body, corner));
            for height in corners.iter().filter(|height| height.value < 0.0) {
                block.add(height, settings.support_sigma_m, 1.0, height_cut(height));
            }
        }
        block.scatter(sums, 0);
    }
}

/// Of the base, its rack left out, in shares of length and width.
const CORNERS: [[f64; 2]; 4] = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]];

/// Height over the support of a point of the base, whose normal in the object's frame is `normal`.
fn height_row(support: &Plane, normal: &Vec3, body: &FittedBody, [along, across]: [f64; 2]) -> Row {
    let point = Vec3::new(along * body.get(LENGTH), across * body.get(WIDTH), 0.0);
    let mut slots = [0.0; SLOT_COUNT];
    slots[SHIFT..SHIFT + 3].copy_from_slice(normal.as_slice());
    slots[TURN..TURN + 3].copy_from_slice(point.cross(normal).as_slice());
    (slots[LENGTH], slots[WIDTH]) = (along * normal.x, across * normal.y);
    Row { value: support.height_of(&body.to_input(&point)), slots }
}

/// Lean of the support in the object's frame, with its derivatives.
fn lean_rows(normal: &Vec3) -> [Row; 2] {
    let mut slots = [[0.0; SLOT_COUNT]; 2];
    // A turn t of the object turns the normal the other way: n x t.
    (slots[0][TURN + 1], slots[0][TURN + 2]) = (-normal.z, normal.y);
    (slots[1][TURN + 2], slots[1][TURN]) = (-normal.x, normal.z);
    [Row { value: normal.x, slots: slots[0] }, Row { value: normal.y, slots: slots[1] }]
}

/// Adds the readings of one part, moved in the object's frame by `motion` where there is one.
pub fn add_part(
    sums: &mut Linearized,
    part: &PartReadings,
    body: &FittedBody,
    motion: Option<&Isometry3<f64>>,
    cut: f64,
) {
    match part.role {
        Role::Base => add_rows::<SLOT_BULGE>(sums, part, body, motion, cut),
        Role::Side(_) => add_rows::<SLOT_FLAP>(sums, part, body, motion, cut),
        Role::Flap(_) => add_rows::<SLOT_TUCK>(sums, part, body, motion, cut),
        Role::Tuck(_) => add_rows::<SLOT_COUNT>(sums, part, body, motion, cut),
    }
}

/// Of a part that depends on the first `COUNT` slots alone.
fn add_rows<const COUNT: usize>(
    sums: &mut Linearized,
    part: &PartReadings,
    body: &FittedBody,
    motion: Option<&Isometry3<f64>>,
    cut: f64,
) {
    let mut block = Block::<COUNT>::default();
    rows_of(part, body, motion, |row, sigma, information| block.add(row, sigma, information, cut));
    block.scatter(sums, part.role.side());
}

/// Each row of a part with the weight that the robust loss leaves it.
pub fn for_each_row(
    part: &PartReadings,
    body: &FittedBody,
    motion: Option<&Isometry3<f64>>,
    cut: f64,
    mut with: impl FnMut(&Row, f64),
) {
    rows_of(part, body, motion, |row, sigma, information| {
        let left = 1.0 / cauchy_ratio(row.value / sigma, cut);
        with(row, information * left / (sigma * sigma));
    });
}

/// Each row of a part with its standard deviation and what it counts.
fn rows_of(
    part: &PartReadings,
    body: &FittedBody,
    motion: Option<&Isometry3<f64>>,
    mut with: impl FnMut(&Row, f64, f64),
) {
    let panel = Panel::new(body, part.role);
    let place = |point: &Vec3| {
        let q = body.to_object(point);
        motion.map_or(q, |motion| motion.transform_point(&q.into()).coords)
    };
    for reading in &part.faces {
        let row = panel.face(&place(&reading.point), part.face);
        with(&row, reading.sigma_m, part.face_information);
    }
    for reading in &part.ends {
        let mut row = panel.beyond(&place(&reading.point), reading.end, part.face);
        row.value += reading.reach_m;
        if row.value > 0.0 || !reading.is_least {
            with(&row, reading.sigma_m, reading.information);
        }
    }
}
