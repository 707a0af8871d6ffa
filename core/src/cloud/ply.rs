//! PLY files: the element `vertex`, wherever it stands; other elements and all lists are passed over. A PLY knows neither
//! an image grid nor a viewpoint: the cloud is unorganized.

use super::fields::{find_roles, Field};
use super::lines::Lines;
use super::parsed::{HeaderPose, Parsed};
use super::pcd::read_body;
use super::ply_header::{read_header, Element, Encoding, Kind, PlyHeader};
use super::ply_walk::{skip_element, take_rows};
use super::records::{Records, Span};
use super::scalar::Endian;
use super::text_rows::{read_rows, Body, Item};
use crate::error::{InputError, Result};

/// Reads a PLY file, text or binary of either byte order.
pub(super) fn read_ply(bytes: &[u8]) -> Result<Parsed> {
    let mut lines = Lines::new(bytes);
    let header = read_header(&mut lines)?;
    let (before, vertex) = find_vertex(&header)?;
    let body = match header.encoding {
        Encoding::Ascii => read_ascii(&mut lines, before, vertex)?,
        Encoding::Binary(endian) => read_binary(bytes, lines.at, before, vertex, endian)?,
    };
    Ok(Parsed { body, width: vertex.count, height: 1, pose: HeaderPose::origin() })
}

/// The vertex element and those that stand before it.
fn find_vertex(header: &PlyHeader) -> Result<(&[Element], &Element)> {
    let mut places = (0..header.elements.len()).filter(|&k| header.elements[k].name == "vertex");
    match (places.next(), places.next()) {
        (Some(k), None) => Ok((&header.elements[..k], &header.elements[k])),
        (None, _) => Err(InputError::new("there is no element vertex").at("header")),
        (Some(_), Some(_)) => Err(InputError::new("element vertex is there twice").at("header")),
    }
}

fn read_ascii(lines: &mut Lines<'_>, before: &[Element], vertex: &Element) -> Result<Body> {
    for element in before.iter().filter(|element| !element.properties.is_empty()) {
        for done in 0..element.count {
            lines.next_filled().ok_or_else(|| {
                let text = format!("the file ends after {done} of {} rows of element {}", element.count, element.name);
                InputError::new(text).at(lines.place())
            })?;
        }
    }
    let mut fields = Vec::new();
    let mut items = Vec::new();
    for property in &vertex.properties {
        items.push(match property.kind {
            Kind::List { .. } => Item::List,
            Kind::Value(scalar) => {
                fields.push(Field { name: property.name.clone(), scalar, place: fields.len() });
                Item::Values(1)
            }
        });
    }
    read_rows(lines, vertex.count, &items, &find_roles(&fields)?)
}

fn read_binary(bytes: &[u8], start: usize, before: &[Element], vertex: &Element, endian: Endian) -> Result<Body> {
    let mut at = start;
    for element in before {
        at = skip_element(bytes, at, element, endian)?;
    }
    let mut fields = Vec::new();
    let mut stride = 0;
    for property in &vertex.properties {
        if let Kind::Value(scalar) = property.kind {
            fields.push(Field { name: property.name.clone(), scalar, place: Span { start: stride, stride: 0 } });
            stride += scalar.size();
        }
    }
    fields.iter_mut().for_each(|field| field.place.stride = stride);
    let roles = find_roles(&fields)?;
    let rows = take_rows(bytes, at, vertex, endian)?;
    read_body(&Records { bytes: &rows, count: vertex.count, endian }, &roles)
}
