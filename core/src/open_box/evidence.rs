//! What the rays say of each panel of a body.

use super::sight::{Says, Sight};
use crate::fit::{flap_end, layout, FittedBody, Rim, Role};
use crate::free_space::Looked;
use crate::geometry::Vec3;

/// Of one panel, in pixels of the image.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Evidence {
    pub met: f64,
    pub through: f64,
    pub hidden: f64,
    pub blank: f64,
    pub outside: f64,
    /// Whether it is a side's or a flap's inner face that the camera sees.
    pub is_inner: bool,
}

/// A panel of fewer pixels counts as none in the cloud (docs/formats.md, "The figures of merit").
pub const LEAST_SEEN_PX: f64 = 400.0;

impl Evidence {
    /// Whether too little of the panel shows to be seen, and as little was looked through: it is turned its edge to the camera.
    pub fn is_edge_on(&self) -> bool {
        self.met + self.through < LEAST_SEEN_PX
    }

    /// Of two views together.
    pub fn and(&self, other: &Self) -> Self {
        Self {
            met: self.met + other.met,
            through: self.through + other.through,
            hidden: self.hidden + other.hidden,
            blank: self.blank + other.blank,
            outside: self.outside + other.outside,
            is_inner: self.is_inner || other.is_inner,
        }
    }

    pub fn looked(&self) -> Looked {
        let Self { met, through, hidden, blank, outside, .. } = *self;
        Looked { met, through, hidden, blank, outside }
    }
}

/// What the rays of all views say of a panel of a body, each of the face that it sees (eq. 100).
pub fn look_from_all(sights: &[Sight], body: &FittedBody, role: Role, model_m: f64) -> Evidence {
    let look = |sight: &Sight| Sheet::new(body, role, &sight.eye).look(sight, model_m);
    sights.iter().map(look).fold(Evidence::default(), |sum, one| sum.and(&one))
}

const ALONG: usize = 16;
const AWAY: usize = 12;
const STRIP: usize = 4;
/// Left out at each end, share of the panel.
const END_SHARE: f64 = 0.06;

/// A panel as a sheet: points by shares of its width and length, with the normal there.
pub struct Sheet<'a> {
    body: &'a FittedBody,
    role: Role,
    rim: Rim,
    /// The panel's own edge directions at its hinge or rim, in the rim's frame (inward, above), and where it begins.
    way: [f64; 2],
    from: [f64; 2],
    width_m: f64,
    pub length_m: f64,
    offset_m: f64,
    taper_m: f64,
    curl: f64,
    /// Half boards off the middle.
    pub face: f64,
}

impl<'a> Sheet<'a> {
    /// The opening, as a sheet that leaves side 0's rim.
    pub fn of_opening(body: &'a FittedBody, eye: &Vec3) -> Self {
        let base = Self::new(body, Role::Base, eye);
        Self { from: [0.0, 0.0], face: 0.0, ..base }
    }

    /// The face that an eye in the body's world sees.
    pub fn new(body: &'a FittedBody, role: Role, eye: &Vec3) -> Self {
        let k = role.side();
        let flap = |place: usize| body.get(layout::flap(k) + place);
        let tuck = |place: usize| body.get(layout::tuck(k) + place);
        let rim = Rim::new(body, k);
        let (angle, from, width_m, length_m, taper_m, curl) = match role {
            // The base as a sheet that leaves side 0's foot inwards.
            Role::Base => (
                0.0,
                [0.0, body.get(layout::THICKNESS) / 2.0 - body.get(layout::HEIGHT)],
                body.edge_m(0),
                body.edge_m(1),
                0.0,
                0.0,
            ),
            Role::Side(_) => {
                (-std::f64::consts::FRAC_PI_2, [0.0, 0.0], body.edge_m(k), body.get(layout::HEIGHT), 0.0, 0.0)
            }
            Role::Flap(_) => (
                flap(layout::FLAP_ANGLE),
                [0.0, 0.0],
                flap(layout::FLAP_WIDTH),
                flap(layout::FLAP_LENGTH),
                flap(layout::FLAP_TAPER),
                flap(layout::FLAP_CURL),
            ),
            Role::Tuck(_) => (
                flap(layout::FLAP_ANGLE) - tuck(layout::TUCK_ANGLE),
                flap_end(body, k),
                tuck(layout::TUCK_WIDTH),
                tuck(layout::TUCK_LENGTH),
                0.0,
                0.0,
            ),
        };
        let offset_m = if matches!(role, Role::Flap(_) | Role::Tuck(_)) { flap(layout::FLAP_OFFSET) } else { 0.0 };
        let (sin, cos) = angle.sin_cos();
        let way = [cos, sin];
        let at = rim.locate(body.to_object(eye));
        let height = (at.above - from[1]) * way[0] - (at.inward - from[0]) * way[1];
        Self { body, role, rim, way, from, width_m, length_m, offset_m, taper_m, curl, face: height.signum() }
    }

    /// The point of the visible face a share `u` of the width from the middle (-1/2 .. 1/2) and `reach_m` away from the hinge, and
    /// the normal there.
    pub fn at(&self, u: f64, reach_m: f64) -> (Vec3, Vec3) {
        let bend = self.curl * reach_m;
        let normal = [-self.way[1] - bend * self.way[0], self.way[0] - bend * self.way[1]];
        let lift = self.curl * reach_m * reach_m / 2.0 + self.face * self.body.board_m() / 2.0;
        let place = |i: usize| self.from[i] + self.way[i] * reach_m + [-self.way[1], self.way[0]][i] * lift;
        let narrowing = 2.0 * self.taper_m * (reach_m / self.length_m.max(1e-3)).min(1.0);
        let point = self.rim.place(self.offset_m + u * (self.width_m - narrowing), place(0), place(1));
        let (_, inward) = self.rim.directions();
        let normal = inward * normal[0] + Vec3::z() * normal[1];
        (self.body.to_input(&point), (self.body.input_from_object.rotation * normal).normalize())
    }

    /// Pixels of which the rays say that, of the strip between two ways from the hinge.
    pub fn asked_between(&self, sight: &Sight, [from_m, to_m]: [f64; 2], model_m: f64, says: Says) -> f64 {
        let cell = self.width_m.max(0.0) * (to_m - from_m) * (1.0 - 2.0 * END_SHARE) / (ALONG * STRIP) as f64;
        let places = (0..ALONG * STRIP).map(|i| {
            let along = END_SHARE + (1.0 - 2.0 * END_SHARE) * ((i % ALONG) as f64 + 0.5) / ALONG as f64;
            let away = ((i / ALONG) as f64 + 0.5) / STRIP as f64;
            self.at(along - 0.5, from_m + away * (to_m - from_m))
        });
        let told = places.filter(|(point, normal)| sight.ask(point, normal, model_m).0 == says);
        told.map(|(point, normal)| sight.pixels(&point, &normal, cell)).sum()
    }

    /// Whether it is a side's or a flap's inner face. A side leaves the rim downwards, a flap upwards: their inner faces look opposite ways.
    pub fn is_inner(&self) -> bool {
        match self.role {
            Role::Side(_) => self.face > 0.0,
            Role::Flap(_) => self.face < 0.0,
            Role::Base | Role::Tuck(_) => false,
        }
    }

    pub fn width_m(&self) -> f64 {
        self.width_m
    }

    /// Pixels on it, and those of them whose readings are wanted.
    pub fn met_and(&self, sight: &Sight, model_m: f64, is_wanted: impl Fn(usize) -> bool) -> (f64, f64) {
        self.cells(sight).filter(|(point, normal, _)| sight.ask(point, normal, model_m).0 == Says::Met).fold(
            (0.0, 0.0),
            |(met, wanted), (point, _, pixels)| {
                (met + pixels, wanted + if sight.index(&point).is_some_and(&is_wanted) { pixels } else { 0.0 })
            },
        )
    }

    /// What the rays say of it.
    pub fn look(&self, sight: &Sight, model_m: f64) -> Evidence {
        let mut out = Evidence { is_inner: self.is_inner(), ..Evidence::default() };
        for (point, normal, pixels) in self.cells(sight) {
            *match sight.ask(&point, &normal, model_m).0 {
                Says::Met => &mut out.met,
                Says::Through => &mut out.through,
                Says::Hidden => &mut out.hidden,
                Says::Blank => &mut out.blank,
                Says::Outside => &mut out.outside,
            } += pixels;
        }
        out
    }

    /// The points at which it is asked, with the normal and the pixels of each.
    fn cells<'b>(&'b self, sight: &'b Sight) -> impl Iterator<Item = (Vec3, Vec3, f64)> + 'b {
        let cell =
            self.width_m.max(0.0) * self.length_m.max(0.0) * (1.0 - 2.0 * END_SHARE).powi(2) / (ALONG * AWAY) as f64;
        let share = |i: usize, n: usize| END_SHARE + (1.0 - 2.0 * END_SHARE) * (i as f64 + 0.5) / n as f64;
        (0..ALONG * AWAY).map(move |i| {
            let (along, away) = (share(i / AWAY, ALONG) - 0.5, share(i % AWAY, AWAY) * self.length_m);
            let (point, normal) = self.at(along, away);
            (point, normal, sight.pixels(&point, &normal, cell))
        })
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Isometry3;

    use super::*;
    use crate::fit::Parameters;

    #[test]
    fn inner_faces_of_sides_and_upright_flaps_are_those_seen_from_within() {
        let mut numbers = Parameters::zeros();
        let lengths = [(layout::LENGTH, 0.4), (layout::WIDTH, 0.3), (layout::HEIGHT, 0.2)];
        lengths.iter().for_each(|&(place, length_m)| numbers[place] = length_m);
        for k in 0..4 {
            numbers[layout::flap(k) + layout::FLAP_LENGTH] = 0.1;
            numbers[layout::flap(k) + layout::FLAP_ANGLE] = std::f64::consts::FRAC_PI_2;
        }
        let body = FittedBody { input_from_object: Isometry3::identity(), numbers };
        let mut cases = 0;
        for k in 0..4 {
            let rim = Rim::new(&body, k);
            for (inward, is_inner) in [(0.05, true), (0.6, true), (-0.05, false), (-0.6, false)] {
                let eye = rim.place(0.1, inward, 0.5);
                for role in [Role::Side(k), Role::Flap(k)] {
                    assert_eq!(Sheet::new(&body, role, &eye).is_inner(), is_inner, "{role:?} {inward}");
                    cases += 1;
                }
                assert!(!Sheet::new(&body, Role::Base, &eye).is_inner());
            }
        }
        assert_eq!(cases, 32);
    }
}
