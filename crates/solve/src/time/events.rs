//! Events of a run (`&ACTION`): triggers are checked after each step, and the step is bisected to locate them; connectors are released
//! or activated, winches change lengths, the environment changes.

use super::action::{ActionKind, Observable, Trigger, point_in_body};
use super::compression::pull;
use super::ends::end_of;
use super::run::Run;
use crate::link::EndAttachment;
use crate::system::SolveError;
use std::sync::Arc;
use windlass_base::geometry::Position;
use windlass_base::units::Dim;
use windlass_hydro::sea::Sea;
use windlass_model::{ClassError, Environment, Model};

/// Most parts of a step that is divided for what is wound in it.
const MAX_STEP_PARTS: f64 = 1000.0;

/// What is winched, and how long it was.
#[derive(Debug, Default)]
pub(super) struct Winches {
    list: Vec<(String, f64, Option<f64>)>,
    lengths: Vec<Option<f64>>,
}

impl Run {
    /// Puts bodies whose motion is given where they are now.
    pub(super) fn prescribe(&mut self) -> Result<(), SolveError> {
        for (motion, node) in self.now.motions.iter_mut().zip(&self.system.nodes) {
            if let Some(prescribed) = &node.prescribed {
                *motion = prescribed.motion_at(self.now.time).map_err(SolveError::error_about(&node.name))?;
            }
        }
        Ok(())
    }

    /// In how many parts a step of the run is taken while a line is wound at a rate (m/s): its elements appear and go one by one.
    fn parts_to_wind(&self, name: &str, rate: f64) -> Result<f64, SolveError> {
        let Some(link) = self.system.links.iter().find(|l| l.name.eq_ignore_ascii_case(name)) else { return Ok(1.0) };
        let Some(line) = link.element.as_dynamic() else { return Ok(1.0) };
        let most = line.max_payout_step();
        let parts = (rate.abs() * self.settings.dt / most).ceil().max(1.0);
        if parts <= MAX_STEP_PARTS {
            return Ok(parts);
        }
        let text = format!(
            "its winch takes {{}} in a step of {{}}, which would need {parts:.0} parts of the step for elements of {{}} each; at most {MAX_STEP_PARTS} are taken"
        );
        let values =
            [(rate.abs() * self.settings.dt, Dim::Length), (self.settings.dt, Dim::Time), (2.0 * most, Dim::Length)];
        let error = ClassError::with_values(text, &values)
            .help("a lower rate, a shorter step of -TIME of &ENV, or fewer elements by -REFINE");
        Err(SolveError { who: Some(link.name.clone()), error })
    }

    /// The longest part of a step (s) that lines under a winch allow.
    pub(super) fn part_to_wind(&self) -> Result<f64, SolveError> {
        let mut most: f64 = 1.0;
        for (name, rate, _) in &self.winches {
            most = most.max(self.parts_to_wind(name, *rate)?);
        }
        Ok(self.settings.dt / most)
    }

    pub(super) fn check_actions(&self) -> Result<(), SolveError> {
        for action in &self.actions {
            let wrong = |error: ClassError| SolveError::new(error.with_subject(format!("action {}", action.name)));
            if let Some(Observable::Height(point)) = action.when.observable() {
                point_in_body(&self.model, point).map_err(wrong)?;
            }
            if let ActionKind::Winch(names, rate, _) = &action.what {
                for name in names {
                    self.parts_to_wind(name, *rate)?;
                    if let Some(assembly) = self.model.reeving(name) {
                        let text = format!("connector {name} is a span of the line of {}", assembly.name);
                        return Err(wrong(ClassError::new(text).help("ASSEMBLY WINCH turns the drum of such a line")));
                    }
                    let connector = self.model.connectors.get(&Model::key(name));
                    if connector.is_none_or(|c| self.model.first_length(c).is_none()) {
                        return Err(wrong(ClassError::new(format!("connector {name} has no length to change"))));
                    }
                }
            }
        }
        Ok(())
    }

    /// The next time an action waits for, up to `end`.
    pub(super) fn next_action(&self, end: f64) -> Option<f64> {
        let waits = self.actions.iter().zip(&self.fired).filter(|(_, f)| f.is_none());
        let times = waits.filter_map(|(a, _)| if let Trigger::At(t) = a.when { Some(t) } else { None });
        times.filter(|t| *t > self.now.time && *t < end).min_by(f64::total_cmp)
    }

    /// Changes the lengths of what is winched, to those at a time; gives what they were, for [`Run::unwind`].
    pub(super) fn wind(&mut self, time: f64) -> Result<Winches, SolveError> {
        if self.winches.is_empty() {
            return Ok(Winches::default());
        }
        let length = |name: &String| self.model.connectors.get(&Model::key(name)).and_then(|c| c.first_length);
        let lengths = self.winches.iter().map(|(name, ..)| length(name)).collect();
        let before = Winches { list: self.winches.clone(), lengths };
        self.wound = true;
        let dt = time - self.now.time;
        for (name, rate, to) in &mut self.winches {
            let Some(connector) = self.model.connectors.get(&Model::key(name)) else { continue };
            let old = self.model.first_length(connector).unwrap_or(0.0);
            let mut length = old + *rate * dt;
            if let Some(target) = *to
                && (target - length) * *rate <= 0.0
            {
                (length, *rate) = (target, 0.0);
            }
            if length <= 0.0 {
                let (name, left) = (name.clone(), old / rate.abs());
                return Err(self.reeled_in_error(&name, left));
            }
            if let Some(connector) = self.model.connectors.get_mut(&Model::key(name)) {
                connector.first_length = Some(length);
            }
            self.system.rebuild_connector(&self.model, name)?;
        }
        self.winches.retain(|(_, rate, _)| *rate != 0.0);
        Ok(before)
    }

    /// The error of a winch that has nothing left to haul in so much later than now (s).
    fn reeled_in_error(&self, name: &str, left: f64) -> SolveError {
        let winds = |what: &ActionKind| match what {
            ActionKind::Winch(names, ..) => names.iter().any(|n| n.eq_ignore_ascii_case(name)),
            _ => false,
        };
        let since = self.actions.iter().zip(&self.fired).filter(|(a, _)| winds(&a.what));
        let last = since.filter_map(|(a, fired)| Some((a, (*fired)?))).max_by(|a, b| a.1.total_cmp(&b.1));
        let by = last.map_or_else(String::new, |(action, _)| format!("by action {} ", action.name));
        let text = format!("its first segment is hauled in {by}to the end: at {{}} nothing of it is left");
        let error = ClassError::with_values(text, &[(self.now.time + left, Dim::Time)])
            .help("a LENGTH of -WINCH, or a later action with a RATE of 0, ends the winch before");
        SolveError { who: Some(name.to_string()), error }
    }

    /// The error of a winch that has less left than it hauls in within a step of the run: the shorter a line, the stiffer, and what
    /// a last step finds no balance for is its end.
    pub(super) fn find_line_nearly_reeled_in(&self) -> Option<SolveError> {
        self.winches.iter().filter(|(_, rate, _)| *rate < 0.0).find_map(|(name, rate, _)| {
            let length = self.model.first_length(self.model.connectors.get(&Model::key(name))?)?;
            let left = length / rate.abs();
            (left <= self.settings.dt * (1.0 + 1e-9)).then(|| self.reeled_in_error(name, left))
        })
    }

    /// Puts lengths and winches back to what they were; elements follow when they are wound again.
    pub(super) fn unwind(&mut self, before: Winches) {
        if before.list.is_empty() {
            return;
        }
        for ((name, ..), length) in before.list.iter().zip(before.lengths) {
            if let Some(connector) = self.model.connectors.get_mut(&Model::key(name)) {
                connector.first_length = length;
            }
        }
        self.winches = before.list;
    }

    /// Whether a condition is still waited for.
    pub(super) fn waits(&self) -> bool {
        self.actions.iter().zip(&self.fired).any(|(a, f)| f.is_none() && !matches!(a.when, Trigger::At(_)))
    }

    /// Whether a condition that is waited for is true now.
    pub(super) fn trigger_crossed(&self) -> bool {
        let waited = self.actions.iter().zip(&self.fired).filter(|(_, f)| f.is_none());
        waited.into_iter().any(|(a, _)| !matches!(a.when, Trigger::At(_)) && self.due(&a.when))
    }

    fn due(&self, when: &Trigger) -> bool {
        match when {
            Trigger::At(time) => self.now.time >= time - 1e-9 * self.settings.dt,
            Trigger::Above(watched, value) => self.observed_value(watched).is_some_and(|v| v > *value),
            Trigger::Below(watched, value) => self.observed_value(watched).is_some_and(|v| v < *value),
            Trigger::After(time, condition) => self.due(&Trigger::At(*time)) && self.due(condition),
        }
    }

    /// The value of what is watched.
    fn observed_value(&self, watched: &Observable) -> Option<f64> {
        match watched {
            Observable::Tension(name) => {
                let mut first = 0;
                for link in &self.system.links {
                    if link.name.eq_ignore_ascii_case(name) {
                        let pulling = link.element.pulling_end();
                        let force = self.now.forces.wrenches.get(first + pulling)?.fixed_rows::<3>(0).into_owned();
                        let at = |end: &EndAttachment| end_of(end, &self.now.motions, false).0.pose.origin;
                        let away = |from| {
                            Some(pull(
                                &force,
                                &(at(link.ends.get(1usize.checked_sub(pulling)?)?) - at(link.ends.get(pulling)?)),
                                from,
                            ))
                        };
                        return link.element.compression_onset().map_or_else(|| Some(force.norm()), away);
                    }
                    first += link.ends.len();
                }
                None
            }
            Observable::Dof(body, dof) => {
                let index = self.model.bodies.get_index_of(&Model::key(body))?;
                let position = self.now.motions.get(index)?.pose.position(self.near.get(index)?);
                position.shift.iter().chain(&position.turn).nth(*dof).copied()
            }
            Observable::Height(point) => {
                let (body, at): (usize, Position) = point_in_body(&self.model, point).ok()?;
                let position = self.now.motions.get(body)?.pose.point(at.into());
                Some(position.z - self.system.surroundings.tide)
            }
        }
    }

    /// Does what has come due; gives the name of an action that ends the run.
    pub(super) fn process_events(&mut self) -> Result<Option<String>, SolveError> {
        let mut changed = false;
        let mut stop = None;
        for index in 0..self.actions.len() {
            if self.fired.get(index).is_none_or(Option::is_some) {
                continue;
            }
            let Some(action) = self.actions.get(index).cloned() else { continue };
            if !self.due(&action.when) {
                continue;
            }
            if let Some(fired) = self.fired.get_mut(index) {
                *fired = Some(self.now.time);
            }
            changed |= !matches!(action.what, ActionKind::Stop | ActionKind::Winch(..));
            match &action.what {
                ActionKind::Stop => stop = Some(action.name.clone()),
                ActionKind::Winch(names, rate, to) => {
                    for name in names {
                        self.winds(&action.name, name, *rate, *to)?;
                        self.winches.retain(|(n, ..)| !n.eq_ignore_ascii_case(name));
                        if *rate != 0.0 {
                            self.winches.push((name.clone(), *rate, *to));
                        }
                    }
                }
                what => self.change(what)?,
            }
        }
        if changed {
            // the forces have changed at once: the acceleration of the step before is not that of the next
            self.clear_caches();
            self.prepare()?;
        }
        Ok(stop)
    }

    /// Refuses to begin to wind what a winch no longer holds, or away from the length that is asked for.
    fn winds(&self, action: &str, name: &str, rate: f64, to: Option<f64>) -> Result<(), SolveError> {
        let wrong = |error: ClassError| SolveError { who: Some(name.to_string()), error };
        if self.system.duties.requirement(name).freed {
            let text = format!("it has been let go by the time of action {action}, and no winch holds it");
            return Err(wrong(ClassError::new(text)));
        }
        let connector = self.model.connectors.get(&Model::key(name));
        let now = connector.and_then(|c| self.model.first_length(c));
        if let (Some(now), Some(to)) = (now, to)
            && (to - now) * rate < 0.0
        {
            let text =
                format!("its first segment is {{}} long at action {action}, and at {{}} a second never comes to {{}}");
            let values = [(now, Dim::Length), (rate, Dim::Length), (to, Dim::Length)];
            return Err(wrong(
                ClassError::with_values(text, &values).help("a positive rate pays out, a negative one hauls in"),
            ));
        }
        Ok(())
    }

    pub(super) fn change(&mut self, what: &ActionKind) -> Result<(), SolveError> {
        match what {
            ActionKind::Release(names) => {
                for name in names {
                    self.winches.retain(|(n, ..)| !n.eq_ignore_ascii_case(name));
                    // a dynamic line is let go at its first end, and falls
                    let falls = self.system.is_dynamic_line(name);
                    if let Some(connector) = self.model.connectors.get_mut(&Model::key(name)) {
                        connector.active = falls;
                    }
                    if falls {
                        self.system.duties.set_end_released(name, true);
                        self.system.rebuild_connector(&self.model, name)?;
                    } else {
                        self.system.leave_out(name);
                    }
                }
            }
            ActionKind::Activate(names) => {
                for name in names {
                    if let Some(connector) = self.model.connectors.get_mut(&Model::key(name)) {
                        connector.active = true;
                    }
                    if self.system.duties.set_end_released(name, false) {
                        // what has fallen is brought back as it first hung
                        self.system.leave_out(name);
                    }
                    self.system.activate_connector(&self.model, name)?;
                }
            }
            ActionKind::Environment(name) => {
                let found = self.model.environments.get(&Model::key(name)).cloned();
                let missing = || SolveError::new(ClassError::new(format!("there is no environment {name}")));
                // ramps count from the start of this run
                self.model.environment = Environment { run_start: self.start(), ..found.ok_or_else(missing)? };
                self.sea = Sea::new(&self.model, &self.model.environment).map_err(SolveError::new)?.map(Arc::new);
                self.seas.push((self.now.time, self.sea.clone()));
                let memory = self.system.rebuild_loads(&self.model, self.sea.as_ref(), &self.now.memory)?;
                self.now.memory = memory;
                // a body that rides on the waves is where the new ones have it, as they are there at once
                self.prescribe()?;
            }
            ActionKind::Winch(..) | ActionKind::Stop => {}
        }
        Ok(())
    }
}
