//! The equations of motion of a body as tables: its own mass with added mass, damping, stiffness and exciting forces, about a point of
//! it, along the global axes.
//!
//! Matrices are about a point p at r from the origin: with the motion of the origin `u0 = u - turn x r` a matrix A about the origin
//! is `T^T A T` about p, and a wrench `T^T F`. Damping grows with no heading here: that of all is the one.

use super::linear::{LinearSystem, Motions};
use crate::system::{DOFS, SolveError};
use nalgebra::{DMatrix, Matrix6, Vector3, Vector6};
use std::f64::consts::{PI, TAU};
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;

/// A point of a body about which equations are taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The number of the body.
    pub body: usize,
    /// The point, in the body (m).
    pub at: Vector3<f64>,
}

impl Frame {
    /// Motions of the origin by those of the point.
    fn transform(&self, linear: &LinearSystem) -> Matrix6<f64> {
        let arm = linear.poses[self.body].axes * self.at;
        let mut made = Matrix6::identity();
        // -(turn x arm) = arm x turn
        made.fixed_view_mut::<3, 3>(0, 3).copy_from(&arm.cross_matrix());
        made
    }

    /// The block of the body of a matrix of all bodies, about the point.
    fn block(&self, linear: &LinearSystem, all: &DMatrix<f64>) -> Matrix6<f64> {
        let to = self.transform(linear);
        let from = 6 * self.body;
        to.transpose() * all.fixed_view::<6, 6>(from, from) * to
    }
}

/// Dimension of a row and a column of a matrix of inertia (seconds 2), damping (1) or stiffness (0).
fn dimension(row: usize, column: usize, seconds: i8) -> Dim {
    Dim::Derived { force: 1, length: -1 + i8::from(row > 2) + i8::from(column > 2), seconds }
}

/// One number of each matrix at a frequency.
struct FrequencyMatrices {
    frequency: f64,
    inertia: Matrix6<f64>,
    damping: Matrix6<f64>,
}

fn at_frequencies(linear: &LinearSystem, frame: &Frame, frequencies: &[f64]) -> Vec<FrequencyMatrices> {
    let one = |frequency: &f64| {
        let (inertia, damping) = linear.inertia_and_damping(*frequency);
        let [inertia, damping] = [inertia, damping].map(|all| frame.block(linear, &all));
        FrequencyMatrices { frequency: *frequency, inertia, damping }
    };
    frequencies.iter().map(one).collect()
}

/// The diagonals of mass with added mass and of damping, a row a frequency (rad/s).
pub fn diagonals(linear: &LinearSystem, frame: &Frame, frequencies: &[f64]) -> Table {
    let rows = at_frequencies(linear, frame, frequencies);
    let mut table = Table::new("Mass with Added Mass, and Damping").with_rows(&rows).column(
        "",
        "Period",
        Dim::Time,
        Digits::Usual,
        |row| TAU / row.frequency,
    );
    for (i, dof) in DOFS.iter().enumerate() {
        table = table
            .column("Mass and Added Mass", dof, dimension(i, i, 2), Digits::Scientific(5), |row| row.inertia[(i, i)]);
    }
    for (i, dof) in DOFS.iter().enumerate() {
        table = table.column("Damping", dof, dimension(i, i, 1), Digits::Scientific(5), |row| row.damping[(i, i)]);
    }
    let mut table = table.build();
    table.note("diagonals, not divided by the mass of the body; MATRICES -FILE writes the whole matrices");
    table
}

/// The whole matrices, a row a frequency: inertia M, damping B and stiffness K with the numbers of row and column.
pub fn matrices(linear: &LinearSystem, frame: &Frame, frequencies: &[f64]) -> Table {
    let rows = at_frequencies(linear, frame, frequencies);
    let stiff = frame.block(linear, &linear.stiffness);
    let mut table = Table::new("Matrices of the Equations of Motion").with_rows(&rows).column(
        "",
        "Period",
        Dim::Time,
        Digits::Usual,
        |row| TAU / row.frequency,
    );
    for (letter, seconds) in [("M", 2), ("B", 1), ("K", 0)] {
        for i in 0..6 {
            for j in 0..6 {
                let name = format!("{letter}{}{}", i + 1, j + 1);
                table = table.column("", &name, dimension(i, j, seconds), Digits::Scientific(5), |row| match seconds {
                    2 => row.inertia[(i, j)],
                    1 => row.damping[(i, j)],
                    _ => stiff[(i, j)],
                });
            }
        }
    }
    table.build()
}

/// The stiffness, a row a force and moment; rows of forces are by length and angle, those of moments too.
pub fn stiffness(linear: &LinearSystem, frame: &Frame) -> [Table; 2] {
    let stiff = frame.block(linear, &linear.stiffness);
    let part = |title: &str, first: usize| {
        let rows: Vec<(&str, usize)> = (first..first + 3).map(|i| (DOFS[i], i)).collect();
        let mut table = Table::new(title).with_rows(&rows).text("Of", |(name, _)| *name);
        for (j, dof) in DOFS.iter().enumerate() {
            let group = if j < 3 { "Translation" } else { "Rotation" };
            table = table.column(group, dof, dimension(first, j, 0), Digits::Scientific(5), |(_, i)| stiff[(*i, j)]);
        }
        table.build()
    };
    [part("Stiffness: Forces", 0), part("Stiffness: Moments", 3)]
}

/// Exciting forces of waves of an amplitude (m), by heading (rad, where the waves come from) and frequency.
///
/// # Errors
/// A heading in a gap of a database.
pub fn exciting_forces(
    linear: &LinearSystem,
    frame: &Frame,
    headings: &[f64],
    frequencies: &[f64],
    amplitude: f64,
) -> Result<Table, SolveError> {
    let to = frame.transform(linear).map(|v| nalgebra::Complex::new(v, 0.0));
    let mut rows = Vec::new();
    for heading in headings {
        for frequency in frequencies {
            let all: Motions = linear.excitation(*frequency, heading + PI)?;
            let own: Vector6<_> = all.fixed_rows::<6>(6 * frame.body).into_owned();
            rows.push((*heading, *frequency, to.tr_mul(&own) * nalgebra::Complex::new(amplitude, 0.0)));
        }
    }
    let mut table = Table::new("Exciting Forces")
        .fact("Wave Amplitude", amplitude, Dim::Length)
        .with_rows(&rows)
        .column("", "Heading", Dim::Angle, Digits::Usual, |row| row.0)
        .column("", "Period", Dim::Time, Digits::Usual, |row| TAU / row.1);
    for (i, name) in ["FX", "FY", "FZ", "MX", "MY", "MZ"].into_iter().enumerate() {
        let dim = if i < 3 { Dim::Force } else { Dim::Moment };
        table = table.column(name, &format!("{name} Amp"), dim, Digits::Scientific(5), |row| row.2[i].norm()).column(
            name,
            &format!("{name} Phase"),
            Dim::Angle,
            Digits::Usual,
            |row| Some(row.2[i]).filter(|v| v.norm() > 0.0).map(|v| v.arg()),
        );
    }
    let mut table = table.build();
    table.note("heading is where the waves come from; phase is the lag behind the crest at the global origin");
    Ok(table)
}
