//! What a run found, as tables: motions of bodies and points, forces and lengths of connectors, forces on bodies.
//!
//! Source: [MOSES-REF ppo_conn, ppo_bodies]. A table has a row an event. A command says what it makes of a stored row of a
//! [`History`]; which instants are reported, and what lies between stored ones, is decided here for all of them.

pub mod along;
mod connectors;
mod drafts;
mod events;
mod fatigue;
mod fenders;
mod forces;
mod groups;
mod line_loads;
mod line_paths;
mod motions;
mod points;
mod relative;
mod rest_state;
mod sensors;
mod tanks;

pub use connectors::{connector_forces, element_forces, magnitudes, total_forces};
pub use drafts::{TrackedMark, drafts};
pub use events::{EventWindow, RunEvent, events};
pub use fatigue::{ScatterExposure, line_damages, scatter};
pub use fenders::{FenderPeak, fender_peaks, fender_table};
pub use forces::body_forces;
pub use groups::{GroupName, group_forces, load_groups};
pub use line_loads::{
    AnchorRecord, LineRecord, LostLines, acts_throughout, is_mooring_line, line_records, lost_lines, segment_tensions,
};
pub use line_paths::{PathPoint, body_panels, body_panels_at, path_at, place_at, static_path};
pub use motions::{MotionOptions, trajectory};
pub use points::{TrackedPoint, points};
pub use relative::{least_distance, relative_motions};
pub use sensors::{Sensor, Signal, SignalComponent, sensors};
pub use tanks::{TrackedHole, TrackedTank, holes, tanks};

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
    fn evaluate(&self, vector: &Vector3<f64>) -> f64 {
        vector.iter().zip(self.0).filter(|(_, counts)| *counts).fold(0.0_f64, |sum, (v, _)| sum.hypot(*v))
    }

    /// A vector and its magnitude.
    fn components_and_magnitude(&self, vector: &Vector3<f64>) -> [f64; 4] {
        [vector.x, vector.y, vector.z, self.evaluate(vector)]
    }
}

/// The head of a group: of one thing its own, of several with the name of the thing in front.
fn group_head(several: bool, name: &str, group: &str) -> String {
    if several { format!("{name} {group}") } else { group.to_string() }
}

/// A table with a row an event under construction: what each stored row comes to is known, columns are added one by one, each with
/// its number of a stored row. The first column is the time.
///
/// The numbers of an instant between two rows lie on the straight line between theirs, as in MOSES; where only one of the two has a
/// number, it is that of the row before. What is not finite is left out.
#[derive(Debug)]
pub struct EventTable<T> {
    table: Table,
    /// The times of the stored rows that events need, and what they come to.
    samples: Vec<(f64, T)>,
    /// For each event the samples of the stored rows around it, and how far it is between them.
    instants: Vec<Instant>,
}

/// An event between two samples.
#[derive(Debug)]
struct Instant {
    before: usize,
    behind: Option<usize>,
    share: f64,
}

impl<T> EventTable<T> {
    /// The table of some events of a run; `sample` says what a stored row comes to, whose columns [`RowLayout`] names.
    ///
    /// # Errors
    /// What `sample` says.
    ///
    /// [`RowLayout`]: crate::time::RowLayout
    pub fn new(
        title: impl Into<String>,
        (history, events): (&History, &[RunEvent]),
        mut sample: impl FnMut(&[f64]) -> Result<T, SolveError>,
    ) -> Result<Self, SolveError> {
        let width = history.layout.width.max(1);
        let (mut rows, mut samples): (Vec<usize>, Vec<(f64, T)>) = (Vec::new(), Vec::new());
        let mut take = |at: usize| {
            // events are in order: a row that is needed again was one of the last two
            if let Some(found) = (rows.len().saturating_sub(2)..rows.len()).find(|i| rows.get(*i) == Some(&at)) {
                return Ok(found);
            }
            let row = history.values.get(at * width..(at + 1) * width).unwrap_or_default();
            samples.push((row.first().copied().unwrap_or(f64::NAN), sample(row)?));
            rows.push(at);
            Ok(samples.len() - 1)
        };
        let mut instants = Vec::new();
        for event in events {
            let before = take(event.row)?;
            let behind = if event.share > 0.0 { Some(take(event.row + 1)?) } else { None };
            instants.push(Instant { before, behind, share: event.share });
        }
        let mut made = EventTable { table: Table::new(title), samples, instants };
        made.add("", ["Time"], Dim::Time, Digits::Usual, |(time, _)| [*time]);
        Ok(made)
    }

    /// Adds columns by what a sample is.
    fn add<const N: usize>(
        &mut self,
        group: &str,
        names: [&str; N],
        dim: Dim,
        digits: Digits,
        values: impl Fn(&(f64, T)) -> [f64; N],
    ) {
        let found: Vec<[f64; N]> = self.samples.iter().map(values).collect();
        let rows: Vec<[Option<f64>; N]> = self
            .instants
            .iter()
            .map(|at| {
                let before = found.get(at.before).copied().unwrap_or([f64::NAN; N]);
                let behind = at.behind.and_then(|i| found.get(i).copied()).unwrap_or([f64::NAN; N]);
                let mut mixed = [None; N];
                for (value, (a, b)) in mixed.iter_mut().zip(before.into_iter().zip(behind)) {
                    *value = match (a.is_finite(), b.is_finite()) {
                        (true, true) => Some(a + at.share * (b - a)),
                        (true, false) => Some(a),
                        (false, _) => None,
                    };
                }
                // zero has no sign
                mixed.map(|value| value.map(|v| v + 0.0))
            })
            .collect();
        self.table =
            std::mem::take(&mut self.table).with_rows(&rows).columns(group, names, dim, digits, |row| *row).build();
    }

    /// Adds a column with its number of a stored row, SI.
    pub fn column(self, group: &str, name: &str, dim: Dim, digits: Digits, value: impl Fn(&T) -> f64) -> Self {
        let mut made = self;
        made.add(group, [name], dim, digits, |(_, sample)| [value(sample)]);
        made
    }

    /// Adds columns of one group and dimension with their numbers of a stored row, SI.
    pub fn columns<const N: usize>(
        self,
        group: &str,
        names: [&str; N],
        dim: Dim,
        values: impl Fn(&T) -> [f64; N],
    ) -> Self {
        let mut made = self;
        made.add(group, names, dim, Digits::Usual, |(_, sample)| values(sample));
        made
    }

    /// Adds a fact to the sub-header.
    pub fn fact(mut self, name: &str, value: impl Into<Cell>, dim: Dim) -> Self {
        self.table = self.table.fact(name, value, dim);
        self
    }

    /// The table with the columns added so far.
    pub fn build(self) -> Table {
        self.table
    }
}
