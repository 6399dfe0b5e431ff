//! The tables of &STATUS that list what the model itself holds: bodies, points, connectors, selectors.

use super::status::{kinds_told, push};
use windlass_base::table::{Cell, Digits, Table};
use windlass_base::units::Dim;
use windlass_model::Model;

fn place_columns(mut table: Table) -> Table {
    for name in ["X", "Y", "Z"] {
        table = table.column("Location", name, Dim::Length, Digits::Usual);
    }
    for name in ["Roll", "Pitch", "Yaw"] {
        table = table.column("Rotation", name, Dim::Angle, Digits::Usual);
    }
    table
}

/// Where the bodies stand.
pub fn configuration(model: &Model, fits: &dyn Fn(&str) -> bool) -> Table {
    let mut table = place_columns(Table::new("Configuration").column("", "Body", Dim::None, Digits::Usual));
    for body in model.bodies.values().filter(|b| fits(&b.name)) {
        let mut row = vec![Cell::from(body.name.as_str())];
        row.extend(body.place.values().map(Cell::Number));
        push(&mut table, row);
    }
    table
}

/// Bodies with their parts.
pub fn bodies(model: &Model, fits: &dyn Fn(&str) -> bool) -> Table {
    let table = Table::new("Bodies and Parts").column("", "Body", Dim::None, Digits::Usual).column(
        "",
        "Part",
        Dim::None,
        Digits::Usual,
    );
    let mut table = place_columns(table).column("", "Points", Dim::None, Digits::Usual).column(
        "",
        "Ignored",
        Dim::None,
        Digits::Usual,
    );
    for part in model.parts.values().filter(|p| fits(&p.body) || fits(&p.name)) {
        let count = model.points.values().filter(|p| Model::key(&p.part) == Model::key(&part.name)).count();
        let ignored = model.bodies.get(&Model::key(&part.body)).map_or(String::new(), |b| b.ignored.join(" "));
        let mut row = vec![Cell::from(part.body.as_str()), Cell::from(part.name.as_str())];
        row.extend(part.place.values().map(Cell::Number));
        row.extend([count.into(), ignored.into()]);
        push(&mut table, row);
    }
    table
}

/// Points, in their parts and in the global system.
pub fn points(model: &Model, fits: &dyn Fn(&str) -> bool) -> Table {
    let mut table =
        Table::new("Points").column("", "Name", Dim::None, Digits::Usual).column("", "Part", Dim::None, Digits::Usual);
    for group in ["Part System", "Global System"] {
        for name in ["X", "Y", "Z"] {
            table = table.column(group, name, Dim::Length, Digits::Usual);
        }
    }
    for point in model.points.values().filter(|p| fits(&p.name)) {
        let mut row = vec![Cell::from(point.name.as_str()), Cell::from(point.part.as_str())];
        row.extend(point.at.into_iter().chain(model.global(point)).map(Cell::Number));
        push(&mut table, row);
    }
    table
}

/// What connectors hang on, and where; two rows each.
pub fn connectors(model: &Model, fits: &dyn Fn(&str) -> bool) -> Table {
    let mut table = Table::new("Connector Geometry")
        .column("", "Name", Dim::None, Digits::Usual)
        .column("", "Class", Dim::None, Digits::Usual)
        .column("", "Status", Dim::None, Digits::Usual)
        .column("", "First Seg.", Dim::Length, Digits::Usual)
        .column("Connection", "Body", Dim::None, Digits::Usual);
    for name in ["X", "Y", "Z"] {
        table = table.column("Connection", name, Dim::Length, Digits::Usual);
    }
    for connector in model.connectors.values().filter(|c| fits(&c.name)) {
        let status = if connector.active { "Active" } else { "Inactive" };
        let ends: Vec<(String, Option<[f64; 3]>)> = connector
            .points
            .iter()
            .enumerate()
            .map(|(index, name)| {
                let point = model.points.get(&Model::key(name));
                let body = point.and_then(|p| model.body_of(p)).map_or("GROUND".to_string(), |b| b.name.clone());
                (body, model.end(connector, index))
            })
            .collect();
        let first = ends.first().cloned().unwrap_or(("GROUND".into(), None));
        let mut row: Vec<Cell> = vec![
            connector.name.as_str().into(),
            connector.class.as_str().into(),
            status.into(),
            model.first_length(connector).into(),
            first.0.into(),
        ];
        let coordinates = |at: Option<[f64; 3]>| [0, 1, 2].map(|i| Cell::from(at.and_then(|a| a.get(i).copied())));
        row.extend(coordinates(first.1));
        push(&mut table, row);
        let (body, at) = ends.get(1).cloned().unwrap_or(("GROUND".into(), None));
        let mut row = vec![Cell::Missing, Cell::Missing, Cell::Missing, Cell::Missing, body.into()];
        match (at, connector.anchor) {
            (None, Some(anchor)) => {
                row.extend(anchor.at.map(Cell::Number));
                row.push(model.placement(connector).other.map(|[_, _, z]| z).into());
            }
            (at, _) => row.extend(coordinates(at)),
        }
        push(&mut table, row);
    }
    table
}

/// Selectors.
pub fn selectors(model: &Model, fits: &dyn Fn(&str) -> bool) -> Table {
    let mut table = Table::new("Selectors")
        .column("", "Name", Dim::None, Digits::Usual)
        .column("", "Select", Dim::None, Digits::Usual)
        .column("", "Except", Dim::None, Digits::Usual);
    for s in model.selectors.values().filter(|s| fits(&s.name)) {
        push(&mut table, vec![s.name.as_str().into(), s.select.join(" ").into(), s.except.join(" ").into()]);
    }
    table
}

/// What the model holds, by number.
pub fn summary(model: &Model) -> Table {
    let mut table =
        Table::new("Model").column("", "What", Dim::None, Digits::Usual).column("", "Number", Dim::None, Digits::Usual);
    for (name, count) in [
        ("bodies", model.bodies.len()),
        ("parts", model.parts.len()),
        ("points", model.points.len()),
        ("classes", model.classes.len()),
        ("connectors", model.connectors.len()),
        ("curves", model.curves.len()),
        ("environments", model.environments.len()),
        ("selectors", model.selectors.len()),
    ] {
        push(&mut table, vec![name.into(), count.into()]);
    }
    table.note(format!("&STATUS tells of: {}", kinds_told().map(|k| k.0).collect::<Vec<_>>().join(" ")));
    table
}
