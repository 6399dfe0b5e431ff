//! What acts on bodies, by category.

use super::super::system::SolveError;
use super::super::time::Run;
use super::{EventTable, Magnitude, RunEvent, group_head};
use nalgebra::Vector3;
use windlass_base::table::Table;
use windlass_base::units::Dim;
use windlass_hydro::Category;

/// Adds the columns of a force and a moment.
pub(super) fn wrench_columns<T>(
    table: EventTable<T>,
    group: &str,
    magnitude: Magnitude,
    wrench: impl Fn(&T) -> [Vector3<f64>; 2],
) -> EventTable<T> {
    table
        .columns(group, ["FX", "FY", "FZ", "F Mag."], Dim::Force, |row| {
            magnitude.components_and_magnitude(&wrench(row)[0])
        })
        .columns(group, ["MX", "MY", "MZ", "M Mag."], Dim::Moment, |row| {
            magnitude.components_and_magnitude(&wrench(row)[1])
        })
}

/// A force and a moment without numbers.
pub(super) fn no_wrench() -> [Vector3<f64>; 2] {
    [Vector3::repeat(f64::NAN); 2]
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
pub fn body_forces(
    run: &Run,
    bodies: &[usize],
    magnitude: Magnitude,
    events: &[RunEvent],
) -> Result<Table, SolveError> {
    let layout = &run.history.layout;
    let several = bodies.len() > 1;
    // by body the wrenches of the categories, then their sum
    let mut table = EventTable::new("Forces on Bodies", (&run.history, events), |row| {
        let of_body = |body: &usize| {
            let mut total = [Vector3::zeros(); 2];
            let mut list = Vec::new();
            for category in &layout.categories {
                let mut own = [Vector3::zeros(); 2];
                add(row, layout.category(*body, *category), &mut own);
                total.iter_mut().zip(own).for_each(|(sum, v)| *sum += v);
                list.push(own);
            }
            list.push(total);
            list
        };
        Ok(bodies.iter().map(of_body).collect::<Vec<_>>())
    })?
    .fact("Moments About", "the origins of the bodies", Dim::None);
    for (index, body) in bodies.iter().enumerate() {
        let Some((name, _)) = layout.bodies.get(*body) else { continue };
        if !several {
            table = table.fact("Body", name.as_str(), Dim::None);
        }
        for (which, group) in layout.categories.iter().map(|c| c.name()).chain(["TOTAL"]).enumerate() {
            let own =
                |all: &Vec<Vec<_>>| all.get(index).and_then(|list| list.get(which)).copied().unwrap_or_else(no_wrench);
            table = wrench_columns(table, &group_head(several, name, group), magnitude, own);
        }
    }
    let mut table = table.build();
    table.note("TOTAL is with inertia: what the step left, and what holds degrees of freedom that do not move");
    if layout.categories.contains(&Category::WaveMean) {
        table.note(
            "W_MEAN is what is slow (TDOM -DIVIDING) of the force of undisturbed waves on members and hulls of -DIFTYPE FK: no drift force, which \
             diffraction and radiation make; #DRIFT or DATABASE give it as W_DRIFT. The mean drag of members is in V_DRAG",
        );
    }
    Ok(table)
}
