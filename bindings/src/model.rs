use boxwright_core::cloud::CloudView;
use boxwright_core::fit::KnownSize;
use boxwright_core::geometry::Vec3;
use boxwright_core::inference::SearchSettings;
use boxwright_core::model;
use boxwright_core::model::SegmentSet;
use boxwright_core::open_box::{self, Judgement, SHAPE_FEATURES};
use boxwright_core::perception::PerceptionSettings;
use boxwright_core::pipeline::{infer_views, Bodies, InputView};
use boxwright_core::{inference, pipeline};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::convert::{motion, named, rows_of_three, to_python};
use crate::perception::Perception;

/// An object's template, read from TOML text.
#[pyclass(frozen, module = "boxwright._core")]
pub struct Template {
    pub template: model::Template,
}

#[pymethods]
impl Template {
    #[new]
    fn new(toml_text: &str) -> PyResult<Self> {
        Ok(Self { template: model::Template::from_toml(toml_text).map_err(to_python)? })
    }

    #[getter]
    fn name(&self) -> &str {
        &self.template.name
    }

    #[getter]
    fn parts(&self) -> Vec<&str> {
        self.template.parts.iter().map(|part| part.name.as_str()).collect()
    }

    /// The class of each part, aligned with `parts`.
    #[getter]
    fn classes(&self) -> Vec<&str> {
        self.template.parts.iter().map(|part| part.class.as_str()).collect()
    }

    #[getter]
    fn feature_names(&self) -> Vec<&str> {
        self.template.features.iter().map(|term| term.name.as_str()).collect()
    }

    #[getter]
    fn relation_names(&self) -> Vec<&str> {
        self.template.relations.iter().map(|term| term.name.as_str()).collect()
    }

    /// Pairs of part numbers that some relation ties.
    #[getter]
    fn edges(&self) -> Vec<(usize, usize)> {
        let mut edges: Vec<(usize, usize)> =
            self.template.relations.iter().flat_map(|term| &term.pairs).map(|&(a, b)| (a.min(b), a.max(b))).collect();
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    /// Every permutation of the parts that leaves the score unchanged: `symmetries[k][p]` takes the segment of part p.
    #[getter]
    fn symmetries(&self) -> Vec<Vec<usize>> {
        self.template.symmetries.clone()
    }
}

/// A template with its weights, ready to compete for segments.
#[pyclass(frozen, module = "boxwright._core")]
pub struct ObjectModel {
    model: inference::ObjectModel,
}

#[pymethods]
impl ObjectModel {
    #[new]
    #[pyo3(signature = (template, weights_json, **search))]
    fn new(template: &Template, weights_json: &str, search: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let weights = model::Weights::from_json(weights_json, &template.template).map_err(to_python)?;
        let settings = search_settings(search)?;
        Ok(Self { model: inference::ObjectModel::new(template.template.clone(), weights, &settings.staged) })
    }
}

/// What tells templates of fitted boxes apart, read from JSON text.
#[pyclass(frozen, module = "boxwright._core")]
pub struct Kinds {
    kinds: open_box::Kinds,
}

#[pymethods]
impl Kinds {
    #[new]
    fn new(weights_json: &str) -> PyResult<Self> {
        Ok(Self { kinds: open_box::Kinds::from_json(weights_json).map_err(to_python)? })
    }
}

/// Refuses settings of the search that do not exist or do not fit, by name.
#[pyfunction]
#[pyo3(signature = (**search))]
fn check_search(search: Option<&Bound<'_, PyDict>>) -> PyResult<()> {
    search_settings(search).map(|_| ())
}

/// What was understood of a cloud.
#[pyclass(frozen, module = "boxwright._core")]
pub struct Answer {
    answer: pipeline::Answer,
}

#[pymethods]
impl Answer {
    /// The objects as JSON text, keys as in docs/formats.md.
    fn objects_json(&self) -> PyResult<Vec<String>> {
        let text = |object| serde_json::to_string(object).map_err(|error| PyValueError::new_err(error.to_string()));
        self.answer.objects.iter().map(text).collect()
    }

    /// What is known of each part of an object (EVIDENCE), none for a part that was not found or summed.
    fn evidence(&self, object: usize) -> PyResult<Vec<Option<Vec<f64>>>> {
        let known = self.answer.objects.get(object);
        let object = known.ok_or_else(|| PyValueError::new_err(format!("object {object} does not exist")))?;
        Ok((0..object.parts.len()).map(|p| object.evidence(p).map(|values| values.to_vec())).collect())
    }

    #[getter]
    fn object_labels<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i16>> {
        PyArray1::from_slice(py, &self.answer.object_of_point)
    }

    #[getter]
    fn part_labels<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i16>> {
        PyArray1::from_slice(py, &self.answer.part_of_point)
    }

    /// What each object, and each of its parts, was judged by, as JSON text: {"box": {name: value}, "parts": {part: {name: value}}}.
    fn features_json(&self) -> PyResult<Vec<String>> {
        let text = |features| serde_json::to_string(features).map_err(|error| PyValueError::new_err(error.to_string()));
        self.answer.features.iter().map(text).collect()
    }

    /// What tells the kind of each object, (objects, features) as `SHAPE_FEATURES`; NaN where no body was fitted.
    #[getter]
    fn shapes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let shapes = &self.answer.shapes;
        let nothing = [f64::NAN; SHAPE_FEATURES.len()];
        let rows = shapes.iter().flat_map(|shape| shape.map_or(nothing, |shape| shape.features()));
        PyArray1::from_iter(py, rows).reshape([shapes.len(), SHAPE_FEATURES.len()])
    }

    #[getter]
    fn free_space(&self) -> bool {
        self.answer.free_space
    }

    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.answer.warnings.clone()
    }

    /// Which candidates are no objects, and why.
    #[getter]
    fn refused(&self) -> Vec<String> {
        self.answer.refused.clone()
    }

    #[getter]
    fn stage_seconds<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let seconds = PyDict::new(py);
        self.answer.stage_seconds.iter().try_for_each(|(stage, s)| seconds.set_item(stage, s))?;
        Ok(seconds)
    }
}

pub fn search_settings(overrides: Option<&Bound<'_, PyDict>>) -> PyResult<SearchSettings> {
    SearchSettings::with_overrides(named("search", overrides)?).map_err(to_python)
}

fn known_sizes(sizes: &[(String, [f64; 3])]) -> PyResult<Vec<KnownSize>> {
    sizes.iter().map(|(name, outer_m)| KnownSize::new(name, *outer_m).map_err(to_python)).collect()
}

/// Refuses outer sizes that no box has, (name, three lengths in metres) each.
#[pyfunction]
fn check_sizes(sizes: Vec<(String, [f64; 3])>) -> PyResult<()> {
    known_sizes(&sizes).map(|_| ())
}

fn model_list(models: &[PyRef<'_, ObjectModel>]) -> Vec<inference::ObjectModel> {
    models.iter().map(|m| m.model.clone()).collect()
}

/// By what fitted boxes are judged, read once from JSON text.
#[pyclass(frozen, name = "Judgement", module = "boxwright._core")]
pub struct PyJudgement {
    judgement: Judgement,
}

#[pymethods]
impl PyJudgement {
    #[new]
    fn new(judgement_json: &str) -> PyResult<Self> {
        Ok(Self { judgement: Judgement::from_json(judgement_json).map_err(to_python)? })
    }
}

/// From a cloud to its objects in one call.
#[pyfunction]
#[pyo3(signature = (points, width, height, models, viewpoint=None, up=None, perception=None, search=None, fitted=false, kinds=None, judgement=None, sizes=Vec::new()))]
#[allow(clippy::too_many_arguments)]
fn infer(
    py: Python<'_>,
    points: PyReadonlyArray2<'_, f32>,
    width: usize,
    height: usize,
    models: Vec<PyRef<'_, ObjectModel>>,
    viewpoint: Option<[f64; 3]>,
    up: Option<[f64; 3]>,
    perception: Option<&Bound<'_, PyDict>>,
    search: Option<&Bound<'_, PyDict>>,
    fitted: bool,
    kinds: Option<&Kinds>,
    judgement: Option<&PyJudgement>,
    sizes: Vec<(String, [f64; 3])>,
) -> PyResult<(Perception, Answer)> {
    let points = rows_of_three(&points, width, height)?;
    let settings = PerceptionSettings::with_overrides(named("perception", perception)?).map_err(to_python)?;
    let settings = PerceptionSettings { up: up.map(Vec3::from), ..settings };
    let search = search_settings(search)?;
    let models = model_list(&models);
    let cloud = CloudView { points, width, height, viewpoint: viewpoint.map(Vec3::from) };
    let judgement = judgement.map(|told| &told.judgement);
    let sizes = known_sizes(&sizes)?;
    let bodies = if fitted { Bodies::Fitted(&cloud, judgement, &sizes) } else { Bodies::Rectangles };
    let kinds = kinds.map_or_else(open_box::Kinds::default, |told| told.kinds.clone());
    let inferred = py.detach(|| pipeline::infer(&cloud, &settings, &models, &search, bodies, &kinds));
    let (scene, answer) = inferred.map_err(to_python)?;
    Ok((Perception { scene, point_count: points.len() }, Answer { answer }))
}

/// A frame of a scene as Python gives it: points, width, height, viewpoint, and first_from_frame, row by row.
type PyFrame<'py> = (PyReadonlyArray2<'py, f32>, usize, usize, Option<[f64; 3]>, [[f64; 4]; 4]);

fn input_view<'a>((points, width, height, viewpoint, rows): &'a PyFrame<'_>) -> PyResult<InputView<'a>> {
    let points = rows_of_three(points, *width, *height)?;
    let cloud = CloudView { points, width: *width, height: *height, viewpoint: viewpoint.map(Vec3::from) };
    Ok(InputView { cloud, first_from_view: motion(rows) })
}

/// From several frames of one scene to its objects in one call.
#[pyfunction]
#[pyo3(signature = (frames, models, kinds, judgement=None, up=None, perception=None, sizes=Vec::new()))]
#[allow(clippy::too_many_arguments)]
fn infer_frames(
    py: Python<'_>,
    frames: Vec<PyFrame<'_>>,
    models: Vec<PyRef<'_, ObjectModel>>,
    kinds: &Kinds,
    judgement: Option<&PyJudgement>,
    up: Option<[f64; 3]>,
    perception: Option<&Bound<'_, PyDict>>,
    sizes: Vec<(String, [f64; 3])>,
) -> PyResult<(Vec<Perception>, Answer)> {
    let settings = PerceptionSettings::with_overrides(named("perception", perception)?).map_err(to_python)?;
    let settings = PerceptionSettings { up: up.map(Vec3::from), ..settings };
    let views: Vec<InputView> = frames.iter().map(input_view).collect::<PyResult<_>>()?;
    let (models, sizes) = (model_list(&models), known_sizes(&sizes)?);
    let judgement = judgement.map(|told| &told.judgement);
    let inferred = py.detach(|| infer_views(&views, &settings, &models, &kinds.kinds, judgement, &sizes));
    let (scenes, answer) = inferred.map_err(to_python)?;
    let counts = views.iter().map(|view| view.cloud.points.len());
    let seen = scenes.into_iter().zip(counts).map(|(scene, point_count)| Perception { scene, point_count });
    Ok((seen.collect(), Answer { answer }))
}

/// Understands what perception saw.
#[pyfunction]
#[pyo3(signature = (perception, models, search=None))]
fn understand(
    py: Python<'_>,
    perception: &Perception,
    models: Vec<PyRef<'_, ObjectModel>>,
    search: Option<&Bound<'_, PyDict>>,
) -> PyResult<Answer> {
    let search = search_settings(search)?;
    let models = model_list(&models);
    let (scene, count) = (&perception.scene, perception.point_count);
    let answer = py.detach(|| pipeline::understand(scene, count, &models, &search, Bodies::Rectangles));
    let answer = answer.map_err(to_python)?;
    Ok(Answer { answer })
}

/// The objects that these assignments are, best as given: `assignments` (K, parts) of the perception's segments, -1 for none.
#[pyfunction]
#[pyo3(signature = (perception, points, width, height, model, assignments, viewpoint=None, fitted=true))]
#[allow(clippy::too_many_arguments)]
fn describe(
    py: Python<'_>,
    perception: &Perception,
    points: PyReadonlyArray2<'_, f32>,
    width: usize,
    height: usize,
    model: &ObjectModel,
    assignments: Vec<Vec<i64>>,
    viewpoint: Option<[f64; 3]>,
    fitted: bool,
) -> PyResult<Answer> {
    let points = rows_of_three(&points, width, height)?;
    let cloud = CloudView { points, width, height, viewpoint: viewpoint.map(Vec3::from) };
    let (scene, parts) = (&perception.scene, model.model.template.parts.len());
    if points.len() != perception.point_count {
        let problem = format!("{} points; the perception is of {}", points.len(), perception.point_count);
        return Err(PyValueError::new_err(problem));
    }
    let all: Vec<usize> = (0..scene.segments.len()).collect();
    let set = SegmentSet::new(scene, &all);
    let mut found = Vec::new();
    for row in assignments {
        let assignment: Vec<Option<usize>> = row.iter().map(|&s| usize::try_from(s).ok()).collect();
        if assignment.len() != parts || assignment.iter().flatten().any(|&s| s >= scene.segments.len()) {
            let problem =
                format!("an assignment is {row:?}; it has {parts} of {} segments or -1", scene.segments.len());
            return Err(PyValueError::new_err(problem));
        }
        found.push((set.clone(), inference::FoundObject::of_assignment(&model.model, &set, assignment)));
    }
    let bodies = if fitted { Bodies::Fitted(&cloud, None, &[]) } else { Bodies::Rectangles };
    let models = std::slice::from_ref(&model.model);
    let answer = py.detach(|| pipeline::describe(scene, points.len(), models, &found, bodies));
    Ok(Answer { answer })
}

pub fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add("EVIDENCE", PyTuple::new(m.py(), model::EVIDENCE)?)?;
    m.add_class::<Template>()?;
    m.add_class::<ObjectModel>()?;
    m.add_class::<Answer>()?;
    m.add_class::<Kinds>()?;
    m.add_class::<PyJudgement>()?;
    m.add("SHAPE_FEATURES", SHAPE_FEATURES.to_vec())?;
    m.add_function(wrap_pyfunction!(check_search, m)?)?;
    m.add_function(wrap_pyfunction!(check_sizes, m)?)?;
    m.add_function(wrap_pyfunction!(infer, m)?)?;
    m.add_function(wrap_pyfunction!(infer_frames, m)?)?;
    m.add_function(wrap_pyfunction!(describe, m)?)?;
    m.add_function(wrap_pyfunction!(understand, m)?)
}
