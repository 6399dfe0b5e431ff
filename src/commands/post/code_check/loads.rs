//! The loads that a check is made of: of a run, or of the lines between their ends as they are.

use super::{CHARACTERISTIC, CheckQuery, Checked, DURATION, is_spare};
use crate::commands::name_filter::NameFilter;
use crate::commands::post::prcpost::{asked_behind_transient, connectors, last_run};
use crate::commands::solve::equilibrium::to_diagnostic;
use crate::commands::solve::line_loss::check_damaged_start;
use crate::commands::{Call, Job};
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::geometry::Position;
use windlass_base::span::Span;
use windlass_design_checks::codes::{Analysis, Condition};
use windlass_design_checks::limits::{distance, distance_to_panels};
use windlass_model::{Body, Condition as Configuration, EntityKind, FatigueSegment, Idealisation, Model, find};
use windlass_signal::extremes::Weibull;
use windlass_signal::{SeriesError, statistics};
use windlass_solve::line_loss::{BALANCED_SHARE, unbalanced_share};
use windlass_solve::results::{
    self, AnchorRecord, PathPoint, RunEvent, body_panels, body_panels_at, is_mooring_line, line_records, lost_lines,
    path_at, place_at, segment_tensions, static_path,
};
use windlass_solve::time::Run;

choices! {
    /// What of the tension over a run is checked.
    pub(super) enum Characteristic {
        /// The most probable maximum in a duration.
        Mpm = "MPM",
        /// The largest of the record.
        Largest = "LARGEST",
    }
}

/// Tension of a segment (N).
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SegmentLoad {
    pub mean: f64,
    pub characteristic: f64,
    /// Largest of the record.
    pub largest: f64,
    /// Least of the record.
    pub least: f64,
    /// What the characteristic tension is.
    pub method: &'static str,
    /// Maxima it is estimated from; none of a line at rest.
    pub maxima: Option<usize>,
    /// Most probable maximum and its 95 per cent interval.
    pub mpm: Option<(f64, (f64, f64))>,
}

/// A line that is checked.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct CheckedLine {
    pub name: String,
    pub segments: Vec<(FatigueSegment, SegmentLoad)>,
    pub anchor: Option<AnchorRecord>,
    pub grounded: Option<f64>,
    /// Largest horizontal distance (m) of the body at its first end from where the model has it; none of a line at rest, or without a body.
    pub offset: Option<f64>,
}

/// The lines of a mooring with what decides on their factors.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct CheckedMooring {
    pub analysis: Analysis,
    pub condition: Condition,
    pub lost: Vec<String>,
    pub lines: Vec<CheckedLine>,
    /// Why no most probable maximum was found, and the segments concerned.
    pub without_mpm: Vec<(String, Vec<String>)>,
    pub is_run: bool,
    /// Share of what the lost lines pull that is unbalanced where the bodies stand, of a state without lines in which they do not rest.
    pub unbalanced: Option<f64>,
    /// Instants of the run that are checked.
    pub events: Vec<RunEvent>,
    /// Time that maxima are sought in (s).
    pub duration: f64,
    /// The storm whose maximum is sought over the record of the run; 1 where the largest of the record is. None of lines at rest.
    pub storm_ratio: Option<f64>,
}

/// The analysis of lines by their idealisations.
fn analysis_of(kinds: &[(&str, Idealisation)], query: &CheckQuery) -> Outcome<Analysis> {
    let of =
        |kind: Idealisation| -> Vec<&str> { kinds.iter().filter(|(_, k)| *k == kind).map(|(name, _)| *name).collect() };
    let (dynamic, quasi) = (of(Idealisation::Dynamic), of(Idealisation::QuasiStatic));
    match (dynamic.as_slice(), quasi.as_slice()) {
        ([], _) => Ok(Analysis::QuasiStatic),
        (_, []) => Ok(Analysis::Dynamic),
        (dynamic, quasi) => {
            let text = format!(
                "the lines are a mix of dynamic ({}) and quasi-static ones ({}), whose factors differ",
                windlass_model::list_names(dynamic),
                windlass_model::list_names(quasi)
            );
            Err(Diagnostic::error(text, query.args.span)
                .help("&CONNECTOR -DYNAMICS makes all of them dynamic; or name the lines of one kind"))
        }
    }
}

/// The lines of the last run.
///
/// # Errors
/// No run, no lines, lines of both kinds, one that does not act all the time.
pub(super) fn of_run(job: &Job, call: &Call, query: &CheckQuery) -> Checked {
    let (args, span) = (query.args, query.args.span);
    let run = last_run(job, span)?;
    let (_, instants) = asked_behind_transient(job, args)?;
    let mut lost = lost_lines(run);
    for names in [&mut lost.before, &mut lost.during] {
        names.retain(|name| !is_spare(job, query, name));
    }
    let condition = match (lost.before.is_empty(), lost.during.is_empty()) {
        (_, false) => Condition::Transient,
        (false, true) => Condition::Damaged,
        (true, true) => Condition::Intact,
    };
    if condition == Condition::Damaged {
        check_damaged_start(job, run, &lost.before).map_err(|text| {
            Diagnostic::error(text, span)
                .help("TDOM -EQUI begins at rest, and &EQUI before TDOM does, both behind &CONNECTOR -INACTIVE")
        })?;
    }
    let lost: Vec<String> = lost.before.into_iter().chain(lost.during).collect();
    let named = !args.data.is_empty();
    let mut links = connectors(job, run, call)?;
    let layout = &run.history.layout;
    if !named {
        // a line that is lost is not checked
        links.retain(|link| {
            layout.links.get(*link).is_some_and(|l| !lost.contains(&l.name) && !is_spare(job, query, &l.name))
        });
    }
    let names: Vec<(&str, Idealisation)> = links
        .iter()
        .filter_map(|link| layout.links.get(*link))
        .filter_map(|l| Some((l.name.as_str(), run.model.connectors.get(&Model::key(&l.name))?)))
        .filter(|(_, connector)| is_mooring_line(&run.model, connector))
        .filter_map(|(name, _)| Some((name, run.model.idealisation(name)?)))
        .collect();
    let analysis = analysis_of(&names, query)?;
    let records = line_records(run, &links, &instants).map_err(|e| to_diagnostic(e, &job.model, span, job.units))?;
    if records.is_empty() {
        return Err(no_line(query));
    }
    let duration = 3600.0 * args.option_number(&DURATION).unwrap_or(3.0);
    let wanted = args.option_choice(&CHARACTERISTIC, const { CHARACTERISTIC.choice("WHAT") });
    let usual = if condition == Condition::Transient { Characteristic::Largest } else { Characteristic::Mpm };
    let mut lines = Vec::new();
    let mut without_mpm: Vec<(String, Vec<String>)> = Vec::new();
    for record in records {
        let mut segments = Vec::new();
        for (index, (segment, tension)) in record.segments.into_iter().zip(&record.tensions).enumerate() {
            let (load, remark) = characteristic(&record.times, tension, duration, wanted.unwrap_or(usual))
                .map_err(|error| Diagnostic::error(format!("{}, segment {}: {error}", record.name, index + 1), span))?;
            if let Some(error) = remark {
                let (who, why) = (format!("{} {}", record.name, index + 1), error.to_string());
                match without_mpm.iter_mut().find(|(reason, _)| *reason == why) {
                    Some((_, segments)) => segments.push(who),
                    None => without_mpm.push((why, vec![who])),
                }
            }
            segments.push((segment, load));
        }
        let offset = largest_offset_of_line(job, run, &record.name, &instants);
        let (anchor, grounded) = (record.anchor, record.grounded);
        lines.push(CheckedLine { name: record.name, segments, anchor, grounded, offset });
    }
    let time = |event: Option<&RunEvent>| event.and_then(|event| event.time(&run.history));
    let record = time(instants.last()).zip(time(instants.first())).map(|(last, first)| last - first);
    let storm_ratio = match wanted.unwrap_or(usual) {
        Characteristic::Mpm => record.filter(|record| *record > 0.0).map(|record| duration / record),
        Characteristic::Largest => Some(1.0),
    };
    Ok(CheckedMooring {
        analysis,
        condition,
        lost,
        lines,
        without_mpm,
        is_run: true,
        unbalanced: None,
        events: instants,
        duration,
        storm_ratio,
    })
}

fn no_line(query: &CheckQuery) -> Box<Diagnostic> {
    Diagnostic::error("none of the connectors is a mooring line that acts", query.args.span)
        .help("lines of segments are: B_CAT, H_CAT, SL_ELEM, ROD")
}

/// Mean and characteristic value of a series; with why the most probable maximum was not to be had, where it was wanted.
fn characteristic(
    times: &[f64],
    values: &[f64],
    duration: f64,
    wanted: Characteristic,
) -> Result<(SegmentLoad, Option<SeriesError>), SeriesError> {
    let moments = statistics::moments(values)?;
    let mean = moments.mean;
    let crossings = statistics::crossings(times, values, mean)?;
    let maxima: Vec<f64> = crossings.maxima.iter().map(|peak| peak.value).filter(|value| *value > mean).collect();
    let found = || {
        let period = crossings.period().ok_or(SeriesError::TooFew {
            what: "a mean period (of up-crossings of the mean)",
            need: 2,
            got: crossings.up,
        })?;
        Weibull::fit(&maxima, mean)?.extreme(period, duration)
    };
    let largest = moments.maximum.1;
    let load = SegmentLoad {
        mean,
        characteristic: largest.max(mean),
        largest,
        least: moments.minimum.1,
        method: "largest",
        maxima: Some(maxima.len()),
        mpm: None,
    };
    match found() {
        Ok(extreme) => {
            let mpm = extreme.interval.map(|interval| (extreme.most_probable, interval));
            let made = match wanted {
                Characteristic::Mpm => {
                    SegmentLoad { characteristic: extreme.most_probable, method: "MPM", mpm, ..load }
                }
                Characteristic::Largest => SegmentLoad { mpm, ..load },
            };
            Ok((made, None))
        }
        Err(error) => Ok((load, Some(error).filter(|_| wanted == Characteristic::Mpm))),
    }
}

/// The lines between their ends as they are, by statics.
///
/// # Errors
/// No lines, or one without a configuration.
pub(super) fn of_state(job: &Job, _: &Call, query: &CheckQuery) -> Checked {
    let (model, span) = (&job.model, query.args.span);
    let chosen = NameFilter::new(&query.args.data, model);
    let mooring: Vec<_> =
        model.connectors.values().filter(|c| is_mooring_line(model, c) && !is_spare(job, query, &c.name)).collect();
    let lost: Vec<String> = mooring.iter().filter(|c| !c.active).map(|c| c.name.clone()).collect();
    let condition = if lost.is_empty() { Condition::Intact } else { Condition::Damaged };
    let acting: Vec<_> = mooring.into_iter().filter(|c| c.active && chosen.matches(&c.name)).collect();
    chosen.check_used("the mooring lines that act", &[EntityKind::Connector])?;
    let mut lines = Vec::new();
    for connector in acting {
        let Some(class) = model.classes.get(&Model::key(&connector.class)) else { continue };
        let segments = class.fatigue_segments();
        if segments.is_empty() || model.reeving(&connector.name).is_some() {
            continue;
        }
        let about =
            |error: windlass_model::ClassError| error.with_subject(connector.name.as_str()).diagnostic(span, job.units);
        let line = class.line(&model.placement(connector), &model.surroundings()).map_err(about)?;
        let state = line.configuration(Configuration::Placed).map_err(about)?;
        let tensions =
            segment_tensions(line.as_ref(), &connector.name, Configuration::Placed, segments.len()).map_err(about)?;
        let load = |tension: f64| SegmentLoad {
            mean: tension,
            characteristic: tension,
            largest: tension,
            least: tension,
            method: "at rest",
            maxima: None,
            mpm: None,
        };
        let [horizontal, vertical] = state.anchor;
        let up = vertical.max(0.0);
        let anchor = AnchorRecord { horizontal, vertical: up, resultant: horizontal.hypot(up) };
        lines.push(CheckedLine {
            name: connector.name.clone(),
            segments: segments.into_iter().zip(tensions.into_iter().map(load)).collect(),
            anchor: connector.anchor.is_some().then_some(anchor),
            grounded: Some(state.on_bottom),
            offset: None,
        });
    }
    if lines.is_empty() {
        return Err(no_line(query));
    }
    let analysis = Analysis::QuasiStatic;
    // what has no balance of forces has no rest that it could be away from
    let unbalanced = unbalanced_share(model, &lost).ok().filter(|share| !lost.is_empty() && *share > BALANCED_SHARE);
    Ok(CheckedMooring {
        analysis,
        condition,
        lost,
        lines,
        without_mpm: Vec::new(),
        is_run: false,
        unbalanced,
        events: Vec::new(),
        duration: 0.0,
        storm_ratio: None,
    })
}

/// Where a body is in the plane (m): at each event of the run, or now.
fn places(job: &Job, mooring: &CheckedMooring, name: &str, span: Span) -> Outcome<Vec<[f64; 2]>> {
    let body = find(&job.model.bodies, name, "body", span)?;
    if !mooring.is_run {
        let [x, y, _] = body.position.shift;
        return Ok(vec![[x, y]]);
    }
    let run = last_run(job, span)?;
    let mut list = Vec::new();
    for event in &mooring.events {
        let place = place_at(run, &body.name, event)
            .ok_or_else(|| Diagnostic::error(format!("{name} is no body of the run"), span))?;
        list.push([place.shift[0], place.shift[1]]);
    }
    Ok(list)
}

/// The largest horizontal distance (m), over instants of a run, of the body at the first end of a line from where the model has it.
fn largest_offset_of_line(job: &Job, run: &Run, line: &str, instants: &[RunEvent]) -> Option<f64> {
    let layout = &run.history.layout;
    let link = layout.links.iter().find(|link| link.name == line)?;
    let body = link.ends.iter().flatten().next()?;
    let body = job.model.bodies.get(&layout.bodies.get(*body)?.1)?;
    let [x, y, _] = body.position.shift;
    let away = |event: &RunEvent| {
        let [now_x, now_y, _] = place_at(run, &body.name, event)?.shift;
        Some((now_x - x).hypot(now_y - y))
    };
    instants.iter().filter_map(away).reduce(f64::max)
}

/// The largest horizontal distance (m) of the origin of a body from a place, and that place (m): of a run where it began unless given.
///
/// # Errors
/// No such body in the run.
pub(super) fn largest_offset(
    job: &Job,
    mooring: &CheckedMooring,
    (name, span): (&str, Span),
    [x, y]: [Option<f64>; 2],
) -> Outcome<(f64, [f64; 2])> {
    let began = match (mooring.is_run, x, y) {
        (true, _, _) => {
            let run = last_run(job, span)?;
            let events = results::events(&run.history, None).map_err(|e| e.diagnostic(span, job.units))?;
            let first = events.first().and_then(|first| place_at(run, name, first));
            first.map_or([0.0; 2], |place| [place.shift[0], place.shift[1]])
        }
        _ => [0.0; 2],
    };
    let from = [x.unwrap_or(began[0]), y.unwrap_or(began[1])];
    let largest = places(job, mooring, name, span)?
        .iter()
        .map(|place| (place[0] - from[0]).hypot(place[1] - from[1]))
        .fold(0.0, f64::max);
    Ok((largest, from))
}

/// What a line is kept away from.
enum Obstacle<'a> {
    Bottom,
    Line(&'a str),
    Body(&'a Body),
}

/// The least distance (m) of a line, or one of its segments, from another line, a body or the bottom.
///
/// # Errors
/// Names that are none of these, a line that is nowhere, a body without pieces.
pub(super) fn least_clearance(
    job: &Job,
    mooring: &CheckedMooring,
    (line, other, segment): (&str, &str, Option<usize>),
    span: Span,
) -> Outcome<f64> {
    let model = &job.model;
    find(&model.connectors, line, "connector", span)?;
    let obstacle = if other.eq_ignore_ascii_case("BOTTOM") {
        Obstacle::Bottom
    } else if model.connectors.contains_key(&Model::key(other)) {
        Obstacle::Line(other)
    } else {
        Obstacle::Body(find(&model.bodies, other, "connector or body", span)?)
    };
    let mut least: Option<f64> = None;
    let mut take = |path: &[PathPoint], second: &[PathPoint], panels: &[Vec<Position>]| {
        let is_own = |point: &&PathPoint| segment.is_none_or(|wanted| point.segment == wanted);
        let points = |path: &[PathPoint]| path.iter().map(|p| p.position).collect::<Vec<_>>();
        let own: Vec<_> = path.iter().filter(is_own).map(|p| p.position).collect();
        let found = match obstacle {
            Obstacle::Bottom => path.iter().filter(is_own).filter_map(|p| p.height).reduce(f64::min),
            Obstacle::Line(_) => distance(&own, &points(second)),
            Obstacle::Body(_) => {
                let panels: Vec<Vec<_>> = panels.iter().map(|p| p.iter().map(|c| (*c).into()).collect()).collect();
                distance_to_panels(&own, &panels)
            }
        };
        if let Some(found) = found {
            least = Some(least.map_or(found, |known: f64| known.min(found)));
        }
    };
    if mooring.is_run {
        let run = last_run(job, span)?;
        let wrong = |error| to_diagnostic(error, model, span, job.units);
        for event in &mooring.events {
            let path = path_at(run, line, event).map_err(wrong)?;
            match obstacle {
                Obstacle::Bottom => take(&path, &[], &[]),
                Obstacle::Line(name) => take(&path, &path_at(run, name, event).map_err(wrong)?, &[]),
                Obstacle::Body(body) => take(&path, &[], &body_panels_at(run, body, event)),
            }
        }
    } else {
        let path = |name: &str| -> Outcome<Vec<PathPoint>> {
            let connector = find(&model.connectors, name, "connector", span)?;
            static_path(model, connector, &model.placement(connector), &model.surroundings())
                .map_err(|error| error.with_subject(name).diagnostic(span, job.units))
        };
        match obstacle {
            Obstacle::Bottom => take(&path(line)?, &[], &[]),
            Obstacle::Line(name) => take(&path(line)?, &path(name)?, &[]),
            Obstacle::Body(body) => take(&path(line)?, &[], &body_panels(model, body)),
        }
    }
    least.ok_or_else(|| {
        Diagnostic::error(format!("the distance of {line} from {other} is not known"), span)
            .help("the line must act and have this segment; a body needs hull pieces, and a bottom must be there")
    })
}
