//! Where a line is in a run, point by point: what clearances are measured on.
//!
//! A quasi-static line is shaped between its ends, with points so dense that it turns by at most 2.3 degrees from one to the next; a
//! dynamic line has the nodes that the run kept.

use super::super::link::{end_attachments, pose_of};
use super::super::outline::outline;
use super::super::system::SolveError;
use super::super::time::Run;
use super::RunEvent;
use super::along::{LineResults, dynamic_path};
use super::connectors::poses;
use nalgebra::Vector3;
use windlass_base::geometry::{Place, Position};
use windlass_base::table::Cell;
use windlass_model::{
    Body, ClassError, Condition, Connector, Idealisation, LineSampling, Model, Placement, Surroundings,
};

/// A point of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathPoint {
    /// Its segment, from 1; where two meet that behind.
    pub segment: usize,
    /// Where it is (m, global).
    pub position: Vector3<f64>,
    /// Height over the bottom (m); none without one.
    pub height: Option<f64>,
}

/// Where a quasi-static line is between its ends.
///
/// # Errors
/// A line without a configuration there, or that is none of segments.
pub fn static_path(
    model: &Model,
    connector: &Connector,
    placement: &Placement,
    surroundings: &Surroundings,
) -> Result<Vec<PathPoint>, ClassError> {
    let class = model
        .classes
        .get(&Model::key(&connector.class))
        .ok_or_else(|| ClassError::new(format!("there is no class {}", connector.class)))?;
    let line = class.line(placement, surroundings)?;
    let shape = line.geometry(&connector.name, Condition::Placed, LineSampling::Adaptive)?;
    let cells = |column: &str| shape.get(column).map(|c| c.cells.as_slice()).unwrap_or_default();
    let (_, along) = placement.span();
    let [x0, y0, _] = placement.fairlead;
    let heights: Vec<Option<f64>> =
        cells("Z").iter().zip(cells("Bottom")).map(|(z, bottom)| Some(z.number()? - bottom.number()?)).collect();
    let points = cells("Segment").iter().zip(cells("X")).zip(cells("Z")).zip(heights);
    Ok(points
        .filter_map(|(((segment, x), z), height)| {
            let Cell::Integer(segment) = segment else { return None };
            let (x, z) = (x.number()?, z.number()?);
            let position = Vector3::new(x0 + along[0] * x, y0 + along[1] * x, z);
            Some(PathPoint { segment: usize::try_from(*segment).ok()?, position, height })
        })
        .collect())
}

/// Where a line of a run is at an event; nothing while it does not act.
///
/// # Errors
/// No such line, or one that cannot be shaped.
pub fn path_at(run: &Run, name: &str, event: &RunEvent) -> Result<Vec<PathPoint>, SolveError> {
    let about = |error: ClassError| SolveError { who: Some(name.to_string()), error };
    let layout = &run.history.layout;
    let width = layout.width.max(1);
    let row = run.history.values.get(event.row * width..(event.row + 1) * width).unwrap_or_default();
    let missing = || about(ClassError::new("is no connector of the run"));
    let columns = layout.links.iter().find(|l| l.name.eq_ignore_ascii_case(name)).ok_or_else(missing)?;
    if row.get(columns.active).is_none_or(|active| *active <= 0.0) {
        return Ok(Vec::new());
    }
    let connector = run.model.connectors.get(&Model::key(name)).ok_or_else(missing)?;
    if run.model.idealisation(name) == Some(Idealisation::Dynamic) {
        return Ok(dynamic_path(&LineResults::find(run, name).map_err(about)?, event));
    }
    let mut positions = Vec::new();
    poses(layout, row, &mut positions);
    let placement = run.model.placement(connector);
    let [fairlead, other] = end_attachments(&run.model, connector).map(|end| pose_of(&end, &positions).origin.into());
    let other = placement.other.filter(|_| placement.anchored).or(Some(other));
    let first_length = columns.length(row).or(placement.first_length);
    let here = Placement { fairlead, other, first_length, ..placement };
    static_path(&run.model, connector, &here, &run.model.surroundings()).map_err(about)
}

/// The panels of the pieces of a body (m, global); none of one without pieces.
pub fn body_panels(model: &Model, body: &Body) -> Vec<Vec<Position>> {
    outline(model, body).panels
}

/// The same where a run had the body at an event.
pub fn body_panels_at(run: &Run, body: &Body, event: &RunEvent) -> Vec<Vec<Position>> {
    place_at(run, &body.name, event)
        .map_or_else(Vec::new, |position| body_panels(&run.model, &Body { position, ..body.clone() }))
}

/// Where a run had a body at an event: the stored instant at or before it.
pub fn place_at(run: &Run, body: &str, event: &RunEvent) -> Option<Place> {
    let layout = &run.history.layout;
    let at = layout.bodies.iter().position(|(name, _)| name.eq_ignore_ascii_case(body)).map(|i| layout.body(i))?;
    let from = event.row * layout.width.max(1) + at;
    let [x, y, z, roll, pitch, yaw] = run.history.values.get(from..from + 6)?.try_into().ok()?;
    Some(Place { shift: [x, y, z], turn: [roll, pitch, yaw] })
}
