//! The scheme that steps in time.

use super::state::RodState;
use super::system::Weights;
use nalgebra::Vector3;
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
fn flush_to_zero(v: Vector3<f64>) -> Vector3<f64> {
    const MIN_MAGNITUDE: f64 = 1e-120;
    v.map(|c| (c + MIN_MAGNITUDE) - MIN_MAGNITUDE)
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

    /// Implicit Euler in the same form: what happened before the step has no part in it but for speed.
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

    /// Averaged acceleration, velocity and acceleration of node `i` moved by `u` from where the step began.
    #[inline(always)]
    pub fn node_motion(&self, from: &RodState, i: usize, u: Vector3<f64>) -> [Vector3<f64>; 3] {
        let (v, a, acc) = (&from.velocity[i], &from.averaged[i], &from.acceleration[i]);
        let new = flush_to_zero((u - v * self.h) * self.new_by_u - a * self.new_by_old);
        let velocity = flush_to_zero(v + a * self.v_by_old + new * self.v_by_new);
        let acceleration = flush_to_zero(new * self.a_by_new + a * self.a_by_old - acc * self.a_by_last);
        [new, velocity, acceleration]
    }
}
