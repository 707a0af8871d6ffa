use nalgebra::{Isometry3, Rotation3, Translation3, UnitQuaternion};

use super::proposal::Proposal;
use super::proposed::middle;
use crate::fit::{layout, FittedBody, Parameters};

/// What a fit starts from where nothing is known, metres.
const BOARD_M: f64 = 0.004;
const FLAP_M: f64 = 0.1;
const TUCK_M: f64 = 0.04;
const FLAP_LESS_THAN_SIDE_M: f64 = 0.006;
const TUCK_LESS_THAN_SIDE_M: f64 = 0.016;

/// A proposal as a body, in the level frame.
pub fn body_of(proposal: &Proposal) -> FittedBody {
    let [x, y] = proposal.spans;
    let rotation = Rotation3::from_basis_unchecked(&[proposal.axes[0], proposal.axes[1], proposal.up]);
    let rotation = UnitQuaternion::from_rotation_matrix(&rotation);
    let mut numbers = Parameters::zeros();
    numbers[layout::LENGTH] = x[1] - x[0] - BOARD_M;
    numbers[layout::WIDTH] = y[1] - y[0] - BOARD_M;
    numbers[layout::HEIGHT] = proposal.heights[1] - proposal.heights[0];
    numbers[layout::THICKNESS] = BOARD_M;
    let bottom = middle(proposal) - proposal.up * (numbers[layout::HEIGHT] / 2.0);
    let mut body =
        FittedBody { input_from_object: Isometry3::from_parts(Translation3::from(bottom), rotation), numbers };
    for k in 0..4 {
        body.numbers[layout::flap(k) + layout::FLAP_LENGTH] = FLAP_M;
        body.numbers[layout::flap(k) + layout::FLAP_WIDTH] = body.edge_m(k) - FLAP_LESS_THAN_SIDE_M;
        body.numbers[layout::flap(k) + layout::FLAP_ANGLE] = std::f64::consts::PI;
        body.numbers[layout::tuck(k) + layout::TUCK_LENGTH] = TUCK_M;
        body.numbers[layout::tuck(k) + layout::TUCK_WIDTH] = body.edge_m(k) - TUCK_LESS_THAN_SIDE_M;
    }
    body
}
