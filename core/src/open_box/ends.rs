use super::evidence::Sheet;
use super::labels::Present;
use super::sight::{Says, Sight};
use crate::fit::{FittedBody, Role};
use crate::perception::EdgeKind;

/// So far beyond an end one looks, metres and pixels.
const BEYOND_M: f64 = 0.009;
const BEYOND_PX: f64 = 2.0;
const PLACES: usize = 11;
const MODEL_M: f64 = 0.005;

/// Ends as the fit counts them: 0 where its side starts, 1 where that ends, 2 at its hinge or rim, 3 across from it.
const NEAR: usize = 2;
pub const FAR: usize = 3;

/// Whether a part's readings tell where it ends there: the fold of a flap is where planes meet.
fn is_told(present: &Present, role: Role, end: usize) -> bool {
    let k = role.side();
    match role {
        Role::Base => false,
        Role::Side(_) => end != NEAR || !present.flaps[k],
        Role::Flap(_) => end != NEAR && (end != FAR || !present.tucks[k]),
        Role::Tuck(_) => end != NEAR,
    }
}

/// Of the free edges of a panel but the base, the share beyond which its surface goes on: it is no panel of its own.
pub fn goes_on(sight: &Sight, body: &FittedBody, present: &Present, role: Role) -> f64 {
    if role == Role::Base {
        return 0.0;
    }
    let told: Vec<usize> = (0..4).filter(|&end| is_told(present, role, end)).collect();
    let sheet = Sheet::new(body, role, &sight.eye);
    let on = told.iter().filter(|&&end| kind(sight, &sheet, end).is_none()).count();
    on as f64 / told.len().max(1) as f64
}

/// What ends a part at each of its ends; `None` where its readings cannot tell.
pub fn ends(sight: &Sight, body: &FittedBody, present: &Present, role: Role) -> [Option<EdgeKind>; 4] {
    let is_told = |end: usize| is_told(present, role, end);
    let sheet = Sheet::new(body, role, &sight.eye);
    [0, 1, 2, 3].map(|end| if is_told(end) { kind(sight, &sheet, end) } else { None })
}

fn kind(sight: &Sight, sheet: &Sheet, end: usize) -> Option<EdgeKind> {
    let mut votes = [0; 4];
    let range = (sheet.at(0.0, 0.0).0 - sight.eye).norm();
    let beyond = BEYOND_M.max(BEYOND_PX * sight.pixel_rad * range);
    for i in 0..PLACES {
        let share = (i as f64 + 0.5) / PLACES as f64;
        let (u, reach) = match end {
            NEAR => (share - 0.5, -beyond),
            FAR => (share - 0.5, sheet.length_m + beyond),
            _ => {
                let sign = if end == 1 { 1.0 } else { -1.0 };
                (sign * (0.5 + beyond / sheet.width_m()), share * sheet.length_m)
            }
        };
        let (point, normal) = sheet.at(u, reach);
        // Beside an edge the sensor's shadow has no readings.
        votes[match sight.ask(&point, &normal, MODEL_M).0 {
            Says::Through | Says::Blank => 0,
            Says::Met => 1,
            Says::Hidden => 2,
            Says::Outside => 3,
        }] += 1;
    }
    let best = (1..4).fold(0, |best, i| if votes[i] > votes[best] { i } else { best });
    [Some(EdgeKind::Edge), None, Some(EdgeKind::Occluded), Some(EdgeKind::Border)][best]
}
