//! The header of a numpy array file. Format: numpy.lib.format, versions 1.0 to 3.0. Only the literal that numpy itself
//! writes is read, a dictionary of descr, fortran_order and shape; nothing is evaluated.

use super::lines::quote;
use super::scalar::{Endian, Scalar};
use crate::error::{InputError, Result};

pub(super) const MAGIC: &[u8] = b"\x93NUMPY";

#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct NpyHeader {
    pub scalar: Scalar,
    pub endian: Endian,
    pub fortran_order: bool,
    pub shape: Vec<usize>,
    /// Byte where the values begin.
    pub start: usize,
}

/// Reads magic, version, length and literal.
pub(super) fn read_header(bytes: &[u8]) -> Result<NpyHeader> {
    let cut_off = || InputError::new("the header is cut off").at(format!("byte {}", bytes.len()));
    if !bytes.starts_with(MAGIC) {
        return Err(InputError::new("the file does not begin with \\x93NUMPY").at("byte 0"));
    }
    let (first, length) = match bytes.get(6).ok_or_else(cut_off)? {
        1 => (10, bytes.get(8..10).map(|raw| usize::from(u16::from_le_bytes([raw[0], raw[1]])))),
        2 | 3 => (12, bytes.get(8..12).map(|raw| u32::from_le_bytes([raw[0], raw[1], raw[2], raw[3]]) as usize)),
        other => return Err(InputError::new(format!("the version is {other}")).at("byte 6").mend("must be 1, 2 or 3")),
    };
    let start = first + length.ok_or_else(cut_off)?;
    let text = bytes.get(first..start).ok_or_else(cut_off)?;
    let mut literal = Literal { text, at: 0 };
    read_literal(&mut literal, start).map_err(|error| {
        let place = format!("byte {}", first + literal.at);
        error.at(place)
    })
}

fn read_literal(literal: &mut Literal<'_>, start: usize) -> Result<NpyHeader> {
    let (mut descr, mut fortran, mut shape) = (None, None, None);
    literal.expect(b'{')?;
    while !literal.take(b'}') {
        match literal.string()? {
            b"descr" => descr = Some(literal.value_of(|l| l.string().and_then(read_descr))?),
            b"fortran_order" => fortran = Some(literal.value_of(Literal::boolean)?),
            b"shape" => shape = Some(literal.value_of(Literal::tuple)?),
            key => return Err(InputError::new(format!("the header has the unknown key {}", quote(key)))),
        }
        if !literal.take(b',') {
            literal.expect(b'}')?;
            break;
        }
    }
    match (descr, fortran, shape) {
        (Some((scalar, endian)), Some(fortran_order), Some(shape)) => {
            Ok(NpyHeader { scalar, endian, fortran_order, shape, start })
        }
        _ => Err(InputError::new("the header lacks a key").mend("it needs descr, fortran_order and shape")),
    }
}

fn read_descr(descr: &[u8]) -> Result<(Scalar, Endian)> {
    match descr {
        b"<f4" => Ok((Scalar::F32, Endian::Little)),
        b">f4" => Ok((Scalar::F32, Endian::Big)),
        b"<f8" => Ok((Scalar::F64, Endian::Little)),
        b">f8" => Ok((Scalar::F64, Endian::Big)),
        _ => {
            Err(InputError::new(format!("the values are of type {}", quote(descr))).mend("must be float32 or float64"))
        }
    }
}

/// Takes a Python literal apart, blanks between its pieces allowed.
struct Literal<'a> {
    text: &'a [u8],
    at: usize,
}

impl<'a> Literal<'a> {
    fn skip_blanks(&mut self) {
        while self.text.get(self.at).is_some_and(u8::is_ascii_whitespace) {
            self.at += 1;
        }
    }

    fn take(&mut self, byte: u8) -> bool {
        self.skip_blanks();
        let hit = self.text.get(self.at) == Some(&byte);
        self.at += usize::from(hit);
        hit
    }

    fn expect(&mut self, byte: u8) -> Result<()> {
        if self.take(byte) {
            return Ok(());
        }
        Err(InputError::new(format!("{:?} is missing in the header", char::from(byte))))
    }

    fn string(&mut self) -> Result<&'a [u8]> {
        let quote = if self.take(b'"') { b'"' } else { b'\'' };
        if quote == b'\'' {
            self.expect(quote)?;
        }
        let text: &'a [u8] = self.text;
        let rest = &text[self.at..];
        let length = rest.iter().position(|&b| b == quote);
        let length = length.ok_or_else(|| InputError::new("a text in the header does not end"))?;
        self.at += length + 1;
        Ok(&rest[..length])
    }

    fn value_of<T>(&mut self, read: impl FnOnce(&mut Self) -> Result<T>) -> Result<T> {
        self.expect(b':')?;
        read(self)
    }

    fn boolean(&mut self) -> Result<bool> {
        self.skip_blanks();
        for (word, value) in [(b"True".as_slice(), true), (b"False", false)] {
            if self.text[self.at..].starts_with(word) {
                self.at += word.len();
                return Ok(value);
            }
        }
        Err(InputError::new("fortran_order is neither True nor False"))
    }

    fn tuple(&mut self) -> Result<Vec<usize>> {
        let mut sizes = Vec::new();
        self.expect(b'(')?;
        while !self.take(b')') {
            sizes.push(self.size()?);
            if !self.take(b',') {
                self.expect(b')')?;
                break;
            }
        }
        Ok(sizes)
    }

    fn size(&mut self) -> Result<usize> {
        self.skip_blanks();
        let rest = &self.text[self.at..];
        let length = rest.iter().take_while(|b| b.is_ascii_digit()).count();
        self.at += length;
        super::lines::number(&rest[..length]).ok_or_else(|| InputError::new("shape holds what is no whole number"))
    }
}
