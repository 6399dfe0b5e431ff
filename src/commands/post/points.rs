//! `POINTS` of the PRCPOST menu: motions of points of interest.

use crate::commands::Command;
use crate::commands::name_filter::NameFilter;
use crate::commands::post::prcpost::{EVENTS, LOCAL, MAG_DEFINE, PostQuery, show, spec};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::table::Table;
use windlass_base::values::Noun;
use windlass_language::spec::{CommandSpec, Kind, ValueSpec};
use windlass_model::{EntityKind, Model, Point};
use windlass_solve::results::{self, TrackedPoint};

/// POINTS.
pub static POINTS: Command = Command { spec: &SPEC, edits: false, run: |job, call| show(job, call, build) };

static SPEC: CommandSpec = CommandSpec {
    options: &[EVENTS, MAG_DEFINE, LOCAL],
    detail: "Of each point that &DESCRIBE INTEREST has marked its location, velocity and acceleration, its motion from where it was marked, \
             the elevation of the waves above the mean water level at its x and y (W. Elv), and its height above the waves (Clearance). \
             Points are taken where they stand in their bodies now, also those marked after the run.",
    ..spec(
        "POINTS",
        &[ValueSpec::new("*POINT", Kind::Name(Noun::Selector), "point, pattern or selector")
            .among(&[Noun::Point])
            .or("all points of interest")],
        "motions of points of interest",
    )
};

/// A point as the run follows it, where it stands in its body now.
///
/// # Errors
/// A body that makes no part of the run.
pub(super) fn track(query: &PostQuery, point: &Point) -> Outcome<TrackedPoint> {
    let model = &query.job.model;
    let part = model.parts.get(&Model::key(&point.part));
    let at = part.map_or(point.at, |p| p.position.apply(point.at));
    let body = match model.body_of(point) {
        None => None,
        Some(body) => {
            let key = Model::key(&body.name);
            let found = query.run.history.layout.bodies.iter().position(|(_, k)| *k == key);
            let missing = || {
                let text = format!("body {} of point {} makes no part of the run", body.name, point.name);
                Diagnostic::error(text, query.span()).help("it was made after the run: TDOM makes another")
            };
            Some(found.ok_or_else(missing)?)
        }
    };
    Ok(TrackedPoint { name: point.name.clone(), body, at, marked: point.interest.unwrap_or_default() })
}

fn build(query: &PostQuery) -> Outcome<Table> {
    let (model, chosen) = (&query.job.model, NameFilter::new(&query.call.args.data, &query.job.model));
    let mut list = Vec::new();
    for point in model.points.values().filter(|p| p.interest.is_some()) {
        if !chosen.matches(&point.name) {
            continue;
        }
        list.push(track(query, point)?);
    }
    chosen.check_used("the points of interest", &[EntityKind::Point])?;
    if list.is_empty() {
        return Err(
            Diagnostic::error("no point is marked", query.span()).help("&DESCRIBE INTEREST *POINT marks points")
        );
    }
    query.to_outcome(results::points(query.run, &list, (query.is_local(), query.magnitude()), &query.events()?))
}
