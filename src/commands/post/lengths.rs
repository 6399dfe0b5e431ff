//! `C_LENGTH` of the PRCPOST menu: lengths of connectors.

use crate::commands::Command;
use crate::commands::post::prcpost::{CONNECTORS, EVENTS, PostQuery, show, spec};
use windlass_base::diagnostic::Outcome;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_language::spec::CommandSpec;
use windlass_solve::results::EventTable;

/// C_LENGTH.
pub static C_LENGTH: Command = Command { spec: &SPEC, edits: false, run: |job, call| show(job, call, build) };

static SPEC: CommandSpec = CommandSpec {
    options: &[EVENTS],
    detail: "A column a connector: the unstretched length of its first segment, which a winch changes.",
    ..spec("C_LENGTH", CONNECTORS, "lengths of connectors")
};

fn build(query: &PostQuery) -> Outcome<Table> {
    let (history, links) = (&query.run.history, query.connectors()?);
    let made = EventTable::new("Lengths of Connectors", (history, &query.events()?), |row| Ok(row.to_vec()));
    let mut table = query.to_outcome(made)?;
    for link in links.iter().filter_map(|link| history.layout.links.get(*link)) {
        table = table.column("First Segment", &link.name, Dim::Length, Digits::Usual, |row| {
            link.length(row).unwrap_or(f64::NAN)
        });
    }
    let mut table = table.build();
    table.note("unstretched; of a connector while it acts");
    Ok(table)
}
