//! What the answer says of parts that were not seen: hidden or absent, and from where a hidden one would be seen.

use super::found_box::FoundBox;
use super::labels::roles;
use super::next_view::Surroundings;
use super::sight::Sight;
use super::unseen::{unseen_flap, unseen_tuck};
use crate::fit::{layout, FittedBody, Role};
use crate::free_space::PartState;
use crate::geometry::Vec3;

/// Of one part without readings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unseen {
    pub role: Role,
    pub state: PartState,
    /// Unit vector, level frame, from the part towards a place that sees it; told of parts that are rather hidden than absent.
    pub seen_from: Option<Vec3>,
}

/// Of the parts of a box that no view saw, `unseen`, flaps before their tuck flaps. The last view is where the camera is.
///
/// Flaps whose tuck flaps were seen are there, where those say.
pub fn unseen_parts(found: &FoundBox, sights: &[Sight], unseen: &[Role], has_seen_tuck: [bool; 4]) -> Vec<Unseen> {
    let body = &found.solution.body;
    let there: Vec<Role> = roles(&found.present);
    let surroundings = Surroundings::new(sights, body, &there);
    let mut out = Vec::new();
    for &role in unseen {
        let (state, poses) = match role {
            Role::Base | Role::Side(_) => {
                let Some((_, evidence)) = found.evidence.iter().find(|(r, _)| *r == role) else { continue };
                (PartState::unseen(&evidence.looked()), vec![(body.clone(), 1.0)])
            }
            Role::Flap(k) if has_seen_tuck[k] => (PartState::HIDDEN, vec![(body.clone(), 1.0)]),
            Role::Flap(k) => {
                let flap = unseen_flap(sights, body, k, usual_length_m(body, found.present.flaps));
                (flap.state, flap.poses)
            }
            Role::Tuck(k) => match out.iter().find(|other: &&Unseen| other.role == Role::Flap(k)) {
                // It is where its flap is, and that is unknown.
                Some(flap) => (flap.state, Vec::new()),
                None => {
                    let tuck = unseen_tuck(sights, body, k);
                    (tuck.state, tuck.poses)
                }
            },
        };
        let is_hidden = !poses.is_empty() && state.hidden > state.absent;
        let seen_from = surroundings.as_ref().filter(|_| is_hidden).and_then(|s| s.seen_from(role, &poses));
        out.push(Unseen { role, state, seen_from });
    }
    out
}

/// Of the box's flaps that were found on average; else as they are cut to meet over the middle.
fn usual_length_m(body: &FittedBody, present: [bool; 4]) -> f64 {
    let found = (0..4).filter(|&k| present[k]).map(|k| body.get(layout::flap(k) + layout::FLAP_LENGTH));
    let (count, sum) = found.fold((0, 0.0), |(count, sum), length_m| (count + 1, sum + length_m));
    if count == 0 {
        body.edge_m(0).min(body.edge_m(1)) / 2.0
    } else {
        sum / f64::from(count)
    }
}
