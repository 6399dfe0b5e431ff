//! Natural modes of an installed tether in the tension it has where the structure is.
//!
//! `K` is bending, tension and the springs of the ends, `M` wall, contents and added mass; deflections at the ends are held. All as the run has
//! them, of a straight tether ([AQWA-TETHER 7.2 and 8.2.21]; [W-INSTALLED 2]).

use super::axis::TetherAxis;
use super::bending::{Bending, PlaneMatrices};
use super::tension::TensionModel;
use super::tether::InstalledTether;
use crate::beam;
use crate::compatibility::Compatibility;
use crate::modes::{self, ModePlane, NaturalMode, Pencil};
use crate::structure::flow::WaterFlow;
use nalgebra::Vector3;
use windlass_model::ClassError;

/// Squared frequencies that differ by less of themselves are those of a pair.
const SAME_MODE: f64 = 1e-9;

/// A mode of an installed tether.
#[derive(Clone, Debug, PartialEq)]
pub struct InstalledMode {
    /// Frequency and shape; its plane Z is that of X here.
    pub mode: NaturalMode,
    /// Height of each node above the anchor (m).
    pub heights: Vec<f64>,
}

impl InstalledMode {
    /// `MODE FREEDOM POSN` [AQWA-TETHER 7.2]: its number among the four degrees of freedom X, Y, RX, RY of each node, from 1.
    pub fn freedom_position(&self) -> Option<usize> {
        self.mode.dof_of([[2, 3], [1, 4]])
    }

    /// X, Y (scaled), RX, RY (rad) of a node.
    pub fn node(&self, index: usize) -> [f64; 4] {
        let value = |list: &[f64]| list[index];
        let (deflection, slope) = (value(&self.mode.deflections), value(&self.mode.slopes));
        match self.mode.plane {
            // the planes of the beam are those of X and Y here
            ModePlane::Z => [deflection, 0.0, 0.0, slope],
            ModePlane::Y => [0.0, deflection, 0.0 - slope, 0.0],
        }
    }
}

/// The lowest `number` modes of a tether with its attachment at a place (m, global), in still water.
///
/// # Errors
/// A tether that cannot be reckoned with, or is too short for its span.
pub fn modes(
    tether: &InstalledTether,
    attachment: Vector3<f64>,
    flow: &WaterFlow,
    number: usize,
    compatibility: &Compatibility,
) -> Result<Vec<InstalledMode>, ClassError> {
    let ([x, y], length) = of_planes(tether, attachment, flow, compatibility, |pencil| modes::modes(pencil, number))?;
    let shares = tether.line.distances().iter().map(|s| s / tether.line.length() * length);
    let heights: Vec<f64> = shares.collect();
    let all = modes::together(&y, &x, number);
    let mut all: Vec<InstalledMode> =
        all.into_iter().map(|mode| InstalledMode { mode, heights: heights.clone() }).collect();
    // a tether that is alike in both planes has modes in pairs: the listing has them by their places in the matrices
    for at in 1..all.len() {
        let (one, other) = (&all[at - 1], &all[at]);
        let equal = (other.mode.eigenvalue - one.mode.eigenvalue).abs() <= SAME_MODE * other.mode.eigenvalue.abs();
        if equal && one.freedom_position() > other.freedom_position() {
            all.swap(at - 1, at);
        }
    }
    Ok(all)
}

/// How many natural modes have a period below [`modes::SHORTEST_PERIOD`], with the attachment at a place (m, global).
///
/// # Errors
/// Those of [`modes()`].
pub fn count_fast_modes(
    tether: &InstalledTether,
    attachment: Vector3<f64>,
    flow: &WaterFlow,
    compatibility: &Compatibility,
) -> Result<usize, ClassError> {
    let find = |pencil: &Pencil| modes::count_below_period(pencil, modes::SHORTEST_PERIOD);
    let ([x, y], _) = of_planes(tether, attachment, flow, compatibility, find)?;
    Ok(x + y)
}

/// What a function finds in the eigenvalue problem of each plane, and the length in tension (m).
fn of_planes<T>(
    tether: &InstalledTether,
    attachment: Vector3<f64>,
    flow: &WaterFlow,
    compatibility: &Compatibility,
    find: impl Fn(&Pencil) -> Result<T, ClassError>,
) -> Result<([T; 2], f64), ClassError> {
    tether.check()?;
    tether.spans((attachment - tether.anchor).norm())?;
    let Some(axis) = TetherAxis::new(tether.anchor, attachment) else {
        return Err(ClassError::new(format!("tether {} hangs straight below its anchor", tether.name)));
    };
    let axial = TensionModel::new(tether, [flow.density, flow.gravity], compatibility.uniform_tension);
    let tension = axial.tension(&axis, attachment.z, 0.0, &flow.at_time(0.0));
    let bending = Bending::new(tether, flow.density, flow.gravity);
    let of = |plane: usize| {
        let PlaneMatrices { stiffness, mass, beams, springs } = bending.matrices(plane, &tension, &axial);
        let last = mass.order() - 1;
        let energy = |x: &[f64]| {
            let of = |(index, [ei, pull, length]): (usize, &[f64; 3])| {
                beam::twice_energy(*ei, *pull, *length, &beam::of_element(x, index))
            };
            let coils = springs[0] * x[1] * x[1] + springs[1] * x[last] * x[last];
            beams.iter().enumerate().map(of).sum::<f64>() + coils
        };
        find(&Pencil { stiffness: &stiffness, mass: &mass, twice_energy: &energy })
    };
    Ok(([of(0)?, of(1)?], tension.length))
}
