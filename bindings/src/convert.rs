//! Conversions that more than one binding file needs.

use boxwright_core::error::InputError;
use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion};
use numpy::PyReadonlyArray2;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::{Map, Value};

/// The points of an (N, 3) array, borrowed, where N = width * height.
pub fn rows_of_three<'a>(
    points: &'a PyReadonlyArray2<'_, f32>,
    width: usize,
    height: usize,
) -> PyResult<&'a [[f32; 3]]> {
    let (rows, columns) = (points.as_array().nrows(), points.as_array().ncols());
    if columns != 3 || width.checked_mul(height) != Some(rows) {
        let problem = format!(
            "points have shape ({rows}, {columns}); width {width} and height {height} want (width * height, 3)"
        );
        return Err(PyValueError::new_err(problem));
    }
    let flat = points
        .as_slice()
        .map_err(|_| PyValueError::new_err("points are not C-contiguous; pass numpy.ascontiguousarray(points)"))?;
    Ok(flat.as_chunks::<3>().0)
}

/// A rigid motion from the rows of its matrix; its rotation is taken to be one.
pub fn motion(rows: &[[f64; 4]; 4]) -> Isometry3<f64> {
    let turn = Matrix3::from_fn(|i, j| rows[i][j]);
    let turn = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(turn));
    Isometry3::from_parts(Translation3::new(rows[0][3], rows[1][3], rows[2][3]), turn)
}

/// Settings by name, for the core to put over its defaults; `what` names them in errors.
pub fn named(what: &str, settings: Option<&Bound<'_, PyDict>>) -> PyResult<Map<String, Value>> {
    let mut values = Map::new();
    for (name, value) in settings.into_iter().flat_map(|s| s.iter()) {
        let name: String = name.extract()?;
        let value = match (value.extract::<u64>(), value.extract::<f64>(), value.extract::<String>()) {
            (Ok(whole), _, _) => Value::from(whole),
            (_, Ok(real), _) => Value::from(real),
            (_, _, Ok(text)) => Value::from(text),
            _ => return Err(PyTypeError::new_err(format!("{what} setting {name} is neither number nor text"))),
        };
        values.insert(name, value);
    }
    Ok(values)
}

pub fn to_python(error: InputError) -> PyErr {
    PyValueError::new_err(error.to_string())
}
