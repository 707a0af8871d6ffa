//! Which of a file's fields are coordinates, colour and label.

use super::scalar::Scalar;
use crate::error::{InputError, Result};

/// A named value of every point; `place` says where it stands (a span of bytes, or a column of text).
#[derive(Debug, Clone)]
pub(super) struct Field<P> {
    pub name: String,
    pub scalar: Scalar,
    pub place: P,
}

#[derive(Debug)]
pub(super) enum Color<'a, P> {
    /// 0xAARRGGBB in four bytes, whatever type the header calls them.
    Packed(&'a Field<P>),
    Separate([&'a Field<P>; 3]),
}

#[derive(Debug)]
pub(super) struct Roles<'a, P> {
    pub xyz: [&'a Field<P>; 3],
    pub color: Option<Color<'a, P>>,
    pub label: Option<&'a Field<P>>,
}

/// Finds x y z, colour (`rgb` or `rgba`; else `red green blue`; else `r g b`) and `label`; case does not matter, other
/// fields are passed over.
pub(super) fn find_roles<P>(fields: &[Field<P>]) -> Result<Roles<'_, P>> {
    let xyz = [required(fields, "x")?, required(fields, "y")?, required(fields, "z")?];
    Ok(Roles { xyz, color: find_color(fields)?, label: find(fields, "label")? })
}

fn find_color<P>(fields: &[Field<P>]) -> Result<Option<Color<'_, P>>> {
    for name in ["rgb", "rgba"] {
        if let Some(field) = find(fields, name)? {
            return packed(field).map(Some);
        }
    }
    for names in [["red", "green", "blue"], ["r", "g", "b"]] {
        if let (Some(r), Some(g), Some(b)) = (find(fields, names[0])?, find(fields, names[1])?, find(fields, names[2])?)
        {
            return separate([r, g, b]).map(Some);
        }
    }
    Ok(None)
}

fn packed<P>(field: &Field<P>) -> Result<Color<'_, P>> {
    if field.scalar.size() != 4 {
        return Err(InputError::new(format!("packed colour has {} bytes", field.scalar.size()))
            .at(format!("field {}", field.name))
            .mend("must have SIZE 4"));
    }
    Ok(Color::Packed(field))
}

fn separate<P>(fields: [&Field<P>; 3]) -> Result<Color<'_, P>> {
    match fields.iter().find(|f| !matches!(f.scalar, Scalar::U8 | Scalar::U16 | Scalar::F32 | Scalar::F64)) {
        None => Ok(Color::Separate(fields)),
        Some(f) => Err(InputError::new(format!("colour is of type {:?}", f.scalar))
            .at(format!("field {}", f.name))
            .mend("must be unsigned of 8 or 16 bits, or floating point from 0 to 1")),
    }
}

fn required<'a, P>(fields: &'a [Field<P>], name: &str) -> Result<&'a Field<P>> {
    find(fields, name)?.ok_or_else(|| {
        InputError::new(format!("there is no field {name}")).at("header").mend("a cloud needs the fields x, y and z")
    })
}

fn find<'a, P>(fields: &'a [Field<P>], name: &str) -> Result<Option<&'a Field<P>>> {
    let mut hits = fields.iter().filter(|field| field.name.eq_ignore_ascii_case(name));
    let first = hits.next();
    if hits.next().is_some() {
        return Err(InputError::new(format!("field {name} is there twice")).at("header").mend("name each field once"));
    }
    Ok(first)
}
