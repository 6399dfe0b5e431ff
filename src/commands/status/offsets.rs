//! The part of `&STATUS G_CONNECTOR` that few connectors need: offsets of their ends and angles of their axes.

use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_model::Model;

/// -GO1, -GO2 and -EULER of the connectors that have one of them; `None` when none has.
pub fn offsets(model: &Model, fits: &dyn Fn(&str) -> bool) -> Option<Table> {
    let mut rows = Vec::new();
    for connector in model.connectors.values().filter(|c| fits(&c.name)) {
        let [first, second] = connector.offsets.map(|at| (at != [0.0; 3]).then_some(at));
        let given = [first, second, connector.euler];
        if given.iter().any(Option::is_some) {
            rows.push((connector.name.as_str(), given));
        }
    }
    let cells = |values: Option<[f64; 3]>| values.map_or([None; 3], |v| v.map(Some));
    let table = Table::new("Offsets and Element Axes")
        .with_rows(&rows)
        .text("Name", |(name, _)| *name)
        .columns("-GO1", ["X", "Y", "Z"], Dim::Length, Digits::Usual, |(_, [first, _, _])| cells(*first))
        .columns("-GO2", ["X", "Y", "Z"], Dim::Length, Digits::Usual, |(_, [_, second, _])| cells(*second))
        .columns("-EULER", ["RX", "RY", "RZ"], Dim::Angle, Digits::Usual, |(_, [_, _, euler])| cells(*euler));
    (!rows.is_empty()).then(|| table.build())
}
