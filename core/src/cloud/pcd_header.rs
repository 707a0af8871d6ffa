//! The header of a PCD file (versions .5 to .7), checked before anything is believed.
//!
//! Format: <https://pointclouds.org/documentation/tutorials/pcd_file_format.html>. Keywords in any case and order; `DATA`
//! ends the header. Where writers differ we read what can only be meant one way:
//! - of WIDTH, HEIGHT and POINTS, one that is missing or 0 follows from the others (WIDTH * HEIGHT = POINTS, HEIGHT 1
//!   before anything else); a contradiction is an error;
//! - WIDTH 1 is a list written as a column, no image: unorganized;
//! - COUNT may be missing (1 everywhere); SIZE and TYPE may not.

use super::fields::Field;
use super::lines::{name_of, number, quote, words, Lines};
use super::parsed::HeaderPose;
use super::scalar::Scalar;
use crate::error::{InputError, Result};
use crate::geometry::Vec3;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Data {
    Ascii,
    Binary,
    BinaryCompressed,
}

/// One entry of FIELDS with its SIZE, TYPE and COUNT.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct PcdField {
    pub name: String,
    pub scalar: Scalar,
    pub count: usize,
}

impl PcdField {
    /// Space that no value is in.
    pub fn is_padding(&self) -> bool {
        self.name == "_"
    }

    /// As a field with a role, if it is a single value.
    pub fn placed<P>(&self, place: P) -> Option<Field<P>> {
        (self.count == 1 && !self.is_padding()).then(|| Field { name: self.name.clone(), scalar: self.scalar, place })
    }
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct PcdHeader {
    pub fields: Vec<PcdField>,
    pub width: usize,
    pub height: usize,
    pub pose: HeaderPose,
    pub data: Data,
}

impl PcdHeader {
    pub fn points(&self) -> usize {
        self.width * self.height
    }
}

/// The header's lines as they stand, each keyword at most once.
#[derive(Default)]
struct Entries<'a> {
    fields: Option<Vec<&'a [u8]>>,
    size: Option<Vec<&'a [u8]>>,
    kind: Option<Vec<&'a [u8]>>,
    count: Option<Vec<&'a [u8]>>,
    width: Option<usize>,
    height: Option<usize>,
    points: Option<usize>,
    pose: Option<HeaderPose>,
}

/// Reads up to and with the DATA line.
pub(super) fn read_header(lines: &mut Lines<'_>) -> Result<PcdHeader> {
    let mut entries = Entries::default();
    let data = loop {
        let Some(line) = lines.next_header_line()? else {
            return Err(InputError::new("the header has no DATA line").at(lines.place()).mend("is the file cut off?"));
        };
        if line.is_empty() || line[0] == b'#' {
            continue;
        }
        if let Some(data) = read_entry(line, &mut entries).map_err(|error| error.at(lines.place()))? {
            break data;
        }
    };
    let (width, height) = layout(entries.width, entries.height, entries.points).map_err(|error| error.at("header"))?;
    let fields = read_fields(&entries).map_err(|error| error.at("header"))?;
    Ok(PcdHeader { fields, width, height, pose: entries.pose.unwrap_or(HeaderPose::origin()), data })
}

/// Takes one line in; the DATA line gives its encoding.
fn read_entry<'a>(line: &'a [u8], entries: &mut Entries<'a>) -> Result<Option<Data>> {
    let mut rest = words(line);
    let keyword = rest.next().unwrap_or_default().to_ascii_uppercase();
    let values: Vec<&[u8]> = rest.collect();
    match keyword.as_slice() {
        b"VERSION" => check_version(&values)?,
        b"FIELDS" | b"COLUMNS" => once(&mut entries.fields, values)?,
        b"SIZE" => once(&mut entries.size, values)?,
        b"TYPE" => once(&mut entries.kind, values)?,
        b"COUNT" => once(&mut entries.count, values)?,
        b"WIDTH" => once(&mut entries.width, whole(&values)?)?,
        b"HEIGHT" => once(&mut entries.height, whole(&values)?)?,
        b"POINTS" => once(&mut entries.points, whole(&values)?)?,
        b"VIEWPOINT" => once(&mut entries.pose, read_pose(&values)?)?,
        b"DATA" => return read_encoding(&values).map(Some),
        _ => {
            return Err(InputError::new(format!("{} is no keyword of a PCD header", quote(line)))
                .mend("known are VERSION FIELDS SIZE TYPE COUNT WIDTH HEIGHT VIEWPOINT POINTS DATA"))
        }
    }
    Ok(None)
}

fn once<T>(slot: &mut Option<T>, value: T) -> Result<()> {
    match slot.replace(value) {
        None => Ok(()),
        Some(_) => Err(InputError::new("the keyword is there twice").mend("write each line of the header once")),
    }
}

fn whole(values: &[&[u8]]) -> Result<usize> {
    match values {
        [word] => number(word),
        _ => None,
    }
    .ok_or_else(|| InputError::new("the value is no whole number").mend("must be one number, 0 or more"))
}

fn check_version(values: &[&[u8]]) -> Result<()> {
    let known: &[&[u8]] = &[b".5", b"0.5", b".6", b"0.6", b".7", b"0.7"];
    match values {
        [version] if known.contains(version) => Ok(()),
        _ => Err(InputError::new("the version is not known").mend("must be .5, .6 or .7")),
    }
}

fn read_encoding(values: &[&[u8]]) -> Result<Data> {
    let name = values.first().map(|word| word.to_ascii_lowercase()).unwrap_or_default();
    match name.as_slice() {
        b"ascii" => Ok(Data::Ascii),
        b"binary" => Ok(Data::Binary),
        b"binary_compressed" => Ok(Data::BinaryCompressed),
        _ => {
            Err(InputError::new(format!("DATA is {}", quote(&name))).mend("must be ascii, binary or binary_compressed"))
        }
    }
}

/// Translation x y z, then rotation w x y z.
fn read_pose(values: &[&[u8]]) -> Result<HeaderPose> {
    let numbers: Option<Vec<f64>> = values.iter().map(|word| number(word)).collect();
    match numbers.as_deref() {
        Some(&[x, y, z, _w, qx, qy, qz]) if [x, y, z, qx, qy, qz].iter().all(|v| v.is_finite()) => {
            Ok(HeaderPose { position: Vec3::new(x, y, z), rotated: [qx, qy, qz] != [0.0; 3] })
        }
        _ => Err(InputError::new("VIEWPOINT cannot be read").mend("must be 7 numbers: x y z qw qx qy qz")),
    }
}

/// Columns and rows, from what the header says of them; see the module's text.
fn layout(width: Option<usize>, height: Option<usize>, points: Option<usize>) -> Result<(usize, usize)> {
    if width.is_none() && points.is_none() {
        return Err(
            InputError::new("there is neither WIDTH nor POINTS").mend("the header must say how many points follow")
        );
    }
    let given = |value: Option<usize>| value.filter(|&v| v > 0);
    let contradiction = || {
        let show = |value: Option<usize>| value.map_or("missing".to_string(), |v| v.to_string());
        InputError::new(format!("WIDTH {}, HEIGHT {}, POINTS {}", show(width), show(height), show(points)))
            .mend("WIDTH * HEIGHT must be POINTS")
    };
    let (columns, rows) = match (given(width), given(height), given(points)) {
        (Some(w), Some(h), Some(n)) if w.checked_mul(h) == Some(n) => (w, h),
        (Some(w), Some(h), None) if w.checked_mul(h).is_some() => (w, h),
        (Some(w), None, Some(n)) if n % w == 0 => (w, n / w),
        (None, Some(h), Some(n)) if n % h == 0 => (n / h, h),
        (Some(w), None, None) => (w, 1),
        (None, None, Some(n)) => (n, 1),
        (None, _, None) => (0, 1),
        _ => return Err(contradiction()),
    };
    Ok(if columns == 1 { (rows, 1) } else { (columns, rows) })
}

fn read_fields(entries: &Entries<'_>) -> Result<Vec<PcdField>> {
    let missing = |keyword: &str| InputError::new(format!("there is no {keyword} line")).mend("a PCD header needs it");
    let names = entries.fields.as_ref().ok_or_else(|| missing("FIELDS"))?;
    let sizes = entries.size.as_ref().ok_or_else(|| missing("SIZE"))?;
    let kinds = entries.kind.as_ref().ok_or_else(|| missing("TYPE"))?;
    let ones = vec![b"1".as_slice(); names.len()];
    let counts = entries.count.as_ref().unwrap_or(&ones);
    for (keyword, list) in [("SIZE", sizes), ("TYPE", kinds), ("COUNT", counts)] {
        if list.len() != names.len() {
            return Err(InputError::new(format!("{} FIELDS but {} values of {keyword}", names.len(), list.len()))
                .mend("must be one for each field"));
        }
    }
    (0..names.len()).map(|k| read_field(names[k], sizes[k], kinds[k], counts[k])).collect()
}

fn read_field(name: &[u8], size: &[u8], kind: &[u8], count: &[u8]) -> Result<PcdField> {
    let scalar = match (kind.to_ascii_uppercase().as_slice(), size) {
        (b"I", b"1") => Scalar::I8,
        (b"U", b"1") => Scalar::U8,
        (b"I", b"2") => Scalar::I16,
        (b"U", b"2") => Scalar::U16,
        (b"I", b"4") => Scalar::I32,
        (b"U", b"4") => Scalar::U32,
        (b"I", b"8") => Scalar::I64,
        (b"U", b"8") => Scalar::U64,
        (b"F", b"4") => Scalar::F32,
        (b"F", b"8") => Scalar::F64,
        _ => {
            return Err(InputError::new(format!("field {} has TYPE {} SIZE {}", quote(name), quote(kind), quote(size)))
                .mend("TYPE must be I or U with SIZE 1, 2, 4 or 8, or F with SIZE 4 or 8"))
        }
    };
    let count = number(count).ok_or_else(|| {
        InputError::new(format!("field {} has COUNT {}", quote(name), quote(count))).mend("must be a whole number")
    })?;
    Ok(PcdField { name: name_of(name), scalar, count })
}
