//! Arms: kinematics and inverse. Poses are (4, 4), positions rad, metres in the base's frame.

use boxwright_core::arm;
use boxwright_core::geometry::Rigid;
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::convert::to_python;

/// An arm with its gripper, read from the TOML text of its file.
#[pyclass(frozen, module = "boxwright._core")]
pub struct Arm {
    pub arm: arm::Arm,
}

/// Positions of all solutions (K, axes), the closed form's branch (K,), and which singularity each is near: (K, 3).
type Inverse<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<u8>>, Bound<'py, PyArray2<bool>>);

#[pymethods]
impl Arm {
    #[new]
    fn new(toml_text: &str) -> PyResult<Self> {
        Ok(Self { arm: arm::Arm::from_toml(toml_text).map_err(to_python)? })
    }

    #[getter]
    fn name(&self) -> &str {
        &self.arm.name
    }

    #[getter]
    fn joint_names(&self) -> Vec<&str> {
        self.arm.joints.iter().map(|joint| joint.name.as_str()).collect()
    }

    /// The base, the links, the gripper and the fingers.
    #[getter]
    fn body_names(&self) -> Vec<&str> {
        (0..self.arm.body_count()).map(|body| self.arm.body_name(body)).collect()
    }

    /// (axes, 2): the lower and the upper limit.
    #[getter]
    fn limits<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let flat = self.arm.joints.iter().flat_map(|joint| [joint.lower_rad, joint.upper_rad]);
        PyArray1::from_iter(py, flat).reshape([self.arm.axes(), 2])
    }

    #[getter]
    fn ready<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.arm.ready)
    }

    /// Whether the inverse is a closed form.
    #[getter]
    fn closed_form(&self) -> bool {
        self.arm.opw.is_some()
    }

    /// (axes, 4, 4): each joint at position 0 on the link before it.
    #[getter]
    fn parent_from_joint<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        stack(py, self.arm.joints.iter().map(|joint| joint.parent_from_joint))
    }

    /// (axes, 3): each joint's axis in its own frame.
    #[getter]
    fn axes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let flat = self.arm.joints.iter().flat_map(|joint| [joint.axis.x, joint.axis.y, joint.axis.z]);
        PyArray1::from_iter(py, flat).reshape([self.arm.axes(), 3])
    }

    #[getter]
    fn last_link_from_flange<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        matrix(py, &self.arm.last_link_from_flange)
    }

    /// (N, 4, 4): base_from_tool at positions (N, axes).
    fn forward<'py>(
        &self,
        py: Python<'py>,
        positions: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let rows = self.rows(&positions)?;
        stack(py, rows.iter().map(|row| self.arm.forward(row)))
    }

    /// (axes + 2, 4, 4): the base, each link and the flange at positions (axes,).
    fn link_frames<'py>(
        &self,
        py: Python<'py>,
        positions: PyReadonlyArray1<'_, f64>,
    ) -> PyResult<Bound<'py, PyArray3<f64>>> {
        stack(py, self.arm.link_frames(&self.row(&positions)?).into_iter())
    }

    /// (6, axes): the tool's velocity (m/s, then rad/s) for each rad/s of a joint, in the base's frame.
    fn jacobian<'py>(
        &self,
        py: Python<'py>,
        positions: PyReadonlyArray1<'_, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let jacobian = self.arm.jacobian(&self.row(&positions)?);
        let flat = (0..6).flat_map(|row| (0..self.arm.axes()).map(move |k| (row, k))).map(|at| jacobian[at]);
        PyArray1::from_iter(py, flat).reshape([6, self.arm.axes()])
    }

    /// All positions within limits that reach base_from_tool (4, 4); a numeric search starts from `near`, or from the ready pose.
    #[pyo3(signature = (base_from_tool, near=None))]
    fn inverse<'py>(
        &self,
        py: Python<'py>,
        base_from_tool: PyReadonlyArray2<'_, f64>,
        near: Option<PyReadonlyArray1<'_, f64>>,
    ) -> PyResult<Inverse<'py>> {
        let tool = rigid(&base_from_tool)?;
        let near = near.map(|near| self.row(&near)).transpose()?.unwrap_or(self.arm.ready);
        let found = py.detach(|| self.arm.inverse_near(&tool, &near));
        let positions = found.iter().flat_map(|solution| solution.positions.to_vec());
        let near = found.iter().flat_map(|s| [s.singular.shoulder, s.singular.elbow, s.singular.wrist]);
        Ok((
            PyArray1::from_iter(py, positions).reshape([found.len(), self.arm.axes()])?,
            PyArray1::from_iter(py, found.iter().map(|solution| solution.branch)),
            PyArray1::from_iter(py, near).reshape([found.len(), 3])?,
        ))
    }
}

impl Arm {
    pub fn row(&self, positions: &PyReadonlyArray1<'_, f64>) -> PyResult<arm::JointPositions> {
        let positions = positions.as_array().to_vec();
        if positions.len() != self.arm.axes() {
            let problem =
                format!("there are {} positions; {} has {} joints", positions.len(), self.name(), self.arm.axes());
            return Err(PyValueError::new_err(problem));
        }
        Ok(arm::JointPositions::from_slice(&positions))
    }

    pub fn rows(&self, positions: &PyReadonlyArray2<'_, f64>) -> PyResult<Vec<arm::JointPositions>> {
        let array = positions.as_array();
        if array.ncols() != self.arm.axes() {
            let problem = format!("positions have shape {:?}; they are (N, {})", array.shape(), self.arm.axes());
            return Err(PyValueError::new_err(problem));
        }
        Ok(array.rows().into_iter().map(|row| arm::JointPositions::from_slice(&row.to_vec())).collect())
    }
}

/// How far a pose's rotation may be from one: above float32's rounding, below any real mistake.
const ROTATION_TOLERANCE: f64 = 1e-6;

/// A (4, 4) pose.
pub fn rigid(matrix: &PyReadonlyArray2<'_, f64>) -> PyResult<Rigid> {
    let array = matrix.as_array();
    if array.shape() != [4, 4] {
        return Err(PyValueError::new_err(format!("a pose has shape {:?}; it is (4, 4)", array.shape())));
    }
    let rotation = nalgebra::Matrix3::from_fn(|i, j| array[[i, j]]);
    let off = (rotation.transpose() * rotation - nalgebra::Matrix3::identity()).norm();
    let straight = off < ROTATION_TOLERANCE && rotation.determinant() > 0.0;
    let translation = nalgebra::Vector3::from_fn(|i, _| array[[i, 3]]);
    if !straight || translation.iter().any(|value| !value.is_finite()) {
        return Err(PyValueError::new_err("a pose's upper left (3, 3) is no rotation, or its position not finite"));
    }
    Ok(Rigid::new(rotation, translation))
}

fn numbers(pose: &Rigid) -> [f64; 16] {
    let (r, t) = (&pose.rotation, &pose.translation);
    [r.m11, r.m12, r.m13, t.x, r.m21, r.m22, r.m23, t.y, r.m31, r.m32, r.m33, t.z, 0.0, 0.0, 0.0, 1.0]
}

pub fn matrix<'py>(py: Python<'py>, pose: &Rigid) -> PyResult<Bound<'py, PyArray2<f64>>> {
    PyArray1::from_slice(py, &numbers(pose)).reshape([4, 4])
}

fn stack<'py>(py: Python<'py>, poses: impl Iterator<Item = Rigid>) -> PyResult<Bound<'py, PyArray3<f64>>> {
    let flat: Vec<f64> = poses.flat_map(|pose| numbers(&pose)).collect();
    let count = flat.len() / 16;
    PyArray1::from_vec(py, flat).reshape([count, 4, 4])
}

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_class::<Arm>()
}
