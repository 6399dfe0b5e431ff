//! Quasi-static lines on one body: their wrench and its stiffness at many poses.

use crate::catenary::Line;
use crate::errors::engine_error;
use crate::interruptible::make_each;
use nalgebra::{Matrix3, Matrix6, Rotation3, Vector3, Vector6};
use numpy::ndarray::{Array2, Array3};
use numpy::{IntoPyArray, PyArray2, PyArray3, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use windlass_catenary::{LineError, LineForces};

/// Poses that a core takes at once.
const POSES_A_TASK: usize = 16;

/// A line between an anchor in the ground and a point of the body.
struct Mooring {
    line: windlass_catenary::Line,
    /// Global (m).
    anchor: Vector3<f64>,
    /// In the axes of the body (m).
    fairlead: Vector3<f64>,
}

/// Lines on one body.
#[pyclass(frozen, module = "windlass.catenary")]
pub struct System {
    moorings: Vec<Mooring>,
}

/// What the lines do to the body at one pose.
struct Held {
    /// Force and moment about the origin of the body (N, N m, global axes).
    wrench: Vector6<f64>,
    /// -d(wrench)/d(small motion of the body): translation, rotation about its origin (global axes).
    stiffness: Matrix6<f64>,
    /// Tension of each line at its fairlead (N).
    tensions: Vec<f64>,
}

/// The matrix of `v x`.
fn cross(v: &Vector3<f64>) -> Matrix3<f64> {
    v.cross_matrix()
}

impl Mooring {
    /// Force on the fairlead and -d(force)/d(place of the fairlead), by global axes.
    fn pull(&self, at: &Vector3<f64>) -> Result<(Vector3<f64>, Matrix3<f64>, f64), LineError> {
        let away = (at - self.anchor).xy();
        let distance = away.norm();
        let LineForces { fairlead: [h, v], stiffness: [[hx, hz], [vx, vz]], .. } =
            self.line.solve_forces(distance, at.z, &mut None)?;
        let out = if distance > 0.0 { away / distance } else { nalgebra::Vector2::x() };
        let radial = Vector3::new(out.x, out.y, 0.0);
        let across = Vector3::new(-out.y, out.x, 0.0);
        // straight above its anchor a line turns with its fairlead: H over the distance is there its slope
        let turning = if distance > 0.0 { h / distance } else { hx };
        let z = Vector3::z();
        let force = -radial * h - z * v;
        let stiffness = radial * radial.transpose() * hx
            + across * across.transpose() * turning
            + radial * z.transpose() * hz
            + z * radial.transpose() * vx
            + z * z.transpose() * vz;
        Ok((force, stiffness, h.hypot(v)))
    }
}

impl System {
    fn hold(&self, pose: &[f64; 6]) -> Result<Held, (usize, LineError)> {
        let [x, y, z, roll, pitch, yaw] = *pose;
        let (origin, turn) = (Vector3::new(x, y, z), Rotation3::from_euler_angles(roll, pitch, yaw));
        let mut held = Held { wrench: Vector6::zeros(), stiffness: Matrix6::zeros(), tensions: Vec::new() };
        for (number, mooring) in self.moorings.iter().enumerate() {
            let arm = turn * mooring.fairlead;
            let (force, k, tension) = mooring.pull(&(origin + arm)).map_err(|error| (number, error))?;
            let arm_cross = cross(&arm);
            held.wrench += Vector6::from_iterator(force.iter().chain(arm.cross(&force).iter()).copied());
            let mut add = |row: usize, column: usize, block: Matrix3<f64>| {
                let mut part = held.stiffness.fixed_view_mut::<3, 3>(row, column);
                part += block;
            };
            // the place moves by -arm x for a small rotation; the moment also by the turn of the arm itself
            add(0, 0, k);
            add(0, 3, -k * arm_cross);
            add(3, 0, arm_cross * k);
            add(3, 3, -arm_cross * k * arm_cross - cross(&force) * arm_cross);
            held.tensions.push(tension);
        }
        Ok(held)
    }

    /// All poses, on all cores; the first that fails is an exception.
    fn hold_all(&self, py: Python<'_>, poses: &PyReadonlyArray2<'_, f64>) -> PyResult<Vec<Held>> {
        if poses.shape().get(1) != Some(&6) {
            let text = format!("poses have the shape {:?}: a row x, y, z, roll, pitch, yaw each", poses.shape());
            return Err(PyValueError::new_err(text));
        }
        let row = |row: numpy::ndarray::ArrayView1<'_, f64>| -> [f64; 6] {
            std::array::from_fn(|at| row.get(at).copied().unwrap_or(f64::NAN))
        };
        let poses: Vec<[f64; 6]> = poses.as_array().rows().into_iter().map(row).collect();
        let hold = |at: usize| poses.get(at).map(|pose| self.hold(pose));
        let held = make_each(py, poses.len(), (0, POSES_A_TASK), hold)?.into_iter().flatten();
        let named = |(at, held): (usize, Result<Held, (usize, LineError)>)| {
            held.map_err(|(line, error)| engine_error(py, format!("pose {at}, line {line}: {error}")))
        };
        held.enumerate().map(named).collect()
    }
}

#[pymethods]
impl System {
    #[new]
    fn new(lines: Vec<PyRef<'_, Line>>, anchors: Vec<[f64; 2]>, fairleads: Vec<[f64; 3]>) -> PyResult<Self> {
        let counts = [lines.len(), anchors.len(), fairleads.len()];
        if counts.iter().any(|count| *count != lines.len()) {
            let [a, b, c] = counts;
            return Err(PyValueError::new_err(format!("{a} lines have {b} anchors and {c} fairleads")));
        }
        if anchors.iter().flatten().chain(fairleads.iter().flatten()).any(|c| !c.is_finite()) {
            return Err(PyValueError::new_err("an anchor or a fairlead is not finite"));
        }
        let mooring = |((line, [x, y]), fairlead): ((PyRef<'_, Line>, [f64; 2]), [f64; 3])| Mooring {
            anchor: Vector3::new(x, y, line.engine.anchor()),
            line: line.engine.clone(),
            fairlead: fairlead.into(),
        };
        Ok(System { moorings: lines.into_iter().zip(anchors).zip(fairleads).map(mooring).collect() })
    }

    /// Force and moment about the origin of the body (N, N m, global axes) at each pose: an array of n by 6.
    fn _wrench<'py>(&self, py: Python<'py>, poses: PyReadonlyArray2<'py, f64>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let held = self.hold_all(py, &poses)?;
        let entry = |(row, at): (usize, usize)| held.get(row).and_then(|h| h.wrench.get(at)).copied();
        Ok(Array2::from_shape_fn((held.len(), 6), |at| entry(at).unwrap_or(f64::NAN)).into_pyarray(py))
    }

    /// -d(wrench)/d(small motion) at each pose: an array of n by 6 by 6.
    fn _stiffness<'py>(
        &self,
        py: Python<'py>,
        poses: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let held = self.hold_all(py, &poses)?;
        let entry = |(row, i, j): (usize, usize, usize)| held.get(row).and_then(|h| h.stiffness.get((i, j))).copied();
        Ok(Array3::from_shape_fn((held.len(), 6, 6), |at| entry(at).unwrap_or(f64::NAN)).into_pyarray(py))
    }

    /// Tension of each line at its fairlead (N) at each pose: an array of n by lines.
    fn _tensions<'py>(
        &self,
        py: Python<'py>,
        poses: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let held = self.hold_all(py, &poses)?;
        let entry = |(row, at): (usize, usize)| held.get(row).and_then(|h| h.tensions.get(at)).copied();
        let shape = (held.len(), self.moorings.len());
        Ok(Array2::from_shape_fn(shape, |at| entry(at).unwrap_or(f64::NAN)).into_pyarray(py))
    }

    fn __len__(&self) -> usize {
        self.moorings.len()
    }

    fn __repr__(&self) -> String {
        format!("<windlass.catenary.System of {} lines>", self.moorings.len())
    }
}
