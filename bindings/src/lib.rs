//! Python face of the core: conversion, shape checks and error mapping only. One file for each module of the core.

use pyo3::prelude::*;

mod arm;
mod cloud;
mod collision;
mod convert;
mod model;
mod perception;
mod planning;
mod problem;
mod sensor;

#[pymodule]
fn _core(m: &Bound<'_, PyModule>) -> PyResult<()> {
    cloud::register(m)?;
    arm::register(m)?;
    collision::register(m)?;
    perception::register(m)?;
    model::register(m)?;
    planning::register(m)?;
    problem::register(m)?;
    sensor::register(m)?;
    Ok(())
}
