//! `BODY_FORCE` of the PRCPOST menu: forces on bodies by category.

use crate::commands::Command;
use crate::commands::post::prcpost::{BODIES, BODY, EVENTS, MAG_DEFINE, PostQuery, show, spec};
use windlass_base::diagnostic::Outcome;
use windlass_base::table::Table;
use windlass_language::spec::CommandSpec;
use windlass_solve::results;

/// BODY_FORCE.
pub static BODY_FORCE: Command = Command { spec: &SPEC, edits: false, run: |job, call| show(job, call, build) };

static SPEC: CommandSpec = CommandSpec {
    options: &[BODY, EVENTS, MAG_DEFINE],
    detail: "Of each body the forces of every category and the moments about its origin, global axes; inertia is a force among them. TOTAL \
             is their sum: what the steps left, and in degrees of freedom of -IGNORE what holds the body. REPORT WIND TOTAL prints two categories.",
    ..spec("BODY_FORCE", BODIES, "forces on bodies by category")
};

fn build(query: &PostQuery) -> Outcome<Table> {
    let (bodies, events) = (query.bodies()?, query.events()?);
    query.to_outcome(results::body_forces(query.run, &bodies, query.magnitude(), &events))
}
