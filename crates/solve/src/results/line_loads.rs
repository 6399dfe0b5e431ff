//! What design checks ask of the lines of a run: the tension of each segment over time, what the anchor bears, the least length on the
//! bottom, and which lines were lost.
//!
//! The tension at the first end is the run's own. Below it a quasi-static line is shaped between its ends at the turning points of that
//! tension; between them the difference of a segment's tension from that at the first end is interpolated over time.

use super::super::link::{EndAttachment, element_attachments, end_attachments, pose_of};
use super::super::system::SolveError;
use super::super::time::Run;
use super::RunEvent;
use super::along::{LineResults, dynamic_line_loads};
use super::connectors::{force, poses};
use super::fatigue::turning_points;
use super::rest_state::RestSolver;
use windlass_base::table::Cell;
use windlass_model::{
    Class, ClassError, Condition, Connector, FatigueSegment, Idealisation, LineModel, LineSampling, Model, Placement,
};

/// The most that an anchor bears over some events (N).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AnchorRecord {
    /// Largest horizontal pull toward the first end.
    pub horizontal: f64,
    /// Largest vertical pull, up; 0 where it is never pulled up.
    pub vertical: f64,
    /// Largest of the two as one force.
    pub resultant: f64,
}

impl AnchorRecord {
    /// Takes the pull of an instant.
    pub(crate) fn take(&mut self, [horizontal, vertical]: [f64; 2]) {
        let up = vertical.max(0.0);
        self.horizontal = self.horizontal.max(horizontal);
        self.vertical = self.vertical.max(up);
        self.resultant = self.resultant.max(horizontal.hypot(up));
    }
}

/// Tensions of the segments of a line over time.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct TensionSeries {
    pub times: Vec<f64>,
    pub segments: Vec<Vec<f64>>,
    pub anchor: Option<AnchorRecord>,
    pub grounded: Option<f64>,
}

/// A line of a run as a design check sees it.
#[derive(Clone, Debug, PartialEq)]
pub struct LineRecord {
    /// The connector.
    pub name: String,
    /// How it was idealised.
    pub idealisation: Idealisation,
    /// Its segments, from the first end.
    pub segments: Vec<FatigueSegment>,
    /// Times (s).
    pub times: Vec<f64>,
    /// The largest tension of each segment (N) at these times.
    pub tensions: Vec<Vec<f64>>,
    /// What its anchor bears; none of a line between bodies, or one whose force does not follow from its ends.
    pub anchor: Option<AnchorRecord>,
    /// Least length on the bottom (m); none where it is not known.
    pub grounded: Option<f64>,
}

/// Which mooring lines a run was without.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LostLines {
    /// Those that did not act when it began.
    pub before: Vec<String>,
    /// Those that acted then, and not at its end.
    pub during: Vec<String>,
}

/// The mooring lines that a run was without at its beginning, and those it lost.
pub fn lost_lines(run: &Run) -> LostLines {
    let mut lost = LostLines::default();
    let layout = &run.history.layout;
    let (first, last) = (run.history.rows().next(), run.history.rows().last());
    for connector in run.model.connectors.values() {
        if !is_mooring_line(&run.model, connector) {
            continue;
        }
        let columns = layout.links.iter().find(|l| l.name == connector.name);
        let acts = |row: Option<&[f64]>| {
            columns.is_some_and(|c| row.and_then(|row| row.get(c.active)).is_some_and(|active| *active > 0.0))
        };
        match (acts(first), acts(last)) {
            (false, false) => lost.before.push(connector.name.clone()),
            (true, false) => lost.during.push(connector.name.clone()),
            _ => {}
        }
    }
    lost
}

/// Whether a connector of a run, by its number, acts at every one of some events.
pub fn acts_throughout(run: &Run, link: usize, events: &[RunEvent]) -> bool {
    let Some(columns) = run.history.layout.links.get(link) else { return false };
    let mut rows = events.iter().map(|event| run.history.rows().nth(event.row));
    rows.all(|row| row.and_then(|row| row.get(columns.active)).is_some_and(|active| *active > 0.0))
}

/// Whether a connector is a line of segments: one that a check of tension is for.
pub fn is_mooring_line(model: &Model, connector: &Connector) -> bool {
    model
        .classes
        .get(&Model::key(&connector.class))
        .is_some_and(|class| class.object.is_line() && class.object.as_segmented().is_some())
}

/// The tensions of lines of a run, by their numbers, over some events. Connectors that are no lines of segments are passed over.
///
/// # Errors
/// A line that does not act at every event, or that cannot be shaped.
pub fn line_records(run: &Run, links: &[usize], events: &[RunEvent]) -> Result<Vec<LineRecord>, SolveError> {
    let mut list = Vec::new();
    for link in links {
        let Some(columns) = run.history.layout.links.get(*link) else { continue };
        let name = columns.name.as_str();
        let Some(connector) = run.model.connectors.get(&Model::key(name)) else { continue };
        let Some(class) = run.model.classes.get(&Model::key(&connector.class)) else { continue };
        let segments = class.fatigue_segments();
        if segments.is_empty() || !is_mooring_line(&run.model, connector) {
            continue;
        }
        let about = |error: ClassError| SolveError { who: Some(name.to_string()), error };
        let idealisation = run.model.idealisation(name).unwrap_or(Idealisation::Massless);
        let made = if idealisation == Idealisation::Dynamic {
            let to_ground = matches!(element_attachments(&run.model, connector).get(1), Some(EndAttachment::Ground(_)));
            dynamic_line_loads(&LineResults::find(run, name).map_err(about)?, to_ground, events)
        } else {
            quasi_static(run, (*link, connector, class), segments.len(), events)?
        };
        if made.segments.iter().flatten().any(|tension| !tension.is_finite()) {
            let error = ClassError::new("it does not act at every event")
                .help("-EVENTS BEG END chooses those at which it does");
            return Err(about(error));
        }
        list.push(LineRecord {
            name: name.to_string(),
            idealisation,
            segments,
            times: made.times,
            tensions: made.segments,
            anchor: made.anchor,
            grounded: made.grounded,
        });
    }
    Ok(list)
}

fn quasi_static(
    run: &Run,
    (link, connector, class): (usize, &Connector, &Class),
    segments: usize,
    events: &[RunEvent],
) -> Result<TensionSeries, SolveError> {
    let (layout, name) = (&run.history.layout, connector.name.as_str());
    let about = |error: ClassError| SolveError { who: Some(name.to_string()), error };
    let width = layout.width.max(1);
    let stored =
        |event: &RunEvent| run.history.values.get(event.row * width..(event.row + 1) * width).unwrap_or_default();
    let mut made = TensionSeries { segments: vec![Vec::new(); segments], ..TensionSeries::default() };
    let mut top = Vec::with_capacity(events.len());
    let mut positions = Vec::new();
    let mut settling = RestSolver::new(&run.model, name)?;
    for event in events {
        let row = stored(event);
        made.times.push(event.time(&run.history).unwrap_or(f64::NAN));
        let acting = force(layout, link, row);
        top.push(acting.and_then(|_| layout.tension(link, row)).unwrap_or(f64::NAN));
        let (Some(settling), Some(_)) = (&mut settling, acting) else { continue };
        poses(layout, row, &mut positions);
        let length = layout.links.get(link).and_then(|l| l.length(row));
        let rest = settling.solve_at(&positions, length)?;
        if rest.horizontal.is_finite() && rest.vertical.is_finite() {
            made.anchor.get_or_insert_default().take([rest.horizontal, rest.vertical]);
        }
        if rest.grounded.is_finite() {
            made.grounded = Some(made.grounded.map_or(rest.grounded, |least: f64| least.min(rest.grounded)));
        }
    }
    if top.iter().any(|tension| !tension.is_finite()) {
        made.segments = vec![top];
        return Ok(made);
    }
    if let Some(assembly) = run.model.reeving(name) {
        let text = format!("it is a span of the line of {}: its segments are not checked", assembly.name);
        return Err(about(ClassError::new(text)));
    }
    // by how much each segment differs from the first end, at the turning points
    let mut turns: Vec<usize> = Vec::new();
    let mut differences: Vec<Vec<f64>> = vec![Vec::new(); segments];
    let ends = end_attachments(&run.model, connector);
    let (placement, surroundings) = (run.model.placement(connector), run.model.surroundings());
    for at in turning_points(&top) {
        let (Some(event), Some(pull)) = (events.get(at), top.get(at)) else { continue };
        let row = stored(event);
        poses(layout, row, &mut positions);
        let [fairlead, other] = ends.map(|end| pose_of(&end, &positions).origin.into());
        let other = placement.other.filter(|_| placement.anchored).or(Some(other));
        let wound = layout.links.get(link).and_then(|l| l.length(row));
        let here = Placement { fairlead, other, first_length: wound.or(placement.first_length), ..placement.clone() };
        let line = class.line(&here, &surroundings).map_err(about)?;
        let most = segment_tensions(line.as_ref(), name, Condition::Placed, segments).map_err(about)?;
        turns.push(at);
        differences.iter_mut().zip(most).for_each(|(list, value)| list.push(value - pull));
    }
    for (series, differences) in made.segments.iter_mut().zip(&differences) {
        *series =
            top.iter().enumerate().map(|(at, pull)| pull + interpolate(&made.times, &turns, differences, at)).collect();
    }
    Ok(made)
}

/// Points inside each segment, from the last two of which the tension at its end is extrapolated.
const POINTS_INSIDE: usize = 4;

/// The largest tension of each segment of a line in a configuration (N). Where two segments meet, a clump or buoy parts their tensions:
/// that of the end of the first of them is extrapolated along it.
///
/// # Errors
/// A condition that no configuration meets.
pub fn segment_tensions(
    line: &dyn LineModel,
    name: &str,
    condition: Condition,
    segments: usize,
) -> Result<Vec<f64>, ClassError> {
    let shape = line.geometry(name, condition, LineSampling::Inside(POINTS_INSIDE))?;
    let cells = |column: &str| shape.get(column).map(|c| c.cells.as_slice()).unwrap_or_default();
    let points: Vec<(usize, f64, f64)> = cells("Segment")
        .iter()
        .zip(cells("Arc Length"))
        .zip(cells("Tension"))
        .filter_map(|((segment, arc), tension)| match segment {
            Cell::Integer(segment) => {
                Some((usize::try_from(*segment).ok()?.checked_sub(1)?, arc.number()?, tension.number()?))
            }
            _ => None,
        })
        .collect();
    Ok(largest_of_segments(&points, segments))
}

/// The largest tension of each segment, of points along the line with segment (from 0), arc length and tension.
fn largest_of_segments(points: &[(usize, f64, f64)], segments: usize) -> Vec<f64> {
    let mut most = vec![f64::NAN; segments];
    let mut take = |segment: usize, tension: f64| {
        if let Some(value) = most.get_mut(segment) {
            *value = value.max(tension);
        }
    };
    for (segment, _, tension) in points {
        take(*segment, *tension);
    }
    for three in points.windows(3) {
        if let [(s0, a0, t0), (s1, a1, t1), (s2, a2, _)] = three
            && s0 == s1
            && s2 != s1
            && a1 > a0
        {
            take(*s1, t1 + (t1 - t0) / (a1 - a0) * (a2 - a1));
        }
    }
    most
}

/// A value that is known at some of the times, at another of them: on the straight line over time.
fn interpolate(times: &[f64], known: &[usize], values: &[f64], at: usize) -> f64 {
    let behind = known.partition_point(|turn| *turn < at);
    let point = |index: usize| Some((*times.get(*known.get(index)?)?, *values.get(index)?));
    let here = times.get(at).copied().unwrap_or(f64::NAN);
    match (behind.checked_sub(1).and_then(point), point(behind)) {
        (Some((t0, v0)), Some((t1, v1))) if t1 > t0 => v0 + (v1 - v0) * (here - t0) / (t1 - t0),
        (_, Some((_, value))) | (Some((_, value)), None) => value,
        (None, None) => f64::NAN,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn difference_is_interpolated_over_time() {
        let times = [0.0, 1.0, 2.0, 4.0];
        let found: Vec<f64> = (0..4).map(|at| interpolate(&times, &[0, 3], &[10.0, 30.0], at)).collect();
        assert_eq!(found, [10.0, 15.0, 20.0, 30.0]);
        assert!(interpolate(&times, &[], &[], 2).is_nan());
    }

    #[test]
    fn end_of_segment_is_extrapolated_before_a_buoy() {
        // the first segment rises to a buoy: 10 at 0, 12 at 4, so 12.5 at 5, where the second begins with 40
        let points = [(0, 0.0, 10.0), (0, 4.0, 12.0), (1, 5.0, 40.0), (1, 9.0, 30.0)];
        assert_eq!(largest_of_segments(&points, 2), [12.5, 40.0]);
        assert!(largest_of_segments(&points, 3)[2].is_nan());
    }

    #[test]
    fn anchor_keeps_most_of_each_and_of_both() {
        let mut anchor = AnchorRecord::default();
        anchor.take([3.0, 4.0]);
        anchor.take([4.5, -9.0]);
        assert_eq!(anchor, AnchorRecord { horizontal: 4.5, vertical: 4.0, resultant: 5.0 });
    }
}
