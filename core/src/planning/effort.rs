//! How hard a flap's push is searched for: each effort is made only where the one before leads nowhere.

use std::ops::Range;

/// How hard it is tried.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Effort {
    /// The first of the settings' searches alone, and no second motion for what one motion does not do.
    Quick,
    /// The next one among finer contacts, then motions one after the other.
    Thorough,
    /// The last ones and the widest: for what stays open after all others.
    Deep,
}

impl Effort {
    /// All up to this one, the quickest first.
    pub fn up_to(self) -> impl Iterator<Item = Self> {
        [Self::Quick, Self::Thorough, Self::Deep].into_iter().take(self as usize + 1)
    }

    /// Its own searches among those of the settings.
    pub fn searches(self) -> Range<usize> {
        match self {
            Self::Quick => 0..1,
            Self::Thorough => 1..2,
            Self::Deep => 2..4,
        }
    }
}

/// The first of the settings' searches alone; and all but the deepest.
pub const FIRST: Range<usize> = 0..1;
pub const USUAL: Range<usize> = 0..2;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn efforts_grow_and_share_no_search() {
        assert_eq!(Effort::Deep.up_to().count(), 3);
        assert_eq!(Effort::Quick.up_to().collect::<Vec<_>>(), [Effort::Quick]);
        let searches: Vec<usize> = Effort::Deep.up_to().flat_map(Effort::searches).collect();
        assert_eq!(searches, [0, 1, 2, 3]);
        assert_eq!((FIRST, USUAL), (Effort::Quick.searches(), 0..Effort::Thorough.searches().end));
    }
}
