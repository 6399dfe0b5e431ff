//! `&DESCRIBE PROCESS`: configurations, connectors, multipliers, environment and the run of one process, kept apart from those of others.
//!
//! Source: [MOSES-REF process]: a process stores configurations, events, connector activity, line lengths and multipliers; a new one takes over all settings.

use crate::commands::Job;
use std::collections::HashMap;
use windlass_base::diagnostic::Outcome;
use windlass_base::geometry::Place;
use windlass_base::span::Span;
use windlass_language::name as rule;
use windlass_model::{Anchor, Environment, Model, Multipliers, TankContents};
use windlass_solve::tethered::Tethered;
use windlass_solve::time::Run;

/// What a connector is in a process.
#[derive(Clone, Debug)]
struct ConnectorSettings {
    active: bool,
    /// Length of its first segment (m), where it is not that of its class.
    first_length: Option<f64>,
    anchor: Option<Anchor>,
}

/// A process that is not the current one.
#[derive(Debug)]
pub struct Process {
    /// Its name as written.
    name: String,
    /// Present and previous places of bodies, by key.
    positions: HashMap<String, [Place; 2]>,
    /// Connectors, by key.
    connectors: HashMap<String, ConnectorSettings>,
    /// What is in compartments, by key.
    contents: HashMap<String, TankContents>,
    multipliers: Multipliers,
    environment: Environment,
    run: Option<Run>,
    tethered: Option<Tethered>,
}

impl Process {
    /// The settings of a model, without events.
    fn of_model(name: &str, model: &Model) -> Self {
        let positions = model.bodies.iter().map(|(key, body)| (key.clone(), [body.position, body.previous]));
        let connectors = model.connectors.iter().map(|(key, c)| {
            (key.clone(), ConnectorSettings { active: c.active, first_length: c.first_length, anchor: c.anchor })
        });
        Process {
            name: name.to_string(),
            positions: positions.collect(),
            connectors: connectors.collect(),
            contents: model.compartments.iter().map(|(key, tank)| (key.clone(), tank.contents)).collect(),
            multipliers: model.multipliers.clone(),
            environment: model.environment.clone(),
            run: None,
            tethered: None,
        }
    }

    /// Gives a model these settings; what has been defined since keeps its own.
    fn restore(self, job: &mut Job) {
        let model = &mut job.model;
        for (key, [position, previous]) in self.positions {
            if let Some(body) = model.bodies.get_mut(&key) {
                (body.position, body.previous) = (position, previous);
            }
        }
        for (key, settings) in self.connectors {
            if let Some(connector) = model.connectors.get_mut(&key) {
                (connector.active, connector.first_length) = (settings.active, settings.first_length);
                connector.anchor = settings.anchor;
            }
        }
        for (key, contents) in self.contents {
            if let Some(tank) = model.compartments.get_mut(&key) {
                tank.contents = contents;
            }
        }
        (model.multipliers, model.environment) = (self.multipliers, self.environment);
        model.refresh_weight_multipliers();
        (job.run, job.tethered, job.process) = (self.run, self.tethered, self.name);
    }
}

/// Makes a process the current one. A new one has the present settings and no events; `forget` drops the events of a known one.
///
/// # Errors
/// A name that cannot be one.
pub(super) fn describe(job: &mut Job, name: &str, position: Span, forget: bool) -> Outcome<()> {
    rule::check(name, None, "process", position)?;
    if !job.process.eq_ignore_ascii_case(name) {
        let left = Process {
            run: job.run.take(),
            tethered: job.tethered.take(),
            ..Process::of_model(&job.process, &job.model)
        };
        job.processes.insert(Model::key(&left.name), left);
        match job.processes.shift_remove(&Model::key(name)) {
            Some(known) => known.restore(job),
            None => job.process = name.to_string(),
        }
        job.note_name(name, position);
    }
    if forget {
        (job.run, job.tethered) = (None, None);
    }
    Ok(())
}

/// The names of all processes, the current one first.
pub(crate) fn names(job: &Job) -> impl Iterator<Item = (&str, bool)> {
    let others = job.processes.values().map(|p| (p.name.as_str(), p.run.is_some()));
    std::iter::once((job.process.as_str(), job.run.is_some())).chain(others)
}
