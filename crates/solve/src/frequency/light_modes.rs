//! What motions in waves are warned of: modes that are not stable, that have next to no damping at a period of the waves, or that nothing holds against slow
//! drift.

use super::linear::LinearSystem;
use super::natural::{Natural, natural};
use crate::equilibrium::{UNRESTRAINED_EIGENVALUE, is_unstable};
use crate::system::{DOFS, SystemBody};
use nalgebra::Complex;
use std::f64::consts::{PI, TAU};

/// Damping over critical below which a mode is named where waves have its period: what vortices and friction take is more.
const LITTLE_DAMPING: f64 = 0.02;
/// Waves beyond the shortest and the longest by this share still move a mode.
const BESIDE: f64 = 1.05;
/// Share of what its parts would be that the force of a wave on a mode is nothing of: symmetry.
const NO_FORCE: f64 = 1e-6;
/// Degrees of freedom up to which modes are found.
const MAX_DOFS: usize = 60;
/// Degrees of freedom that slow drift moves.
const DRIFTING: [&str; 3] = ["X", "Y", "RZ"];

/// The waves that motions are found in.
#[derive(Clone, Copy, Debug)]
pub struct WaveBand<'a> {
    /// Their frequencies (rad/s).
    pub frequencies: &'a [f64],
    /// Where they come from (rad).
    pub headings: &'a [f64],
}

/// The warnings of motions in waves, a sentence each; none of systems of more than 60 degrees of freedom, and none where the modes have no answer, which their own
/// report says.
pub fn warnings_of_modes(linear: &LinearSystem, waves: WaveBand) -> Vec<String> {
    if linear.stiffness.nrows() > MAX_DOFS {
        return Vec::new();
    }
    let modes = natural(linear).unwrap_or_default();
    let largest = modes.iter().map(|own| own.mode.eigenvalue.abs()).fold(0.0, f64::max);
    let mut list = Vec::new();
    for Natural { mode, damping, settled } in &modes {
        let (body, dof) = (mode.most.0.as_str(), mode.most.1);
        if !linear.has_database(body) {
            continue;
        }
        if is_unstable(mode.eigenvalue, largest) {
            list.push(format!(
                "{body} is not stable in {dof}: at rest it does not stay there, and its motions in waves mean nothing; &STATUS MODES has all modes"
            ));
        }
        let (Some(period), Some(ratio)) = (mode.period, damping.filter(|_| *settled)) else { continue };
        if ratio < LITTLE_DAMPING && waves.has(period) && waves.moves(linear, mode.shape.as_slice(), TAU / period) {
            let more = match dof {
                "RX" => "#ROLL_DAMPING, #TANAKA and #DAMP give",
                _ => "#DAMP gives",
            };
            list.push(format!(
                "{body} {dof} has {:.2} % of critical damping at its natural period of {period:.2} s, among those of the waves: motions near it are too large without \
                 what friction and eddies take; {more} that",
                100.0 * ratio
            ));
        }
    }
    list
}

/// The bodies with slow drift that nothing holds against it, a sentence each.
pub fn warnings_of_free_drift(linear: &LinearSystem) -> Vec<String> {
    let (mass, _) = linear.inertia_and_damping(0.0);
    // not by the shapes of modes, which are any mixture of the motions that nothing holds
    let is_loose = |at: usize| linear.stiffness[(at, at)].abs() <= UNRESTRAINED_EIGENVALUE * mass[(at, at)];
    let of_body = |(index, node): (usize, &SystemBody)| {
        let dofs: Vec<&str> = DRIFTING
            .iter()
            .filter(|dof| {
                let at = DOFS.iter().position(|own| own == *dof);
                at.is_some_and(|at| node.moves(at) && is_loose(DOFS.len() * index + at))
            })
            .copied()
            .collect();
        (linear.drifts(&node.name) && !dofs.is_empty()).then(|| {
            format!(
                "nothing holds {} in {}: drift carries it away, and its mean and slow motions there mean nothing; moorings hold it; -MEAN_DRIFT NO of G_PRESSURE and -DRIFT NONE of DATABASE leave drift out",
                node.name,
                dofs.join(", ")
            )
        })
    };
    linear.system.nodes.iter().enumerate().filter_map(of_body).collect()
}

impl WaveBand<'_> {
    /// Whether a period (s) is among those of the waves.
    fn has(&self, period: f64) -> bool {
        let all = || self.frequencies.iter().copied();
        let (low, high) = (all().fold(f64::INFINITY, f64::min), all().fold(0.0, f64::max));
        (low / BESIDE..=high * BESIDE).contains(&(TAU / period))
    }

    /// Whether waves of a frequency (rad/s) push along a mode.
    fn moves(&self, linear: &LinearSystem, shape: &[f64], frequency: f64) -> bool {
        self.headings.iter().any(|from| {
            let Ok(force) = linear.excitation(frequency, from + PI) else { return false };
            let parts = || force.iter().zip(shape).map(|(force, motion)| force * *motion);
            let (whole, each) = (parts().sum::<Complex<f64>>(), parts().map(|part| part.norm()));
            let each = each.sum::<f64>();
            each > 0.0 && whole.norm() > NO_FORCE * each
        })
    }
}
