use boxwright_sensor::{close_groups, simulate, Kinect, Rgb, Scene, SensorError, Triangle};
use numpy::{
    IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyReadonlyArray3,
    PyUntypedArrayMethods,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_function(wrap_pyfunction!(kinect_camera, m)?)?;
    m.add_function(wrap_pyfunction!(simulate_depth, m)?)?;
    m.add_function(wrap_pyfunction!(close_surface_groups, m)?)
}

type Intrinsics = (f64, f64, f64, f64, usize, usize);
type Frame<'py> = (Bound<'py, PyArray2<f32>>, Bound<'py, PyArray1<i32>>, Bound<'py, PyArray2<u8>>);

/// Intrinsics of the default camera: fx, fy, cx, cy, width, height.
#[pyfunction]
fn kinect_camera() -> Intrinsics {
    let k = Kinect::default();
    (k.fx, k.fy, k.cx, k.cy, k.width, k.height)
}

#[pyfunction]
#[pyo3(signature = (triangles, surface_ids, surface_rgb, seed, camera=None, noise=1.0))]
fn simulate_depth<'py>(
    py: Python<'py>,
    triangles: PyReadonlyArray3<'py, f64>,
    surface_ids: PyReadonlyArray1<'py, i32>,
    surface_rgb: PyReadonlyArray2<'py, u8>,
    seed: u64,
    camera: Option<Intrinsics>,
    noise: f64,
) -> PyResult<Frame<'py>> {
    let triangles = to_triangles(&triangles)?;
    let ids = surface_ids.as_slice()?;
    let colors = to_colors(&surface_rgb)?;
    let kinect = match camera {
        Some((fx, fy, cx, cy, width, height)) => Kinect { fx, fy, cx, cy, width, height, ..Kinect::default() },
        None => Kinect::default(),
    }
    .with_noise(noise);
    let scene = Scene { triangles: &triangles, surface_ids: ids, colors: &colors };
    let readings = py.detach(|| simulate(&scene, &kinect, seed)).map_err(to_value_error)?;
    let points: Vec<f32> = readings.iter().flat_map(|r| r.point).collect();
    let labels: Vec<i32> = readings.iter().map(|r| r.surface_id).collect();
    let rgb: Vec<u8> = readings.iter().flat_map(|r| r.rgb).collect();
    let count = readings.len();
    Ok((
        points.into_pyarray(py).reshape([count, 3])?,
        labels.into_pyarray(py),
        rgb.into_pyarray(py).reshape([count, 3])?,
    ))
}

#[pyfunction]
fn close_surface_groups<'py>(
    py: Python<'py>,
    triangles: PyReadonlyArray3<'py, f64>,
    groups: PyReadonlyArray1<'py, i32>,
    gap_m: f64,
) -> PyResult<Vec<(i32, i32)>> {
    let triangles = to_triangles(&triangles)?;
    let groups = groups.as_slice()?;
    py.detach(|| close_groups(&triangles, groups, gap_m)).map_err(to_value_error)
}

fn to_triangles(array: &PyReadonlyArray3<'_, f64>) -> PyResult<Vec<Triangle>> {
    let shape = array.shape();
    if shape[1..] != [3, 3] {
        return Err(PyValueError::new_err(format!("triangles has shape {shape:?}: expected (T, 3, 3)")));
    }
    let flat = array.as_slice()?;
    Ok(flat.chunks_exact(9).map(|c| [[c[0], c[1], c[2]], [c[3], c[4], c[5]], [c[6], c[7], c[8]]]).collect())
}

fn to_colors(array: &PyReadonlyArray2<'_, u8>) -> PyResult<Vec<Rgb>> {
    let shape = array.shape();
    if shape[1] != 3 {
        return Err(PyValueError::new_err(format!("surface_rgb has shape {shape:?}: expected (T, 3)")));
    }
    Ok(array.as_slice()?.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect())
}

fn to_value_error(error: SensorError) -> PyErr {
    PyValueError::new_err(error.to_string())
}
