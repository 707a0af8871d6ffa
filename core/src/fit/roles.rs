use crate::model::OpenBoxRoles;

/// What a part of an open box is; sides, flaps and tuck flaps with their number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Role {
    Base,
    Side(usize),
    Flap(usize),
    Tuck(usize),
}

impl Role {
    /// Of the template's parts, in order of the box: base, sides, flaps, tuck flaps.
    pub fn of_parts(roles: &OpenBoxRoles) -> Vec<(usize, Self)> {
        let mut out = vec![(roles.base, Self::Base)];
        out.extend((0..4).map(|k| (roles.sides[k], Self::Side(k))));
        out.extend((0..4).filter_map(|k| Some((roles.flaps[k]?, Self::Flap(k)))));
        out.extend((0..4).filter_map(|k| Some((roles.tucks[k]?, Self::Tuck(k)))));
        out
    }

    /// What shipped templates call it.
    pub fn name(self) -> String {
        match self {
            Self::Base => "base".to_owned(),
            Self::Side(k) => format!("side_{k}"),
            Self::Flap(k) => format!("flap_{k}"),
            Self::Tuck(k) => format!("tuck_{k}"),
        }
    }

    /// The number of the side that it is or hangs on.
    pub fn side(self) -> usize {
        match self {
            Self::Base => 0,
            Self::Side(k) | Self::Flap(k) | Self::Tuck(k) => k,
        }
    }

    /// Its role on the box that has side `by` as side 0.
    pub fn turned(self, by: usize) -> Self {
        let turn = |k: usize| (k + 4 - by % 4) % 4;
        match self {
            Self::Base => Self::Base,
            Self::Side(k) => Self::Side(turn(k)),
            Self::Flap(k) => Self::Flap(turn(k)),
            Self::Tuck(k) => Self::Tuck(turn(k)),
        }
    }
}
