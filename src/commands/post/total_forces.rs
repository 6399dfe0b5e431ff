//! `TOT_CFORCE` of the PRCPOST menu: sums of the forces of connectors on bodies.

use crate::commands::Command;
use crate::commands::post::prcpost::{BODIES, BODY, EVENTS, MAG_DEFINE, PostQuery, show, spec};
use windlass_base::diagnostic::Outcome;
use windlass_base::table::Table;
use windlass_language::spec::CommandSpec;
use windlass_solve::results;

/// TOT_CFORCE.
pub static TOT_CFORCE: Command = Command { spec: &SPEC, edits: false, run: |job, call| show(job, call, build) };

static SPEC: CommandSpec = CommandSpec {
    options: &[BODY, EVENTS, MAG_DEFINE],
    detail: "Of each body the sum of the forces of all connectors on it, and their moment about its origin, global axes.",
    ..spec("TOT_CFORCE", BODIES, "sums of the forces of connectors on bodies")
};

fn build(query: &PostQuery) -> Outcome<Table> {
    let (bodies, events) = (query.bodies()?, query.events()?);
    query.to_outcome(results::total_forces(query.run, &bodies, query.magnitude(), &events))
}
