//! What a run found, as tables: motions of bodies and points, forces and lengths of connectors, forces on bodies.
//!
//! Source: [MOSES-REF ppo_conn, ppo_bodies]. A table has a row an event. A command says what it makes of a stored row of a
//! [`History`]; which instants are told, and what lies between stored ones, is decided here for all of them.

pub mod along;
mod connectors;
mod events;
mod fatigue;
mod fenders;
mod forces;
mod motions;
mod points;
mod settled;

pub use connectors::{connector_forces, lengths, magnitudes, total_forces};
pub use events::{Event, Window, events};
pub use fatigue::{Exposed, line_damages, scatter};
pub use fenders::{FenderPeak, fender_peaks, fender_table};
pub use forces::body_forces;
pub use motions::{Told, trajectory};
pub use points::{TrackedPoint, points};

use super::system::SolveError;
use super::time::History;
use nalgebra::Vector3;
use windlass_base::table::{Cell, Digits, Table};
use windlass_base::units::Dim;

/// Which components of a vector its magnitude is of: its length, or that of its projection on a plane or an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Magnitude(pub [bool; 3]);

impl Default for Magnitude {
    fn default() -> Self {
        Magnitude([true; 3])
    }
}

impl Magnitude {
    fn of(&self, vector: &Vector3<f64>) -> f64 {
        vector.iter().zip(self.0).filter(|(_, counts)| *counts).fold(0.0_f64, |sum, (v, _)| sum.hypot(*v))
    }

    /// Adds a vector and its magnitude to the numbers of a row.
    fn push(&self, vector: &Vector3<f64>, row: &mut Vec<f64>) {
        row.extend(vector.iter());
        row.push(self.of(vector));
    }
}

/// A table whose first column is the time.
fn timed(title: impl Into<String>) -> Table {
    Table::new(title).column("", "Time", Dim::Time, Digits::Usual)
}

/// Adds columns of one group and dimension.
fn columns(table: Table, group: &str, names: &[&str], dim: Dim) -> Table {
    names.iter().fold(table, |t, name| t.column(group, name, dim, Digits::Usual))
}

/// The head of a group: of one thing its own, of several with the name of the thing in front.
fn headed(several: bool, name: &str, group: &str) -> String {
    if several { format!("{name} {group}") } else { group.to_string() }
}

/// Appends the numbers that a stored row comes to.
type Make<'m> = dyn FnMut(&[f64], &mut Vec<f64>) -> Result<(), SolveError> + 'm;

/// Fills a table of [`timed`]: `make` appends the numbers behind the time that a stored row comes to. Those of an instant between
/// two rows lie on the straight line between theirs, as in MOSES; where only one of the two has a number, it is that of the row before.
/// What is no number is left out.
///
/// # Errors
/// What `make` says.
fn filled((history, events): (&History, &[Event]), mut table: Table, make: &mut Make) -> Result<Table, SolveError> {
    let width = history.layout.width.max(1);
    let mut fill = |at: usize, made: &mut (usize, Vec<f64>)| {
        let row = history.values.get(at * width..(at + 1) * width).unwrap_or_default();
        made.0 = at;
        made.1.clear();
        made.1.extend(row.first());
        make(row, &mut made.1)
    };
    let (mut low, mut high) = ((usize::MAX, Vec::new()), (usize::MAX, Vec::new()));
    for event in events {
        if low.0 != event.row {
            if high.0 == event.row {
                std::mem::swap(&mut low, &mut high);
            } else {
                fill(event.row, &mut low)?;
            }
        }
        if event.share > 0.0 && high.0 != event.row + 1 {
            fill(event.row + 1, &mut high)?;
        }
        for (index, column) in table.columns.iter_mut().enumerate() {
            let of = |made: &(usize, Vec<f64>)| made.1.get(index).copied().filter(|v| v.is_finite());
            let value = match (of(&low), of(&high).filter(|_| event.share > 0.0)) {
                (Some(a), Some(b)) => Some(a + event.share * (b - a)),
                (a, _) => a,
            };
            // zero has no sign
            column.cells.push(value.map_or(Cell::Missing, |v| Cell::Number(v + 0.0)));
        }
    }
    Ok(table)
}
