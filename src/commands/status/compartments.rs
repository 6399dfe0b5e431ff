//! `&STATUS COMPARTMENT` and `V_HOLES`: what is in compartments, and how high their holes are above the water.
//!
//! MOSES has the reports [MOSES-REF status]; their columns are ours.

use crate::commands::model::compartment::{hole_word, pose_of};
use crate::commands::status::kind::StatusKind;
use windlass_base::diagnostic::Outcome;
use windlass_base::pose::Pose;
use windlass_base::table::{Digits, Table};
use windlass_base::units::{Dim, UnitSystem};
use windlass_hydro::Tank;
use windlass_model::{ClassError, Compartment, EntityKind, FreeSurface, Model};

/// `&STATUS COMPARTMENT`.
pub static COMPARTMENT: StatusKind =
    StatusKind::new("COMPARTMENT", "what is in compartments, where it lies, and its free surface", |query, _| {
        Ok(vec![contents(query.model(), &query.fits(), query.job.units)])
    })
    .with_names(&[EntityKind::Compartment])
    .of_moses()
    .also(&["S_COMPARTMENT", "CG_COMPARTMENT"]);

/// `&STATUS V_HOLES`.
pub static V_HOLES: StatusKind =
    StatusKind::new("V_HOLES", "holes of compartments and their heights above the water", |query, _| {
        holes(query.model(), &query.fits())
    })
    .of_moses()
    .also(&["WT_DOWN", "NWT_DOWN"]);

/// What is in a compartment where its body stands: a row of the report.
pub(crate) struct CompartmentRow<'m> {
    compartment: &'m Compartment,
    /// Volume of it when full (m3).
    pub(crate) capacity: f64,
    /// Volume of what is in it (m3).
    pub(crate) volume: f64,
    /// Density of that (kg/m3).
    pub(crate) density: f64,
    /// Height of its surface along the sounding tube (m).
    pub(crate) sounding: Option<f64>,
    /// Centre of what is in it, in the body (m).
    pub(crate) centre: [Option<f64>; 3],
    /// Second moments of the surface, about the longitudinal and the transverse axis (m4); none of contents that turn with the body.
    inertia: Option<[f64; 2]>,
}

/// What is in a compartment where its body stands.
///
/// # Errors
/// A compartment that bounds no volume, or contents that have no level.
pub(crate) fn find_contents<'m>(model: &Model, compartment: &'m Compartment) -> Result<CompartmentRow<'m>, ClassError> {
    let tank = Tank::new(model, compartment)?;
    let pose = pose_of(model, compartment);
    let state = compartment.contents;
    let frozen = !state.is_flooded && (state.surface == FreeSurface::Frozen || state.fraction <= compartment.residual);
    let at = if frozen { Pose::default() } else { pose };
    let liquid = tank.liquid(&at)?;
    let centre = liquid.centroid().map(|c| at.axes.transpose() * c);
    let tube = tank.sounding_tube(model, compartment);
    let sounding = if liquid.volume() > 0.0 { tank.sounding(&at, tube, liquid.level) } else { Some(0.0) };
    Ok(CompartmentRow {
        compartment,
        capacity: tank.capacity,
        volume: liquid.volume(),
        density: tank.density(),
        sounding,
        centre: centre.map_or([None; 3], |c| [c.x, c.y, c.z].map(|x| Some(if x.abs() < 1e-9 { 0.0 } else { x }))),
        inertia: (!frozen).then(|| liquid.surface_inertia(&at)),
    })
}

fn contents(model: &Model, fits: &dyn Fn(&str) -> bool, units: UnitSystem) -> Table {
    let mut table = Table::new("Compartments");
    let mut rows = Vec::new();
    for compartment in model.compartments.values().filter(|c| fits(&c.name)) {
        match find_contents(model, compartment) {
            Ok(row) => rows.push(row),
            Err(error) => table.note_absent(format!("{}: {}", compartment.name, error.text(units))),
        }
    }
    let gravity = model.defaults.gravity;
    let fourth = Dim::Derived { force: 0, length: 4, seconds: 0 };
    table.note("Centers are in the system of the body; second moments are those of the free surface about axes through its centroid, along and across the body");
    table
        .with_rows(&rows)
        .text("Name", |row| &row.compartment.name)
        .text("Description", |row| &row.compartment.description)
        .text("Filling", |row| match row.compartment.contents {
            state if state.is_flooded => "flooded",
            state if state.surface == FreeSurface::Frozen => "app_none",
            _ => "correct",
        })
        .column("", "% Full", Dim::None, Digits::Decimals(2), |row| 100.0 * row.volume / row.capacity)
        .column("", "Sounding", Dim::Length, Digits::Usual, |row| row.sounding)
        .column("", "Amount", Dim::Force, Digits::Usual, |row| row.volume * row.density * gravity)
        .column("", "S.G.", Dim::None, Digits::Decimals(4), |row| row.density / 1000.0)
        .columns("Center of Gravity", ["X", "Y", "Z"], Dim::Length, Digits::Usual, |row| row.centre)
        .columns("Free Surface", ["Trans.", "Long."], fourth, Digits::Usual, |row| {
            row.inertia.map_or([None; 2], |i| i.map(Some))
        })
        .build()
}

fn holes(model: &Model, fits: &dyn Fn(&str) -> bool) -> Outcome<Vec<Table>> {
    let level = model.surroundings().tide;
    let rows: Vec<_> = model.holes.values().filter(|hole| fits(&hole.name)).collect();
    let position = |name: &Option<String>| {
        name.as_ref().and_then(|name| model.points.get(&Model::key(name))).map(|point| model.global(point))
    };
    let of = |hole: &str| {
        let has = |c: &&Compartment| c.holes.iter().any(|name| name.eq_ignore_ascii_case(hole));
        model.compartments.values().filter(has).map(|c| c.name.as_str()).collect::<Vec<_>>().join(" ")
    };
    Ok(vec![
        Table::new("Holes")
            .with_rows(&rows)
            .text("Name", |hole| &hole.name)
            .text("Type", |hole| hole_word(hole.kind))
            .text("Compartments", |hole| of(&hole.name))
            .text("Point", |hole| hole.point.clone().unwrap_or_default())
            .columns("Global", ["X", "Y", "Z"], Dim::Length, Digits::Usual, |hole| {
                position(&hole.point).map_or([None; 3], |at| at.map(Some))
            })
            .column("Above", "Water", Dim::Length, Digits::Usual, |hole| {
                position(&hole.point).map(|[_, _, z]| z - level)
            })
            .build(),
    ])
}
