use nalgebra::DMatrix;

use super::body::{FittedBody, Parameters};
use super::layout::{place_of_slot, PARAMETER_COUNT, SHIFT, SLOT_COUNT, TURN};
use super::panel::Panel;
use super::priors::Prior;
use super::readings::PartReadings;
use super::row::Row;
use super::settings::FitSettings;
use crate::geometry::{Plane, Vec3};

/// Everything that a body is held against.
#[derive(Debug, Clone)]
pub struct Problem {
    pub parts: Vec<PartReadings>,
    /// What the box stands on, normal up.
    pub support: Option<Plane>,
    pub priors: Vec<Prior>,
    pub settings: FitSettings,
}

/// The objective at a body, half the robust sum of squares, with its gradient and Gauss-Newton curvature (eq. 81, 82).
#[derive(Debug, Clone)]
pub struct Linearized {
    pub cost: f64,
    pub gradient: Parameters,
    /// Lower triangle.
    pub curvature: DMatrix<f64>,
}

/// Half of Cauchy's loss of a residual in standard deviations, and the weight it leaves the residual.
fn cauchy(residual: f64, cut: f64) -> (f64, f64) {
    let ratio = 1.0 + (residual / cut).powi(2);
    (0.5 * cut * cut * ratio.ln(), 1.0 / ratio)
}

impl Problem {
    /// At `body`, residuals beyond `cut` standard deviations losing their say.
    pub fn linearize(&self, body: &FittedBody, cut: f64) -> Linearized {
        let mut sums = Linearized {
            cost: 0.0,
            gradient: Parameters::zeros(),
            curvature: DMatrix::zeros(PARAMETER_COUNT, PARAMETER_COUNT),
        };
        for part in &self.parts {
            add_part(&mut sums, part, body, cut);
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

    /// The base's underside lies on the support.
    fn add_support(&self, sums: &mut Linearized, body: &FittedBody, cut: f64) {
        let Some(support) = self.support else { return };
        let settings = &self.settings;
        let normal = body.input_from_object.inverse_transform_vector(&support.normal);
        let height = support.height_of(&body.input_from_object.translation.vector);
        let mut block = Block::default();
        for (value, row) in support_rows(&normal, height) {
            let sigma = if row.1 { settings.support_sigma_m } else { settings.support_sigma_rad };
            block.add(&Row { value, slots: row.0 }, sigma, 1.0, cut);
        }
        block.scatter(sums, 0);
    }
}

/// Height of the object's origin (true) and lean of the support in the object's frame (false), with their derivatives.
fn support_rows(normal: &Vec3, height: f64) -> [(f64, ([f64; SLOT_COUNT], bool)); 3] {
    let mut slots = [[0.0; SLOT_COUNT]; 3];
    slots[0][SHIFT..SHIFT + 3].copy_from_slice(normal.as_slice());
    // A turn t of the object turns the normal the other way: n x t.
    (slots[1][TURN + 1], slots[1][TURN + 2]) = (-normal.z, normal.y);
    (slots[2][TURN + 2], slots[2][TURN]) = (-normal.x, normal.z);
    [(height, (slots[0], true)), (normal.x, (slots[1], false)), (normal.y, (slots[2], false))]
}

fn add_part(sums: &mut Linearized, part: &PartReadings, body: &FittedBody, cut: f64) {
    let panel = Panel::new(body, part.role);
    let mut block = Block::default();
    for reading in &part.faces {
        let row = panel.face(&body.to_object(&reading.point), part.face);
        block.add(&row, reading.sigma_m, part.face_information, cut);
    }
    for reading in &part.ends {
        let mut row = panel.beyond(&body.to_object(&reading.point), reading.end, part.face);
        row.value += reading.reach_m;
        if row.value > 0.0 || !reading.is_least {
            block.add(&row, reading.sigma_m, reading.information, cut);
        }
    }
    block.scatter(sums, part.role.side());
}

/// The sums of one part, by slots.
struct Block {
    cost: f64,
    gradient: [f64; SLOT_COUNT],
    curvature: [[f64; SLOT_COUNT]; SLOT_COUNT],
}

impl Default for Block {
    fn default() -> Self {
        Self { cost: 0.0, gradient: [0.0; SLOT_COUNT], curvature: [[0.0; SLOT_COUNT]; SLOT_COUNT] }
    }
}

impl Block {
    fn add(&mut self, row: &Row, sigma: f64, information: f64, cut: f64) {
        let (cost, left) = cauchy(row.value / sigma, cut);
        self.cost += information * cost;
        let weight = information * left / (sigma * sigma);
        for (i, by) in row.slots.iter().enumerate() {
            if *by == 0.0 {
                continue;
            }
            let weighted = weight * by;
            self.gradient[i] += weighted * row.value;
            for (sum, other) in self.curvature[i].iter_mut().zip(&row.slots) {
                *sum += weighted * other;
            }
        }
    }

    fn scatter(&self, sums: &mut Linearized, k: usize) {
        sums.cost += self.cost;
        for i in 0..SLOT_COUNT {
            let place = place_of_slot(i, k);
            sums.gradient[place] += self.gradient[i];
            for j in 0..SLOT_COUNT {
                let other = place_of_slot(j, k);
                if other <= place {
                    sums.curvature[(place, other)] += self.curvature[i][j];
                }
            }
        }
    }
}
