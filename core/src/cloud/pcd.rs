//! PCD files: header, then text, records, or one compressed array for each field.

use super::fields::{find_roles, Field, Roles};
use super::lines::Lines;
use super::lzf;
use super::parsed::Parsed;
use super::pcd_header::{read_header, Data, PcdField, PcdHeader};
use super::records::{Records, Span};
use super::scalar::Endian;
use super::text_rows::{read_rows, Body, Item};
use crate::error::{InputError, Result};

/// Reads a PCD file: version .5 to .7, every encoding, fields of any order, type and count.
pub(super) fn read_pcd(bytes: &[u8]) -> Result<Parsed> {
    let mut lines = Lines::new(bytes);
    let header = read_header(&mut lines)?;
    check_roles(&header.fields)?;
    let body = match header.data {
        Data::Ascii => read_ascii(&mut lines, &header)?,
        Data::Binary => read_binary(bytes, lines.at, &header)?,
        Data::BinaryCompressed => read_compressed(bytes, lines.at, &header)?,
    };
    Ok(Parsed { body, width: header.width, height: header.height, pose: header.pose })
}

/// Wrong fields are told before wrong sizes, which they may cause.
fn check_roles(fields: &[PcdField]) -> Result<()> {
    check_single(fields)?;
    let placed: Vec<Field<()>> = fields.iter().filter_map(|field| field.placed(())).collect();
    find_roles(&placed).map(|_| ())
}

/// A coordinate with COUNT 3 would otherwise be told as missing, a colour passed over.
fn check_single(fields: &[PcdField]) -> Result<()> {
    let single = ["x", "y", "z", "rgb", "rgba", "label"];
    match fields.iter().find(|f| f.count != 1 && single.iter().any(|name| f.name.eq_ignore_ascii_case(name))) {
        None => Ok(()),
        Some(f) => {
            Err(InputError::new(format!("field {} has COUNT {}", f.name, f.count)).at("header").mend("must be 1"))
        }
    }
}

fn read_ascii(lines: &mut Lines<'_>, header: &PcdHeader) -> Result<Body> {
    let mut fields = Vec::new();
    let mut items = Vec::new();
    let mut word = 0usize;
    for field in &header.fields {
        fields.extend(field.placed(word));
        items.push(Item::Values(field.count));
        word = word.checked_add(field.count).ok_or_else(too_big)?;
    }
    let body = read_rows(lines, header.points(), &items, &find_roles(&fields)?)?;
    match lines.next_filled() {
        None => Ok(body),
        Some(_) => Err(left_over(header.points()).at(lines.place())),
    }
}

fn read_binary(bytes: &[u8], start: usize, header: &PcdHeader) -> Result<Body> {
    let stride = record_size(&header.fields, true)?;
    let size = stride.checked_mul(header.points()).ok_or_else(too_big)?;
    let data = &bytes[start..];
    if data.len() < size {
        return Err(cut_off(header.points(), size, data.len()).at(format!("byte {}", bytes.len())));
    }
    check_padding(data, size, header.points(), start)?;
    let mut fields = Vec::new();
    let mut offset = 0;
    for field in &header.fields {
        fields.extend(field.placed(Span { start: offset, stride }));
        offset += field.scalar.size() * field.count;
    }
    read_body(&Records { bytes: data, count: header.points(), endian: Endian::Little }, &find_roles(&fields)?)
}

/// Two 32-bit sizes, then an LZF block that holds one array for each field, one after another.
fn read_compressed(bytes: &[u8], start: usize, header: &PcdHeader) -> Result<Body> {
    let data = &bytes[start..];
    record_size(&header.fields, true)?;
    if data.is_empty() && header.points() == 0 {
        return read_body(
            &Records { bytes: &[], count: 0, endian: Endian::Little },
            &find_roles(&arrays(header, true))?,
        );
    }
    let sizes = data.get(..8).ok_or_else(|| {
        InputError::new("the sizes of the compressed block are cut off").at(format!("byte {}", bytes.len()))
    })?;
    let word = |k: usize| u32::from_le_bytes([sizes[k], sizes[k + 1], sizes[k + 2], sizes[k + 3]]) as usize;
    let (packed_size, size) = (word(0), word(4));
    let block = data
        .get(8..8 + packed_size)
        .ok_or_else(|| cut_off(header.points(), packed_size, data.len() - 8).at(format!("byte {}", bytes.len())))?;
    check_padding(data, 8 + packed_size, header.points(), start)?;
    let padded = holds_padding(header, size).map_err(|error| error.at(format!("byte {}", start + 4)))?;
    let unpacked = lzf::decompress(block, size).map_err(|error| {
        let place = format!("block at byte {}, {}", start + 8, error.place);
        error.at(place)
    })?;
    let fields = arrays(header, padded);
    read_body(&Records { bytes: &unpacked, count: header.points(), endian: Endian::Little }, &find_roles(&fields)?)
}

/// Whether padding fields are in the block (PCL leaves them out, others do not): the size tells.
fn holds_padding(header: &PcdHeader, size: usize) -> Result<bool> {
    for padded in [true, false] {
        if record_size(&header.fields, padded)?.checked_mul(header.points()) == Some(size) {
            return Ok(padded);
        }
    }
    let wanted = record_size(&header.fields, true)?;
    Err(InputError::new(format!(
        "the block unpacks to {size} bytes, but {} points of {wanted} bytes are promised",
        header.points()
    )))
}

/// Where each field's array stands in the unpacked block, whose size has been checked.
fn arrays(header: &PcdHeader, padded: bool) -> Vec<Field<Span>> {
    let mut fields = Vec::new();
    let mut start = 0;
    for field in header.fields.iter().filter(|f| padded || !f.is_padding()) {
        let stride = field.scalar.size() * field.count;
        fields.extend(field.placed(Span { start, stride }));
        start += stride * header.points();
    }
    fields
}

pub(super) fn read_body(records: &Records<'_>, roles: &Roles<'_, Span>) -> Result<Body> {
    Ok(Body {
        points: records.points(roles.xyz),
        colors: roles.color.as_ref().map(|color| records.colors(color)),
        labels: roles.label.map(|field| records.labels(field)).transpose()?,
    })
}

fn record_size(fields: &[PcdField], padded: bool) -> Result<usize> {
    let sizes = fields.iter().filter(|f| padded || !f.is_padding()).map(|f| f.scalar.size().checked_mul(f.count));
    sizes.into_iter().try_fold(0usize, |sum, size| sum.checked_add(size?)).ok_or_else(too_big)
}

/// Some writers fill the last page with zeros or end with a newline; anything else after the points is a header that lies.
fn check_padding(data: &[u8], size: usize, points: usize, start: usize) -> Result<()> {
    match data[size..].iter().position(|&b| b != 0 && !b.is_ascii_whitespace()) {
        None => Ok(()),
        Some(k) => Err(left_over(points).at(format!("byte {}", start + size + k))),
    }
}

fn left_over(points: usize) -> InputError {
    InputError::new(format!("there are more data after the {points} points of the header"))
        .mend("WIDTH, HEIGHT and POINTS must fit the data")
}

fn cut_off(points: usize, needed: usize, found: usize) -> InputError {
    InputError::new(format!("{points} points need {needed} bytes of data, {found} are there"))
        .mend("is the file cut off?")
}

fn too_big() -> InputError {
    InputError::new("the header promises more bytes than can be counted").at("header")
}
