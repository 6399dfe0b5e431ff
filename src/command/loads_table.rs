//! `&STATUS LOADS`: the loads of wind, current and waves that records have put on parts, and what they come to.

use super::Job;
use super::status::push;
use windlass_base::pose::{Pose, Six};
use windlass_base::table::{Cell, Digits, Table};
use windlass_base::units::Dim;
use windlass_hydro::{Category, Floating};
use windlass_model::{Body, ClassError, Fluid, LoadKind, Model};

/// One table of the records, one of the forces on each body as it stands.
pub(super) fn loads(job: &Job, fits: &dyn Fn(&str) -> bool) -> Vec<Table> {
    let model = &job.model;
    let chosen = |part: &str| {
        let body = model.parts.get(&Model::key(part)).map_or("", |p| p.body.as_str());
        fits(part) || fits(body)
    };
    let mut records = Table::new("Loads of Wind, Current and Waves")
        .column("", "Part", Dim::None, Digits::Usual)
        .column("", "Record", Dim::None, Digits::Usual)
        .column("", "Acts in", Dim::None, Digits::Usual);
    for name in ["X", "Y", "Z"] {
        records = records.column("Point in Part", name, Dim::Length, Digits::Usual);
    }
    for name in ["X", "Y", "Z"] {
        records = records.column("Area x Coefficient", name, Dim::Area, Digits::Usual);
    }
    records = records.column("", "Headings", Dim::None, Digits::Usual).column("", "Heading", Dim::Angle, Digits::Usual);
    for load in model.loads.iter().filter(|l| chosen(&l.part)) {
        let acts = match (&load.kind, load.fluid) {
            (LoadKind::Drift { .. }, _) => "waves",
            (LoadKind::Drag(_) | LoadKind::Damping(_) | LoadKind::AddedMass(_), _) => "water",
            (_, Fluid::ByHeight) => "by height",
            (_, Fluid::Air) => "air",
            (_, Fluid::Water) => "water",
        };
        let mut row: Vec<Cell> = vec![load.part.as_str().into(), load.kind.name().into(), acts.into()];
        row.extend(load.at.map(Cell::Number));
        let (areas, headings, heading) = match &load.kind {
            LoadKind::Area(areas) => (Some(*areas), None, None),
            LoadKind::Plate { area, normal } => (Some(normal.map(|n| area * n.abs())), None, None),
            LoadKind::Coefficients { rows, .. } => (None, Some(rows.len()), None),
            LoadKind::Drift { heading, .. } => (None, None, Some(*heading)),
            LoadKind::Drag(_) | LoadKind::Damping(_) | LoadKind::AddedMass(_) => (None, None, None),
        };
        row.extend([0, 1, 2].map(|i| Cell::from(areas.and_then(|a| a.get(i).copied()))));
        row.extend([headings.into(), heading.into()]);
        push(&mut records, row);
    }
    for (name, factor) in model.multipliers.categories.iter().chain(&model.multipliers.parts) {
        records.note(format!("&APPLY multiplies loads of {name} by {factor}"));
    }
    vec![records, forces(job, &chosen)]
}

/// Force and moment of each category on each body that has such loads, about its origin.
fn forces(job: &Job, chosen: &dyn Fn(&str) -> bool) -> Table {
    let model = &job.model;
    let mut table = Table::new("Steady Forces").column("", "Body", Dim::None, Digits::Usual).column(
        "",
        "Category",
        Dim::None,
        Digits::Usual,
    );
    for name in ["FX", "FY", "FZ"] {
        table = table.column("Force, Global", name, Dim::Force, Digits::Usual);
    }
    for name in ["MX", "MY", "MZ"] {
        table = table.column("Moment about the Origin", name, Dim::Moment, Digits::Usual);
    }
    let loaded = |b: &&Body| {
        let mut parts = model.parts_of(b);
        parts.any(|p| !p.pieces.is_empty() || model.loads.iter().any(|l| Model::key(&l.part) == Model::key(&p.name)))
    };
    for body in model.bodies.values().filter(|b| chosen(&b.name)).filter(loaded) {
        match sums(model, body) {
            Ok(list) => {
                for (category, wrench) in list {
                    let mut row: Vec<Cell> = vec![body.name.as_str().into(), category.name().into()];
                    row.extend(wrench.iter().map(|v| Cell::Number(*v)));
                    push(&mut table, row);
                }
            }
            Err(error) => table.note_absent(format!("{}: {}", body.name, error.text(job.units))),
        }
    }
    table
}

fn sums(model: &Model, body: &Body) -> Result<Vec<(Category, Six)>, ClassError> {
    let floating = Floating::of(model, body)?;
    let pose = Pose::of(&body.place);
    let mut list = Vec::new();
    for category in [Category::Wind, Category::ViscousDrag, Category::WaveDrift] {
        let mut mine = floating.loads.iter().filter(|l| l.category() == category).peekable();
        if mine.peek().is_some() {
            let sum = mine.try_fold(Six::zeros(), |sum, load| load.load(&pose).map(|l| sum + l.wrench))?;
            list.push((category, sum));
        }
    }
    Ok(list)
}
