//! How a connector is idealised: what every table of line tension says under Model.

use super::{Connector, Model, list_names};
use windlass_base::table::{Cell, Column, Digits, Table};
use windlass_base::units::Dim;

/// How a connector is idealised in statics and in time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Idealisation {
    /// A line with inertia, drag and bottom contact of its own, solved by elements.
    Dynamic,
    /// A line that at every instant has the shape of rest between its ends.
    QuasiStatic,
    /// A spring, tie or bar: its force follows from its ends alone.
    Massless,
}

impl Idealisation {
    /// All, in the order of remarks.
    const ALL: [Idealisation; 3] = [Idealisation::QuasiStatic, Idealisation::Dynamic, Idealisation::Massless];

    /// The word of reports.
    pub fn name(self) -> &'static str {
        match self {
            Idealisation::Dynamic => "dynamic",
            Idealisation::QuasiStatic => "quasi-static",
            Idealisation::Massless => "massless",
        }
    }
}

impl From<Idealisation> for Cell {
    fn from(idealisation: Idealisation) -> Cell {
        idealisation.name().into()
    }
}

impl Model {
    /// Whether a connector is a line that at every instant has the shape of rest between its ends: a line whose own inertia and drag are
    /// left out.
    pub fn is_quasi_static(&self, connector: &Connector) -> bool {
        let class = self.classes.get(&Model::key(&connector.class));
        class.is_some_and(|c| c.object.as_line().is_some()) && !self.is_dynamic_line(connector)
    }

    /// How the connector, or the pipe of an assembly, of a name is idealised in statics and in time. None of what is neither.
    pub fn idealisation(&self, name: &str) -> Option<Idealisation> {
        let key = Model::key(name);
        if self.assemblies.contains_key(&key) {
            return Some(Idealisation::Dynamic);
        }
        let connector = self.connectors.get(&key)?;
        Some(match connector {
            c if self.is_dynamic_line(c) || self.holds_pipe(&c.name) => Idealisation::Dynamic,
            c if self.is_quasi_static(c) => Idealisation::QuasiStatic,
            _ => Idealisation::Massless,
        })
    }

    /// The idealisations of some connectors as a remark: `Model: quasi-static A, B; dynamic C`. None without such.
    pub fn idealisations<'a>(&self, names: impl Iterator<Item = &'a str> + Clone) -> Option<String> {
        let of_kind = |kind: Idealisation| {
            let own: Vec<&str> = names.clone().filter(|name| self.idealisation(name) == Some(kind)).collect();
            (!own.is_empty()).then(|| format!("{} {}", kind.name(), list_names(&own)))
        };
        let parts: Vec<String> = Idealisation::ALL.into_iter().filter_map(of_kind).collect();
        (!parts.is_empty()).then(|| format!("Model: {}", parts.join("; ")))
    }
}

/// Adds a column Model to a table whose first column names the connectors of the rows; last, so that the numbers of the others stay.
pub fn add_model_column(table: &mut Table, model_of: impl Fn(&str) -> Option<Idealisation>) {
    let Some(names) = table.columns().first() else { return };
    let cell = |name: &Cell| match name {
        Cell::Text(name) => model_of(name).into(),
        _ => Cell::Missing,
    };
    let cells: Vec<Cell> = names.cells.iter().map(cell).collect();
    table.add_column(Column::new("", "Model", Dim::None, Digits::Usual, cells));
}
