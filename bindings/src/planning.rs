//! Plans that close a box.

use boxwright_core::arm::{Arm, JointPositions};
use boxwright_core::planning::{time, Bounds, Request};
use numpy::PyReadonlyArray2;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::convert::to_python;

/// The text of a robot's file and a planning request as JSON; the motion as JSON.
#[pyfunction]
fn plan_closing(py: Python<'_>, robot: &str, request: &str) -> PyResult<String> {
    py.detach(|| {
        let arm = Arm::from_toml(robot)?;
        Request::from_json(request)?.plan(&arm)?.to_json()
    })
    .map_err(to_python)
}

/// A robot's file and a request as above: for each open flap, by name, whether brute force can close it. Takes minutes.
#[pyfunction]
fn feasible_flaps(py: Python<'_>, robot: &str, request: &str) -> PyResult<Vec<(String, bool)>> {
    py.detach(|| Request::from_json(request)?.feasible(&Arm::from_toml(robot)?)).map_err(to_python)
}

/// A request as above: for each open flap, by name, whether the box, as its folds and weight are assumed, stands its closing.
#[pyfunction]
fn bearable_flaps(py: Python<'_>, request: &str) -> PyResult<Vec<(String, bool)>> {
    py.detach(|| Request::from_json(request)?.bearable()).map_err(to_python)
}

/// Row by row.
type Rows = Vec<Vec<f64>>;

/// Times from rest to rest along postures (N, axes): times (M,), positions and velocities (M, axes), rows one after the other.
#[pyfunction]
fn time_way(
    way: PyReadonlyArray2<'_, f64>,
    speeds: Vec<f64>,
    accelerations: Vec<f64>,
    period_s: f64,
) -> PyResult<(Vec<f64>, Rows, Rows)> {
    let rows = way.as_array();
    if rows.ncols() != speeds.len() || speeds.len() != accelerations.len() || rows.nrows() < 2 {
        return Err(PyValueError::new_err(
            "way is no (N, axes) array, N > 1, with a speed and an acceleration for each axis",
        ));
    }
    let postures: Vec<JointPositions> =
        rows.rows().into_iter().map(|row| JointPositions::from_slice(&row.to_vec())).collect();
    let both = speeds.into_iter().zip(accelerations);
    let bounds: Vec<Bounds> = both.map(|(speed, acceleration)| Bounds { speed, acceleration }).collect();
    let Some(timed) = time(&postures, &bounds, period_s, |_| f64::INFINITY) else {
        return Err(PyValueError::new_err("way holds one posture only; a motion leads from one to another"));
    };
    let lists = |postures: &[JointPositions]| postures.iter().map(|posture| posture.to_vec()).collect();
    Ok((timed.times_s, lists(&timed.positions), lists(&timed.velocities)))
}

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_function(wrap_pyfunction!(time_way, m)?)?;
    m.add_function(wrap_pyfunction!(bearable_flaps, m)?)?;
    m.add_function(wrap_pyfunction!(feasible_flaps, m)?)?;
    m.add_function(wrap_pyfunction!(plan_closing, m)?)
}
