//! Natural modes of a tether as tables (seed 003, 7.2).

use super::line::Line;
use super::modes::NaturalMode;
use crate::language::units::Dim;
use crate::table::{Digits, Table};
use std::f64::consts::TAU;

/// The page of one mode, nodes from the vessel down. Deflections are of largest 1, without a unit.
///
/// The listing's `MODE FREEDOM POSN` is not told: it is the place of the mode in the work space of that program's solver.
pub fn table(mode: &NaturalMode, number: usize, tether: usize, line: &Line) -> Table {
    let mut out = Table::new(format!("Eigensolution Mode {number} of Tether {tether}"))
        .fact("Eigenvalue", mode.eigenvalue, Dim::None)
        .fact("Frequency", mode.frequency(), Dim::Frequency)
        .fact("Frequency (Hz)", mode.frequency().map(|w| w / TAU), Dim::None)
        .fact("Period", mode.period(), Dim::Time)
        .column("", "Node", Dim::None, Digits::Usual)
        .column("", "Distance", Dim::Length, Digits::Decimals(2))
        .column("Displacement", "Y", Dim::None, Digits::Decimals(4))
        .column("Displacement", "Z", Dim::None, Digits::Decimals(4))
        .column("Slope", "RY", Dim::Angle, Digits::Decimals(4))
        .column("Slope", "RZ", Dim::Angle, Digits::Decimals(4));
    for (node, distance) in line.distances().iter().enumerate().rev() {
        let [y, z, ry, rz] = mode.node(node);
        // the row has one cell a column
        let _ = out.push(vec![(node + 1).into(), (*distance).into(), y.into(), z.into(), ry.into(), rz.into()]);
    }
    if mode.eigenvalue < 0.0 {
        out.note("this mode is not stable: its stiffness is negative");
    }
    out
}

/// All modes in one table: number, plane, frequency, period.
pub fn summary(modes: &[NaturalMode], tether: usize) -> Table {
    let mut out = Table::new(format!("Natural Modes of Tether {tether}"))
        .column("", "Mode", Dim::None, Digits::Usual)
        .column("", "Plane", Dim::None, Digits::Usual)
        .column("", "Frequency", Dim::Frequency, Digits::Decimals(4))
        .column("", "Frequency (Hz)", Dim::None, Digits::Decimals(4))
        .column("", "Period", Dim::Time, Digits::Decimals(2));
    for (mode, number) in modes.iter().zip(1usize..) {
        let frequency = mode.frequency();
        let hertz = frequency.map(|w| w / TAU);
        let plane = format!("{:?}", mode.plane);
        // the row has one cell a column
        let _ = out.push(vec![number.into(), plane.into(), frequency.into(), hertz.into(), mode.period().into()]);
    }
    out
}
