//! `CF_MAGNITUDE` of the PRCPOST menu: magnitudes of the forces of connectors.

use crate::commands::Command;
use crate::commands::post::prcpost::{CONNECTORS, EVENTS, MAG_DEFINE, PostQuery, show, spec};
use windlass_base::diagnostic::Outcome;
use windlass_base::table::Table;
use windlass_language::spec::CommandSpec;
use windlass_solve::results;

/// CF_MAGNITUDE.
pub static CF_MAGNITUDE: Command = Command { spec: &SPEC, edits: false, run: |job, call| show(job, call, build) };

static SPEC: CommandSpec = CommandSpec {
    options: &[EVENTS, MAG_DEFINE],
    detail: "A column a connector: the magnitude of the force on its first end on a body.",
    ..spec("CF_MAGNITUDE", CONNECTORS, "magnitudes of the forces of connectors")
};

fn build(query: &PostQuery) -> Outcome<Table> {
    let (links, events) = (query.connectors()?, query.events()?);
    query.to_outcome(results::magnitudes(query.run, &links, query.magnitude(), &events))
}
