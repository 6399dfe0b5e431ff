//! `LDGFORCE` of the PRCPOST menu: what load groups exert on their bodies.

use crate::commands::Command;
use crate::commands::name_filter::NameFilter;
use crate::commands::post::prcpost::{EVENTS, MAG_DEFINE, PostQuery, show, spec};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::table::Table;
use windlass_base::values::Noun;
use windlass_language::spec::{CommandSpec, Kind, ValueSpec};
use windlass_model::EntityKind;
use windlass_solve::results;

/// LDGFORCE.
pub static LDGFORCE: Command = Command { spec: &SPEC, edits: false, run: |job, call| show(job, call, build) };

const GROUPS: &[ValueSpec] =
    &[ValueSpec::new(":LG", Kind::Name(Noun::Selector), "load group or part, pattern or selector")
        .or("all load groups and parts")];

static SPEC: CommandSpec = CommandSpec {
    options: &[EVENTS, MAG_DEFINE],
    detail: "Of each load group, and of what of each part is in none, the forces of every category and the moments about the origin of its body, global axes; TOTAL is \
             their sum. The run stores the sum over each body alone: these follow from where the body is, its velocity and acceleration, and the time. Waves on \
             members and hulls and slow drift remember what was, and are left out with a warning. Inertia of weights is not among the forces.",
    ..spec("LDGFORCE", GROUPS, "forces of load groups by category")
};

fn build(query: &PostQuery) -> Outcome<Table> {
    let model = &query.run.model;
    let chosen = NameFilter::new(&query.args().data, &query.job.model);
    let mut groups = results::load_groups(model);
    groups.retain(|group| chosen.matches(&group.name));
    chosen.check_used("the load groups and parts of the run", &[EntityKind::Part])?;
    if groups.is_empty() {
        return Err(Diagnostic::error("the run has no load group to report", query.span()));
    }
    query.to_outcome(results::group_forces(query.run, &groups, query.magnitude(), &query.events()?))
}
