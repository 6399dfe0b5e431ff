//! Quasi-static lines over numpy arrays.

use crate::errors::{detached, engine_error};
use crate::interruptible::make_each;
use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use windlass_catenary::{
    CatenaryWarmStart, EndForces, FlatBottom, Joint, Line as Engine, LineError, LineForces, SeabedModel, Segment,
};

/// Lines that a core takes at once: the share of one is then far above what handing it out costs.
const LINES_A_TASK: usize = 256;
/// Most lines that one core takes without looking for Ctrl-C: some ten milliseconds.
const LINES_AT_ONCE: usize = 1 << 14;

/// A column of input: one value for all lines, or one a line.
struct Input<'a> {
    name: &'static str,
    values: &'a [f64],
}

impl Input<'_> {
    #[inline]
    fn get(&self, at: usize) -> f64 {
        match self.values {
            [one] => *one,
            many => many.get(at).copied().unwrap_or(f64::NAN),
        }
    }
}

/// How many lines columns are of.
fn count(inputs: &[Input<'_>]) -> PyResult<usize> {
    let longest = inputs.iter().find(|input| input.values.len() != 1);
    let count = longest.map_or(1, |input| input.values.len());
    match inputs.iter().find(|input| ![1, count].contains(&input.values.len())) {
        Some(other) => {
            let (a, b) = (longest.map_or("x", |input| input.name), other.name);
            let text = format!("{a} has {count} values and {b} has {}", other.values.len());
            Err(PyValueError::new_err(text))
        }
        None => Ok(count),
    }
}

fn contiguous<'a>(name: &'static str, array: &'a PyReadonlyArray1<'_, f64>) -> PyResult<Input<'a>> {
    let values = array.as_slice().map_err(|_| PyValueError::new_err(format!("{name} is not contiguous")))?;
    Ok(Input { name, values })
}

/// Columns of results under their names; a line without an answer is NaN in all of them.
struct Columns<'py> {
    made: Bound<'py, PyDict>,
}

impl<'py> Columns<'py> {
    fn new(py: Python<'py>) -> Self {
        Columns { made: PyDict::new(py) }
    }

    fn add(&self, name: &str, values: Vec<f64>) -> PyResult<()> {
        self.made.set_item(name, values.into_pyarray(self.made.py()))
    }
}

/// A number of an answer, or NaN.
fn column<T, E>(solved: &[Result<T, E>], number: impl Fn(&T) -> f64) -> Vec<f64> {
    solved.iter().map(|answer| answer.as_ref().map_or(f64::NAN, &number)).collect()
}

/// The failed lines: their numbers from 0 and why. With `raise` the first of them is an exception.
fn failures<T, E: std::fmt::Display>(
    py: Python<'_>,
    solved: &[Result<T, E>],
    raise: bool,
) -> PyResult<Vec<(usize, String)>> {
    let failed = solved.iter().enumerate().filter_map(|(at, answer)| Some((at, answer.as_ref().err()?)));
    named(py, solved.len(), failed, raise)
}

/// Failed ones of so many lines, as [`failures`] has them.
fn named<'a, E: std::fmt::Display + 'a>(
    py: Python<'_>,
    count: usize,
    mut failed: impl Iterator<Item = (usize, &'a E)>,
    raise: bool,
) -> PyResult<Vec<(usize, String)>> {
    if raise {
        let Some((at, error)) = failed.next() else { return Ok(Vec::new()) };
        let more = failed.count();
        let more = if more > 0 { format!(", and {more} lines more have no answer") } else { String::new() };
        let text = if count == 1 { error.to_string() } else { format!("line {at}: {error}{more}") };
        return Err(engine_error(py, text));
    }
    Ok(failed.map(|(at, error)| (at, error.to_string())).collect())
}

fn add_pulls<'py>(columns: &Columns<'py>, solved: &[Result<LineForces, LineError>], stiffness: bool) -> PyResult<()> {
    columns.add("h", column(solved, |f| f.fairlead[0]))?;
    columns.add("v", column(solved, |f| f.fairlead[1]))?;
    columns.add("anchor_h", column(solved, |f| f.anchor[0]))?;
    columns.add("anchor_v", column(solved, |f| f.anchor[1]))?;
    if stiffness {
        for (row, names) in [["kxx", "kxz"], ["kzx", "kzz"]].into_iter().enumerate() {
            for (at, name) in names.into_iter().enumerate() {
                columns.add(name, column(solved, |f| f.stiffness[row][at]))?;
            }
        }
    }
    Ok(())
}

type Solved<'py> = (Bound<'py, PyDict>, Vec<(usize, String)>);

/// Single lines between an anchor at (0, 0) and a fairlead at (x, z): columns of results, and the lines that failed.
#[pyfunction]
#[pyo3(signature = (x, z, length, ea, w, friction, *, seabed, stiffness, raise_, threads))]
#[allow(clippy::too_many_arguments, reason = "the arguments of the Python function")]
pub fn solve<'py>(
    py: Python<'py>,
    x: PyReadonlyArray1<'py, f64>,
    z: PyReadonlyArray1<'py, f64>,
    length: PyReadonlyArray1<'py, f64>,
    ea: PyReadonlyArray1<'py, f64>,
    w: PyReadonlyArray1<'py, f64>,
    friction: PyReadonlyArray1<'py, f64>,
    seabed: bool,
    stiffness: bool,
    raise_: bool,
    threads: usize,
) -> PyResult<Solved<'py>> {
    let inputs = [
        contiguous("x", &x)?,
        contiguous("z", &z)?,
        contiguous("length", &length)?,
        contiguous("ea", &ea)?,
        contiguous("w", &w)?,
        contiguous("friction", &friction)?,
    ];
    let count = count(&inputs)?;
    let [x, z, length, ea, w, friction] = &inputs;
    let solve = |at: usize| -> Result<EndForces, LineError> {
        let segment = Segment { length: length.get(at), weight: w.get(at), ea: ea.get(at) };
        let bottom = seabed.then(|| FlatBottom { friction: friction.get(at) });
        segment.solve_end_forces(x.get(at), z.get(at), bottom)
    };
    let pulls = |f: &EndForces| [f.fairlead[0], f.fairlead[1], f.anchor[0], f.anchor[1], f.grounded];
    if !stiffness {
        let names = ["h", "v", "anchor_h", "anchor_v", "grounded"];
        return solve_rows(py, count, (threads, raise_), names, |at| solve(at).map(|f| pulls(&f)));
    }
    let names = ["h", "v", "anchor_h", "anchor_v", "grounded", "kxx", "kxz", "kzx", "kzz"];
    solve_rows(py, count, (threads, raise_), names, |at| {
        solve(at).map(|f| {
            let ([h, v, anchor_h, anchor_v, grounded], [[kxx, kxz], [kzx, kzz]]) = (pulls(&f), f.stiffness);
            [h, v, anchor_h, anchor_v, grounded, kxx, kxz, kzx, kzz]
        })
    })
}

/// Columns of what is found of each of so many lines. On one core a batch that takes some milliseconds goes straight into its columns, on the
/// thread of its caller: rows of all lines and a thread of its own would take it a tenth longer. Rows hold no more than is asked for.
fn solve_rows<'py, const N: usize>(
    py: Python<'py>,
    count: usize,
    (threads, raise): (usize, bool),
    names: [&str; N],
    row: impl Fn(usize) -> Result<[f64; N], LineError> + Sync + Send,
) -> PyResult<Solved<'py>> {
    let columns = Columns::new(py);
    if threads == 1 && count <= LINES_AT_ONCE {
        let (made, failed) = detached(py, || {
            let mut made: [Vec<f64>; N] = std::array::from_fn(|_| Vec::with_capacity(count));
            let mut failed = Vec::new();
            for at in 0..count {
                let found = row(at).unwrap_or_else(|error| {
                    failed.push((at, error));
                    [f64::NAN; N]
                });
                made.iter_mut().zip(found).for_each(|(column, value)| column.push(value));
            }
            (made, failed)
        })?;
        let failed = named(py, count, failed.iter().map(|(at, error)| (*at, error)), raise)?;
        for (name, column) in names.into_iter().zip(made) {
            columns.add(name, column)?;
        }
        return Ok((columns.made, failed));
    }
    let solved = make_each(py, count, (threads, LINES_A_TASK), |at| row(at).map_err(Box::new))?;
    let failed = failures(py, &solved, raise)?;
    for (index, name) in names.into_iter().enumerate() {
        columns.add(name, column(&solved, |row| row[index]))?;
    }
    Ok((columns.made, failed))
}

/// A line of segments with what stands between them.
#[pyclass(frozen, module = "windlass.catenary")]
#[derive(Clone)]
pub struct Line {
    /// The engine's line.
    pub engine: Engine,
}

fn joint(given: &Bound<'_, PyAny>) -> PyResult<Joint> {
    if given.is_none() {
        return Ok(Joint::Free);
    }
    let refuse = || {
        PyValueError::new_err(
            "a joint is None, ('weight', N), ('buoy', lift N, weight N) or ('spring buoy', capacity N, depth m)",
        )
    };
    let words: Vec<Bound<'_, PyAny>> = given.extract().map_err(|_| refuse())?;
    let kind: String = words.first().and_then(|word| word.extract().ok()).ok_or_else(refuse)?;
    let numbers: PyResult<Vec<f64>> = words.iter().skip(1).map(|word| word.extract()).collect();
    match (kind.as_str(), numbers?.as_slice()) {
        ("weight", [weight]) => Ok(Joint::Weight(*weight)),
        ("buoy", [lift, weight]) => Ok(Joint::Buoy { lift: *lift, weight: *weight }),
        ("spring buoy", [capacity, depth]) => Ok(Joint::SpringBuoy { capacity: *capacity, depth: *depth }),
        _ => Err(refuse()),
    }
}

#[pymethods]
impl Line {
    #[new]
    #[pyo3(signature = (segments, *, anchor, joints = None, surface = 0.0, seabed = true, slope = 0.0, friction = 0.0))]
    #[allow(clippy::too_many_arguments, reason = "the arguments of the Python class")]
    fn new(
        py: Python<'_>,
        segments: Vec<(f64, f64, f64)>,
        anchor: f64,
        joints: Option<Vec<Bound<'_, PyAny>>>,
        surface: f64,
        seabed: bool,
        slope: f64,
        friction: f64,
    ) -> PyResult<Self> {
        let count = segments.len();
        let segments = segments.into_iter().map(|(length, weight, ea)| Segment { length, weight, ea }).collect();
        let joints = match joints {
            None => vec![Joint::Free; count.saturating_sub(1)],
            Some(given) => given.iter().map(joint).collect::<PyResult<Vec<Joint>>>()?,
        };
        let floor = seabed.then_some(SeabedModel { elevation: anchor, slope, friction });
        let made = || Engine::new(segments, joints, anchor, surface).and_then(|line| line.with_seabed(floor));
        let engine = detached(py, made)?;
        engine.map(|engine| Line { engine }).map_err(|error| engine_error(py, error))
    }

    /// Unstretched length (m).
    #[getter]
    fn length(&self) -> f64 {
        self.engine.length()
    }

    /// Elevation of the anchor (m).
    #[getter]
    fn anchor(&self) -> f64 {
        self.engine.anchor()
    }

    /// Forces with the fairlead `x` beside the anchor at the elevation `z`: columns of results, and the lines that failed.
    #[pyo3(signature = (x, z, *, stiffness, raise_, threads))]
    fn _solve<'py>(
        &self,
        py: Python<'py>,
        x: PyReadonlyArray1<'py, f64>,
        z: PyReadonlyArray1<'py, f64>,
        stiffness: bool,
        raise_: bool,
        threads: usize,
    ) -> PyResult<Solved<'py>> {
        let inputs = [contiguous("x", &x)?, contiguous("z", &z)?];
        let count = count(&inputs)?;
        let [x, z] = &inputs;
        let solved = make_each(py, count, (threads, LINES_A_TASK), |at| -> Result<LineForces, LineError> {
            // each is found as if nothing were known, so that the order of the places does not show
            let mut warm: Option<CatenaryWarmStart> = None;
            self.engine.solve_forces(x.get(at), z.get(at), &mut warm)
        })?;
        let failed = failures(py, &solved, raise_)?;
        let columns = Columns::new(py);
        add_pulls(&columns, &solved, stiffness)?;
        Ok((columns.made, failed))
    }

    /// The shape between its ends: unstretched length from the fairlead, distance from the fairlead, elevation, tension, by columns.
    #[pyo3(signature = (x, z, *, points = 20))]
    fn shape<'py>(&self, py: Python<'py>, x: f64, z: f64, points: usize) -> PyResult<Bound<'py, PyDict>> {
        if points > MAX_SHAPE_POINTS {
            return Err(PyValueError::new_err(format!("at most {MAX_SHAPE_POINTS} points a segment")));
        }
        let shape = detached(py, || self.engine.at_distance(x, z).map(|state| self.engine.shape(&state, points)))?;
        let shape = shape.map_err(|error| engine_error(py, error))?;
        let columns = Columns::new(py);
        columns.add("arc", shape.iter().map(|point| point.arc).collect())?;
        columns.add("x", shape.iter().map(|point| point.x).collect())?;
        columns.add("z", shape.iter().map(|point| point.z).collect())?;
        columns.add("tension", shape.iter().map(|point| point.tension()).collect())?;
        columns.made.set_item("on_bottom", on_bottom(py, shape.iter().map(|point| point.on_bottom).collect()))?;
        Ok(columns.made)
    }

    /// The distance from the anchor (m) at which the tension at a fairlead of elevation `z` is as wanted (N).
    fn distance_at_tension(&self, py: Python<'_>, tension: f64, z: f64) -> PyResult<f64> {
        let state = detached(py, || self.engine.at_tension(tension, z))?;
        state.map(|state| state.x).map_err(|error| engine_error(py, error))
    }

    fn __repr__(&self) -> String {
        format!("<windlass.catenary.Line of {} segments, {} m>", self.engine.segments().len(), self.engine.length())
    }
}

/// Points of a shape between the ends of a segment.
const MAX_SHAPE_POINTS: usize = 100_000;

fn on_bottom(py: Python<'_>, values: Vec<bool>) -> Bound<'_, PyArray1<bool>> {
    values.into_pyarray(py)
}
