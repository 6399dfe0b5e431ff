//! The results a run is judged by, and their statistics as it goes, in flat memory.

use super::compression::CompressionOnset;
use super::history::RowLayout;
use crate::system::DOFS;
use nalgebra::Vector3;
use windlass_base::units::Dim;
use windlass_signal::SeriesError;
use windlass_signal::running::Running;

/// A result against time.
#[derive(Clone, Debug, PartialEq)]
pub struct ResultSeries {
    /// What it is of, and which: `TBRG X`, `A Tension`.
    pub name: String,
    /// Its dimension.
    pub dim: Dim,
    /// Its numbers in a row: one, or the components of a force whose size it is.
    pub columns: std::ops::Range<usize>,
    /// Of the force of a connector that may push, where it does: its size is then negative.
    pub pushing: Option<CompressionOnset>,
}

impl ResultSeries {
    /// Its value in a row (SI).
    pub fn value(&self, row: &[f64]) -> f64 {
        match (row.get(self.columns.clone()), &self.pushing) {
            (Some([one]), _) => *one,
            (Some([x, y, z]), Some(pushing)) => pushing.pull(&Vector3::new(*x, *y, *z), row),
            (Some(several), _) => several.iter().map(|v| v * v).sum::<f64>().sqrt(),
            (None, _) => f64::NAN,
        }
    }
}

/// The results a run is judged by: places and angles of the bodies in the degrees of freedom that move, tensions of the connectors.
pub fn results(layout: &RowLayout) -> Vec<ResultSeries> {
    let mut list = Vec::new();
    for (body, (name, _)) in layout.bodies.iter().enumerate() {
        let at = layout.body(body);
        let moves = layout.moves[body];
        for (i, dof) in DOFS.iter().enumerate().filter(|(i, _)| moves[*i]) {
            let dim = if i < 3 { Dim::Length } else { Dim::Angle };
            list.push(ResultSeries { name: format!("{name} {dof}"), dim, columns: at + i..at + i + 1, pushing: None });
        }
    }
    for (link, columns) in layout.links.iter().enumerate() {
        if let Some(at) = layout.pull(link) {
            list.push(ResultSeries {
                name: format!("{} Tension", columns.name),
                dim: Dim::Force,
                columns: at..at + 3,
                pushing: columns.pushing.clone(),
            });
        }
    }
    list
}

/// Statistics of all results of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct RunStatistics {
    list: Vec<(ResultSeries, Running)>,
    from: f64,
}

impl RunStatistics {
    /// Of the results of a layout, from a time on (s).
    pub fn new(layout: &RowLayout, from: f64) -> Self {
        RunStatistics { list: results(layout).into_iter().map(|s| (s, Running::with_level(0.0))).collect(), from }
    }

    /// Takes the results of a row.
    ///
    /// # Errors
    /// A result that is no number.
    pub fn take(&mut self, row: &[f64]) -> Result<(), SeriesError> {
        let time = row.first().copied().unwrap_or(f64::NAN);
        if time >= self.from {
            for (series, running) in &mut self.list {
                running.push(time, series.value(row))?;
            }
        }
        Ok(())
    }

    /// Every result with what was seen of it.
    pub fn results(&self) -> impl Iterator<Item = (&ResultSeries, &Running)> {
        self.list.iter().map(|(series, running)| (series, running))
    }
}
