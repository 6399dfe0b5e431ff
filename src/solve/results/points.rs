//! Where points of interest go, and the waves there.

use super::super::system::SolveError;
use super::super::time::Run;
use super::motions::moving;
use super::{Event, Magnitude, columns, filled, headed, timed};
use crate::hydro::sea::Sea;
use crate::language::units::Dim;
use crate::model::{Model, Position};
use crate::table::Table;
use nalgebra::Vector3;
use std::sync::Arc;

/// A point that is told of.
#[derive(Clone, Debug, PartialEq)]
pub struct Interest {
    /// Its name as written.
    pub name: String,
    /// The number of its body in the run; none in the ground.
    pub body: Option<usize>,
    /// Where it stands in its body; in the ground, global (m).
    pub at: Position,
    /// Where it stood when it was marked (m, global).
    pub marked: Position,
}

/// The seas of a run, each with the time since when it has been in force (s); `None` for one that is not known.
struct Seas(Vec<(f64, Option<Option<Arc<Sea>>>)>);

impl Seas {
    fn of(run: &Run) -> Result<Self, SolveError> {
        if run.environments().is_empty() {
            return Ok(Seas(vec![(f64::NEG_INFINITY, Some(run.sea.clone()))]));
        }
        // the run keeps the sea it ended in, and the names of those before
        let mut list = vec![(f64::NEG_INFINITY, None)];
        for (since, name) in run.environments() {
            let env = run.model.environments.get(&Model::key(name));
            let sea = env.map(|env| Sea::of(&run.model, env)).transpose().map_err(SolveError::new)?;
            list.push((*since, sea.map(|s| s.map(Arc::new))));
        }
        Ok(Seas(list))
    }

    fn at(&self, time: f64) -> Option<Option<&Sea>> {
        let found = self.0.iter().rev().find(|(since, _)| *since <= time)?;
        found.1.as_ref().map(|sea| sea.as_deref())
    }
}

/// Location, velocity and acceleration of points, their motion from where they were marked, the elevation of the waves above the
/// mean level there (`W. Elv`), and the height of the point above the waves. `local`: velocities, accelerations and motions along
/// the axes of the body.
///
/// # Errors
/// An environment of the run whose sea cannot be made again.
pub fn points(
    run: &Run,
    chosen: &[Interest],
    (local, magnitude): (bool, Magnitude),
    events: &[Event],
) -> Result<Table, SolveError> {
    let (layout, seas) = (&run.history.layout, Seas::of(run)?);
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
    if seas.0.iter().any(|(_, sea)| sea.is_none()) {
        table.note("the waves before the first change of the environment are not kept: W. Elv is left out there");
    }
    filled((&run.history, events), table, &mut |row, made| {
        let time = row.first().copied().unwrap_or(0.0);
        let sea = seas.at(time);
        let waves = sea.map(|sea| sea.map(|sea| (sea.level, sea.at(time))));
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
                Some(Some((level, sea))) => (*level, sea.elevation(at.x, at.y)),
                Some(None) => (still, 0.0),
                None => (f64::NAN, f64::NAN),
            };
            made.extend([elevation, at.z - level - elevation]);
        }
        Ok(())
    })
}
