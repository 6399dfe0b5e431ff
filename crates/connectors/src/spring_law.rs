//! The one-dimensional laws of a zero-length spring: springs in series, dashpots, friction against a velocity.
//!
//! Source: [MOSES-FLEX -X_PY, -X_DAMPING, -FRICTION].

use super::options::X_DAMPING;
use super::viscous::{Affine, ViscoelasticLaw};
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};
use windlass_base::values::{Args, Given};
use windlass_language::spec::OptionSpec;

/// Velocity below which a dashpot of an exponent below one is linear (m/s): its slope is without bound at rest.
const LINEAR_DASHPOT_SPEED: f64 = 1e-3;
/// Velocity at which friction against a velocity has 71 per cent of its value (m/s): at rest it has no direction.
pub const FRICTION_REFERENCE_SPEED: f64 = 0.01;

/// A secant and a slope of a law that only knows a size: force over deflection, and its derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Sized {
    secant: f64,
    slope: f64,
}

/// Springs in series, the same both ways: force against deflection in straight pieces from zero; the last slope goes on.
#[derive(Clone, Debug, PartialEq)]
pub struct Elastic {
    /// (force, deflection), growing deflections.
    points: Vec<(f64, f64)>,
}

impl Elastic {
    /// A spring (N/m or N m/rad), in series with a P-Y curve of points (force, deflection), where one is given.
    pub fn new(stiffness: f64, curve: Option<&[(f64, f64)]>) -> Self {
        let curve = curve.unwrap_or_default().iter().filter(|(p, _)| *p > 0.0);
        let mut points: Vec<(f64, f64)> = curve.map(|(p, y)| (*p, y + p / stiffness)).collect();
        if points.is_empty() {
            points.push((stiffness, 1.0));
        }
        Elastic { points }
    }

    /// Its stiffness (N/m or N m/rad), where it is the same at every deflection.
    pub fn constant_stiffness(&self) -> Option<f64> {
        match self.points.as_slice() {
            [(force, deflection)] => Some(force / deflection),
            _ => None,
        }
    }

    /// A force by its own points (force N, deflection m): deflections grow, forces may fall; the origin is passed over.
    pub fn from_curve(curve: &[(f64, f64)]) -> Self {
        Elastic { points: curve.iter().copied().filter(|(_, y)| *y > 0.0).collect() }
    }

    /// Force at a deflection >= 0 with a further spring of this compliance (m/N) in series.
    fn force(&self, deflection: f64, compliance: f64) -> Sized {
        let (mut from, mut force, mut slope) = ((0.0, 0.0), 0.0, 0.0);
        for (p, y) in &self.points {
            let to = (*p, y + compliance * p);
            slope = (to.0 - from.0) / (to.1 - from.1);
            force = from.0 + slope * (deflection - from.1);
            if deflection <= to.1 {
                break;
            }
            from = to;
        }
        Sized { secant: if deflection > 0.0 { force / deflection } else { slope }, slope }
    }
}

/// A nonlinear dashpot: F = Co v**Ex up to Fo.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dashpot {
    /// Coefficient (N (s/m)**Ex).
    pub coefficient: f64,
    /// Exponent.
    pub exponent: f64,
    /// Largest force (N); infinite where none is given.
    pub most: f64,
}

impl Dashpot {
    /// That of an option `Co Ex Fo`.
    pub fn read(args: &Args, option: &OptionSpec) -> Option<Dashpot> {
        args.option_if_declared(option).and_then(Dashpot::from_given)
    }

    /// From the values of a dashpot's option, that of any axis.
    pub fn from_given(given: &Given) -> Option<Dashpot> {
        let most = given.number(const { X_DAMPING.number("Fo") }).unwrap_or(f64::INFINITY);
        let [coefficient, exponent] = const { X_DAMPING.numbers(["Co", "Ex"]) };
        Some(Dashpot { coefficient: given.number(coefficient)?, exponent: given.number(exponent)?, most })
    }

    fn force(&self, speed: f64) -> Sized {
        let (c, ex) = (self.coefficient, self.exponent);
        // below one the power is rounded off at rest, and stays below the power
        let soft = if ex < 1.0 { speed.hypot(LINEAR_DASHPOT_SPEED) } else { speed };
        let secant = c * soft.powf(ex - 1.0);
        if secant * speed > self.most {
            return Sized { secant: self.most / speed, slope: 0.0 };
        }
        let share = if soft > 0.0 { (speed / soft).powi(2) } else { 1.0 };
        Sized { secant, slope: secant * (1.0 + (ex - 1.0) * share) }
    }

    /// Force along velocities (m/s), of those components that `takes` keeps, and its derivative. Of two components the law holds
    /// for their resultant.
    pub fn evaluate(&self, rate: &Vector3<f64>, takes: [bool; 3]) -> (Vector3<f64>, Matrix3<f64>) {
        let takes = Vector3::from(takes.map(|t| f64::from(u8::from(t))));
        let kept = rate.component_mul(&takes);
        let Sized { secant, slope } = self.force(kept.norm());
        (secant * kept, derivative_along(&kept, &Matrix3::from_diagonal(&takes), secant, slope))
    }
}

/// The derivative of `secant * v` where the secant follows from the size of v.
fn derivative_along(v: &Vector3<f64>, kept: &Matrix3<f64>, secant: f64, slope: f64) -> Matrix3<f64> {
    let n = v.try_normalize(0.0).unwrap_or_default();
    kept * secant + n * n.transpose() * (slope - secant)
}

/// A force of a given size in the direction of a velocity, rounded off at rest: `size * v / sqrt(v2 + v0 2)`. The direction, and
/// its derivative by the velocity.
pub fn rubbing(rate: &Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
    let soft = rate.norm().hypot(FRICTION_REFERENCE_SPEED);
    let n = rate / soft;
    (n, (Matrix3::identity() - n * n.transpose()) / soft)
}

/// The springs of one degree of freedom, or of two that act by their resultant: an elastic law in series with a viscoelastic one.
#[derive(Clone, Debug, PartialEq)]
pub struct SpringGroup {
    /// Degrees of freedom, 0 to 5.
    pub dofs: Vec<usize>,
    /// Springs without memory.
    pub elastic: Elastic,
    /// The spring of -CONVOLUTION.
    pub viscous: Option<ViscoelasticLaw>,
}

impl SpringGroup {
    /// Number of values of its state.
    pub fn states(&self) -> usize {
        self.viscous.as_ref().map_or(0, |v| self.dofs.len() * v.states())
    }

    /// Adds the forces at these deflections (m, rad) and their derivatives, and writes the state.
    pub fn evaluate(
        &self,
        deflection: &Vector6<f64>,
        dt: Option<f64>,
        committed: &[f64],
        trial: &mut [f64],
        force: &mut Vector6<f64>,
        slopes: &mut Matrix6<f64>,
    ) {
        let lines = self.lines(dt, committed);
        // all components have the same slope: it follows from the law and the step; a spring that is not viscoelastic has no lines
        let compliance = lines.first().map_or(0.0, |line| 1.0 / line.slope);
        let mut target = Vector6::zeros();
        for dof in &self.dofs {
            target[*dof] = deflection[*dof];
        }
        for (dof, line) in self.dofs.iter().zip(&lines) {
            target[*dof] += line.rest / line.slope;
        }
        let Sized { secant, slope } = self.elastic.force(target.norm(), compliance);
        let n = target.try_normalize(0.0).unwrap_or_default();
        for dof in &self.dofs {
            force[*dof] += secant * target[*dof];
            slopes[(*dof, *dof)] += secant;
            for other in &self.dofs {
                slopes[(*dof, *other)] += (slope - secant) * n[*dof] * n[*other];
            }
        }
        self.advance(dt, committed, trial, &lines, |dof| secant * target[dof]);
    }

    /// The state at the end of a step without force: the viscoelastic spring recovers.
    pub fn release(&self, dt: Option<f64>, committed: &[f64], trial: &mut [f64]) {
        let lines = self.lines(dt, committed);
        self.advance(dt, committed, trial, &lines, |_| 0.0);
    }

    fn lines(&self, dt: Option<f64>, committed: &[f64]) -> Vec<Affine> {
        let Some(viscous) = &self.viscous else { return Vec::new() };
        committed.chunks(viscous.states()).map(|part| viscous.step(dt, part)).collect()
    }

    fn advance(
        &self,
        dt: Option<f64>,
        committed: &[f64],
        trial: &mut [f64],
        lines: &[Affine],
        force: impl Fn(usize) -> f64,
    ) {
        let Some(viscous) = &self.viscous else { return };
        let parts = committed.chunks(viscous.states()).zip(trial.chunks_mut(viscous.states()));
        for ((dof, line), (old, new)) in self.dofs.iter().zip(lines).zip(parts) {
            viscous.advance(dt, old, (force(*dof) - line.rest) / line.slope, new);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_springs_share_one_force_and_extrapolate_last_slope() {
        // 1000 N/m in series with (100 N, 0.3 m), (300 N, 0.5 m): at 200 N 0.2 + 0.4 m; beyond 300 N a slope of 1000 N/m
        let law = Elastic::new(1000.0, Some(&[(0.0, 0.0), (100.0, 0.3), (300.0, 0.5)]));
        for (u, f) in [(0.2, 50.0), (0.4, 100.0), (0.6, 200.0), (0.8, 300.0), (1.2, 500.0)] {
            let got = law.force(u, 0.0);
            assert!((got.secant * u - f).abs() < 1e-10, "{u}: {got:?}");
        }
        assert!((law.force(1.0, 0.0).slope - 500.0).abs() < 1e-9);
    }

    #[test]
    fn dashpot_force_is_power_law_up_to_its_limit() {
        let dashpot = Dashpot { coefficient: 5.0, exponent: 2.0, most: 40.0 };
        for (v, f) in [(0.0, 0.0), (2.0, 20.0), (-2.0, -20.0), (3.0, 40.0), (-9.0, -40.0)] {
            let (got, _) = dashpot.evaluate(&Vector3::new(v, 7.0, 0.0), [true, false, false]);
            assert!((got - Vector3::new(f, 0.0, 0.0)).norm() < 1e-12, "{v}: {got}");
        }
        // a root, away from rest
        let root = Dashpot { coefficient: 5.0, exponent: 0.5, most: f64::INFINITY };
        let (got, _) = root.evaluate(&Vector3::new(4.0, 0.0, 0.0), [true, false, false]);
        assert!((got.x - 10.0).abs() < 1e-6);
    }
}
