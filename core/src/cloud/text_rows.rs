//! Points written as text, one a line: the bodies of ASCII PCD and ASCII PLY.

use super::fields::{Color, Field, Roles};
use super::lines::{number, quote, words, Lines};
use super::records::{bad_label, channel_byte, label_from, unpack};
use super::scalar::{coordinate, Scalar};
use crate::error::{InputError, Result};

/// More values than any point has (large feature histograms have some thousands).
const MOST_WORDS: usize = 1 << 16;

/// What stands on a line, in order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Item {
    /// So many words.
    Values(usize),
    /// A count and then so many words (a PLY list); its words are passed over.
    List,
}

/// Points, colours and labels as they come out of any file's body.
#[derive(Debug, Default)]
pub(super) struct Body {
    pub points: Vec<[f32; 3]>,
    pub colors: Option<Vec<[u8; 3]>>,
    pub labels: Option<Vec<u32>>,
}

/// Reads `count` filled lines; a field's place is its word's number among those that `Item::Values` counts.
pub(super) fn read_rows(lines: &mut Lines<'_>, count: usize, items: &[Item], roles: &Roles<'_, usize>) -> Result<Body> {
    check_room(lines, count, items)?;
    let mut body = empty_body(count, roles);
    let mut row = Vec::new();
    for done in 0..count {
        let Some(line) = lines.next_filled() else {
            return Err(InputError::new(format!("the file ends after {done} of {count} points")).at(lines.place()));
        };
        split_row(line, items, &mut row)
            .and_then(|()| push_row(&row, roles, &mut body))
            .map_err(|error| error.at(lines.place()))?;
    }
    Ok(body)
}

/// Refuses a count that the bytes there cannot hold: every word needs a byte and a blank.
fn check_room(lines: &Lines<'_>, count: usize, items: &[Item]) -> Result<()> {
    let words = items.iter().try_fold(0usize, |sum, item| match item {
        Item::Values(n) => sum.checked_add(*n),
        Item::List => sum.checked_add(1),
    });
    if words.is_none_or(|words| words > MOST_WORDS) {
        return Err(InputError::new("the fields have more values than fit a line of text")
            .at("header")
            .mend(format!("must be at most {MOST_WORDS} values a point")));
    }
    let needed = words.and_then(|words| words.checked_mul(2)?.checked_mul(count));
    if needed.is_none_or(|needed| needed > lines.left() + 1) {
        return Err(InputError::new(format!(
            "the header promises {count} points, but only {} bytes follow",
            lines.left()
        ))
        .at(format!("byte {}", lines.at)));
    }
    Ok(())
}

fn empty_body(count: usize, roles: &Roles<'_, usize>) -> Body {
    Body {
        points: Vec::with_capacity(count),
        colors: roles.color.as_ref().map(|_| Vec::with_capacity(count)),
        labels: roles.label.map(|_| Vec::with_capacity(count)),
    }
}

/// The line's words without those of lists.
fn split_row<'a>(line: &'a [u8], items: &[Item], row: &mut Vec<&'a [u8]>) -> Result<()> {
    row.clear();
    let mut rest = words(line);
    for item in items {
        let wanted = match item {
            Item::Values(n) => *n,
            Item::List => list_length(rest.next())?,
        };
        for _ in 0..wanted {
            let word = rest.next().ok_or_else(|| InputError::new("the line has too few values"))?;
            if *item != Item::List {
                row.push(word);
            }
        }
    }
    match rest.next() {
        None => Ok(()),
        Some(word) => Err(InputError::new(format!("the line has more values than fields, from {} on", quote(word)))),
    }
}

pub(super) fn list_length(word: Option<&[u8]>) -> Result<usize> {
    let word = word.ok_or_else(|| InputError::new("the line has too few values"))?;
    number(word).ok_or_else(|| InputError::new(format!("{} is no list length", quote(word))))
}

fn push_row(row: &[&[u8]], roles: &Roles<'_, usize>, body: &mut Body) -> Result<()> {
    let mut point = [0.0f32; 3];
    for (value, field) in point.iter_mut().zip(roles.xyz) {
        *value = coordinate(row[field.place]).ok_or_else(|| no_number(row, field))?;
    }
    body.points.push(point);
    if let (Some(colors), Some(color)) = (&mut body.colors, &roles.color) {
        colors.push(color_of(row, color)?);
    }
    if let (Some(labels), Some(field)) = (&mut body.labels, roles.label) {
        let value: f64 = number(row[field.place]).ok_or_else(|| no_number(row, field))?;
        labels.push(label_from(value).ok_or_else(|| bad_label(value))?);
    }
    Ok(())
}

fn color_of(row: &[&[u8]], color: &Color<'_, usize>) -> Result<[u8; 3]> {
    match *color {
        Color::Packed(field) => {
            let word = row[field.place];
            let bits = match field.scalar {
                Scalar::F32 => coordinate(word).map(f32::to_bits),
                _ => number::<i64>(word).map(|value| value as u32),
            };
            bits.map(unpack).ok_or_else(|| no_number(row, field))
        }
        Color::Separate(fields) => {
            let mut rgb = [0u8; 3];
            for (channel, field) in rgb.iter_mut().zip(fields) {
                let value: f64 = number(row[field.place]).ok_or_else(|| no_number(row, field))?;
                *channel = channel_byte(value, field.scalar);
            }
            Ok(rgb)
        }
    }
}

fn no_number(row: &[&[u8]], field: &Field<usize>) -> InputError {
    let kind = if field.scalar.is_float() { "number" } else { "whole number" };
    InputError::new(format!("field {} is {}", field.name, quote(row[field.place]))).mend(format!("must be a {kind}"))
}
