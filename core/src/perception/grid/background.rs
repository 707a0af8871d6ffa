//! One plane of the room, seen in several parts, is one piece.

use super::piece::Piece;
use super::rays::Rays;
use crate::perception::ransac::components::UnionFind;
use crate::perception::readings::Readings;
use crate::perception::scene::BACKGROUND;

/// Parts of one plane lean less than this from one another.
const SAME_COSINE: f64 = 0.993;
/// Each part's middle lies within so many tolerances of the other's plane.
const TOLERANCES: f64 = 2.0;

/// Joins the background's pieces that lie in one plane into the largest; `support` is the piece that things stand on.
pub fn join_background(
    rays: &Rays,
    readings: &Readings,
    pieces: &mut Vec<Piece>,
    group: &mut Vec<i32>,
    support: &mut Option<usize>,
) {
    let room: Vec<usize> = (0..pieces.len()).filter(|&p| group[p] == BACKGROUND).collect();
    let mut sets = UnionFind::new(pieces.len());
    for (k, &a) in room.iter().enumerate() {
        for &b in &room[..k] {
            if in_one_plane(readings, &pieces[a], &pieces[b]) {
                sets.join(a, b);
            }
        }
    }
    let mut gone = vec![false; pieces.len()];
    for &set in &room {
        let members: Vec<usize> = room.iter().copied().filter(|&p| sets.find(p) == set).collect();
        let Some(&largest) = members.iter().max_by_key(|&&p| (pieces[p].points, std::cmp::Reverse(p))) else {
            continue;
        };
        if members.len() < 2 {
            continue;
        }
        let parts: Vec<&Piece> = members.iter().map(|&p| &pieces[p]).collect();
        let Some(joined) = Piece::joined(rays, &parts) else { continue };
        pieces[largest] = joined;
        members.iter().filter(|&&p| p != largest).for_each(|&p| gone[p] = true);
        if support.is_some_and(|s| members.contains(&s)) {
            *support = Some(largest);
        }
    }
    *support = support.map(|s| s - gone[..s].iter().filter(|&&g| g).count());
    super::piece::keep(pieces, group, |p| !gone[p]);
}

fn in_one_plane(readings: &Readings, a: &Piece, b: &Piece) -> bool {
    let near = |of: &Piece, on: &Piece| {
        let middle = of.rectangle.center();
        on.plane.height_of(&middle).abs() < TOLERANCES * readings.tolerance_m(&middle)
    };
    a.plane.normal.dot(&b.plane.normal) > SAME_COSINE && near(a, b) && near(b, a)
}
