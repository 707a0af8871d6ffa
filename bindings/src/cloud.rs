//! Cloud readers: a file's bytes are read and parsed without the GIL; the arrays go to numpy without a copy.

use std::path::PathBuf;

use boxwright_core::cloud::{self, Cloud, Distortion, Intrinsics, ReadOptions};
use boxwright_core::error::{InputError, Result};
use boxwright_core::geometry::Vec3;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;

/// What a reader found, still without its path.
#[pyclass(frozen, get_all)]
struct CloudArrays {
    points: Py<PyArray2<f32>>,
    width: usize,
    height: usize,
    viewpoint: Option<(f64, f64, f64)>,
    colors: Option<Py<PyArray2<u8>>>,
    labels: Option<Py<PyArray1<u32>>>,
}

/// A reader's failure, before it is a Python exception.
enum Failure {
    Input(InputError),
    Io(std::io::Error),
}

impl From<InputError> for Failure {
    fn from(error: InputError) -> Self {
        Self::Input(error)
    }
}

#[pyfunction]
fn read_cloud(
    py: Python<'_>,
    path: PathBuf,
    format: &str,
    unit: &str,
    frame: &str,
    viewpoint: Option<(f64, f64, f64)>,
) -> PyResult<CloudArrays> {
    let read = || {
        let (format, options) = (format.parse()?, read_options(unit, frame, viewpoint)?);
        let bytes = std::fs::read(&path).map_err(Failure::Io)?;
        Ok(cloud::read_cloud(&bytes, format, &options)?)
    };
    arrays(py, py.detach(read).map_err(|failure| exception(failure, &path))?)
}

#[pyfunction]
#[allow(clippy::too_many_arguments)] // the public face gathers them in a type
fn read_depth_png(
    py: Python<'_>,
    path: PathBuf,
    camera: [f64; 4],
    size: Option<(usize, usize)>,
    distortion: [f64; 5],
    depth_unit_m: f64,
    depth_decode: &str,
    unit: &str,
    frame: &str,
    viewpoint: Option<(f64, f64, f64)>,
) -> PyResult<CloudArrays> {
    let [fx, fy, cx, cy] = camera;
    let camera = Intrinsics { fx, fy, cx, cy, size, distortion: Distortion(distortion), depth_unit_m };
    let read = || {
        let (decoding, options) = (depth_decode.parse()?, read_options(unit, frame, viewpoint)?);
        let bytes = std::fs::read(&path).map_err(Failure::Io)?;
        Ok(cloud::read_depth_png(&bytes, &camera, decoding, &options)?)
    };
    arrays(py, py.detach(read).map_err(|failure| exception(failure, &path))?)
}

fn read_options(unit: &str, frame: &str, viewpoint: Option<(f64, f64, f64)>) -> Result<ReadOptions> {
    Ok(ReadOptions {
        unit: unit.parse()?,
        frame: frame.parse()?,
        viewpoint: viewpoint.map(|(x, y, z)| Vec3::new(x, y, z)),
    })
}

fn exception(failure: Failure, path: &std::path::Path) -> PyErr {
    match failure {
        Failure::Input(error) => PyValueError::new_err(error.in_source(path.display().to_string()).to_string()),
        Failure::Io(error) => {
            let text = error.to_string();
            let text = text.split(" (os error").next().unwrap_or_default().to_string();
            // With an error number and a file name OSError becomes FileNotFoundError and its like.
            PyOSError::new_err((error.raw_os_error(), text, path.as_os_str().to_os_string()))
        }
    }
}

fn arrays(py: Python<'_>, cloud: Cloud) -> PyResult<CloudArrays> {
    let count = cloud.points.len();
    let points = cloud.points.into_flattened().into_pyarray(py).reshape([count, 3])?;
    let colors = cloud.colors.map(|colors| colors.into_flattened().into_pyarray(py).reshape([count, 3])).transpose()?;
    Ok(CloudArrays {
        points: points.unbind(),
        width: cloud.width,
        height: cloud.height,
        viewpoint: cloud.viewpoint.map(|p| (p.x, p.y, p.z)),
        colors: colors.map(Bound::unbind),
        labels: cloud.labels.map(|labels| labels.into_pyarray(py).unbind()),
    })
}

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_class::<CloudArrays>()?;
    m.add_function(wrap_pyfunction!(read_cloud, m)?)?;
    m.add_function(wrap_pyfunction!(read_depth_png, m)?)
}
