//! Fatigue of lines over a run, and over a scatter of environments.
//!
//! Source: [MOSES-REF sn_def, sn_bind, fatigue]. Cycles are those of rainflow ([`windlass_signal::rainflow`]) of the tension at the upper
//! end of each segment. At the fairlead that is the run's own; below, the line is shaped between its ends at the turning points of the
//! tension at the fairlead, between which a line at rest in every instant has no others of note.

use super::super::link::{end_attachments, pose_of};
use super::super::system::SolveError;
use super::super::time::Run;
use super::RunEvent;
use super::connectors::{force, poses};
use windlass_base::pose::Pose;
use windlass_base::table::{Cell, Digits, Table};
use windlass_base::units::Dim;
use windlass_model::{Class, ClassError, Condition, Connector, FatigueSelection, LineSampling, Model, Placement};
use windlass_signal::SeriesError;
use windlass_signal::fatigue::{
    Exposure, LineDamage, Loaded, SegmentDamage, SegmentLife, SnCurve, find, line_damage, line_life,
};

/// A run in a scatter of environments.
#[derive(Clone, Debug, PartialEq)]
pub struct ScatterExposure {
    /// Name of its environment.
    pub environment: String,
    /// Length of the record (s).
    pub record: f64,
    /// How long the environment lasts (s).
    pub duration: f64,
    /// Its lines, by name, and what the record comes to in each.
    pub lines: Vec<(String, LineDamage)>,
}

/// The damage of connectors of a run, by their numbers, over the stored instants of some events. Connectors of classes without
/// sections are passed over.
///
/// # Errors
/// A segment without a curve; a line that does not act at every event, or that cannot be shaped.
pub fn line_damages(
    run: &Run,
    links: &[usize],
    selection: &FatigueSelection,
    events: &[RunEvent],
) -> Result<Vec<(String, LineDamage)>, SolveError> {
    let mut list = Vec::new();
    for columns_of in links.iter().filter_map(|l| run.history.layout.links.get(*l)) {
        let name = columns_of.name.as_str();
        let Some(connector) = run.model.connectors.get(&Model::key(name)) else { continue };
        let Some(class) = run.model.classes.get(&Model::key(&connector.class)) else { continue };
        let segments = class.fatigue_segments();
        if segments.is_empty() {
            continue;
        }
        let wrong = |error: ClassError| SolveError { who: Some(name.to_string()), error };
        let curves = segments.iter().enumerate().map(|(index, segment)| {
            let curve = selection.curve_of(segment);
            let missing = || match curve {
                Some(curve) => ClassError::new(format!("there is no fatigue curve {curve}")),
                None => ClassError::new(format!("segment {} of {} has no fatigue curve", index + 1, class.name)),
            };
            let found = curve.and_then(|c| find(c, selection));
            found.ok_or_else(|| wrong(missing().help("-C_SN of its class, or &REP_SELECT -SN, names one")))
        });
        let curves = curves.collect::<Result<Vec<SnCurve>, SolveError>>()?;
        let tensions = tensions(run, (name, connector, class), segments.len(), events).map_err(wrong)?;
        let loaded = segments.iter().zip(&curves).zip(&tensions);
        let loaded: Vec<Loaded> =
            loaded.map(|((segment, curve), tension)| Loaded { segment, curve, tension }).collect();
        let made =
            line_damage(&loaded, selection.thickness.as_ref()).map_err(|e| wrong(ClassError::new(e.to_string())))?;
        list.push((name.to_string(), made));
    }
    Ok(list)
}

/// The tension at the upper end of each segment: of the first at every event, of the others at the turning points of the first.
fn tensions(
    run: &Run,
    (name, connector, class): (&str, &Connector, &Class),
    segments: usize,
    events: &[RunEvent],
) -> Result<Vec<Vec<f64>>, ClassError> {
    let (layout, width) = (&run.history.layout, run.history.layout.width.max(1));
    let link = layout.links.iter().position(|l| l.name == name).unwrap_or(usize::MAX);
    let row = |event: &RunEvent| run.history.values.get(event.row * width..(event.row + 1) * width).unwrap_or_default();
    let idle =
        || ClassError::new("it does not act at every event").help("-EVENTS BEG END chooses those at which it does");
    let top: Vec<f64> = events
        .iter()
        .map(|e| force(layout, link, row(e)).and_then(|_| layout.tension(link, row(e))).filter(|t| t.is_finite()))
        .collect::<Option<_>>()
        .ok_or_else(idle)?;
    let mut all = vec![Vec::new(); segments];
    if segments > 1 {
        if let Some(assembly) = run.model.reeving(name) {
            let text = format!(
                "it is a span of the line of {}: fatigue of spans of several segments is not computed",
                assembly.name
            );
            return Err(ClassError::new(text));
        }
        let ends = end_attachments(&run.model, connector);
        let (placement, surroundings) = (run.model.placement(connector), run.model.surroundings());
        let active = layout.links.get(link).map_or(0, |l| l.active);
        let mut positions: Vec<Pose> = Vec::new();
        for event in turning_points(&top).filter_map(|at| events.get(at)) {
            let row = row(event);
            poses(layout, row, &mut positions);
            let [fairlead, other] = ends.map(|end| pose_of(&end, &positions).origin.into());
            let other = placement.other.filter(|_| placement.anchored).or(Some(other));
            let first_length = row.get(active + 1).copied().filter(|l| l.is_finite()).or(placement.first_length);
            let here = Placement { fairlead, other, first_length, ..placement.clone() };
            let shape = class.line(&here, &surroundings)?.geometry(name, Condition::Placed, LineSampling::Inside(0))?;
            let numbers = |column: &str| shape.get(column).map(|c| c.cells.as_slice()).unwrap_or_default();
            let mut seen = 0;
            for (segment, tension) in numbers("Segment").iter().zip(numbers("Tension")) {
                let (Cell::Integer(segment), Some(tension)) = (segment, tension.number()) else { continue };
                // the first point of a segment is its upper end
                if usize::try_from(*segment).is_ok_and(|s| s == seen + 1) {
                    if let Some(series) = all.get_mut(seen) {
                        series.push(tension);
                    }
                    seen += 1;
                }
            }
        }
    }
    if let Some(first) = all.first_mut() {
        *first = top;
    }
    Ok(all)
}

/// The places of the values of a series where it turns, and of its ends.
pub(super) fn turning_points(series: &[f64]) -> impl Iterator<Item = usize> + '_ {
    let turns = |at: &usize| match (at.checked_sub(1).and_then(|b| series.get(b)), series.get(*at), series.get(at + 1))
    {
        (Some(before), Some(here), Some(after)) => (here - before) * (after - here) <= 0.0,
        _ => true,
    };
    (0..series.len()).filter(turns)
}

/// What a scatter of environments comes to, a row a segment: the last run alone, and all together with the life they leave; `factor`
/// is the design fatigue factor.
///
/// # Errors
/// Runs that do not report the same lines and segments; a duration or record without length.
pub fn scatter(runs: &[ScatterExposure], factor: f64) -> Result<Table, SeriesError> {
    let days: f64 = runs.iter().map(|r| r.duration).sum();
    let mut table = Table::new("Fatigue of Lines")
        .fact("Environments", runs.len(), Dim::None)
        .fact("Duration", days, Dim::Days)
        .fact("Design Fatigue Factor", factor, Dim::None);
    let mut rows: Vec<ScatterRow> = Vec::new();
    let lines = runs.last().map_or(&[][..], |last| &last.lines);
    for (name, own) in lines {
        let of = |run: &ScatterExposure| -> Option<(f64, f64, LineDamage)> {
            let found = run.lines.iter().find(|(n, _)| n == name)?;
            Some((run.record, run.duration, found.1.clone()))
        };
        let all: Option<Vec<_>> = runs.iter().map(of).collect();
        let all = all
            .ok_or_else(|| SeriesError::Refused(format!("an earlier run of the scatter reports nothing of {name}")))?;
        let exposures: Vec<Exposure> = all
            .iter()
            .map(|(record, duration, line)| Exposure { line, record: *record, duration: *duration })
            .collect();
        for (index, (segment, life)) in own.segments.iter().zip(line_life(&exposures, factor)?).enumerate() {
            rows.push(ScatterRow { line: name, governs: index == own.governing, segment, life });
            if segment.unconfirmed {
                table.note(format!("the numbers of curve {} are not confirmed: &STATUS SN", segment.curve));
            }
        }
    }
    table.notes.dedup();
    if !runs.is_empty() {
        table.note(
            "CDR is the sum over the environments of the damage of each record times duration over length of the record",
        );
    }
    let table = table
        .with_rows(&rows)
        .text("Line", |row| row.line)
        .column("", "Segment", Dim::None, Digits::Usual, |row| row.segment.segment)
        .text("Curve", |row| &row.life.curve)
        .column("Last Run", "Mean T/TB", Dim::None, Digits::Decimals(3), |row| row.segment.mean)
        .column("Last Run", "Max T/TB", Dim::None, Digits::Decimals(3), |row| row.segment.most_used)
        .column("Last Run", "Cycles", Dim::None, Digits::Usual, |row| row.segment.cycles)
        .column("Last Run", "Damage", Dim::None, Digits::Scientific(4), |row| row.segment.damage)
        .column("All Environments", "CDR", Dim::None, Digits::Scientific(4), |row| row.life.damage)
        .column("All Environments", "Life, Years", Dim::None, Digits::Scientific(4), |row| row.life.years)
        .text("Governs", |row| if row.governs { "yes" } else { "" })
        .build();
    Ok(table)
}

/// A segment of a line: what the last run did to it, and what all runs leave of its life.
struct ScatterRow<'r> {
    line: &'r str,
    governs: bool,
    segment: &'r SegmentDamage,
    life: SegmentLife,
}
