//! An arm in a world of solids: clear or not, and what is nearest. Metres, the base's frame.

use boxwright_core::collision::{
    signed_distance_m, ArmPieces, Capsule, Checker, HalfSpace, Obstacle, OrientedBox, Rules, Solid, World as Solids,
    IGNORED,
};
use boxwright_core::geometry::Vec3;
use numpy::{PyArray1, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::arm::{rigid, Arm};
use crate::convert::to_python;

/// What stands around an arm. Things go by name.
#[pyclass(frozen, module = "boxwright._core")]
pub struct World {
    world: Solids,
}

#[pymethods]
impl World {
    /// Boxes (name, base_from_box (4, 4), size (3)), capsules (name, from (3), to (3), radius), planes (name, normal (3), distance)
    /// below which all is solid.
    #[new]
    #[pyo3(signature = (boxes=Vec::new(), capsules=Vec::new(), planes=Vec::new()))]
    fn new(
        boxes: Vec<(String, PyReadonlyArray2<'_, f64>, [f64; 3])>,
        capsules: Vec<(String, [f64; 3], [f64; 3], f64)>,
        planes: Vec<(String, [f64; 3], f64)>,
    ) -> PyResult<Self> {
        let mut obstacles = Vec::new();
        for (name, base_from_box, size_m) in boxes {
            let solid = Solid::Box(OrientedBox::new(rigid(&base_from_box)?, Vec3::from(size_m) / 2.0));
            obstacles.push(Obstacle { name, solid });
        }
        for (name, from, to, radius_m) in capsules {
            let solid = Solid::Capsule(Capsule { from: from.into(), to: to.into(), radius_m });
            obstacles.push(Obstacle { name, solid });
        }
        for (name, normal, distance_m) in planes {
            obstacles.push(Obstacle { name, solid: Solid::HalfSpace(HalfSpace { normal: normal.into(), distance_m }) });
        }
        Ok(Self { world: Solids::new(obstacles) })
    }

    #[getter]
    fn names(&self) -> Vec<&str> {
        self.world.obstacles().iter().map(|obstacle| obstacle.name.as_str()).collect()
    }

    /// Signed, between two things by their places in `names`; below 0 the least shift that parts them.
    fn distance_m(&self, a: usize, b: usize) -> PyResult<f64> {
        let solid = |k: usize| self.world.obstacles().get(k).map(|obstacle| &obstacle.solid);
        match (solid(a), solid(b)) {
            (Some(a), Some(b)) => Ok(signed_distance_m(a, b)),
            _ => Err(PyValueError::new_err(format!("there are {} things, no {a} and {b}", self.names().len()))),
        }
    }
}

/// An arm with its fingers at an opening, in a world, and how far apart all must be.
#[pyclass(frozen, module = "boxwright._core")]
pub struct Clearance {
    arm: Py<Arm>,
    world: Py<World>,
    pieces: ArmPieces,
    rules: Rules,
}

#[pymethods]
impl Clearance {
    /// `ignored` are pairs (body of the arm, thing of the world) that are not looked at.
    #[new]
    #[pyo3(signature = (arm, world, clearance_m, opening_m, ignored=Vec::new()))]
    fn new(
        py: Python<'_>,
        arm: Py<Arm>,
        world: Py<World>,
        clearance_m: f64,
        opening_m: f64,
        ignored: Vec<(String, String)>,
    ) -> PyResult<Self> {
        let (core, solids) = (&arm.get().arm, &world.get().world);
        let mut rules = Rules::new(core, solids, clearance_m);
        for (body, thing) in &ignored {
            let body = core.body_index(body).map_err(to_python)?;
            let thing = solids.index_of(thing).ok_or_else(|| PyValueError::new_err(format!("there is no {thing}")))?;
            rules.set(body, thing, IGNORED);
        }
        let pieces = ArmPieces::new(core, opening_m);
        Ok(Self { arm: arm.clone_ref(py), world: world.clone_ref(py), pieces, rules })
    }

    /// (N,) whether all is far enough apart at positions (N, axes), rad.
    fn is_clear<'py>(
        &self,
        py: Python<'py>,
        positions: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<Bound<'py, PyArray1<bool>>> {
        let rows = self.arm.get().rows(&positions)?;
        Ok(PyArray1::from_iter(py, rows.iter().map(|row| self.checker().is_clear(row, &self.rules))))
    }

    /// The pair with least to spare at positions (axes,): body, the other's name, their signed distance; None where all is ignored.
    fn nearest(&self, positions: PyReadonlyArray1<'_, f64>) -> PyResult<Option<(String, String, f64)>> {
        let row = self.arm.get().row(&positions)?;
        let checker = self.checker();
        let nearest = checker.nearest(&row, &self.rules);
        Ok(nearest.map(|near| {
            let body = checker.arm.body_name(near.body).to_owned();
            (body, checker.other_name(near.other).to_owned(), near.distance_m)
        }))
    }
}

impl Clearance {
    fn checker(&self) -> Checker<'_> {
        Checker { arm: &self.arm.get().arm, pieces: &self.pieces, world: &self.world.get().world }
    }
}

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_class::<World>()?;
    m.add_class::<Clearance>()
}
