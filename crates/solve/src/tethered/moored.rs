//! The other connectors of a structure that tethers hold.

use super::actions::MooredActions;
use crate::link::{EndAttachment, Link, link, pose_of};
use crate::system::SolveError;
use crate::time::{Action, ActionKind, RunRequirements, pull};
use nalgebra::Vector3;
use windlass_base::pose::{Pose, Six};
use windlass_hydro::{BodyStep, ambient, move_wrench};
use windlass_model::{Body, ClassError, Model, SolverCache};
use windlass_model::{ConnectorResponse, End, Situation, Surroundings, TimeStep};
use windlass_tether::structure::flow::FlowAt;
use windlass_tether::structure::{Structure, StructureForces};

/// A connector of the structure.
#[derive(Debug)]
pub(super) struct MooredLink {
    pub link: Link,
    /// Whether it acts now.
    pub acts: bool,
}

/// A structure with connectors to the ground that are no tethers.
#[derive(Debug)]
pub struct Moored {
    inner: Box<dyn Structure>,
    links: Vec<MooredLink>,
    actions: MooredActions,
    states: Vec<f64>,
    trial: Vec<f64>,
    /// Index of the body in the model.
    body: usize,
    centre: Vector3<f64>,
    surroundings: Surroundings,
    response: ConnectorResponse,
}

impl Moored {
    /// A structure with the connectors of its body in the model and the actions on them; itself where there are none. `centre` is the
    /// centre of gravity in the axes of the body (m).
    ///
    /// # Errors
    /// A connector to another body, or one that makes no element; an action that a run of tethers cannot do.
    pub fn build(
        inner: Box<dyn Structure>,
        model: &Model,
        (body, centre): (&Body, Vector3<f64>),
        actions: &[Action],
    ) -> Result<Box<dyn Structure>, SolveError> {
        let (mut links, mut states) = (Vec::new(), Vec::new());
        let ambient = ambient(model, None).map_err(SolveError::new)?;
        let Some(index) = model.bodies.get_index_of(&Model::key(&body.name)) else { return Ok(inner) };
        let awaited = |name: &str| {
            let brings = |action: &Action| match &action.what {
                ActionKind::Activate(names) => names.iter().any(|other| other.eq_ignore_ascii_case(name)),
                _ => false,
            };
            actions.iter().any(brings)
        };
        for connector in model.connectors.values().filter(|c| c.active || awaited(&c.name)) {
            if !super::case::sections(model, connector).is_empty() {
                continue;
            }
            let made = link((model, &ambient, &RunRequirements::default()), connector, &mut states)?;
            if made.is_dynamic() {
                let error = ClassError::new("a dynamic line cannot run beside tethers").with_span(connector.span);
                let error = error.help("release it, or give a class without dynamics of its own");
                return Err(SolveError { who: Some(connector.name.clone()), error });
            }
            let on = |end: &EndAttachment| matches!(end, EndAttachment::Body(i, _) if *i == index);
            let elsewhere = |end: &EndAttachment| matches!(end, EndAttachment::Body(i, _) if *i != index);
            if !made.ends.iter().any(on) {
                continue;
            }
            if made.ends.iter().any(elsewhere) {
                let text = format!("it ties {} to another body, and tethers run with one body alone", body.name);
                let error = ClassError::new(text).with_span(connector.span);
                return Err(SolveError { who: Some(connector.name.clone()), error });
            }
            links.push(MooredLink { link: made, acts: connector.active });
        }
        let actions = MooredActions::new(model, body, actions, &links)?;
        if links.is_empty() {
            return Ok(inner);
        }
        let trial = states.clone();
        let surroundings = model.surroundings();
        Ok(Box::new(Moored {
            inner,
            links,
            actions,
            states,
            trial,
            body: index,
            centre,
            surroundings,
            response: ConnectorResponse::default(),
        }))
    }
}

impl Moored {
    /// The force of the connectors that act about the centre of gravity, and the tension of each (N, negative where it pushes), with the
    /// bodies of the model at `poses`.
    fn evaluate(&mut self, at: &BodyStep, poses: &[Pose]) -> Result<(Six, Vec<f64>), ClassError> {
        let step = (at.dt > 0.0).then_some(TimeStep { time: at.time, dt: at.dt });
        let spin = Vector3::new(at.velocity[3], at.velocity[4], at.velocity[5]);
        let velocity = Vector3::new(at.velocity[0], at.velocity[1], at.velocity[2]);
        let (mut mooring, mut tensions) = (Six::zeros(), Vec::with_capacity(self.links.len()));
        for moored in &self.links {
            let link = &moored.link;
            if !moored.acts {
                tensions.push(0.0);
                continue;
            }
            let ends: Vec<End> = link
                .ends
                .iter()
                .map(|end| {
                    let position = pose_of(end, poses);
                    let mut moves = Six::zeros();
                    if matches!(end, EndAttachment::Body(..)) {
                        let own = velocity + spin.cross(&(position.origin - at.pose.origin));
                        moves.fixed_rows_mut::<3>(0).copy_from(&own);
                        moves.fixed_rows_mut::<3>(3).copy_from(&spin);
                    }
                    End { velocity: moves, ..End::at_rest(position) }
                })
                .collect();
            let situation = Situation { ends: &ends, step, surroundings: &self.surroundings };
            let (Some(before), Some(after)) =
                (self.states.get(link.states.clone()), self.trial.get_mut(link.states.clone()))
            else {
                tensions.push(0.0);
                continue;
            };
            let named = |mut error: ClassError| {
                error.message = error.message.with_subject(format!("connector {}", link.name));
                error
            };
            link.element
                .evaluate(&situation, before, after, &mut SolverCache::new(), &mut self.response)
                .map_err(named)?;
            for ((end, kind), wrench) in ends.iter().zip(&link.ends).zip(&self.response.wrench) {
                if matches!(kind, EndAttachment::Body(..)) {
                    mooring += move_wrench(wrench, end.pose.origin - at.pose.origin);
                }
            }
            tensions.push(tension(link, &ends, &self.response.wrench));
        }
        Ok((mooring, tensions))
    }
}

impl Structure for Moored {
    fn forces(
        &mut self,
        at: &BodyStep,
        water: &FlowAt,
        accepted: bool,
        out: &mut StructureForces,
    ) -> Result<(), ClassError> {
        self.inner.forces(at, water, accepted, out)?;
        let arm = at.pose.axes * self.centre;
        let pose = Pose { origin: at.pose.origin - arm, axes: at.pose.axes };
        let mut poses = vec![Pose::default(); self.body + 1];
        if let Some(own) = poses.get_mut(self.body) {
            *own = pose;
        }
        let (mut mooring, tensions) = self.evaluate(at, &poses)?;
        if accepted && self.actions.process((at.time, at.dt), &pose, &tensions, &mut self.links) {
            // what begins to act may be what another action waits for: the next state shows it
            (mooring, _) = self.evaluate(at, &poses)?;
        }
        out.mooring += mooring;
        if accepted {
            self.states.copy_from_slice(&self.trial);
        }
        Ok(())
    }

    fn actions(&self) -> Vec<(String, Option<f64>)> {
        self.actions.times()
    }

    fn memory(&self) -> Vec<f64> {
        let mut numbers = self.states.clone();
        numbers.extend(self.actions.memory());
        if !self.actions.is_empty() {
            numbers.extend(self.links.iter().map(|moored| f64::from(u8::from(moored.acts))));
        }
        numbers.extend(self.inner.memory());
        numbers
    }

    fn remember(&mut self, numbers: &[f64]) -> bool {
        let Some((own, inner)) = numbers.split_at_checked(self.states.len()) else { return false };
        self.states.copy_from_slice(own);
        self.trial.copy_from_slice(own);
        let Some(mut inner) = self.actions.remember(inner) else { return false };
        if !self.actions.is_empty() {
            let Some((acts, rest)) = inner.split_at_checked(self.links.len()) else { return false };
            for (moored, acts) in self.links.iter_mut().zip(acts) {
                moored.acts = *acts != 0.0;
            }
            inner = rest;
        }
        self.inner.remember(inner)
    }
}

/// The tension of a connector by the forces on its ends (N), negative where it pushes.
fn tension(link: &Link, ends: &[End], wrenches: &[Six]) -> f64 {
    let pulling = link.element.pulling_end();
    let Some(force) = wrenches.get(pulling).map(|wrench| Vector3::new(wrench[0], wrench[1], wrench[2])) else {
        return 0.0;
    };
    let other = 1usize.checked_sub(pulling).and_then(|end| ends.get(end));
    match (link.element.compression_onset(), other, ends.get(pulling)) {
        (Some(from), Some(other), Some(own)) => pull(&force, &(other.pose.origin - own.pose.origin), from),
        _ => force.norm(),
    }
}
