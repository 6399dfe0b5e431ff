//! The part of `&STATUS G_CONNECTOR` that few connectors need: offsets of their ends and angles of their axes.

use super::status::push;
use windlass_base::table::{Cell, Digits, Table};
use windlass_base::units::Dim;
use windlass_model::Model;

/// -GO1, -GO2 and -EULER of the connectors that have one of them; `None` when none has.
pub fn offsets(model: &Model, fits: &dyn Fn(&str) -> bool) -> Option<Table> {
    let mut table = Table::new("Offsets and Element Axes").column("", "Name", Dim::None, Digits::Usual);
    for (group, names, dim) in [
        ("-GO1", ["X", "Y", "Z"], Dim::Length),
        ("-GO2", ["X", "Y", "Z"], Dim::Length),
        ("-EULER", ["RX", "RY", "RZ"], Dim::Angle),
    ] {
        for name in names {
            table = table.column(group, name, dim, Digits::Usual);
        }
    }
    for connector in model.connectors.values().filter(|c| fits(&c.name)) {
        let [first, second] = connector.offsets.map(|at| (at != [0.0; 3]).then_some(at));
        let given = [first, second, connector.euler];
        if given.iter().any(Option::is_some) {
            let cells =
                given.into_iter().flat_map(|g| [0, 1, 2].map(|i| Cell::from(g.and_then(|g| g.get(i).copied()))));
            let row = std::iter::once(Cell::from(connector.name.as_str())).chain(cells).collect();
            push(&mut table, row);
        }
    }
    (table.rows() > 0).then_some(table)
}
