//! The tables of &STATUS that list what the model itself holds: bodies, points, connectors, selectors.

use crate::commands::environment::bathymetry;
use crate::commands::model::t_pressure;
use crate::commands::solve::prescribe::motions;
use crate::commands::status::kind::StatusKind;
use crate::commands::status::listed_kinds;
use crate::commands::status::offsets::offsets;
use windlass_base::choice::Choice;
use windlass_base::geometry::Place;
use windlass_base::table::{Digits, Table, TableBuilder};
use windlass_base::units::Dim;
use windlass_model::EntityKind;
use windlass_model::{Body, Connector, LOOSE_SURFACES, Model, Part, Point, Selector};

/// `&STATUS` alone.
pub static SUMMARY: StatusKind =
    StatusKind::new("SUMMARY", "what the model holds", |query, _| Ok(vec![summary(query.model())]));

/// `&STATUS CONFIGURATION`.
pub static CONFIGURATION: StatusKind = StatusKind::new("CONFIGURATION", "where the bodies stand", |query, _| {
    Ok(vec![configuration(query.model(), &query.fits())])
})
.with_names(&[EntityKind::Body])
.of_moses();

/// `&STATUS G_CONNECTOR`.
pub static G_CONNECTOR: StatusKind = StatusKind::new("G_CONNECTOR", "connector geometry", |query, _| {
    let (model, fits) = (query.model(), query.fits());
    Ok(std::iter::once(connectors(model, &fits)).chain(offsets(model, &fits)).collect())
})
.with_names(&[EntityKind::Connector])
.of_moses();

/// `&STATUS BATHYMETRY`.
pub static BATHYMETRY: StatusKind =
    StatusKind::new("BATHYMETRY", "bottoms over a grid: extent, least and greatest depth", |query, _| {
        Ok(vec![bathymetry::table(query.model(), &query.fits())])
    })
    .with_names(&[EntityKind::Bathymetry]);

/// `&STATUS T_PRESSURE`.
pub static T_PRESSURE: StatusKind =
    StatusKind::new("T_PRESSURE", "temperature, pressure and contents of pipes", |query, _| {
        Ok(vec![t_pressure::table(query.model(), &query.fits())])
    })
    .with_names(&[EntityKind::Filling]);

/// `&STATUS BODIES`.
pub static BODIES: StatusKind = StatusKind::new("BODIES", "bodies and their parts", |query, _| {
    let (model, fits) = (query.model(), query.fits());
    Ok(std::iter::once(bodies(model, &fits)).chain(motions(model, &fits)).collect())
})
.with_names(&[EntityKind::Body, EntityKind::Part])
.also(&["PARTS"]);

/// `&STATUS POINTS`.
pub static POINTS: StatusKind =
    StatusKind::new("POINTS", "points, in their parts and in the global system", |query, _| {
        Ok(vec![points(query.model(), &query.fits())])
    })
    .with_names(&[EntityKind::Point])
    .also(&["POINT", "NODE"]);

/// `&STATUS SELECTORS`.
pub static SELECTORS: StatusKind =
    StatusKind::new("SELECTORS", "selectors", |query, _| Ok(vec![selectors(query.model(), &query.fits())]))
        .with_names(&[EntityKind::Selector]);

fn place_columns<'r, R>(table: TableBuilder<'r, R>, position: impl Fn(&'r R) -> &'r Place) -> TableBuilder<'r, R> {
    table.columns("Location", ["X", "Y", "Z"], Dim::Length, Digits::Usual, |row| position(row).shift).columns(
        "Rotation",
        ["Roll", "Pitch", "Yaw"],
        Dim::Angle,
        Digits::Usual,
        |row| position(row).turn,
    )
}

/// Where the bodies stand.
pub fn configuration(model: &Model, fits: &dyn Fn(&str) -> bool) -> Table {
    let bodies: Vec<&Body> = model.bodies.values().filter(|b| fits(&b.name)).collect();
    let table = Table::new("Configuration").with_rows(&bodies).text("Body", |body| &body.name);
    place_columns(table, |body| &body.position).build()
}

/// Bodies with their parts.
pub fn bodies(model: &Model, fits: &dyn Fn(&str) -> bool) -> Table {
    let parts: Vec<&Part> =
        model.parts.values().filter(|p| p.name != LOOSE_SURFACES && (fits(&p.body) || fits(&p.name))).collect();
    let table = Table::new("Bodies and Parts")
        .with_rows(&parts)
        .text("Body", |part| &part.body)
        .text("Part", |part| &part.name);
    place_columns(table, |part| &part.position)
        .column("", "Points", Dim::None, Digits::Usual, |part| {
            model.points.values().filter(|p| Model::key(&p.part) == Model::key(&part.name)).count()
        })
        .text("Ignored", |part| {
            model
                .bodies
                .get(&Model::key(&part.body))
                .map_or(String::new(), |b| b.ignored.iter().map(|dof| dof.word()).collect::<Vec<_>>().join(" "))
        })
        .build()
}

/// Points, in their parts and in the global system.
pub fn points(model: &Model, fits: &dyn Fn(&str) -> bool) -> Table {
    let points: Vec<&Point> = model.points.values().filter(|p| fits(&p.name)).collect();
    Table::new("Points")
        .with_rows(&points)
        .text("Name", |point| &point.name)
        .text("Part", |point| &point.part)
        .columns("Part System", ["X", "Y", "Z"], Dim::Length, Digits::Usual, |point| point.at)
        .columns("Global System", ["X", "Y", "Z"], Dim::Length, Digits::Usual, |point| model.global(point))
        .build()
}

/// What a row of the connector geometry shows: one end of a connector.
struct EndRow<'m> {
    /// The connector, on the row of its first end.
    connector: Option<&'m Connector>,
    /// The body of the end, or `GROUND`.
    body: &'m str,
    /// Its global coordinates (m), as far as they are known.
    at: [Option<f64>; 3],
}

impl<'m> EndRow<'m> {
    /// The rows of a connector, the first end before the second.
    fn build_pair(model: &'m Model, connector: &'m Connector) -> [Self; 2] {
        let end = |index: usize| {
            let name = connector.points.get(index);
            let point = name.and_then(|name| model.points.get(&Model::key(name)));
            let body = point.and_then(|p| model.body_of(p)).map_or("GROUND", |b| b.name.as_str());
            (body, model.end(connector, index))
        };
        let [(first, first_at), (second, second_at)] = [end(0), end(1)];
        let known = |at: Option<[f64; 3]>| at.map_or([None; 3], |at| at.map(Some));
        let second_at = match (second_at, connector.anchor) {
            (None, Some(anchor)) => {
                let [x, y] = anchor.at;
                [Some(x), Some(y), model.placement(connector).other.map(|[_, _, z]| z)]
            }
            (at, _) => known(at),
        };
        [
            EndRow { connector: Some(connector), body: first, at: known(first_at) },
            EndRow { connector: None, body: second, at: second_at },
        ]
    }
}

/// What connectors hang on, and where; two rows each.
pub fn connectors(model: &Model, fits: &dyn Fn(&str) -> bool) -> Table {
    let chosen = model.connectors.values().filter(|c| fits(&c.name));
    let ends: Vec<EndRow> = chosen.flat_map(|connector| EndRow::build_pair(model, connector)).collect();
    Table::new("Connector Geometry")
        .with_rows(&ends)
        .text("Name", |end| end.connector.map(|c| c.name.as_str()))
        .text("Class", |end| end.connector.map(|c| c.class.as_str()))
        .text("Status", |end| end.connector.map(|c| if c.active { "Active" } else { "Inactive" }))
        .column("", "First Seg.", Dim::Length, Digits::Usual, |end| end.connector.and_then(|c| model.first_length(c)))
        .column("Connection", "Body", Dim::None, Digits::Usual, |end| end.body)
        .columns("Connection", ["X", "Y", "Z"], Dim::Length, Digits::Usual, |end| end.at)
        .build()
}

/// Selectors.
pub fn selectors(model: &Model, fits: &dyn Fn(&str) -> bool) -> Table {
    let selectors: Vec<&Selector> = model.selectors.values().filter(|s| fits(&s.name)).collect();
    Table::new("Selectors")
        .with_rows(&selectors)
        .text("Name", |s| &s.name)
        .text("Select", |s| s.select.join(" "))
        .text("Except", |s| s.except.join(" "))
        .build()
}

/// What the model holds, by number.
pub fn summary(model: &Model) -> Table {
    let counts = [
        ("bodies", model.bodies.len()),
        ("parts", model.parts.len()),
        ("points", model.points.len()),
        ("classes", model.classes.len()),
        ("connectors", model.connectors.len()),
        ("curves", model.curves.len()),
        ("environments", model.environments.len()),
        ("selectors", model.selectors.len()),
    ];
    let mut table = Table::new("Model")
        .with_rows(&counts)
        .text("What", |(name, _)| *name)
        .column("", "Number", Dim::None, Digits::Usual, |(_, count)| *count)
        .build();
    table.note(format!("&STATUS reports: {}", listed_kinds().map(|k| k.0).collect::<Vec<_>>().join(" ")));
    table
}
