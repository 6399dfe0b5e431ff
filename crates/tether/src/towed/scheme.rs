//! The step in time: two stages, bending taken half ahead ([AQWA-TETHER 3.6], with its misprints mended).
//!
//! With b = 0.54 (0.5 is centred; more damps the highest modes):
//! `M(t) a1 = F(t) - K (x + b v dt + b a1 dt^2/2)`, `v* = v + a1 dt`, `x* = x + (v + v*) dt/2`;
//! `M* a2 = F* - K (x + b v dt + (b - 1/2) a1 dt^2 + b a2 dt^2/2)`; `v += (a1 + a2) dt/2`, `x += (v before + v after) dt/2`.
//! The term of `a1` in the second is not in the manual, but in its numbers; it is what the first says with v* in the part
//! that is ahead of the middle of the step. Without it the highest modes would swing on undamped. End springs are in F.

use super::super::beam::{self, Matrix4, PlaneMatrix, Vector4, of_element, times};
use super::loads::Loading;
use super::{Towed, run::ElementEnd};
use windlass_base::units::Dim;
use windlass_model::ClassError;
use windlass_nonlinear::try_bisect;

/// The value of b that [AQWA-TETHER 3.6] found best.
pub const USUAL_B: f64 = 0.54;

/// Halvings between no step and one that is too long: the longest stable one to 1e-12 of it.
const STEP_HALVINGS: usize = 40;

/// Deflections and slopes of the nodes in the planes y and z, and their rates.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TowedState {
    /// Deflection (m) and slope d/dx (rad) of each node.
    pub at: [Vec<f64>; 2],
    /// Their rates (m/s, rad/s).
    pub velocity: [Vec<f64>; 2],
}

/// The step of a case, with its work space: it allocates nothing once made.
#[derive(Clone, Debug)]
pub struct TowedScheme<'a> {
    case: &'a Towed,
    loading: Loading<'a>,
    step: f64,
    b: f64,
    stiffness: PlaneMatrix,
    elements: Vec<(Matrix4, Matrix4)>,
    dry: PlaneMatrix,
    matrix: [PlaneMatrix; 2],
    factored: [PlaneMatrix; 2],
    factors: [PlaneMatrix; 2],
    ahead: TowedState,
    taken: Vec<f64>,
    pull: Vec<f64>,
    /// Accelerations of the two stages in the two planes (m/s2, rad/s2).
    pub accelerations: [[Vec<f64>; 2]; 2],
    /// Forces and moments of the nodes on each element's ends in the planes y and z: mean of the stages.
    pub ends: Vec<[Vector4; 2]>,
}

impl<'a> TowedScheme<'a> {
    /// The scheme of a case, a step (s) and b.
    ///
    /// # Errors
    /// Those of [`Loading::new`].
    pub fn new(case: &'a Towed, step: f64, b: f64) -> Result<Self, ClassError> {
        let order = 2 * case.line.nodes();
        let elements = case.line.elements().iter();
        let matrices = |e: &super::super::TetherElement| {
            (beam::stiffness(e.bending_stiffness(), e.length), beam::mass(e.mass_per_length(), e.length))
        };
        let elements: Vec<_> = elements.map(matrices).collect();
        let (mut stiffness, mut dry) = (PlaneMatrix::new(order), PlaneMatrix::new(order));
        for (i, (k, m)) in elements.iter().enumerate() {
            beam::assemble(&mut stiffness, i, k);
            beam::assemble(&mut dry, i, m);
        }
        let zeros = || [vec![0.0; order], vec![0.0; order]];
        Ok(TowedScheme {
            case,
            loading: Loading::new(case)?,
            step,
            b,
            stiffness,
            dry,
            matrix: [PlaneMatrix::new(order), PlaneMatrix::new(order)],
            factored: [PlaneMatrix::new(order), PlaneMatrix::new(order)],
            factors: [PlaneMatrix::new(order), PlaneMatrix::new(order)],
            ahead: TowedState { at: zeros(), velocity: zeros() },
            taken: vec![0.0; order],
            pull: vec![0.0; order],
            accelerations: [zeros(), zeros()],
            ends: vec![[[0.0; 4]; 2]; elements.len()],
            elements,
        })
    }

    /// The two stages of the step from a time (s); the state is left for [`TowedScheme::advance`].
    ///
    /// # Errors
    /// A matrix that is singular, or an acceleration that is not finite: the motion has no bound.
    pub fn stages(&mut self, time: f64, state: &TowedState) -> Result<(), ClassError> {
        self.ends.iter_mut().for_each(|end| *end = [[0.0; 4]; 2]);
        self.loading.find(time, state);
        self.stage(0, state, None)?;
        let dt = self.step;
        for p in 0..2 {
            let acceleration = &self.accelerations[0][p];
            for (i, a) in acceleration.iter().enumerate() {
                let v = state.velocity[p][i];
                self.ahead.velocity[p][i] = v + a * dt;
                self.ahead.at[p][i] = state.at[p][i] + (v + 0.5 * a * dt) * dt;
            }
        }
        let ahead = std::mem::take(&mut self.ahead);
        self.loading.find(time + dt, &ahead);
        let result = self.stage(1, state, Some(&ahead));
        self.ahead = ahead;
        result?;
        // one sum shows any value that is not finite
        let sum: f64 = self.accelerations.iter().flatten().flatten().sum();
        if !sum.is_finite() {
            let message = "the motion of the towed tether has no bound at the time {}, with a step of {}";
            let help = "a smaller step, softer end springs or less drag may help";
            return Err(ClassError::with_values(message, &[(time, Dim::Time), (dt, Dim::Time)]).help(help));
        }
        Ok(())
    }

    /// Brings a state to the end of the step whose stages were found for it.
    pub fn advance(&self, state: &mut TowedState) {
        let dt = self.step;
        for p in 0..2 {
            let [first, second] = [&self.accelerations[0][p], &self.accelerations[1][p]];
            for i in 0..first.len() {
                let before = state.velocity[p][i];
                let after = before + 0.5 * (first[i] + second[i]) * dt;
                state.velocity[p][i] = after;
                state.at[p][i] += 0.5 * (before + after) * dt;
            }
        }
    }

    /// One stage: accelerations of the loads found, and half of the forces on the ends of the elements.
    fn stage(&mut self, number: usize, state: &TowedState, ahead: Option<&TowedState>) -> Result<(), ClassError> {
        let (dt, b) = (self.step, self.b);
        let implicit = 0.5 * b * dt * dt;
        let springs_at = ahead.unwrap_or(state);
        for p in 0..2 {
            self.matrix[p].clone_from(&self.dry);
            self.matrix[p].add_scaled(implicit, &self.stiffness);
            for (i, added) in self.loading.added.iter().enumerate() {
                beam::assemble(&mut self.matrix[p], i, &added[p]);
            }
            if self.matrix[p] != self.factored[p] {
                beam::factor(&self.matrix[p], &mut self.factors[p])?;
                self.factored[p].clone_from(&self.matrix[p]);
            }
            // the place without the acceleration that is sought
            for (i, taken) in self.taken.iter_mut().enumerate() {
                *taken = state.at[p][i] + b * dt * state.velocity[p][i];
                if ahead.is_some() {
                    *taken += (b - 0.5) * dt * dt * self.accelerations[0][p][i];
                }
            }
            self.stiffness.times(&self.taken, &mut self.pull);
            let right = &mut self.accelerations[number][p];
            for (value, pull) in right.iter_mut().zip(&self.pull) {
                *value = -pull;
            }
            for (i, forces) in self.loading.forces.iter().enumerate() {
                beam::gather(right, i, &forces[p]);
            }
            let last = right.len() - 2;
            right[0] -= self.case.spring(0, p) * springs_at.at[p][0];
            right[last] -= self.case.spring(1, p) * springs_at.at[p][last];
            self.factors[p].solve(right);
            for (taken, a) in self.taken.iter_mut().zip(right.iter()) {
                *taken += implicit * a;
            }
            for (i, (stiffness, mass)) in self.elements.iter().enumerate() {
                let (position, a) = (of_element(&self.taken, i), of_element(right, i));
                let [bending, dry, wet] =
                    [times(stiffness, &position), times(mass, &a), times(&self.loading.added[i][p], &a)];
                for (j, end) in self.ends[i][p].iter_mut().enumerate() {
                    *end += 0.5 * (bending[j] + dry[j] + wet[j] - self.loading.forces[i][p][j]);
                }
            }
        }
        Ok(())
    }

    /// Forces and stresses at an end (0, 1) of an element: signs and stresses of the listing.
    pub fn end(&self, element: usize, end: usize) -> ElementEnd {
        let Some(([y, z], e)) = self.ends.get(element).zip(self.case.line.elements().get(element)) else {
            return ElementEnd::default();
        };
        let sign = if end == 0 { -1.0 } else { 1.0 };
        let moment = [sign * z[2 * end + 1], sign * y[2 * end + 1]];
        let factor = e.tube().stress_of_moment();
        ElementEnd {
            shear: [-y[2 * end], -z[2 * end]],
            moment,
            stress: [factor * moment[0].hypot(moment[1]), factor * moment[0], factor * moment[1]],
        }
    }

    /// Whether the explicit springs are stable with the step; without water mass, which only helps. A spring alone with a mass
    /// is stable up to `w dt = 2`: of the matrix of one step of this scheme, the determinant is `1 - p^2/8` and the trace
    /// `2 - p + p^2/8`, p being `(w dt)^2`, and both eigenvalues are within the unit circle up to p = 4.
    ///
    /// # Errors
    /// A step that is too large, with the one that would do.
    pub fn check_step(&self) -> Result<(), ClassError> {
        let mut longest = f64::INFINITY;
        for p in 0..2 {
            longest = longest.min(self.longest_step(p)?);
        }
        if self.step <= longest {
            return Ok(());
        }
        let message = "the step of {} is too large for the end springs of the towed tether: their stiffest motion needs {} or less";
        let help = "give a smaller step or softer springs";
        Err(ClassError::with_values(message, &[(self.step, Dim::Time), (longest, Dim::Time)]).help(help))
    }

    /// The longest stable step of a plane: that of the run where it is.
    fn longest_step(&self, plane: usize) -> Result<f64, ClassError> {
        let springs = [self.case.spring(0, plane), self.case.spring(1, plane)];
        let stable = |dt: f64| -> Result<bool, ClassError> {
            let mut matrix = self.dry.clone();
            matrix.add_scaled(0.5 * self.b * dt * dt, &self.stiffness);
            let order = matrix.order();
            let mut factors = PlaneMatrix::new(order);
            beam::factor(&matrix, &mut factors)?;
            let column = |end: usize| {
                let mut right = vec![0.0; order];
                right[if end == 0 { 0 } else { order - 2 }] = 1.0;
                factors.solve(&mut right);
                [right[0], right[order - 2]]
            };
            let (first, second) = (column(0), column(1));
            // the larger eigenvalue of the springs against the mass seen at the two ends
            let (a, d) = (springs[0] * first[0], springs[1] * second[1]);
            let cross = springs[0] * springs[1] * first[1] * second[0];
            let largest = 0.5 * (a + d) + (0.25 * (a - d) * (a - d) + cross.max(0.0)).sqrt();
            Ok(largest * dt * dt <= 4.0)
        };
        if stable(self.step)? {
            return Ok(self.step);
        }
        let [longest, _] = try_bisect([0.0, self.step], STEP_HALVINGS, |_| false, stable)?;
        Ok(longest)
    }
}
