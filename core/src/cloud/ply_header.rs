//! The header of a PLY file. Format: <http://paulbourke.net/dataformats/ply/>.

use super::lines::{name_of, number, quote, words, Lines};
use super::scalar::{Endian, Scalar};
use crate::error::{InputError, Result};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    Binary(Endian),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Value(Scalar),
    List { length: Scalar, item: Scalar },
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Property {
    pub name: String,
    pub kind: Kind,
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Element {
    pub name: String,
    pub count: usize,
    pub properties: Vec<Property>,
}

impl Element {
    /// Bytes of a row, or `None` when lists make rows unequal.
    pub fn row_size(&self) -> Option<usize> {
        self.properties
            .iter()
            .map(|p| match p.kind {
                Kind::Value(scalar) => Some(scalar.size()),
                Kind::List { .. } => None,
            })
            .sum()
    }

    /// Bytes that every row has at least: lists may be empty.
    pub fn least_row_size(&self) -> usize {
        self.properties
            .iter()
            .map(|p| match p.kind {
                Kind::Value(scalar) | Kind::List { length: scalar, .. } => scalar.size(),
            })
            .sum()
    }
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct PlyHeader {
    pub encoding: Encoding,
    pub elements: Vec<Element>,
}

/// Reads from "ply" to "end_header".
pub(super) fn read_header(lines: &mut Lines<'_>) -> Result<PlyHeader> {
    if lines.next_header_line()? != Some(b"ply") {
        return Err(InputError::new("the first line is not \"ply\"").at("line 1"));
    }
    let mut encoding = None;
    let mut elements: Vec<Element> = Vec::new();
    loop {
        let Some(line) = lines.next_header_line()? else {
            return Err(InputError::new("the header has no end_header").at(lines.place()).mend("is the file cut off?"));
        };
        let row: Vec<&[u8]> = words(line).collect();
        match row.as_slice() {
            [b"end_header"] => break,
            [] | [b"comment" | b"obj_info", ..] => Ok(()),
            [b"format", name, b"1.0"] => read_format(name).map(|read| encoding = Some(read)),
            [b"element", name, count] => read_element(name, count).map(|element| elements.push(element)),
            [b"property", rest @ ..] => read_property(rest).and_then(|p| add_property(&mut elements, p)),
            _ => Err(InputError::new(format!("{} is no line of a PLY header", quote(line)))
                .mend("known are format (1.0), element, property, comment, obj_info, end_header")),
        }
        .map_err(|error| error.at(lines.place()))?;
    }
    let encoding = encoding.ok_or_else(|| InputError::new("there is no format line").at("header"))?;
    Ok(PlyHeader { encoding, elements })
}

fn read_format(name: &[u8]) -> Result<Encoding> {
    match name {
        b"ascii" => Ok(Encoding::Ascii),
        b"binary_little_endian" => Ok(Encoding::Binary(Endian::Little)),
        b"binary_big_endian" => Ok(Encoding::Binary(Endian::Big)),
        _ => Err(InputError::new(format!("format is {}", quote(name)))
            .mend("must be ascii, binary_little_endian or binary_big_endian")),
    }
}

fn read_element(name: &[u8], count: &[u8]) -> Result<Element> {
    let count = number(count).ok_or_else(|| {
        InputError::new(format!("element {} is there {} times", quote(name), quote(count)))
            .mend("must be a whole number")
    })?;
    Ok(Element { name: name_of(name), count, properties: Vec::new() })
}

fn add_property(elements: &mut [Element], property: Property) -> Result<()> {
    let element = elements.last_mut().ok_or_else(|| InputError::new("a property stands before any element"))?;
    element.properties.push(property);
    Ok(())
}

fn read_property(row: &[&[u8]]) -> Result<Property> {
    let (kind, name) = match row {
        [b"list", length, item, name] => (Kind::List { length: length_type(length)?, item: read_type(item)? }, name),
        [kind, name] => (Kind::Value(read_type(kind)?), name),
        _ => return Err(InputError::new("the property cannot be read").mend("must be: property TYPE NAME")),
    };
    Ok(Property { name: name_of(name), kind })
}

fn length_type(name: &[u8]) -> Result<Scalar> {
    match read_type(name)? {
        scalar if scalar.is_float() => {
            Err(InputError::new(format!("a list's length is of type {}", quote(name))).mend("must be an integer type"))
        }
        scalar => Ok(scalar),
    }
}

fn read_type(name: &[u8]) -> Result<Scalar> {
    Ok(match name {
        b"char" | b"int8" => Scalar::I8,
        b"uchar" | b"uint8" => Scalar::U8,
        b"short" | b"int16" => Scalar::I16,
        b"ushort" | b"uint16" => Scalar::U16,
        b"int" | b"int32" => Scalar::I32,
        b"uint" | b"uint32" => Scalar::U32,
        b"float" | b"float32" => Scalar::F32,
        b"double" | b"float64" => Scalar::F64,
        _ => {
            return Err(InputError::new(format!("{} is no type of PLY", quote(name)))
                .mend("must be char, uchar, short, ushort, int, uint, float or double"))
        }
    })
}
