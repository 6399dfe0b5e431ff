//! Where points of interest go, and the waves there.

use super::super::system::SolveError;
use super::super::time::{RowLayout, Run};
use super::motions::find_motion;
use super::{EventTable, Magnitude, RunEvent, group_head};
use nalgebra::Vector3;
use windlass_base::geometry::Position;
use windlass_base::table::Table;
use windlass_base::units::Dim;

/// A point that is reported.
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

impl TrackedPoint {
    /// Where it is (m), its velocity (m/s) and its acceleration (m/s2) at a stored instant, global axes.
    pub(super) fn motion(&self, row: &[f64], layout: &RowLayout) -> [Vector3<f64>; 3] {
        let own = Vector3::from(self.at);
        match self.body.map(|body| find_motion(row, layout.body(body), own)) {
            Some(now) => [now.at, now.velocity[0], now.acceleration[0]],
            None => [own, Vector3::zeros(), Vector3::zeros()],
        }
    }
}

/// The mean water level (m) at a time of a run, and the elevation of the waves above it at a place (m).
pub(super) fn water_at(run: &Run, time: f64) -> (f64, impl Fn(f64, f64) -> f64 + '_) {
    let waves = run.sea_at(time).map(|sea| (sea.level, sea.at_time(time)));
    let level = waves.as_ref().map_or_else(|| run.model.surroundings().tide, |(level, _)| *level);
    (level, move |x, y| waves.as_ref().map_or(0.0, |(_, sea)| sea.elevation(x, y)))
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
    events: &[RunEvent],
) -> Result<Table, SolveError> {
    let layout = &run.history.layout;
    let still = run.model.surroundings().tide;
    let several = chosen.len() > 1;
    let mut table = EventTable::new("Points of Interest", (&run.history, events), |row| {
        let time = row.first().copied().unwrap_or(0.0);
        let waves = run.sea_at(time).map(|sea| (sea.level, sea.at_time(time)));
        let of_point = |point: &TrackedPoint| {
            let own = Vector3::from(point.at);
            let now = point.body.map(|body| find_motion(row, layout.body(body), own));
            let along = |v: Vector3<f64>| match &now {
                Some(now) if local => now.pose.axes.transpose() * v,
                _ => v,
            };
            let at = now.as_ref().map_or(own, |n| n.at);
            let (level, elevation) = match &waves {
                Some((level, sea)) => (*level, sea.elevation(at.x, at.y)),
                None => (still, 0.0),
            };
            PointRow {
                at,
                velocity: along(now.as_ref().map_or(Vector3::zeros(), |n| n.velocity[0])),
                acceleration: along(now.as_ref().map_or(Vector3::zeros(), |n| n.acceleration[0])),
                moved: along(at - Vector3::from(point.marked)),
                elevation,
                clearance: at.z - level - elevation,
            }
        };
        Ok(chosen.iter().map(of_point).collect::<Vec<_>>())
    })?;
    for (index, point) in chosen.iter().enumerate() {
        if !several {
            table = table.fact("Point", point.name.as_str(), Dim::None);
        }
        let with = |all: &Vec<PointRow>, vector: fn(&PointRow) -> &Vector3<f64>| {
            all.get(index).map_or([f64::NAN; 4], |row| magnitude.components_and_magnitude(vector(row)))
        };
        let head = |group: &str| group_head(several, &point.name, group);
        table = table
            .columns(&head("Location"), ["X", "Y", "Z", "Mag."], Dim::Length, |all| with(all, |row| &row.at))
            .columns(&head("Velocity"), ["VX", "VY", "VZ", "V Mag."], Dim::Velocity, |all| {
                with(all, |row| &row.velocity)
            })
            .columns(&head("Acceleration"), ["AX", "AY", "AZ", "A Mag."], Dim::Acceleration, |all| {
                with(all, |row| &row.acceleration)
            })
            .columns(&head("Motion"), ["DX", "DY", "DZ", "D Mag."], Dim::Length, |all| with(all, |row| &row.moved))
            .columns(&head("Waves"), ["W. Elv", "Clearance"], Dim::Length, |all| {
                all.get(index).map_or([f64::NAN; 2], |row| [row.elevation, row.clearance])
            });
    }
    Ok(table.fact("Axes", if local { "of the body" } else { "global" }, Dim::None).build())
}

/// A point at a stored instant.
struct PointRow {
    /// Global (m).
    at: Vector3<f64>,
    /// (m/s), (m/s2) and from where it was marked (m), along the axes asked for.
    velocity: Vector3<f64>,
    acceleration: Vector3<f64>,
    moved: Vector3<f64>,
    /// Of the waves above the mean level (m), and of the point above the waves.
    elevation: f64,
    clearance: f64,
}
