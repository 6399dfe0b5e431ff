//! What a pipe does to each of its supports over time.

use super::LineResults;
use crate::results::{EventTable, Magnitude, RunEvent};
use crate::system::SolveError;
use nalgebra::Vector3;
use windlass_base::table::Table;
use windlass_base::units::Dim;
use windlass_model::{AssemblyKind, Model};

/// The force of a pipe on each of its supports on bodies over some events, global axes, from the support nearest to the bottom to the
/// tensioner.
///
/// # Errors
/// A line that no supports hold.
pub fn supports(line: &LineResults, magnitude: Magnitude, events: &[RunEvent]) -> Result<Table, SolveError> {
    let (model, layout) = (&line.run.model, &line.run.history.layout);
    let names = match model.assemblies.get(&Model::key(line.name)).map(|a| &a.kind) {
        Some(AssemblyKind::Pipe { supports, .. }) => supports,
        _ => return Err(line.error("it lies on no supports: a pipe assembly does")),
    };
    let acts = |name: &&String| model.connectors.get(&Model::key(name)).is_some_and(|c| c.active);
    let (mut positions, mut grounded) = (Vec::new(), Vec::new());
    for (end, name) in names.iter().filter(acts).enumerate() {
        let Some(at) = layout.wrench(line.link, end) else {
            grounded.push(format!("{name} stands in the ground, and the run keeps no force on it"));
            continue;
        };
        positions.push((name, at));
    }
    let mut table = EventTable::new("Forces on Supports", (&line.run.history, events), |row| {
        let force = |at: usize| row.get(at..at + 3).map_or(Vector3::repeat(f64::NAN), Vector3::from_column_slice);
        Ok(positions.iter().map(|(_, at)| magnitude.components_and_magnitude(&force(*at))).collect::<Vec<_>>())
    })?
    .fact("Line", line.name, Dim::None);
    for (index, (name, _)) in positions.iter().enumerate() {
        table = table.columns(name, ["FX", "FY", "FZ", "Mag."], Dim::Force, |forces| {
            forces.get(index).copied().unwrap_or([f64::NAN; 4])
        });
    }
    let mut table = table.build();
    table.add_notes(grounded);
    Ok(table)
}
