//! `CONFORCE` of the PRCPOST menu: forces of connectors, and what their anchors bear.

use crate::commands::Command;
use crate::commands::post::prcpost::{CONNECTORS, EVENTS, MAG_DEFINE, PostQuery, show, spec};
use windlass_base::diagnostic::Outcome;
use windlass_base::table::Table;
use windlass_language::spec::CommandSpec;
use windlass_solve::results;

/// CONFORCE.
pub static CONFORCE: Command = Command { spec: &SPEC, edits: false, run: |job, call| show(job, call, build) };

static SPEC: CommandSpec = CommandSpec {
    options: &[EVENTS, MAG_DEFINE],
    detail: "Of each connector the force on its first end on a body in global axes, its magnitude, the largest tension of a segment \
             over its break (of springs the force over its allowable), the unstretched length on the bottom, and what its anchor bears: \
             V. Pull upward, H. Pull toward the fairlead. The force is that of the run; what follows it is found between the ends where the \
             run had them, with the length a winch had given it. A connector with a memory, as a piston, has no answer for these; one that \
             does not act has no numbers.",
    ..spec("CONFORCE", CONNECTORS, "forces of connectors")
};

fn build(query: &PostQuery) -> Outcome<Table> {
    let (links, events) = (query.connectors()?, query.events()?);
    query.to_outcome(results::connector_forces(query.run, &links, query.magnitude(), &events))
}
