use boxwright_core::cloud::CloudView;
use boxwright_core::geometry::Vec3;
use boxwright_core::perception::{perceive as perceive_cloud, EdgeKind, PerceptionSettings, PlaneFinder, Scene};
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::convert::{named, rows_of_three, to_python};

/// What perception says of a cloud; holds the core's `Scene`.
#[pyclass(frozen, module = "boxwright._core")]
pub struct Perception {
    pub(crate) scene: Scene,
    /// Number of points of the cloud, invalid ones included.
    pub(crate) point_count: usize,
}

#[pymethods]
impl Perception {
    #[getter]
    fn up<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, self.scene.up.as_slice())
    }

    #[getter]
    fn support_plane<'py>(&self, py: Python<'py>) -> Option<(Bound<'py, PyArray1<f64>>, f64)> {
        self.scene.support.map(|plane| (PyArray1::from_slice(py, plane.normal.as_slice()), plane.distance))
    }

    #[getter]
    fn normals<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let flat = self.scene.segments.planes.iter().flat_map(|p| [p.normal.x, p.normal.y, p.normal.z]);
        PyArray1::from_iter(py, flat).reshape([self.scene.segments.len(), 3])
    }

    #[getter]
    fn distances<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_iter(py, self.scene.segments.planes.iter().map(|p| p.distance))
    }

    #[getter]
    fn rectangles<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let corners = self.scene.segments.rectangles.iter().flat_map(|r| r.corners);
        let flat = corners.flat_map(|c| [c.x, c.y, c.z]);
        PyArray1::from_iter(py, flat).reshape([self.scene.segments.len(), 4, 3])
    }

    #[getter]
    fn hulls<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyArray2<f64>>>> {
        let array = |hull: &Vec<Vec3>| {
            PyArray1::from_iter(py, hull.iter().flat_map(|c| [c.x, c.y, c.z])).reshape([hull.len(), 3])
        };
        self.scene.segments.hulls.iter().map(array).collect()
    }

    #[getter]
    fn edges(&self) -> Vec<(&'static str, &'static str, &'static str, &'static str)> {
        self.scene.segments.edges.iter().map(|kinds| kinds.map(EdgeKind::name).into()).collect()
    }

    #[getter]
    fn rms<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.scene.segments.rms)
    }

    #[getter]
    fn point_counts<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        let segments = &self.scene.segments;
        PyArray1::from_iter(py, (0..segments.len()).map(|s| segments.points_of(s).len() as i64))
    }

    #[getter]
    fn groups<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i32>> {
        PyArray1::from_iter(py, self.scene.segments.group.iter().copied())
    }

    #[getter]
    fn labels<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i32>> {
        PyArray1::from_vec(py, self.scene.segments.labels(self.point_count))
    }

    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.scene.warnings.clone()
    }

    #[getter]
    fn stage_seconds<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let seconds = PyDict::new(py);
        self.scene.stage_seconds.iter().try_for_each(|(stage, s)| seconds.set_item(stage, s))?;
        Ok(seconds)
    }

    fn __len__(&self) -> usize {
        self.scene.segments.len()
    }
}

#[pyfunction]
#[pyo3(signature = (points, width, height, viewpoint=None, up=None, **settings))]
fn perceive(
    py: Python<'_>,
    points: PyReadonlyArray2<'_, f32>,
    width: usize,
    height: usize,
    viewpoint: Option<[f64; 3]>,
    up: Option<[f64; 3]>,
    settings: Option<&Bound<'_, PyDict>>,
) -> PyResult<Perception> {
    let points = rows_of_three(&points, width, height)?;
    let settings = PerceptionSettings {
        up: up.map(Vec3::from),
        ..PerceptionSettings::with_overrides(named("perception", settings)?).map_err(to_python)?
    };
    let cloud = CloudView { points, width, height, viewpoint: viewpoint.map(Vec3::from) };
    let scene = py.detach(|| perceive_cloud(&cloud, &settings)).map_err(to_python)?;
    Ok(Perception { scene, point_count: points.len() })
}

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add("DEFAULT_PLANES", PerceptionSettings::default().planes.name())?;
    m.add("PLANES", PyTuple::new(m.py(), PlaneFinder::ALL.map(PlaneFinder::name))?)?;
    m.add_class::<Perception>()?;
    m.add_function(wrap_pyfunction!(perceive, m)?)
}
