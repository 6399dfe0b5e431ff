//! `DRAFT` of the PRCPOST menu: drafts read at draft marks.

use crate::commands::Command;
use crate::commands::name_filter::NameFilter;
use crate::commands::post::points::track;
use crate::commands::post::prcpost::{EVENTS, PostQuery, show, spec};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::table::Table;
use windlass_base::values::Noun;
use windlass_language::spec::{CommandSpec, Kind, ValueSpec};
use windlass_model::{EntityKind, find};
use windlass_solve::results::{self, TrackedMark};

/// DRAFT.
pub static DRAFT: Command = Command { spec: &SPEC, edits: false, run: |job, call| show(job, call, build) };

static SPEC: CommandSpec = CommandSpec {
    options: &[EVENTS],
    detail: "Of each mark of &DESCRIBE DMARK the length along its line from its first point to the mean water level, as &STATUS DRAFT reports it, \
             and the elevation of the waves above that level there (W. Elv; our reading).",
    ..spec(
        "DRAFT",
        &[ValueSpec::new(":D", Kind::Name(Noun::Selector), "draft mark, pattern or selector")
            .among(&[Noun::DraftMark])
            .or("all draft marks")],
        "drafts at draft marks",
    )
};

fn build(query: &PostQuery) -> Outcome<Table> {
    let model = &query.job.model;
    let chosen = NameFilter::new(&query.args().data, model);
    let mut marks = Vec::new();
    for mark in model.draft_marks.values().filter(|mark| chosen.matches(&mark.name)) {
        let end = |name: &String| track(query, find(&model.points, name, "point", query.span())?);
        let points = [end(&mark.points[0])?, end(&mark.points[1])?];
        marks.push(TrackedMark { name: mark.name.clone(), points });
    }
    chosen.check_used("the draft marks", &[EntityKind::DraftMark])?;
    if marks.is_empty() {
        return Err(Diagnostic::error("there is no draft mark", query.span())
            .help("&DESCRIBE DMARK NAME *PT1 *PT2 describes one"));
    }
    query.to_outcome(results::drafts(query.run, &marks, &query.events()?))
}
