//! How far the fenders of a run were deflected, and the energy they took.

use super::connectors::poses;
use crate::link::{end_attachments, pose_of};
use crate::system::SolveError;
use crate::time::Run;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_model::{ClassRole, End, FenderState, Model, Situation};

/// A fender at the stored instant at which it was deflected most.
#[derive(Clone, Debug, PartialEq)]
pub struct FenderPeak {
    /// The connector, as written.
    pub name: String,
    /// When (s).
    pub time: f64,
    /// How far.
    pub state: FenderState,
}

/// The fenders of a run, each at its largest deflection among the stored instants after the transient; one that never touched has none.
/// Actions that let a fender go are not looked at.
///
/// # Errors
/// A fender that makes no element.
pub fn fender_peaks(run: &Run) -> Result<Vec<FenderPeak>, SolveError> {
    let (model, surroundings) = (&run.model, run.model.surroundings());
    let mut found = Vec::new();
    for connector in model.connectors.values() {
        let class = model.classes.get(&Model::key(&connector.class));
        if !class.is_some_and(|c| c.object.role() == ClassRole::Fender) {
            continue;
        }
        let element = model.element(connector).map_err(SolveError::error_about(&connector.name))?;
        let (attached, start) = (end_attachments(model, connector), vec![0.0; element.states()]);
        let mut bodies = Vec::new();
        let mut peak: Option<FenderPeak> = None;
        for row in run.history.rows() {
            let Some(time) = row.first().copied().filter(|t| *t >= run.statistics_start()) else { continue };
            poses(&run.history.layout, row, &mut bodies);
            let ends = attached.map(|end| End::at_rest(pose_of(&end, &bodies)));
            let at = Situation { ends: &ends, step: None, surroundings: &surroundings };
            let summary = element.summary(&at, &start).map_err(SolveError::error_about(&connector.name))?;
            let Some(state) = summary.fender.filter(|s| s.deflection > 0.0) else { continue };
            if peak.as_ref().is_none_or(|p| state.deflection > p.state.deflection) {
                peak = Some(FenderPeak { name: connector.name.clone(), time, state });
            }
        }
        found.extend(peak);
    }
    Ok(found)
}

/// The table of fenders in a situation; the time of each is given where it is one of a run.
pub fn fender_table<'a>(title: &str, rows: impl IntoIterator<Item = (&'a str, &'a FenderState, Option<f64>)>) -> Table {
    let energy = Dim::Derived { force: 1, length: 1, seconds: 0 };
    let rows: Vec<(&str, &FenderState, Option<f64>)> = rows.into_iter().collect();
    let timed = rows.first().is_some_and(|(.., time)| time.is_some());
    let table = Table::new(title)
        .with_rows(&rows)
        .text("Name", |(name, ..)| *name)
        .column("Deflection", "Size", Dim::Length, Digits::Decimals(4), |(_, s, _)| s.deflection)
        .column("Deflection", "of Rated", Dim::None, Digits::Decimals(3), |(_, s, _)| s.deflection / s.rated)
        .column("", "Reaction", Dim::Force, Digits::Usual, |(_, s, _)| s.reaction)
        .column("Energy", "Absorbed", energy, Digits::Usual, |(_, s, _)| s.energy)
        .column("Energy", "of Rated ", Dim::None, Digits::Decimals(3), |(_, s, _)| s.energy / s.rated_energy);
    if timed { table.column("", "At", Dim::Time, Digits::Usual, |(.., time)| *time).build() } else { table.build() }
}
