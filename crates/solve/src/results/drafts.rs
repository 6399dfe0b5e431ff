//! Drafts read at draft marks over a run.

use super::super::system::SolveError;
use super::super::time::Run;
use super::points::{TrackedPoint, water_at};
use super::{EventTable, RunEvent};
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;

/// A draft mark that is read over a run.
#[derive(Clone, Debug, PartialEq)]
pub struct TrackedMark {
    /// Its name as written.
    pub name: String,
    /// The points it runs between.
    pub points: [TrackedPoint; 2],
}

/// The draft at each mark: the length along its line from its first point to the mean water level, as [`windlass_model::Model::draft_at`]
/// has it, and the elevation of the waves above that level there.
///
/// # Errors
/// Rows that make no table.
pub fn drafts(run: &Run, marks: &[TrackedMark], events: &[RunEvent]) -> Result<Table, SolveError> {
    let layout = &run.history.layout;
    let mut table = EventTable::new("Drafts", (&run.history, events), |row| {
        let (level, waves) = water_at(run, row.first().copied().unwrap_or(0.0));
        let of_mark = |mark: &TrackedMark| {
            let [first, second] = [0, 1].map(|end| mark.points[end].motion(row, layout)[0]);
            let along = second - first;
            let share = (level - first.z) / along.z;
            let at = first + along * share;
            [along.norm() * share, waves(at.x, at.y)]
        };
        Ok(marks.iter().map(of_mark).collect::<Vec<[f64; 2]>>())
    })?;
    for (index, mark) in marks.iter().enumerate() {
        for (which, name) in ["Draft", "W. Elv"].into_iter().enumerate() {
            let value = |all: &Vec<[f64; 2]>| all.get(index).map_or(f64::NAN, |found| found[which]);
            table = table.column(&mark.name, name, Dim::Length, Digits::Usual, value);
        }
    }
    let mut table = table.build();
    table.note("drafts are to the mean water level; W. Elv is the elevation of the waves above it at the mark");
    Ok(table)
}
