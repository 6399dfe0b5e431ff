//! What acts on bodies, by category.

use super::super::system::SolveError;
use super::super::time::Run;
use super::{Event, Magnitude, columns, filled, headed, timed};
use nalgebra::Vector3;
use windlass_base::table::Table;
use windlass_base::units::Dim;
use windlass_hydro::Category;

/// Adds the columns of a force and a moment.
pub(super) fn wrench_columns(table: Table, group: &str) -> Table {
    let table = columns(table, group, &["FX", "FY", "FZ", "F Mag."], Dim::Force);
    columns(table, group, &["MX", "MY", "MZ", "M Mag."], Dim::Moment)
}

/// Adds a force and a moment, which begin at `from` of a row.
pub(super) fn add(row: &[f64], from: Option<usize>, sum: &mut [Vector3<f64>; 2]) {
    let Some(values) = from.and_then(|at| row.get(at..at + 6)) else { return };
    if let [fx, fy, fz, mx, my, mz] = values {
        sum[0] += Vector3::new(*fx, *fy, *fz);
        sum[1] += Vector3::new(*mx, *my, *mz);
    }
}

/// The forces on some bodies of a run by category, and their sum, about the origins of the bodies, global axes. Inertia is one of
/// them, as a force: the sum is what a step left, and in a degree of freedom that does not move what holds it.
///
/// # Errors
/// None of its own.
pub fn body_forces(run: &Run, bodies: &[usize], magnitude: Magnitude, events: &[Event]) -> Result<Table, SolveError> {
    let layout = &run.history.layout;
    let several = bodies.len() > 1;
    let mut table = timed("Forces on Bodies").fact("Moments About", "the origins of the bodies", Dim::None);
    for (name, _) in bodies.iter().filter_map(|b| layout.bodies.get(*b)) {
        if !several {
            table = table.fact("Body", name.as_str(), Dim::None);
        }
        for group in layout.categories.iter().map(|c| c.name()).chain(["TOTAL"]) {
            table = wrench_columns(table, &headed(several, name, group));
        }
    }
    table.note("TOTAL is with inertia: what the step left, and what holds degrees of freedom that do not move");
    if layout.categories.contains(&Category::WaveMean) {
        table.note(
            "W_MEAN is what is slow (TDOM -DIVIDING) of the force of undisturbed waves on members and hulls of -DIFTYPE FK: no drift force, which \
             diffraction and radiation make; #DRIFT or DATABASE give it as W_DRIFT. The mean drag of members is in V_DRAG",
        );
    }
    filled((&run.history, events), table, &mut |row, made| {
        for body in bodies {
            let mut total = [Vector3::zeros(); 2];
            for category in &layout.categories {
                let mut own = [Vector3::zeros(); 2];
                add(row, layout.category(*body, *category), &mut own);
                own.iter().for_each(|v| magnitude.push(v, made));
                total.iter_mut().zip(own).for_each(|(sum, v)| *sum += v);
            }
            total.iter().for_each(|v| magnitude.push(v, made));
        }
        Ok(())
    })
}
