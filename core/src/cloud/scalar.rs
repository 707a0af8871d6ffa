//! Number types that clouds are stored in, and their text.

use super::lines::number;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Endian {
    Little,
    Big,
}

impl Scalar {
    /// Size in bytes.
    pub fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
        }
    }

    pub fn is_float(self) -> bool {
        matches!(self, Self::F32 | Self::F64)
    }
}

/// Text of a coordinate, or `None` when it is no number. What C libraries print for "not a number" is one: `nan`,
/// `-nan(ind)`, `1.#QNAN`.
pub(super) fn coordinate(word: &[u8]) -> Option<f32> {
    number(word).or_else(|| {
        let text = word.to_ascii_lowercase();
        let text = text.strip_prefix(b"-").unwrap_or(&text);
        (text.starts_with(b"nan(") || text.starts_with(b"1.#")).then_some(f32::NAN)
    })
}
