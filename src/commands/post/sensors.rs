//! `SENSOR` of the PRCPOST menu: what sensors read.

use crate::commands::Command;
use crate::commands::name_filter::NameFilter;
use crate::commands::post::points::track;
use crate::commands::post::prcpost::{EVENTS, PostQuery, show, spec};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::table::Table;
use windlass_base::values::Noun;
use windlass_language::spec::{CommandSpec, Kind, ValueSpec};
use windlass_model::{HoleKind, Model, SensorRecord, SensorSignal, find};
use windlass_solve::results::{self, Sensor, Signal, SignalComponent, TrackedPoint};

/// SENSOR.
pub static SENSOR: Command = Command { spec: &SPEC, edits: false, run: |job, call| show(job, call, build) };

static SPEC: CommandSpec = CommandSpec {
    options: &[EVENTS],
    detail: "What each sensor of &DESCRIBE SENSOR reads, and with -LIMITS whether it raises its alarm: 1 outside of them, else 0. The force of a \
             connector is its tension, components are along the global axes; heights of holes are above the water with its waves. Sensors that are off are left out.",
    ..spec(
        "SENSOR",
        &[ValueSpec::new(":S", Kind::Name(Noun::Selector), "sensor, pattern or selector")
            .among(&[Noun::Sensor])
            .or("all sensors that are on")],
        "readings of sensors",
    )
};

fn build(query: &PostQuery) -> Outcome<Table> {
    let model = &query.job.model;
    let chosen = NameFilter::new(&query.args().data, model);
    let records: Vec<&SensorRecord> = model.sensors.values().filter(|s| chosen.matches(&s.name) && s.is_on).collect();
    chosen.check_used("the sensors", &[])?;
    if records.is_empty() {
        return Err(Diagnostic::error("no sensor is on", query.span())
            .help("&DESCRIBE SENSOR NAME -SIGNAL TYPE SOURCE describes one"));
    }
    let sensors = records.into_iter().map(|record| sensor(query, record)).collect::<Outcome<Vec<_>>>()?;
    query.to_outcome(results::sensors(query.run, &sensors, &query.events()?))
}

/// A sensor with the numbers its sources have in the run.
fn sensor(query: &PostQuery, record: &SensorRecord) -> Outcome<Sensor> {
    let (model, layout) = (&query.job.model, &query.run.history.layout);
    let source = |which: usize| record.sources.get(which).map_or("", String::as_str);
    let gone = |what: &str| {
        Diagnostic::error(
            format!("{what} {} of sensor {} makes no part of the run", source(0), record.name),
            query.span(),
        )
        .other(record.span, "described here")
    };
    let point = |which: usize| track(query, find(&model.points, source(which), "point", query.span())?);
    let link =
        || layout.links.iter().position(|l| l.name.eq_ignore_ascii_case(source(0))).ok_or_else(|| gone("connector"));
    let body =
        || layout.bodies.iter().position(|(name, _)| name.eq_ignore_ascii_case(source(0))).ok_or_else(|| gone("body"));
    let signal = match record.signal {
        SensorSignal::Time => Signal::Time,
        SensorSignal::Point => Signal::Point(point(0)?),
        SensorSignal::Vector => Signal::Vector([point(0)?, point(1)?]),
        SensorSignal::Length => Signal::Length(link()?),
        SensorSignal::Force => Signal::Force(link()?),
        SensorSignal::Angles => Signal::Angles(body()?),
        SensorSignal::WatertightHeight => Signal::LeastHeight(holes(query, record, true)?),
        SensorSignal::DownFloodingHeight => Signal::LeastHeight(holes(query, record, false)?),
    };
    Ok(Sensor {
        name: record.name.clone(),
        signal,
        component: record.component.map_or(SignalComponent::Norm, SignalComponent::Single),
        is_rate: record.is_rate,
        limits: record.limits,
    })
}

/// The holes of a body: those that let no water in, or the others.
fn holes(query: &PostQuery, record: &SensorRecord, watertight: bool) -> Outcome<Vec<TrackedPoint>> {
    let model = &query.job.model;
    let body = record.sources.first().map(|name| Model::key(name));
    let mut points = Vec::new();
    let sort = |kind: HoleKind| match watertight {
        true => kind == HoleKind::WatertightVent,
        false => matches!(kind, HoleKind::Vent | HoleKind::VentValve),
    };
    for hole in model.holes.values().filter(|hole| sort(hole.kind)) {
        let Some(point) = hole.point.as_ref().and_then(|name| model.points.get(&Model::key(name))) else { continue };
        if model.body_of(point).map(|own| Model::key(&own.name)) == body {
            points.push(track(query, point)?);
        }
    }
    if points.is_empty() {
        let sort = if watertight { "WT_VENT" } else { "VENT or V_VALVE" };
        let text = format!("body {} of sensor {} has no hole of type {sort}", record.sources.join(" "), record.name);
        return Err(Diagnostic::error(text, query.span()).other(record.span, "described here"));
    }
    Ok(points)
}
