//! `ELMFORCE` of the PRCPOST menu: forces and moments of connectors on their ends.

use crate::commands::Command;
use crate::commands::post::prcpost::{CONNECTORS, EVENTS, PostQuery, show, spec};
use windlass_base::diagnostic::Outcome;
use windlass_base::table::Table;
use windlass_language::spec::CommandSpec;
use windlass_solve::results;

/// ELMFORCE.
pub static ELMFORCE: Command = Command { spec: &SPEC, edits: false, run: |job, call| show(job, call, build) };

static SPEC: CommandSpec = CommandSpec {
    options: &[EVENTS],
    detail: "Of each connector the forces and moments on each of its ends that is on a body: in global axes, and in those of the element, x from its \
             first end to the second, y level, z across them (our reading). A pull of the first end is a positive FX there. BEAM and PLATE are parts of a \
             rigid body, have no stiffness and no forces of their own: a stress analysis has.",
    ..spec("ELMFORCE", CONNECTORS, "forces of elements on their ends")
};

fn build(query: &PostQuery) -> Outcome<Table> {
    let (links, events) = (query.connectors()?, query.events()?);
    query.to_outcome(results::element_forces(query.run, &links, &events))
}
