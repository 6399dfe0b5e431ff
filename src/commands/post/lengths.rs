//! `C_LENGTH` of the PRCPOST menu: lengths of connectors.

use crate::commands::Command;
use crate::commands::post::prcpost::{CONNECTORS, EVENTS, PostQuery, show, spec};
use windlass_base::diagnostic::Outcome;
use windlass_base::table::Table;
use windlass_language::spec::CommandSpec;
use windlass_solve::results;

/// C_LENGTH.
pub static C_LENGTH: Command = Command { spec: &SPEC, edits: false, run: |job, call| show(job, call, build) };

static SPEC: CommandSpec = CommandSpec {
    options: &[EVENTS],
    detail: "A column a connector: the unstretched length of its first segment, which a winch changes.",
    ..spec("C_LENGTH", CONNECTORS, "lengths of connectors")
};

fn build(query: &PostQuery) -> Outcome<Table> {
    query.solved(results::lengths(query.run, &query.connectors()?, &query.events()?))
}
