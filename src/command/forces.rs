//! `&STATUS F_CONNECTOR`: the forces of the connectors between their ends as they are.

use super::chosen::{WARNING, gathered};
use super::status::push;
use crate::language::units::{Dim, UnitSystem};
use crate::model::{ClassError, Connector, LineLoads, Model};
use crate::table::{Cell, Digits, Table};

/// One row a connector. Those that are inactive, of a class that makes no line, or without a solution have no forces.
pub fn forces(model: &Model, fits: &dyn Fn(&str) -> bool, units: UnitSystem) -> Table {
    let mut table = Table::new("Connector Forces")
        .column("", "Name", Dim::None, Digits::Usual)
        .column("", "Class", Dim::None, Digits::Usual)
        .column("", "Solution", Dim::None, Digits::Usual)
        .column("Horizontal", "Distance", Dim::Length, Digits::Usual);
    for name in ["FX", "FY", "FZ"] {
        table = table.column("Force on First End", name, Dim::Force, Digits::Usual);
    }
    let mut table = table
        .column("Tension", "Ten Top", Dim::Force, Digits::Usual)
        .column("Tension", "Max T/TB", Dim::None, Digits::Decimals(3))
        .column("Tension", "Crit. Seg", Dim::None, Digits::Usual)
        .column("Anchor", "V. Pull", Dim::Force, Digits::Usual)
        .column("Anchor", "H. Pull", Dim::Force, Digits::Usual)
        .column("On Bottom", "Unstretched", Dim::Length, Digits::Usual);
    let (mut notes, mut others): (Vec<(String, Vec<String>)>, Vec<String>) = (Vec::new(), Vec::new());
    for connector in model.connectors.values().filter(|c| fits(&c.name)) {
        let class = model.classes.get(&Model::key(&connector.class));
        let line = class.is_some_and(|c| c.object.is_line());
        let (solution, loads) = match (connector.active, line) {
            (false, _) => ("inactive", None),
            (true, false) => {
                others.extend(class.map(|c| format!("{} ({})", connector.name, c.object.kind())));
                ("no line", None)
            }
            (true, true) => match loads(model, connector) {
                Ok(mut loads) => {
                    notes.push((connector.name.clone(), std::mem::take(&mut loads.notes)));
                    (loads.solution, Some(loads))
                }
                Err(error) => {
                    notes.push((connector.name.clone(), vec![format!("{WARNING}{}", error.text(units))]));
                    ("none", None)
                }
            },
        };
        let mut row: Vec<Cell> = vec![connector.name.as_str().into(), connector.class.as_str().into(), solution.into()];
        row.extend(numbers(loads.as_ref(), model.placement(connector).span().1));
        push(&mut table, row);
    }
    table.notes = gathered(&notes);
    if !others.is_empty() {
        table.note(format!(
            "classes of these types make no line yet, and their forces are not computed: {}",
            others.join(", ")
        ));
    }
    table
}

fn loads(model: &Model, connector: &Connector) -> Result<LineLoads, ClassError> {
    let class = model.classes.get(&Model::key(&connector.class));
    let class = class.ok_or_else(|| ClassError::new(format!("there is no class {}", connector.class)))?;
    class.object.line(&model.placement(connector), &model.surroundings())?.loads()
}

/// The ten numbers of a row; `along` is the direction from the first end to the other.
fn numbers(loads: Option<&LineLoads>, along: [f64; 2]) -> [Cell; 10] {
    let Some(loads) = loads else { return [const { Cell::Missing }; 10] };
    let ([fx, fy, fz], [horizontal, vertical]) = (loads.fairlead, loads.anchor(along));
    [
        loads.distance.into(),
        fx.into(),
        fy.into(),
        fz.into(),
        loads.tension.into(),
        loads.ratio.into(),
        loads.critical.into(),
        vertical.into(),
        horizontal.into(),
        loads.grounded.into(),
    ]
}
