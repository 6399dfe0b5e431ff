//! `&STATUS SYSTEM`, `SIZE`, `NAMES`, `PARAMETER` and `PROCESS`: the model as a whole.
//!
//! MOSES has reports of these names; what stands in them is our reading.

use crate::commands::Job;
use crate::commands::model::process;
use crate::commands::status::body_status;
use crate::commands::status::kind::StatusKind;
use crate::commands::status::model_tables;
use windlass_base::choice::Choice;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_model::{EntityKind, Model};

/// `&STATUS SYSTEM`.
pub static SYSTEM: StatusKind = StatusKind {
    caveats: true,
    ..StatusKind::new("SYSTEM", "where the bodies stand, and what acts on them by category", |query, _| {
        let mut tables = vec![model_tables::configuration(query.model(), &query.fits())];
        tables.extend(body_status::forces(query.job, query.call, &query.fits())?);
        Ok(tables)
    })
    .with_names(&[EntityKind::Body])
    .of_moses()
};

/// `&STATUS SIZE`.
pub static SIZE: StatusKind =
    StatusKind::new("SIZE", "how many things of each sort the model holds", |query, _| Ok(vec![size(query.model())]))
        .of_moses();

/// `&STATUS NAMES`.
pub static NAMES: StatusKind =
    StatusKind::new("NAMES", "the names of all that the model holds", |query, _| Ok(vec![names(query.model())]))
        .of_moses();

/// `&STATUS PARAMETER`.
pub static PARAMETER: StatusKind =
    StatusKind::new("PARAMETER", "what &PARAMETER has set", |query, _| Ok(vec![parameters(query.job)])).of_moses();

/// `&STATUS PROCESS`.
pub static PROCESS: StatusKind =
    StatusKind::new("PROCESS", "the processes of &DESCRIBE PROCESS, the current one first", |query, _| {
        let rows: Vec<(&str, bool)> = process::names(query.job).collect();
        let table = Table::new("Processes")
            .with_rows(&rows)
            .text("Process", |(name, _)| *name)
            .text("Events", |(_, has_run)| if *has_run { "a run of TDOM" } else { "none" })
            .build();
        Ok(vec![table])
    })
    .of_moses();

fn size(model: &Model) -> Table {
    let counts: Vec<(EntityKind, usize)> =
        EntityKind::ALL.iter().map(|kind| (*kind, model.names(*kind).len())).collect();
    let weights: usize = model.parts.values().map(|p| p.weights.len()).sum();
    Table::new("Size of the Model")
        .fact("Records of Weight", weights, Dim::None)
        .fact("Records of Loads", model.loads.len(), Dim::None)
        .with_rows(&counts)
        .text("Sort", |(kind, _)| kind.word())
        .column("", "Number", Dim::None, Digits::Usual, |(_, count)| *count)
        .build()
}

fn names(model: &Model) -> Table {
    let rows: Vec<(EntityKind, &str)> =
        EntityKind::ALL.iter().flat_map(|kind| model.names(*kind).into_iter().map(|name| (*kind, name))).collect();
    Table::new("Names").with_rows(&rows).text("Sort", |(kind, _)| kind.word()).text("Name", |(_, name)| *name).build()
}

fn parameters(job: &Job) -> Table {
    let yes_no = |on: bool| if on { "YES" } else { "NO" };
    let p = &job.model.parameters;
    Table::new("Parameters")
        .fact("-DRGTUB", p.tube_drag.unwrap_or(1.0), Dim::None)
        .fact("-AMCTUB", p.tube_added_mass.unwrap_or(1.0), Dim::None)
        .fact("-WCSTUBE", p.tube_wind.unwrap_or(1.0), Dim::None)
        .fact("-DRGPLA", p.plate_drag.unwrap_or(1.0), Dim::None)
        .fact("-REL_WIND", "YES", Dim::None)
        .fact("-ACCEPT_MISSING", yes_no(p.accept_missing), Dim::None)
        .fact("-STIFFNESS", job.model.defaults.rope_stiffness.map_or("not chosen", Choice::word), Dim::None)
}
