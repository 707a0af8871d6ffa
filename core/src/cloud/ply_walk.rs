//! Walking over the rows of a binary PLY, lists included.

use std::borrow::Cow;

use super::ply_header::{Element, Kind};
use super::scalar::{Endian, Scalar};
use crate::error::{InputError, Result};

/// The byte after an element's rows.
pub(super) fn skip_element(bytes: &[u8], at: usize, element: &Element, endian: Endian) -> Result<usize> {
    check_room(bytes, at, element)?;
    match element.row_size() {
        Some(size) => Ok(at + size * element.count),
        None => walk_rows(bytes, at, element, endian, |_| ()),
    }
}

/// An element's rows without their lists, so that all are of one size.
pub(super) fn take_rows<'a>(bytes: &'a [u8], at: usize, element: &Element, endian: Endian) -> Result<Cow<'a, [u8]>> {
    check_room(bytes, at, element)?;
    if let Some(size) = element.row_size() {
        return Ok(Cow::Borrowed(&bytes[at..at + size * element.count]));
    }
    let mut rows = Vec::new();
    walk_rows(bytes, at, element, endian, |value| rows.extend_from_slice(value))?;
    Ok(Cow::Owned(rows))
}

/// Refuses a count that the bytes there cannot hold; after it, a walk over the rows takes no longer than the file is.
fn check_room(bytes: &[u8], at: usize, element: &Element) -> Result<()> {
    let there = bytes.len() - at;
    match element.least_row_size().checked_mul(element.count) {
        Some(least) if least <= there => Ok(()),
        _ => Err(InputError::new(format!(
            "{} rows of element {} are promised, but only {there} bytes follow",
            element.count, element.name
        ))
        .at(format!("byte {at}"))
        .mend("is the file cut off?")),
    }
}

/// Gives each single value's bytes to `take`, in order; returns the byte after the last row.
fn walk_rows<'a>(
    bytes: &'a [u8],
    mut at: usize,
    element: &Element,
    endian: Endian,
    mut take: impl FnMut(&'a [u8]),
) -> Result<usize> {
    for _ in 0..element.count {
        for property in &element.properties {
            match property.kind {
                Kind::Value(scalar) => {
                    let end = at + scalar.size();
                    take(bytes.get(at..end).ok_or_else(|| cut_off(at, element))?);
                    at = end;
                }
                Kind::List { length, item } => at = skip_list(bytes, at, length, item, endian, element)?,
            }
        }
    }
    Ok(at)
}

fn skip_list(
    bytes: &[u8],
    at: usize,
    length: Scalar,
    item: Scalar,
    endian: Endian,
    element: &Element,
) -> Result<usize> {
    let first = at + length.size();
    let raw = bytes.get(at..first).ok_or_else(|| cut_off(at, element))?;
    let count = integer(raw, length, endian)
        .ok_or_else(|| InputError::new("a list has a negative length").at(format!("byte {at}")))?;
    let end = count.checked_mul(item.size()).and_then(|size| first.checked_add(size));
    end.filter(|&end| end <= bytes.len()).ok_or_else(|| cut_off(at, element))
}

/// A list's length, or `None` when it is negative.
fn integer(raw: &[u8], scalar: Scalar, endian: Endian) -> Option<usize> {
    let mut wide = [0u8; 8];
    for (k, &byte) in raw.iter().enumerate() {
        wide[if endian == Endian::Little { k } else { raw.len() - 1 - k }] = byte;
    }
    let value = u64::from_le_bytes(wide);
    let signed = matches!(scalar, Scalar::I8 | Scalar::I16 | Scalar::I32 | Scalar::I64);
    if signed && value >> (8 * raw.len() - 1) & 1 == 1 {
        return None;
    }
    usize::try_from(value).ok()
}

fn cut_off(at: usize, element: &Element) -> InputError {
    InputError::new(format!("element {} is cut off", element.name))
        .at(format!("byte {at}"))
        .mend("is the file cut off?")
}
