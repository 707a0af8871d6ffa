//! Text lines of a file that may turn binary half-way, with their numbers and places.

use crate::error::{InputError, Result};

/// Room for a thousand fields.
const LONGEST_HEADER_LINE: usize = 1 << 16;

/// Walks over lines; the place after the last line taken is where binary data begins.
pub(super) struct Lines<'a> {
    bytes: &'a [u8],
    /// Byte where the next line begins.
    pub at: usize,
    /// Number of the line taken last, from 1.
    pub number: usize,
}

impl<'a> Lines<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0, number: 0 }
    }

    /// Next line without its end (LF or CRLF) and without blanks around it.
    pub fn next_line(&mut self) -> Option<&'a [u8]> {
        let rest = self.bytes.get(self.at..).filter(|rest| !rest.is_empty())?;
        let length = rest.iter().position(|&b| b == b'\n').unwrap_or(rest.len());
        self.at += (length + 1).min(rest.len());
        self.number += 1;
        Some(rest[..length].trim_ascii())
    }

    /// Next line of a header, whose lines are short: a binary file with a text file's name is not taken for one.
    pub fn next_header_line(&mut self) -> Result<Option<&'a [u8]>> {
        match self.next_line() {
            Some(line) if line.len() > LONGEST_HEADER_LINE => {
                Err(InputError::new(format!("the header has a line of {} bytes", line.len()))
                    .at(self.place())
                    .mend(format!("must be at most {LONGEST_HEADER_LINE}")))
            }
            line => Ok(line),
        }
    }

    /// Next line with anything on it.
    pub fn next_filled(&mut self) -> Option<&'a [u8]> {
        loop {
            let line = self.next_line()?;
            if !line.is_empty() {
                return Some(line);
            }
        }
    }

    /// "line 4", for errors.
    pub fn place(&self) -> String {
        format!("line {}", self.number)
    }

    /// Bytes not yet taken.
    pub fn left(&self) -> usize {
        self.bytes.len() - self.at
    }
}

/// Words of a line.
pub(super) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

/// A piece of a file as it can stand in a one-line message: short, printable.
pub(super) fn quote(bytes: &[u8]) -> String {
    const SHOWN: usize = 32;
    let shown = &bytes[..bytes.len().min(SHOWN)];
    let more = if bytes.len() > SHOWN { "..." } else { "" };
    format!("\"{}{more}\"", shown.escape_ascii())
}

/// A name out of a file, printable whatever it is.
pub(super) fn name_of(word: &[u8]) -> String {
    word.escape_ascii().to_string()
}

/// A word as a number of any type.
pub(super) fn number<T: std::str::FromStr>(word: &[u8]) -> Option<T> {
    std::str::from_utf8(word).ok()?.parse().ok()
}
