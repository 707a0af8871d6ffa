//! Binary values at regular places of a buffer, to points, colours and labels.

use super::fields::{Color, Field};
use super::scalar::{Endian, Scalar};
use crate::error::{InputError, Result};

/// Place of a binary field: the value of point `i` starts at byte `start + i * stride`. This one shape fits records
/// (PCD, PLY), one array for each field (compressed PCD) and arrays in either order (npy).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Span {
    pub start: usize,
    pub stride: usize,
}

/// A buffer that holds every field of `count` points; whoever makes it has checked that it is long enough.
pub(super) struct Records<'a> {
    pub bytes: &'a [u8],
    pub count: usize,
    pub endian: Endian,
}

/// Calls `$put(i, value)` with field `$field`'s value of every point, in its own type.
macro_rules! for_each_value {
    ($records:expr, $field:expr, $put:expr) => {
        match $field.scalar {
            Scalar::I8 => $records.each::<i8, 1>($field, i8::from_le_bytes, i8::from_be_bytes, $put),
            Scalar::U8 => $records.each::<u8, 1>($field, u8::from_le_bytes, u8::from_be_bytes, $put),
            Scalar::I16 => $records.each::<i16, 2>($field, i16::from_le_bytes, i16::from_be_bytes, $put),
            Scalar::U16 => $records.each::<u16, 2>($field, u16::from_le_bytes, u16::from_be_bytes, $put),
            Scalar::I32 => $records.each::<i32, 4>($field, i32::from_le_bytes, i32::from_be_bytes, $put),
            Scalar::U32 => $records.each::<u32, 4>($field, u32::from_le_bytes, u32::from_be_bytes, $put),
            Scalar::I64 => $records.each::<i64, 8>($field, i64::from_le_bytes, i64::from_be_bytes, $put),
            Scalar::U64 => $records.each::<u64, 8>($field, u64::from_le_bytes, u64::from_be_bytes, $put),
            Scalar::F32 => $records.each::<f32, 4>($field, f32::from_le_bytes, f32::from_be_bytes, $put),
            Scalar::F64 => $records.each::<f64, 8>($field, f64::from_le_bytes, f64::from_be_bytes, $put),
        }
    };
}

impl Records<'_> {
    /// Coordinates, in the file's unit.
    pub fn points(&self, xyz: [&Field<Span>; 3]) -> Vec<[f32; 3]> {
        if let Some(start) = self.packed_floats(xyz) {
            return self.packed_points(start, xyz[0].place.stride);
        }
        let mut points = vec![[0.0f32; 3]; self.count];
        for (axis, field) in xyz.into_iter().enumerate() {
            self.numbers(field, |i, value| points[i][axis] = value as f32);
        }
        points
    }

    /// Red, green, blue of every point.
    pub fn colors(&self, color: &Color<'_, Span>) -> Vec<[u8; 3]> {
        let mut colors = vec![[0u8; 3]; self.count];
        match *color {
            Color::Packed(field) => {
                let bits = Field { name: String::new(), scalar: Scalar::U32, place: field.place };
                self.each::<u32, 4>(&bits, u32::from_le_bytes, u32::from_be_bytes, |i, v| colors[i] = unpack(v));
            }
            Color::Separate(channels) => {
                for (channel, field) in channels.into_iter().enumerate() {
                    self.numbers(field, |i, value| colors[i][channel] = channel_byte(value, field.scalar));
                }
            }
        }
        colors
    }

    /// Labels; see `label_from`.
    pub fn labels(&self, field: &Field<Span>) -> Result<Vec<u32>> {
        let mut labels = vec![0u32; self.count];
        let mut wrong = None;
        self.numbers(field, |i, value| match label_from(value) {
            Some(label) => labels[i] = label,
            None => wrong = wrong.or(Some((i, value))),
        });
        match wrong {
            None => Ok(labels),
            Some((i, value)) => Err(bad_label(value).at(format!("point {i}, field {}", field.name))),
        }
    }

    /// Every value as a double (64-bit integers lose their last digits, which no coordinate or label needs).
    #[allow(clippy::unnecessary_cast)] // the macro casts a double to itself, too
    fn numbers(&self, field: &Field<Span>, mut put: impl FnMut(usize, f64)) {
        for_each_value!(self, field, |i, value| put(i, value as f64));
    }

    fn each<T, const SIZE: usize>(
        &self,
        field: &Field<Span>,
        from_le: fn([u8; SIZE]) -> T,
        from_be: fn([u8; SIZE]) -> T,
        mut put: impl FnMut(usize, T),
    ) {
        let Span { start, stride } = field.place;
        for i in 0..self.count {
            let at = start + i * stride;
            let mut raw = [0u8; SIZE];
            raw.copy_from_slice(&self.bytes[at..at + SIZE]);
            put(i, if self.endian == Endian::Little { from_le(raw) } else { from_be(raw) });
        }
    }

    /// Where x starts, if x y z are three little-endian floats in a row: what nearly every file holds.
    fn packed_floats(&self, xyz: [&Field<Span>; 3]) -> Option<usize> {
        let Span { start, stride } = xyz[0].place;
        let fits = |k: usize| {
            xyz[k].scalar == Scalar::F32 && xyz[k].place == Span { start: start + 4 * k, stride } && stride >= 12
        };
        (self.endian == Endian::Little && (0..3).all(fits)).then_some(start)
    }

    fn packed_points(&self, start: usize, stride: usize) -> Vec<[f32; 3]> {
        let float = |raw: &[u8], k: usize| f32::from_le_bytes([raw[k], raw[k + 1], raw[k + 2], raw[k + 3]]);
        let records = (0..self.count).map(|i| &self.bytes[start + i * stride..][..12]);
        records.map(|raw| [float(raw, 0), float(raw, 4), float(raw, 8)]).collect()
    }
}

/// 0xAARRGGBB to red, green, blue.
pub(super) fn unpack(bits: u32) -> [u8; 3] {
    let [b, g, r, _] = bits.to_le_bytes();
    [r, g, b]
}

/// One colour channel as a byte: 8 bits as they are, 16 bits by their upper half, floating point from 0..1.
pub(super) fn channel_byte(value: f64, scalar: Scalar) -> u8 {
    match scalar {
        Scalar::U16 => (value / 256.0) as u8,
        Scalar::F32 | Scalar::F64 => (value * 255.0).round() as u8,
        _ => value as u8,
    }
}

/// A label is 32 bits: negative ones keep their bit pattern (-1 is 0xFFFFFFFF); `None` for what is no such integer.
pub(super) fn label_from(value: f64) -> Option<u32> {
    let whole = value.fract() == 0.0 && (f64::from(i32::MIN)..=f64::from(u32::MAX)).contains(&value);
    whole.then_some(value as i64 as u32)
}

pub(super) fn bad_label(value: f64) -> InputError {
    InputError::new(format!("label is {value}")).mend("must be a 32-bit integer")
}
