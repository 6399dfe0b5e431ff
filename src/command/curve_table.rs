//! The tables of `&STATUS CURVES`.

use windlass_base::table::{Cell, Digits, Table};
use windlass_base::units::Dim;
use windlass_connectors::viscous::Viscoelastic;
use windlass_model::{Curve, Model};

/// What the title of a fit begins with.
const FIT: &str = "Exponentials of Curve";

/// Each curve that fits, and behind a convolution the exponentials that stand for it in the time domain.
pub fn curves(model: &Model, fits: &dyn Fn(&str) -> bool) -> Vec<Table> {
    let chosen = model.curves.values().filter(|c| fits(&c.name));
    chosen.flat_map(|curve| std::iter::once(points(curve)).chain(exponentials(curve))).collect()
}

/// Whether a table is one to plot: a curve, not a fit.
pub fn chart(table: &Table) -> bool {
    !table.title.starts_with(FIT)
}

fn push(table: &mut Table, row: Vec<Cell>) {
    let fits = table.push(row);
    debug_assert!(fits.is_ok(), "a row of a curve must fit its table");
}

fn points(curve: &Curve) -> Table {
    let [a, b] = curve.kind.axes();
    let mut table = Table::new(format!("Curve {}", curve.name))
        .fact("Type", curve.kind.name(), Dim::None)
        .column("", a.0, a.1, Digits::Usual)
        .column("", b.0, b.1, Digits::Usual);
    for (x, y) in &curve.points {
        push(&mut table, vec![(*x).into(), (*y).into()]);
    }
    table
}

fn exponentials(curve: &Curve) -> Option<Table> {
    let fit = Viscoelastic::fit(curve)?;
    let mut table = Table::new(format!("{FIT} {}", curve.name))
        .fact("Long-Term Stiffness", fit.law.long_term, Dim::ForcePerLength)
        .fact("Largest Error / Stiffness", fit.error, Dim::None)
        .column("", "Relaxation Time", Dim::Time, Digits::Usual)
        .column("", "Stiffness", Dim::ForcePerLength, Digits::Usual);
    for branch in &fit.law.branches {
        push(&mut table, vec![branch.time.into(), branch.stiffness.into()]);
    }
    Some(table)
}
