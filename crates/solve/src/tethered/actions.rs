//! Actions (`&ACTION`) of a run of tethers: the other connectors of the structure break, are released, or begin to act. A run of tethers
//! keeps its step: an action happens at the first state in which its condition is met, and changes the forces of that state.

use super::moored::MooredLink;
use crate::system::SolveError;
use crate::time::{Action, ActionKind, Observable, Trigger, point_in_body};
use nalgebra::Vector3;
use windlass_base::geometry::Place;
use windlass_base::pose::Pose;
use windlass_model::{Body, ClassError, Model};

/// Share of a step by which a state may be before the time of an action.
const TIME_ROUNDING_SHARE: f64 = 1e-9;
/// The time of an action that has not happened, among the numbers of a checkpoint.
const NOT_YET: f64 = -1.0;
/// Numbers of the place of the structure among those of a checkpoint.
const PLACE_NUMBERS: usize = 6;

/// The actions of a run, and when they happened.
#[derive(Debug)]
pub(super) struct MooredActions {
    list: Vec<Action>,
    fired: Vec<Option<f64>>,
    /// Points of the structure whose heights are watched: name, and place in the axes of the body (m).
    points: Vec<(String, Vector3<f64>)>,
    /// Height of the mean water level (m).
    level: f64,
    /// Where the structure was at the last state, whose angles the next ones go on from.
    near: Place,
}

/// Refuses an action, with its name.
fn refused(action: &Action, text: &str) -> SolveError {
    let error = ClassError::new(format!("action {}: {text}", action.name));
    SolveError::new(error.help("&ACTION NAME -DELETE forgets an action"))
}

/// Refuses all actions of a run of a towed tether, whose vessel is held and has no other connectors.
///
/// # Errors
/// An action.
pub(super) fn refuse_any(actions: &[Action]) -> Result<(), SolveError> {
    let text = "a towed tether runs alone: no action happens in its run";
    actions.first().map_or(Ok(()), |action| Err(refused(action, text)))
}

impl MooredActions {
    /// Those of a run, on a structure with these connectors.
    ///
    /// # Errors
    /// An action that a run of tethers cannot do: of a tether or of what is not on the structure, of another environment, a winch, an end
    /// of the run.
    pub fn new(model: &Model, body: &Body, list: &[Action], links: &[MooredLink]) -> Result<Self, SolveError> {
        let mut points = Vec::new();
        let known = |name: &String| links.iter().any(|moored| moored.link.name.eq_ignore_ascii_case(name));
        for action in list {
            match &action.what {
                ActionKind::Release(_) | ActionKind::Activate(_) => {}
                ActionKind::Winch(..) => return Err(refused(action, "a winch does not run beside tethers")),
                ActionKind::Environment(_) => return Err(refused(action, "the environment stays in a run of tethers")),
                ActionKind::Stop => return Err(refused(action, "a run of tethers ends with -TIME of &ENV")),
            }
            if let Some(name) = action.connectors().iter().chain(action.when.connector()).find(|name| !known(name)) {
                let text = format!("{name} is no connector that acts on {} beside its tethers", body.name);
                return Err(refused(action, &text));
            }
            match action.when.observable() {
                Some(Observable::Dof(other, _)) if Model::key(other) != Model::key(&body.name) => {
                    return Err(refused(
                        action,
                        &format!("{other} makes no part of the run: tethers hold {}", body.name),
                    ));
                }
                Some(Observable::Height(name)) => {
                    let (index, at) = point_in_body(model, name).map_err(SolveError::new)?;
                    if model.bodies.get_index_of(&Model::key(&body.name)) != Some(index) {
                        return Err(refused(action, &format!("{name} is no point of {}", body.name)));
                    }
                    points.push((name.clone(), Vector3::from(at)));
                }
                _ => {}
            }
        }
        Ok(MooredActions {
            list: list.to_vec(),
            fired: vec![None; list.len()],
            points,
            level: model.surroundings().tide,
            near: body.position,
        })
    }

    /// Does what is due in a state: `pose` is that of the body, `tensions` are those of the connectors (N). Whether a connector was released, or acts
    /// now.
    pub fn process(&mut self, (time, dt): (f64, f64), pose: &Pose, tensions: &[f64], links: &mut [MooredLink]) -> bool {
        self.near = pose.position(&self.near);
        let mut changed = false;
        for index in 0..self.list.len() {
            let waits = self.fired.get(index).is_some_and(Option::is_none);
            let Some(action) = self.list.get(index).filter(|_| waits) else { continue };
            if !self.is_due(&action.when, (time, dt), pose, tensions, links) {
                continue;
            }
            let acts = matches!(action.what, ActionKind::Activate(_));
            for moored in links.iter_mut() {
                if action.connectors().iter().any(|name| name.eq_ignore_ascii_case(&moored.link.name)) {
                    changed |= moored.acts != acts;
                    moored.acts = acts;
                }
            }
            if let Some(fired) = self.fired.get_mut(index) {
                *fired = Some(time);
            }
        }
        changed
    }

    fn is_due(
        &self,
        when: &Trigger,
        (time, dt): (f64, f64),
        pose: &Pose,
        tensions: &[f64],
        links: &[MooredLink],
    ) -> bool {
        let value = |watched: &Observable| match watched {
            Observable::Tension(name) => {
                let index = links.iter().position(|moored| moored.link.name.eq_ignore_ascii_case(name))?;
                links.get(index).filter(|moored| moored.acts)?;
                tensions.get(index).copied()
            }
            Observable::Dof(_, dof) => self.near.shift.iter().chain(&self.near.turn).nth(*dof).copied(),
            Observable::Height(name) => {
                let (_, at) = self.points.iter().find(|(known, _)| known.eq_ignore_ascii_case(name))?;
                Some(pose.point(*at).z - self.level)
            }
        };
        match when {
            Trigger::At(at) => time >= at - TIME_ROUNDING_SHARE * dt,
            Trigger::Above(watched, limit) => value(watched).is_some_and(|value| value > *limit),
            Trigger::Below(watched, limit) => value(watched).is_some_and(|value| value < *limit),
            Trigger::After(at, condition) => {
                time >= at - TIME_ROUNDING_SHARE * dt && self.is_due(condition, (time, dt), pose, tensions, links)
            }
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Names and times (s) of the actions; no time of one that has not happened.
    pub fn times(&self) -> Vec<(String, Option<f64>)> {
        self.list.iter().map(|action| action.name.clone()).zip(self.fired.iter().copied()).collect()
    }

    /// The numbers of a checkpoint.
    pub fn memory(&self) -> Vec<f64> {
        if self.list.is_empty() {
            return Vec::new();
        }
        self.fired.iter().map(|fired| fired.unwrap_or(NOT_YET)).chain(self.near.values()).collect()
    }

    /// Takes back as many of these numbers as there are; gives the others.
    pub fn remember<'a>(&mut self, numbers: &'a [f64]) -> Option<&'a [f64]> {
        if self.list.is_empty() {
            return Some(numbers);
        }
        let (fired, rest) = numbers.split_at_checked(self.fired.len())?;
        let (position, rest) = rest.split_at_checked(PLACE_NUMBERS)?;
        self.fired = fired.iter().map(|time| (*time >= 0.0).then_some(*time)).collect();
        let [x, y, z, roll, pitch, yaw] = *position else { return None };
        self.near = Place { shift: [x, y, z], turn: [roll, pitch, yaw] };
        Some(rest)
    }
}
