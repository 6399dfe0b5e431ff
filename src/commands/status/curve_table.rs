//! The tables of `&STATUS CURVES`.

use crate::commands::status::kind::StatusKind;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_connectors::viscous::ViscoelasticLaw;
use windlass_model::EntityKind;
use windlass_model::{Curve, Model};

/// `&STATUS CURVES`.
pub static CURVES: StatusKind =
    StatusKind::new("CURVES", "curves", |query, _| Ok(curves(query.model(), &query.fits())))
        .with_names(&[EntityKind::Curve])
        .plotted(|_, tables| Ok(tables.iter().filter(|table| chart(table)).cloned().collect()))
        .of_moses();

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

fn points(curve: &Curve) -> Table {
    let [a, b] = curve.kind.axes();
    Table::new(format!("Curve {}", curve.name))
        .fact("Type", curve.kind.name(), Dim::None)
        .with_rows(&curve.points)
        .column("", a.0, a.1, Digits::Usual, |(x, _)| *x)
        .column("", b.0, b.1, Digits::Usual, |(_, y)| *y)
        .build()
}

fn exponentials(curve: &Curve) -> Option<Table> {
    let fit = ViscoelasticLaw::fit(curve)?;
    let table = Table::new(format!("{FIT} {}", curve.name))
        .fact("Long-Term Stiffness", fit.law.long_term, Dim::ForcePerLength)
        .fact("Largest Error / Stiffness", fit.error, Dim::None)
        .with_rows(&fit.law.branches)
        .column("", "Relaxation Time", Dim::Time, Digits::Usual, |branch| branch.time)
        .column("", "Stiffness", Dim::ForcePerLength, Digits::Usual, |branch| branch.stiffness)
        .build();
    Some(table)
}
