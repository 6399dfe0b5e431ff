//! How a connector is idealised: what every table of line tension says under Model.

use super::{Connector, Model, list_names};
use windlass_base::table::{Cell, Column, Digits, Table};
use windlass_base::units::Dim;

/// A line with inertia, drag and bottom contact of its own, solved by elements.
pub const DYNAMIC: &str = "dynamic";
/// A line that at every instant has the shape of rest between its ends.
pub const QUASI_STATIC: &str = "quasi-static";
/// A spring, tie or bar: its force follows from its ends alone.
pub const MASSLESS: &str = "massless";

impl Model {
    /// Whether a connector is a line that at every instant has the shape of rest between its ends: a line whose own inertia and drag are
    /// left out.
    pub fn is_quasi_static(&self, connector: &Connector) -> bool {
        let class = self.classes.get(&Model::key(&connector.class));
        class.is_some_and(|c| c.object.is_line()) && !self.moves(connector)
    }

    /// How the connector, or the pipe of an assembly, of a name is idealised in statics and in time: [`DYNAMIC`], [`QUASI_STATIC`] or
    /// [`MASSLESS`]. None of what is neither.
    pub fn idealisation(&self, name: &str) -> Option<&'static str> {
        let key = Model::key(name);
        if self.assemblies.contains_key(&key) {
            return Some(DYNAMIC);
        }
        let connector = self.connectors.get(&key)?;
        Some(match connector {
            c if self.moves(c) || self.holds_pipe(&c.name) => DYNAMIC,
            c if self.is_quasi_static(c) => QUASI_STATIC,
            _ => MASSLESS,
        })
    }

    /// The idealisations of some connectors as a remark: `Model: quasi-static A, B; dynamic C`. None without such.
    pub fn idealisations<'a>(&self, names: impl Iterator<Item = &'a str> + Clone) -> Option<String> {
        let of_kind = |kind: &'static str| {
            let own: Vec<&str> = names.clone().filter(|name| self.idealisation(name) == Some(kind)).collect();
            (!own.is_empty()).then(|| format!("{kind} {}", list_names(&own)))
        };
        let parts: Vec<String> = [QUASI_STATIC, DYNAMIC, MASSLESS].into_iter().filter_map(of_kind).collect();
        (!parts.is_empty()).then(|| format!("Model: {}", parts.join("; ")))
    }
}

/// Adds a column Model to a table whose first column names the connectors of the rows; last, so that the numbers of the others stay.
pub fn add_model_column(table: &mut Table, model_of: impl Fn(&str) -> Option<&'static str>) {
    let Some(names) = table.columns.first() else { return };
    let cell = |name: &Cell| match name {
        Cell::Text(name) => model_of(name).into(),
        _ => Cell::Missing,
    };
    let cells: Vec<Cell> = names.cells.iter().map(cell).collect();
    table.columns.push(Column::new("", "Model", Dim::None, Digits::Usual, cells));
}
