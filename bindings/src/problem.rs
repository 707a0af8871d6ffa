use boxwright_core::inference::{
    best_exhaustive, marginals, rank_staged, solve, ExactSettings, Marginals, Potentials, Rules, SearchPlans, Solution,
};
use boxwright_core::model::{self, Assignment, FeatureTables, SegmentSet};
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyReadonlyArray3};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::convert::to_python;
use crate::model::{search_settings, Template};
use crate::perception::Perception;

/// The segments of one group under one template: features, scores, search.
#[pyclass(frozen, module = "boxwright._core")]
pub struct Problem {
    template: model::Template,
    /// Numbers of the segments among the perception's.
    scene_index: Vec<usize>,
    tables: FeatureTables,
}

#[pymethods]
impl Problem {
    /// One problem for each group of the perception, in the groups' order.
    #[staticmethod]
    fn by_group(perception: &Perception, template: &Template) -> Vec<Self> {
        SegmentSet::by_group(&perception.scene).into_iter().map(|set| Self::of(&template.template, set)).collect()
    }

    /// The problem of these of the perception's segments, of any group.
    #[staticmethod]
    fn of_segments(perception: &Perception, template: &Template, segments: Vec<usize>) -> PyResult<Self> {
        let count = perception.scene.segments.planes.len();
        if let Some(s) = segments.iter().find(|&&s| s >= count) {
            return Err(PyValueError::new_err(format!("segment {s} does not exist; there are {count}")));
        }
        Ok(Self::of(&template.template, SegmentSet::new(&perception.scene, &segments)))
    }

    /// The problem of given values: features (F, n) and relations (R, n, n), in the template's order.
    #[staticmethod]
    fn of_values(
        template: &Template,
        features: PyReadonlyArray2<'_, f64>,
        relations: PyReadonlyArray3<'_, f64>,
    ) -> PyResult<Self> {
        let template = template.template.clone();
        let (features, relations) = (features.as_array(), relations.as_array());
        let n = features.ncols();
        let wanted = (template.features.len(), [template.relations.len(), n, n]);
        if (features.nrows(), relations.shape()) != (wanted.0, &wanted.1) {
            let problem = format!("features {:?} and relations {:?}", features.shape(), relations.shape());
            let mend = format!("the template wants ({}, n) and ({}, n, n)", wanted.0, wanted.1[0]);
            return Err(PyValueError::new_err(format!("{problem}: {mend}")));
        }
        let tables = FeatureTables {
            segment_count: n,
            unary: features.outer_iter().map(|row| row.to_vec()).collect(),
            pair: relations.outer_iter().map(|table| table.iter().copied().collect()).collect(),
        };
        Ok(Self { template, scene_index: (0..n).collect(), tables })
    }

    /// The problem without these of its segments; what is left is numbered anew, in the old order. Values stay.
    fn without(&self, segments: Vec<usize>) -> PyResult<Self> {
        let n = self.tables.segment_count;
        if let Some(s) = segments.iter().find(|&&s| s >= n) {
            return Err(PyValueError::new_err(format!("segment {s} does not exist; there are {n}")));
        }
        let kept: Vec<usize> = (0..n).filter(|s| !segments.contains(s)).collect();
        Ok(Self {
            template: self.template.clone(),
            scene_index: kept.iter().map(|&s| self.scene_index[s]).collect(),
            tables: self.tables.only(&kept),
        })
    }

    /// The problem with further features, after the template's own: the parts of each, and their values (F, n).
    fn with_features(&self, parts: Vec<Vec<usize>>, values: PyReadonlyArray2<'_, f64>) -> PyResult<Self> {
        let (mut template, mut tables) = (self.template.clone(), self.tables.clone());
        let values = values.as_array();
        if values.shape() != [parts.len(), tables.segment_count] {
            let problem = format!("values {:?} of {} features", values.shape(), parts.len());
            return Err(PyValueError::new_err(format!("{problem}; a row each, {} columns", tables.segment_count)));
        }
        if let Some(p) = parts.iter().flatten().find(|&&p| p >= template.parts.len()) {
            return Err(PyValueError::new_err(format!("part {p} does not exist; there are {}", template.parts.len())));
        }
        for (number, (parts, row)) in parts.into_iter().zip(values.outer_iter()).enumerate() {
            let name = format!("further_{number}");
            template.features.push(model::FeatureTerm { name, feature: model::Feature::Existence, parts });
            tables.unary.push(row.to_vec());
        }
        Ok(Self { template, scene_index: self.scene_index.clone(), tables })
    }

    /// Numbers of the problem's segments among the perception's.
    #[getter]
    fn scene_segments<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        PyArray1::from_iter(py, self.scene_index.iter().map(|&s| s as i64))
    }

    fn __len__(&self) -> usize {
        self.tables.segment_count
    }

    /// Feature vectors (K, terms) of assignments (K, parts) of the problem's segments to parts, -1 for empty.
    fn features<'py>(
        &self,
        py: Python<'py>,
        assignments: PyReadonlyArray2<'_, i64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let rows = self.rows(&assignments)?;
        let values = rows.iter().flat_map(|row| self.tables.feature_vector(&self.template, row));
        PyArray1::from_iter(py, values).reshape([rows.len(), self.template.term_count()])
    }

    /// The best assignments (K, parts) by the staged search under `weights` (terms,), their scores (K,), and the gap.
    #[pyo3(signature = (weights, importance, most, **search))]
    #[allow(clippy::type_complexity)]
    fn rank<'py>(
        &self,
        py: Python<'py>,
        weights: PyReadonlyArray1<'_, f64>,
        importance: PyReadonlyArray1<'_, f64>,
        most: usize,
        search: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<(Bound<'py, PyArray2<i64>>, Bound<'py, PyArray1<f64>>, f64)> {
        let settings = search_settings(search)?;
        let weights = self.weights(&weights, &importance)?;
        let mut ranking = py.detach(|| {
            let settings = &settings.staged;
            let plans = SearchPlans::new(&self.template, &weights, settings.max_exponent);
            let plan = plans.for_size(self.tables.segment_count, settings.max_candidates);
            let free = vec![false; self.tables.segment_count];
            rank_staged(&self.template, &weights, &self.tables, plan, &free, most, settings)
        });
        ranking.candidates.truncate(most);
        let scores = PyArray1::from_iter(py, ranking.candidates.iter().map(|c| c.score));
        let rows: Vec<Assignment> = ranking.candidates.into_iter().map(|c| c.assignment).collect();
        Ok((self.array(py, &rows)?, scores, ranking.gap))
    }

    /// The `k` best of all assignments (K, parts), their scores (K,), "optimal" or "gap", the gap, and the nodes visited.
    #[pyo3(signature = (weights, k=1, budget=None))]
    #[allow(clippy::type_complexity)]
    fn solve<'py>(
        &self,
        py: Python<'py>,
        weights: PyReadonlyArray1<'_, f64>,
        k: usize,
        budget: Option<u64>,
    ) -> PyResult<(Bound<'py, PyArray2<i64>>, Bound<'py, PyArray1<f64>>, &'static str, f64, u64)> {
        let weights = self.weights(&weights, &weights)?;
        let solution = py.detach(|| self.solved(&weights, k, budget)).map_err(to_python)?;
        let scores = PyArray1::from_iter(py, solution.candidates.iter().map(|c| c.score));
        let rows: Vec<Assignment> = solution.candidates.into_iter().map(|c| c.assignment).collect();
        let status = if solution.is_optimal { "optimal" } else { "gap" };
        Ok((self.array(py, &rows)?, scores, status, solution.gap, solution.nodes))
    }

    /// The best assignment (parts,), its probability, those of each part's segments (parts, n + 1), and their error.
    #[pyo3(signature = (weights, temperature, tolerance=None, budget=None))]
    #[allow(clippy::type_complexity)]
    fn marginals<'py>(
        &self,
        py: Python<'py>,
        weights: PyReadonlyArray1<'_, f64>,
        temperature: f64,
        tolerance: Option<f64>,
        budget: Option<u64>,
    ) -> PyResult<(Bound<'py, PyArray1<i64>>, f64, Bound<'py, PyArray2<f64>>, f64)> {
        let weights = self.weights(&weights, &weights)?;
        let defaults = ExactSettings::default();
        let settings = ExactSettings {
            sum_tolerance: tolerance.unwrap_or(defaults.sum_tolerance),
            max_sum_nodes: budget.unwrap_or(defaults.max_sum_nodes),
            ..defaults
        };
        let summed = py.detach(|| -> boxwright_core::error::Result<(Assignment, Marginals)> {
            let best = self.solved(&weights, 1, None)?.candidates.swap_remove(0).assignment;
            let free = vec![false; self.tables.segment_count];
            let sums = marginals(&self.template, &weights, &self.tables, &free, &best, temperature, &settings)?;
            Ok((best, sums))
        });
        let (best, sums) = summed.map_err(to_python)?;
        let row = PyArray1::from_iter(py, best.iter().map(|s| s.map_or(-1, |s| s as i64)));
        // Empty goes last, where index -1 finds it.
        let table = sums.parts.iter().flat_map(|row| row[1..].iter().chain(&row[..1]).copied());
        let shape = [self.template.parts.len(), self.tables.segment_count + 1];
        Ok((row, sums.probability, PyArray1::from_iter(py, table).reshape(shape)?, sums.unseen))
    }

    /// What the exact search sums up: scores (parts, n + 1) of the parts alone, pairs (E, 2), their scores (E, n + 1, n + 1).
    #[allow(clippy::type_complexity)]
    fn score_tables<'py>(
        &self,
        py: Python<'py>,
        weights: PyReadonlyArray1<'_, f64>,
    ) -> PyResult<(Bound<'py, PyArray2<f64>>, Vec<(usize, usize)>, Bound<'py, PyArray3<f64>>)> {
        let weights = self.weights(&weights, &weights)?;
        let uses_relation = vec![true; self.template.relations.len()];
        let potentials = Potentials::new(&self.template, &weights, &self.tables, &uses_relation);
        let (states, edges) = (potentials.states, potentials.edges.len());
        let own = PyArray1::from_iter(py, potentials.unary.iter().flatten().copied());
        let tied = PyArray1::from_iter(py, potentials.edges.iter().flat_map(|edge| edge.values.iter().copied()));
        let pairs = potentials.edges.iter().map(|edge| (edge.first, edge.second)).collect();
        Ok((own.reshape([self.template.parts.len(), states])?, pairs, tied.reshape([edges, states, states])?))
    }

    /// The best of all assignments (parts,), its score, and how many were tried: small problems only.
    #[allow(clippy::type_complexity)]
    fn exhaustive<'py>(
        &self,
        py: Python<'py>,
        weights: PyReadonlyArray1<'_, f64>,
    ) -> PyResult<(Bound<'py, PyArray1<i64>>, f64, u64)> {
        let weights = self.weights(&weights, &weights)?;
        let (best, visited) = py.detach(|| best_exhaustive(&self.template, &weights, &self.tables));
        let row = PyArray1::from_iter(py, best.assignment.iter().map(|s| s.map_or(-1, |s| s as i64)));
        Ok((row, best.score, visited))
    }
}

impl Problem {
    fn of(template: &model::Template, set: SegmentSet) -> Self {
        Self { tables: FeatureTables::new(template, &set), template: template.clone(), scene_index: set.scene_index }
    }

    fn solved(
        &self,
        weights: &model::Weights,
        k: usize,
        budget: Option<u64>,
    ) -> boxwright_core::error::Result<Solution> {
        let defaults = ExactSettings::default();
        let settings = ExactSettings { max_nodes: budget.unwrap_or(defaults.max_nodes), ..defaults };
        let rules = Rules { most: k, floor: f64::NEG_INFINITY, accept: None };
        let free = vec![false; self.tables.segment_count];
        solve(&self.template, weights, &self.tables, &free, rules, &settings)
    }

    fn rows(&self, assignments: &PyReadonlyArray2<'_, i64>) -> PyResult<Vec<Assignment>> {
        let (n, parts) = (self.tables.segment_count, self.template.parts.len());
        let segment = |&s: &i64| match usize::try_from(s) {
            Ok(s) if s < n => Ok(Some(s)),
            Err(_) if s == -1 => Ok(None),
            _ => Err(PyValueError::new_err(format!("an assignment names segment {s}; there are {n}, and -1 is none"))),
        };
        let array = assignments.as_array();
        if array.ncols() != parts {
            let problem = format!("assignments have {} columns; the template has {parts} parts", array.ncols());
            return Err(PyValueError::new_err(problem));
        }
        array.outer_iter().map(|row| row.iter().map(segment).collect()).collect()
    }

    fn array<'py>(&self, py: Python<'py>, rows: &[Assignment]) -> PyResult<Bound<'py, PyArray2<i64>>> {
        let flat = rows.iter().flatten().map(|s| s.map_or(-1, |s| s as i64));
        PyArray1::from_iter(py, flat).reshape([rows.len(), self.template.parts.len()])
    }

    fn weights(
        &self,
        values: &PyReadonlyArray1<'_, f64>,
        importance: &PyReadonlyArray1<'_, f64>,
    ) -> PyResult<model::Weights> {
        let terms = self.template.term_count();
        let (values, importance) = (values.as_array().to_vec(), importance.as_array().to_vec());
        if values.len() != terms || importance.len() != terms {
            let problem = format!("{} weights and {} importances for {terms} terms", values.len(), importance.len());
            return Err(PyValueError::new_err(problem));
        }
        Ok(model::Weights { values, importance, accept_score: 0.0, temperature: 1.0, calibration: Default::default() })
    }
}

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_class::<Problem>()
}
