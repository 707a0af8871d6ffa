//! numpy arrays: (N, 3) is an unorganized cloud, (H, W, 3) an organized one seen from the origin.

use super::fields::{find_roles, Field};
use super::npy_header::{read_header, NpyHeader};
use super::parsed::{HeaderPose, Parsed};
use super::pcd::read_body;
use super::records::{Records, Span};
use super::text_rows::Body;
use crate::error::{InputError, Result};

/// Reads a .npy file: float32 or float64, either byte order, C or Fortran order.
pub(super) fn read_npy(bytes: &[u8]) -> Result<Parsed> {
    let header = read_header(bytes)?;
    let (width, height) = layout(&header.shape)?;
    let count = check_size(&header, bytes.len())?;
    let records = Records { bytes: &bytes[header.start..], count, endian: header.endian };
    let mut body = read_body(&records, &find_roles(&axes(&header, count))?)?;
    if header.fortran_order && height > 1 {
        body.points = rows_from_columns(&body, width, height);
    }
    Ok(Parsed { body, width, height, pose: HeaderPose::origin() })
}

/// Columns and rows; one row, or one column, is no image.
fn layout(shape: &[usize]) -> Result<(usize, usize)> {
    match *shape {
        [count, 3] => Ok((count, 1)),
        [rows, 1, 3] => Ok((rows, 1)),
        [0, _, 3] | [_, 0, 3] => Ok((0, 1)),
        [rows, columns, 3] => Ok((columns, rows)),
        _ => Err(InputError::new(format!("the array's shape has {} axes or does not end in 3", shape.len()))
            .at("shape")
            .mend("must be (points, 3) or (rows, columns, 3)")),
    }
}

/// Number of points, after the bytes there are found to be exactly those that the shape asks for.
fn check_size(header: &NpyHeader, file_size: usize) -> Result<usize> {
    let values = header.shape.iter().try_fold(1usize, |product, &size| product.checked_mul(size));
    let there = file_size - header.start;
    match values.and_then(|values| values.checked_mul(header.scalar.size())) {
        Some(needed) if needed == there => Ok(there / header.scalar.size() / 3),
        _ => Err(InputError::new(format!("the shape {:?} does not fit the {there} bytes of data", header.shape))
            .at(format!("byte {file_size}"))
            .mend("is the file cut off?")),
    }
}

/// Where x, y and z stand: side by side in C order, each in an array of its own in Fortran order.
fn axes(header: &NpyHeader, count: usize) -> Vec<Field<Span>> {
    let size = header.scalar.size();
    let place = |axis: usize| match header.fortran_order {
        true => Span { start: axis * count * size, stride: size },
        false => Span { start: axis * size, stride: 3 * size },
    };
    let field = |(axis, name): (usize, &str)| Field { name: name.into(), scalar: header.scalar, place: place(axis) };
    ["x", "y", "z"].into_iter().enumerate().map(field).collect()
}

/// Fortran order runs down the columns.
fn rows_from_columns(body: &Body, width: usize, height: usize) -> Vec<[f32; 3]> {
    let by_row = (0..height).flat_map(|v| (0..width).map(move |u| u * height + v));
    by_row.map(|k| body.points[k]).collect()
}
