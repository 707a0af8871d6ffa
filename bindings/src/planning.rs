//! Plans that close a box.

use boxwright_core::arm::Arm;
use boxwright_core::planning::Request;
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

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_function(wrap_pyfunction!(plan_closing, m)?)
}
