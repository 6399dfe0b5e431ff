//! The scheme that steps in time.

use super::state::RodState;
use super::system::Weights;
use bytemuck::{cast_slice, cast_slice_mut};
use multiversion::multiversion;
use windlass_model::SchemeWeights;

/// How a rod is stepped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RodSettings {
    /// The scheme. Of generalised-alpha a spectral radius at infinite frequency of 1 damps nothing, 0 kills what the step cannot follow.
    pub scheme: SchemeWeights,
    /// An iteration has converged when no node moves by more than this share of the shortest element, or none would
    /// from then on if its moves went on shrinking as they do. A turn counts as the move on an arm of that length.
    pub tolerance: f64,
    /// Iterations after which a step is cut.
    pub iterations: usize,
    /// How often a step may be halved.
    pub halvings: u32,
    /// Whether statics may also end where any push would make the rod leave, as a ring bent out of a straight beam.
    pub unstable: bool,
}

/// Spectral radius at infinite frequency where nothing else is asked for: of a mode it damps 2.3 % of critical at 10 steps a period,
/// 0.40 % at 20, 0.055 % at 40, and it throws little up where a line snaps taut.
const DEFAULT_SPECTRAL_RADIUS: f64 = 0.2;

impl Default for RodSettings {
    fn default() -> Self {
        RodSettings {
            scheme: SchemeWeights::generalised_alpha(DEFAULT_SPECTRAL_RADIUS),
            tolerance: 1e-5,
            iterations: 20,
            halvings: 12,
            unstable: false,
        }
    }
}

/// The scheme's constants for one step length, in the form of [ARNOLD-BRULS-2007], in which equilibrium holds at the end of the step.
#[derive(Clone, Copy, Debug)]
pub(super) struct StepScheme {
    pub h: f64,
    /// The new averaged acceleration by the move beyond v h, and by the old one.
    new_by_u: f64,
    new_by_old: f64,
    /// The velocity by the old and new averaged accelerations.
    v_by_old: f64,
    v_by_new: f64,
    /// The acceleration by the new and old averaged ones, and by the last.
    a_by_new: f64,
    a_by_old: f64,
    a_by_last: f64,
}

/// Takes what is smaller than 1e-136 as zero: a motion that dies away would end in denormal numbers, which cost a
/// hundred times as much as others.
#[inline(always)]
fn flush_to_zero(c: f64) -> f64 {
    const MIN_MAGNITUDE: f64 = 1e-120;
    (c + MIN_MAGNITUDE) - MIN_MAGNITUDE
}

impl StepScheme {
    pub fn new(h: f64, weights: &SchemeWeights) -> Self {
        let SchemeWeights { alpha_m, alpha_f, beta, gamma } = *weights;
        StepScheme {
            h,
            new_by_u: 1.0 / (beta * h * h),
            new_by_old: (0.5 - beta) / beta,
            v_by_old: (1.0 - gamma) * h,
            v_by_new: gamma * h,
            a_by_new: (1.0 - alpha_m) / (1.0 - alpha_f),
            a_by_old: alpha_m / (1.0 - alpha_f),
            a_by_last: alpha_f / (1.0 - alpha_f),
        }
    }

    /// Implicit Euler over a step `h` (s) in the same form: what happened before the step has no part in it but for speed.
    pub fn euler(h: f64) -> Self {
        StepScheme {
            h,
            new_by_u: 1.0 / (h * h),
            new_by_old: 0.0,
            v_by_old: 0.0,
            v_by_new: h,
            a_by_new: 1.0,
            a_by_old: 0.0,
            a_by_last: 0.0,
        }
    }

    pub fn weights(&self) -> Weights {
        Weights { k: 1.0, c: self.v_by_new * self.new_by_u, m: self.a_by_new * self.new_by_u }
    }

    /// Gives `to` the positions at which its nodes end if their averaged accelerations stay, and the motion that belongs to them.
    pub fn predict(&self, from: &RodState, to: &mut RodState) {
        let start = StepStart::new(from);
        let [x, averaged, velocity, acceleration] = motions(to);
        predict(self, &start, x, [averaged, velocity, acceleration]);
    }

    /// Gives `to` averaged accelerations, velocities and accelerations that belong to its positions.
    pub fn set_motions(&self, from: &RodState, to: &mut RodState) {
        let start = StepStart::new(from);
        let [x, averaged, velocity, acceleration] = motions(to);
        set_motions(self, &start, x, [averaged, velocity, acceleration]);
    }

    /// New averaged acceleration, velocity and acceleration of a coordinate that moves by `u` from where the step began, by its
    /// velocity, averaged acceleration and acceleration there.
    #[inline(always)]
    fn motion(&self, u: f64, [v, a, acceleration]: [f64; 3]) -> [f64; 3] {
        let new = flush_to_zero((u - v * self.h) * self.new_by_u - a * self.new_by_old);
        let velocity = flush_to_zero(v + a * self.v_by_old + new * self.v_by_new);
        [new, velocity, flush_to_zero(new * self.a_by_new + a * self.a_by_old - acceleration * self.a_by_last)]
    }
}

/// The coordinates of a state at the start of a step, one after the other.
struct StepStart<'a> {
    x: &'a [f64],
    v: &'a [f64],
    averaged: &'a [f64],
    a: &'a [f64],
}

impl<'a> StepStart<'a> {
    fn new(from: &'a RodState) -> Self {
        let [x, v, averaged, a] =
            [&from.position, &from.velocity, &from.averaged, &from.acceleration].map(|list| cast_slice(list));
        StepStart { x, v, averaged, a }
    }
}

/// Positions, averaged accelerations, velocities and accelerations of a state, one coordinate after the other.
fn motions(state: &mut RodState) -> [&mut [f64]; 4] {
    let RodState { position, averaged, velocity, acceleration, .. } = state;
    [position, averaged, velocity, acceleration].map(|list| cast_slice_mut(list))
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn predict(scheme: &StepScheme, from: &StepStart, x: &mut [f64], [averaged, velocity, acceleration]: [&mut [f64]; 3]) {
    let count = x.len();
    let (averaged, velocity, acceleration) =
        (&mut averaged[..count], &mut velocity[..count], &mut acceleration[..count]);
    let (x0, v0, averaged0, a0) = (&from.x[..count], &from.v[..count], &from.averaged[..count], &from.a[..count]);
    for i in 0..count {
        let u = (v0[i] + averaged0[i] * (0.5 * scheme.h)) * scheme.h;
        x[i] = x0[i] + u;
        [averaged[i], velocity[i], acceleration[i]] = scheme.motion(u, [v0[i], averaged0[i], a0[i]]);
    }
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn set_motions(scheme: &StepScheme, from: &StepStart, x: &[f64], [averaged, velocity, acceleration]: [&mut [f64]; 3]) {
    let count = x.len();
    let (averaged, velocity, acceleration) =
        (&mut averaged[..count], &mut velocity[..count], &mut acceleration[..count]);
    let (x0, v0, averaged0, a0) = (&from.x[..count], &from.v[..count], &from.averaged[..count], &from.a[..count]);
    for i in 0..count {
        [averaged[i], velocity[i], acceleration[i]] = scheme.motion(x[i] - x0[i], [v0[i], averaged0[i], a0[i]]);
    }
}
