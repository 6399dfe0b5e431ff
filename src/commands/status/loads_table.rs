//! `&STATUS LOADS`: the loads of wind, current and waves that records have put on parts, and what they come to.

use crate::commands::Job;
use crate::commands::model::apply;
use crate::commands::status::kind::StatusKind;
use windlass_base::pose::{Pose, Six};
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_hydro::{Category, Floating};
use windlass_model::EntityKind;
use windlass_model::{Body, ClassError, Fluid, LoadKind, Model, PartLoad};

/// `&STATUS LOADS`.
pub static LOADS: StatusKind =
    StatusKind::new("LOADS", "loads of wind, current and waves on parts, and the forces they come to", |query, _| {
        Ok(loads(query.job, &query.fits()))
    })
    .with_names(&[EntityKind::Body, EntityKind::Part])
    .also(&["G_LOAD", "LOAD_GROUP"]);

/// One table of the records, one of the forces on each body as it stands.
pub(crate) fn loads(job: &Job, fits: &dyn Fn(&str) -> bool) -> Vec<Table> {
    let model = &job.model;
    let chosen = |part: &str| {
        let body = model.parts.get(&Model::key(part)).map_or("", |p| p.body.as_str());
        fits(part) || fits(body)
    };
    let loads: Vec<&PartLoad> = model.loads.iter().filter(|l| chosen(&l.part)).collect();
    let mut records = Table::new("Loads of Wind, Current and Waves")
        .with_rows(&loads)
        .text("Part", |load| &load.part)
        .text("Record", |load| load.kind.name())
        .text("Acts in", |load| match (&load.kind, load.fluid) {
            (LoadKind::Drift { .. }, _) => "waves",
            (LoadKind::Buoyancy { .. } | LoadKind::EddyDamping(_) | LoadKind::RollDamping(_), _) => "water",
            (LoadKind::Force(_), _) => "any",
            (LoadKind::Drag(_) | LoadKind::Damping(_) | LoadKind::AddedMass(_) | LoadKind::Lump(_), _) => "water",
            (_, Fluid::ByHeight) => "by height",
            (_, Fluid::Air) => "air",
            (_, Fluid::Water) => "water",
        })
        .columns("Point in Part", ["X", "Y", "Z"], Dim::Length, Digits::Usual, |load| load.at)
        .columns("Area x Coefficient", ["X", "Y", "Z"], Dim::Area, Digits::Usual, |load| match &load.kind {
            LoadKind::Area(areas) => areas.map(Some),
            LoadKind::Lump(lump) => lump.drag_areas.map(Some),
            LoadKind::Plate { area, normal } => normal.map(|n| Some(area * n.abs())),
            _ => [None; 3],
        })
        .column("", "Headings", Dim::None, Digits::Usual, |load| match &load.kind {
            LoadKind::Coefficients { rows, .. } => Some(rows.len()),
            _ => None,
        })
        .column("", "Heading", Dim::Angle, Digits::Usual, |load| match &load.kind {
            LoadKind::Drift { heading, .. } => Some(*heading),
            _ => None,
        })
        .build();
    for (name, factor) in model.multipliers.categories.iter().chain(&model.multipliers.parts) {
        records.note(format!("&APPLY multiplies loads of {name} by {factor}"));
    }
    for rule in &model.multipliers.attributes {
        let of = rule.attribute.map_or("loads", |attribute| apply::attribute_word(attribute));
        records.note(format!("&APPLY multiplies {of} of category {} by {}", rule.categories, rule.factor));
    }
    for load in loads.iter().filter(|load| load.shape_coefficients != [1.0; 2]) {
        let [wind, drag] = load.shape_coefficients;
        let record = load.kind.name();
        records.note(format!("{record} of {}: coefficient {wind} in wind, {drag} in current", load.part));
    }
    vec![records, forces(job, &chosen)]
}

/// Force and moment of each category on each body that has such loads, about its origin.
fn forces(job: &Job, chosen: &dyn Fn(&str) -> bool) -> Table {
    let model = &job.model;
    let mut table = Table::new("Steady Forces");
    let loaded = |b: &&Body| {
        let mut parts = model.parts_of(b);
        parts.any(|p| !p.pieces.is_empty() || model.loads.iter().any(|l| Model::key(&l.part) == Model::key(&p.name)))
    };
    let mut rows: Vec<(&str, Category, Six)> = Vec::new();
    for body in model.bodies.values().filter(|b| chosen(&b.name)).filter(loaded) {
        match sums(model, body) {
            Ok(list) => rows.extend(list.into_iter().map(|(category, wrench)| (body.name.as_str(), category, wrench))),
            Err(error) => table.note_absent(format!("{}: {}", body.name, error.text(job.units))),
        }
    }
    table
        .with_rows(&rows)
        .text("Body", |(body, ..)| *body)
        .text("Category", |(_, category, _)| category.name())
        .columns("Force, Global", ["FX", "FY", "FZ"], Dim::Force, Digits::Usual, |(.., w)| [w[0], w[1], w[2]])
        .columns("Moment about the Origin", ["MX", "MY", "MZ"], Dim::Moment, Digits::Usual, |(.., w)| {
            [w[3], w[4], w[5]]
        })
        .build()
}

fn sums(model: &Model, body: &Body) -> Result<Vec<(Category, Six)>, ClassError> {
    let floating = Floating::at_rest(model, body)?;
    let pose = Pose::from_place(&body.position);
    let mut list = Vec::new();
    for category in [Category::Wind, Category::ViscousDrag, Category::WaveDrift, Category::Applied] {
        let mut mine = floating.loads.iter().filter(|l| l.category() == category).peekable();
        if mine.peek().is_some() {
            let sum = mine.try_fold(Six::zeros(), |sum, load| load.mean_load(&pose).map(|l| sum + l.wrench))?;
            list.push((category, sum));
        }
    }
    Ok(list)
}
