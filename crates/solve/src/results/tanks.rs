//! What is in compartments over a run, and the heads at their walls and holes.
//!
//! The amount in a compartment is constant in a run, that of a flooded one follows the waterline ([`windlass_hydro::Tank`]). Heads
//! are heights of sea water: a liquid of density r at a depth d has the head `d r / r_sea`. Over the height of a compartment the
//! head inside less that outside is linear between its lowest and highest point, its surface and the sea's: the largest is at one
//! of these heights.

use super::super::system::SolveError;
use super::super::time::Run;
use super::points::{TrackedPoint, water_at};
use super::{EventTable, RunEvent, group_head};
use nalgebra::Vector3;
use windlass_base::geometry::{Place, Position};
use windlass_base::pose::Pose;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_hydro::Tank;
use windlass_model::{ClassError, Compartment, Model};

/// A compartment that is followed over a run.
#[derive(Debug)]
pub struct TrackedTank {
    /// Its name as written.
    pub name: String,
    body: usize,
    tank: Tank,
    tube: [Position; 2],
}

impl TrackedTank {
    /// A compartment of the model of a run; `None` where its body makes no part of the run.
    ///
    /// # Errors
    /// A compartment that encloses no volume.
    pub fn new(run: &Run, compartment: &Compartment) -> Result<Option<Self>, ClassError> {
        let model = &run.model;
        let key = model.parts.get(&Model::key(&compartment.part)).map(|part| Model::key(&part.body));
        let Some(body) = run.history.layout.bodies.iter().position(|(_, own)| Some(own) == key.as_ref()) else {
            return Ok(None);
        };
        let tank = Tank::new(model, compartment)?;
        let tube = tank.sounding_tube(model, compartment);
        Ok(Some(TrackedTank { name: compartment.name.clone(), body, tank, tube }))
    }

    /// What it holds at a stored instant.
    fn state(&self, run: &Run, row: &[f64]) -> Result<TankState, SolveError> {
        let layout = &run.history.layout;
        let from = layout.body(self.body);
        let mut position = [f64::NAN; 6];
        position.iter_mut().zip(row.get(from..).unwrap_or_default()).for_each(|(value, stored)| *value = *stored);
        let [x, y, z, roll, pitch, yaw] = position;
        let pose = Pose::from_place(&Place { shift: [x, y, z], turn: [roll, pitch, yaw] });
        let time = row.first().copied().unwrap_or(0.0);
        let failed = |e| SolveError::error_about(&self.name)(e);
        let liquid = self.tank.liquid(&pose).map_err(failed)?;
        let volume = liquid.volume();
        let [low, high] = self.tank.reach(&pose);
        let (sea, _) = water_at(run, time);
        let share = self.tank.density() / run.model.surroundings().water_density;
        let surface = if volume > 0.0 { liquid.level } else { low };
        let difference = |height: f64| share * (surface - height).max(0.0) - (sea - height).max(0.0);
        let heights = [low, high, surface.clamp(low, high), sea.clamp(low, high)];
        let largest = heights.into_iter().map(|z| difference(z).abs()).fold(0.0, f64::max);
        let attitude = self.tank.level_pose(&pose);
        let level = self.tank.liquid(&attitude).map_err(failed)?.level;
        let [top, bottom] = self.tube.map(Vector3::from);
        let sounding = if volume > 0.0 { self.tank.sounding(&attitude, self.tube, level) } else { Some(0.0) };
        let sounding = sounding.unwrap_or(f64::NAN);
        Ok(TankState {
            percent: 100.0 * volume / self.tank.capacity,
            sounding,
            ullage: (top - bottom).norm() - sounding,
            amount: volume * self.tank.density() * run.model.defaults.gravity,
            surface,
            head: share * (surface - low),
            difference: largest,
            share,
        })
    }
}

/// A compartment at a stored instant.
#[derive(Clone, Copy)]
struct TankState {
    /// Share of its volume that is filled (per cent).
    percent: f64,
    /// Along the sounding tube, from its lower end to the surface and from there to its upper end (m).
    sounding: f64,
    ullage: f64,
    /// Weight (N).
    amount: f64,
    /// Height of the surface (m, global).
    surface: f64,
    /// Head at its lowest point (m of sea water).
    head: f64,
    /// Largest difference of the heads inside and outside of its walls (m of sea water).
    difference: f64,
    /// Density of the liquid over that of the sea.
    share: f64,
}

/// Percentage, sounding, ullage, amount and heads of compartments.
///
/// # Errors
/// Contents without a level.
pub fn tanks(run: &Run, chosen: &[TrackedTank], events: &[RunEvent]) -> Result<Table, SolveError> {
    let table = EventTable::new("Contents of Compartments", (&run.history, events), |row| {
        chosen.iter().map(|tank| tank.state(run, row)).collect::<Result<Vec<_>, _>>()
    })?;
    let several = chosen.len() > 1;
    let mut table = table;
    for (index, tank) in chosen.iter().enumerate() {
        if !several {
            table = table.fact("Compartment", tank.name.as_str(), Dim::None);
        }
        let with = |all: &Vec<TankState>, of: fn(&TankState) -> f64| all.get(index).map_or(f64::NAN, of);
        let head = |group: &str| group_head(several, &tank.name, group);
        table = table
            .column(&head("Contents"), "% Full", Dim::None, Digits::Decimals(2), |all| with(all, |s| s.percent))
            .columns(&head("Contents"), ["Sounding", "Ullage"], Dim::Length, |all| {
                [with(all, |s| s.sounding), with(all, |s| s.ullage)]
            })
            .columns(&head("Contents"), ["Amount"], Dim::Force, |all| [with(all, |s| s.amount)])
            .columns(&head("Head"), ["Pressure", "Max Diff."], Dim::Length, |all| {
                [with(all, |s| s.head), with(all, |s| s.difference)]
            });
    }
    let mut table = table.build();
    table.note(
        "heads are heights of sea water: Pressure at the lowest point, Max Diff. the largest difference across the walls with the sea at its mean level",
    );
    table.note(NO_FLOW);
    Ok(table)
}

/// What these tables do not report.
const NO_FLOW: &str =
    "amounts are constant in a run, those of flooded compartments follow the waterline: flow rates are not computed";

/// A hole that is followed over a run.
#[derive(Clone, Debug, PartialEq)]
pub struct TrackedHole {
    /// Its name as written.
    pub name: String,
    /// Where it is.
    pub point: TrackedPoint,
    /// The number of its compartment among those followed; none of a hole of no compartment.
    pub tank: Option<usize>,
}

/// Height of holes above the water with its waves, and the heads outside and inside of them.
///
/// # Errors
/// Contents without a level.
pub fn holes(
    run: &Run,
    (chosen, tanks): (&[TrackedHole], &[TrackedTank]),
    events: &[RunEvent],
) -> Result<Table, SolveError> {
    let layout = &run.history.layout;
    let mut table = EventTable::new("Holes of Compartments", (&run.history, events), |row| {
        let (level, waves) = water_at(run, row.first().copied().unwrap_or(0.0));
        let states = tanks.iter().map(|tank| tank.state(run, row)).collect::<Result<Vec<_>, _>>()?;
        let of_hole = |hole: &TrackedHole| {
            let [at, ..] = hole.point.motion(row, layout);
            let above = at.z - level - waves(at.x, at.y);
            let outside = (-above).max(0.0);
            let state = hole.tank.and_then(|tank| states.get(tank));
            let inside = state.map_or(f64::NAN, |s| s.share * (s.surface - at.z).max(0.0));
            [above, outside, inside, outside - inside]
        };
        Ok(chosen.iter().map(of_hole).collect::<Vec<[f64; 4]>>())
    })?;
    for (index, hole) in chosen.iter().enumerate() {
        if chosen.len() == 1 {
            table = table.fact("Hole", hole.name.as_str(), Dim::None);
        }
        let head = |group: &str| group_head(chosen.len() > 1, &hole.name, group);
        let value = |all: &Vec<[f64; 4]>, which: usize| all.get(index).map_or(f64::NAN, |found| found[which]);
        table = table.columns(&head("Hole"), ["Above Water"], Dim::Length, |all| [value(all, 0)]).columns(
            &head("Head"),
            ["External", "Internal", "Diff."],
            Dim::Length,
            |all| [value(all, 1), value(all, 2), value(all, 3)],
        );
    }
    let mut table = table.build();
    table.note("heads are heights of sea water at the hole, outside with the elevation of the waves; Diff. is external less internal");
    table.note(NO_FLOW);
    Ok(table)
}
