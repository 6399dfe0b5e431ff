//! Where points of interest go, and the waves there.

use super::super::system::SolveError;
use super::super::time::Run;
use super::motions::moving;
use super::{Event, Magnitude, columns, filled, headed, timed};
use nalgebra::Vector3;
use windlass_base::geometry::Position;
use windlass_base::table::Table;
use windlass_base::units::Dim;

/// A point that is told of.
#[derive(Clone, Debug, PartialEq)]
pub struct TrackedPoint {
    /// Its name as written.
    pub name: String,
    /// The number of its body in the run; none in the ground.
    pub body: Option<usize>,
    /// Where it stands in its body; in the ground, global (m).
    pub at: Position,
    /// Where it stood when it was marked (m, global).
    pub marked: Position,
}

/// Location, velocity and acceleration of points, their motion from where they were marked, the elevation of the waves above the
/// mean level there (`W. Elv`), and the height of the point above the waves. `local`: velocities, accelerations and motions along
/// the axes of the body.
///
/// # Errors
/// Rows that make no table.
pub fn points(
    run: &Run,
    chosen: &[TrackedPoint],
    (local, magnitude): (bool, Magnitude),
    events: &[Event],
) -> Result<Table, SolveError> {
    let layout = &run.history.layout;
    let still = run.model.surroundings().tide;
    let several = chosen.len() > 1;
    let mut table = timed("Points of Interest");
    for point in chosen {
        if !several {
            table = table.fact("Point", point.name.as_str(), Dim::None);
        }
        let head = |group: &str| headed(several, &point.name, group);
        table = columns(table, &head("Location"), &["X", "Y", "Z", "Mag."], Dim::Length);
        table = columns(table, &head("Velocity"), &["VX", "VY", "VZ", "V Mag."], Dim::Velocity);
        table = columns(table, &head("Acceleration"), &["AX", "AY", "AZ", "A Mag."], Dim::Acceleration);
        table = columns(table, &head("Motion"), &["DX", "DY", "DZ", "D Mag."], Dim::Length);
        table = columns(table, &head("Waves"), &["W. Elv", "Clearance"], Dim::Length);
    }
    table = table.fact("Axes", if local { "of the body" } else { "global" }, Dim::None);
    filled((&run.history, events), table, &mut |row, made| {
        let time = row.first().copied().unwrap_or(0.0);
        let waves = run.sea_at(time).map(|sea| (sea.level, sea.at(time)));
        for point in chosen {
            let own = Vector3::from(point.at);
            let now = point.body.map(|body| moving(row, layout.body(body), own));
            let along = |v: Vector3<f64>| match &now {
                Some(now) if local => now.pose.axes.transpose() * v,
                _ => v,
            };
            let at = now.as_ref().map_or(own, |n| n.at);
            magnitude.push(&at, made);
            magnitude.push(&along(now.as_ref().map_or(Vector3::zeros(), |n| n.velocity[0])), made);
            magnitude.push(&along(now.as_ref().map_or(Vector3::zeros(), |n| n.acceleration[0])), made);
            magnitude.push(&along(at - Vector3::from(point.marked)), made);
            let (level, elevation) = match &waves {
                Some((level, sea)) => (*level, sea.elevation(at.x, at.y)),
                None => (still, 0.0),
            };
            made.extend([elevation, at.z - level - elevation]);
        }
        Ok(())
    })
}
