//! Dynamic lines whose fairleads the caller moves.

use crate::errors::{detached, engine_error};
use crate::interruptible;
use nalgebra::Vector3;
use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray2, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use windlass::hosted::LineWater;
use windlass_line_dynamics::{
    CoupledLine, CoupledLines, PlaneBottom, Rod, RodSegment, SeabedLaw, Surroundings, UniformFluid,
};

/// Steps of all lines up to which a call is short: it is not stopped by Ctrl-C.
const SHORT_STEPS: f64 = 20.0;

/// Lines at rest or on their way.
#[pyclass(frozen, module = "windlass.dynamics")]
pub struct Dynamics {
    inner: Mutex<CoupledLines>,
    /// Set at Ctrl-C.
    stop: Arc<AtomicBool>,
}

/// A number of a description by its name; one that is missing has its usual value, or is an error.
struct Described<'py> {
    of: Bound<'py, PyDict>,
    place: String,
    known: Vec<&'static str>,
}

impl<'py> Described<'py> {
    fn new(of: Bound<'py, PyDict>, place: String) -> Self {
        Described { of, place, known: Vec::new() }
    }

    fn number(&mut self, name: &'static str, usual: Option<f64>) -> PyResult<f64> {
        self.known.push(name);
        match (self.of.get_item(name)?, usual) {
            (Some(value), _) => {
                value.extract().map_err(|_| PyValueError::new_err(format!("{}: {name} is no number", self.place)))
            }
            (None, Some(usual)) => Ok(usual),
            (None, None) => Err(PyValueError::new_err(format!("{}: {name} is missing", self.place))),
        }
    }

    fn whole(&mut self, name: &'static str, usual: usize) -> PyResult<usize> {
        self.known.push(name);
        match self.of.get_item(name)? {
            Some(value) => {
                value.extract().map_err(|_| PyValueError::new_err(format!("{}: {name} is no whole number", self.place)))
            }
            None => Ok(usual),
        }
    }

    fn point(&mut self, name: &'static str) -> PyResult<Vector3<f64>> {
        self.known.push(name);
        let given = self.of.get_item(name)?;
        let given = given.ok_or_else(|| PyValueError::new_err(format!("{}: {name} is missing", self.place)))?;
        let numbers: [f64; 3] =
            given.extract().map_err(|_| PyValueError::new_err(format!("{}: {name} is no x, y, z", self.place)))?;
        Ok(numbers.into())
    }

    /// Refuses names that were not asked for.
    fn finish(&self) -> PyResult<()> {
        for name in self.of.keys() {
            let name: String = name.extract()?;
            if !self.known.contains(&name.as_str()) {
                let near = windlass_base::diagnostic::suggest(&name, self.known.iter().copied());
                let help = near.map_or(String::new(), |near| format!(": {near}"));
                return Err(PyValueError::new_err(format!("{}: `{name}` is no property of a line{help}", self.place)));
            }
        }
        Ok(())
    }
}

/// A line by its properties.
fn line(py: Python<'_>, number: usize, given: &Bound<'_, PyDict>) -> PyResult<CoupledLine> {
    let mut of = Described::new(given.clone(), format!("line {number}"));
    let (length, elements) = (of.number("length", None)?, of.whole("elements", 50)?);
    let (mass, ea, diameter) = (of.number("mass", None)?, of.number("ea", None)?, of.number("diameter", None)?);
    let segment = RodSegment {
        axial_damping: of.number("axial_damping", Some(0.0))?,
        bending: of.number("ei", Some(0.0))?,
        drag_normal: of.number("cd_normal", None)?,
        drag_tangential: of.number("cd_axial", None)?,
        added_normal: of.number("ca_normal", None)?,
        added_tangential: of.number("ca_axial", None)?,
        ..RodSegment::line(length, elements, mass, ea, diameter)
    };
    let (anchor, fairlead) = (of.point("anchor")?, of.point("fairlead")?);
    of.finish()?;
    let finite = |at: &Vector3<f64>| at.iter().all(|c| c.is_finite());
    if !(finite(&anchor) && finite(&fairlead)) {
        return Err(PyValueError::new_err(format!("line {number}: an end is not finite")));
    }
    let rod = Rod::new(&format!("line {number}"), vec![segment], vec![]).map_err(|error| engine_error(py, error))?;
    Ok(CoupledLine { rod, anchor, fairlead })
}

fn vectors(name: &str, given: &PyReadonlyArray2<'_, f64>) -> PyResult<Vec<Vector3<f64>>> {
    if given.shape().get(1) != Some(&3) {
        return Err(PyValueError::new_err(format!("{name} has the shape {:?}: a row x, y, z a line", given.shape())));
    }
    let row = |row: numpy::ndarray::ArrayView1<'_, f64>| Vector3::from_iterator(row.iter().copied());
    Ok(given.as_array().rows().into_iter().map(row).collect())
}

fn rows<'py>(py: Python<'py>, list: &[Vector3<f64>]) -> Bound<'py, PyArray2<f64>> {
    Array2::from_shape_fn((list.len(), 3), |(row, at)| {
        list.get(row).and_then(|v| v.get(at)).copied().unwrap_or(f64::NAN)
    })
    .into_pyarray(py)
}

impl Dynamics {
    fn read<T>(&self, read: impl FnOnce(&CoupledLines) -> T) -> PyResult<T> {
        let inner = self.inner.try_lock();
        let inner = inner.map_err(|_| PyRuntimeError::new_err("the lines are at work in another thread"))?;
        Ok(read(&inner))
    }
}

#[pymethods]
impl Dynamics {
    #[new]
    #[pyo3(signature = (lines, *, depth, density, gravity, current, environment, seabed_stiffness, seabed_damping, friction, dt))]
    #[allow(clippy::too_many_arguments, reason = "the arguments of the Python class")]
    fn new(
        py: Python<'_>,
        lines: Vec<Bound<'_, PyDict>>,
        depth: Option<f64>,
        density: f64,
        gravity: f64,
        current: [f64; 3],
        environment: Option<String>,
        seabed_stiffness: f64,
        seabed_damping: f64,
        friction: f64,
        dt: f64,
    ) -> PyResult<Self> {
        let lowest = |name: &str, value: f64| {
            let refused = format!("{name} is {value}: it is zero or more");
            if value >= 0.0 && value.is_finite() { Ok(value) } else { Err(PyValueError::new_err(refused)) }
        };
        for (name, value) in [
            ("density", density),
            ("gravity", gravity),
            ("seabed_stiffness", seabed_stiffness),
            ("seabed_damping", seabed_damping),
            ("friction", friction),
        ] {
            lowest(name, value)?;
        }
        if current.iter().chain(&depth).any(|c| !c.is_finite()) {
            return Err(PyValueError::new_err("the current or the depth is not finite"));
        }
        if let Some(depth) = depth.filter(|depth| *depth <= 0.0) {
            return Err(PyValueError::new_err(format!(
                "depth is {depth}: it is more than zero, or None without a bottom"
            )));
        }
        let law = SeabedLaw {
            damping: seabed_damping,
            friction_along: friction,
            friction_across: friction,
            ..SeabedLaw::elastic(seabed_stiffness)
        };
        let water = LineWater { depth, density, gravity };
        let ambient = environment.map(|options| detached(py, || water.ambient(&options))).transpose()?;
        let ambient = ambient.transpose().map_err(|error| engine_error(py, error.rendered.trim_end()))?;
        let around = Surroundings {
            ambient,
            water: UniformFluid::moving(density, current.into()),
            bottom: depth.map(|depth| (PlaneBottom { height: -depth, slope: [0.0; 2] }, law)),
            gravity,
        };
        let made: PyResult<Vec<CoupledLine>> =
            lines.iter().enumerate().map(|(at, given)| line(py, at + 1, given)).collect();
        let made = made?;
        let stop = Arc::new(AtomicBool::new(false));
        let make = || CoupledLines::with_interrupt(made, around, dt, Arc::clone(&stop));
        let inner = interruptible::run(py, &stop, make)?.map_err(|error| engine_error(py, error))?;
        Ok(Dynamics { inner: Mutex::new(inner), stop })
    }

    /// Takes the lines to a time (s) with their fairleads at `x` (m) moving at `v` (m/s), a row each; the force of each on its fairlead (N).
    fn step<'py>(
        &self,
        py: Python<'py>,
        t: f64,
        x: PyReadonlyArray2<'py, f64>,
        v: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let (x, v) = (vectors("x", &x)?, vectors("v", &v)?);
        let inner = self.inner.try_lock();
        let mut inner = inner.map_err(|_| PyRuntimeError::new_err("the lines are at work in another thread"))?;
        let lines = &mut *inner;
        // most steps of a coupling are short: no thread is begun for those
        self.stop.store(false, Ordering::Relaxed);
        let steps = (t - lines.time()) / lines.longest_step() * lines.len() as f64;
        let stepped = if steps <= SHORT_STEPS {
            detached(py, || lines.step(t, &x, &v))?
        } else {
            interruptible::run(py, &self.stop, || lines.step(t, &x, &v))?
        };
        stepped.map_err(|error| engine_error(py, error))?;
        Ok(rows(py, &inner.fairlead_forces()))
    }

    /// The time at which the lines are (s).
    #[getter]
    fn time(&self) -> PyResult<f64> {
        self.read(CoupledLines::time)
    }

    /// The force of each line on its fairlead (N), a row each.
    #[getter]
    fn forces<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        Ok(rows(py, &self.read(CoupledLines::fairlead_forces)?))
    }

    /// The force of each line on its anchor (N), a row each.
    #[getter]
    fn anchor_forces<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        Ok(rows(py, &self.read(CoupledLines::anchor_forces)?))
    }

    /// Where each fairlead is (m), a row each.
    #[getter]
    fn fairleads<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        Ok(rows(py, &self.read(CoupledLines::fairleads)?))
    }

    /// Where the nodes of a line (from 0) are (m), from its fairlead, a row each.
    fn nodes<'py>(&self, py: Python<'py>, line: isize) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let count = self.read(CoupledLines::len)?;
        // from the last one, as lists count
        let at = usize::try_from(line).ok().or_else(|| count.checked_sub(line.unsigned_abs())).unwrap_or(count);
        let nodes = self.read(|lines| lines.node_positions(at))?;
        nodes
            .map(|nodes| rows(py, &nodes))
            .ok_or_else(|| pyo3::exceptions::PyIndexError::new_err(format!("there is no line {line}")))
    }

    fn __len__(&self) -> PyResult<usize> {
        self.read(CoupledLines::len)
    }

    fn __repr__(&self) -> PyResult<String> {
        self.read(|lines| format!("<windlass.Dynamics of {} lines at {} s>", lines.len(), lines.time()))
    }
}
