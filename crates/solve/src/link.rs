//! Connectors of a system: their elements, and what their ends are fixed to.

use super::system::SolveError;
use super::time::RunRequirements;
use nalgebra::Vector3;
use std::sync::Arc;
use windlass_base::pose::Pose;
use windlass_model::{Ambient, Assembly, Connector, ConnectorElement, LaidPipe, Model};

/// What an end of a connector is fixed to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum EndAttachment {
    Ground(Pose),
    /// A body by its number, and the point in its system (m).
    Body(usize, Vector3<f64>),
}

/// A connector of the system.
#[derive(Debug)]
pub(super) struct Link {
    pub name: String,
    pub element: Box<dyn ConnectorElement>,
    pub ends: Vec<EndAttachment>,
    /// Where its values stand in the vector of states.
    pub states: std::ops::Range<usize>,
    /// The assembly whose line it is a span of, where it is one over pulleys or off a drum.
    pub reeving: Option<String>,
}

/// A connector of a model; its states go behind the others.
pub(super) fn link(
    (model, ambient, duties): (&Model, &Arc<dyn Ambient>, &RunRequirements),
    connector: &Connector,
    states: &mut Vec<f64>,
) -> Result<Link, SolveError> {
    let made = model.element_of_run(connector, Some(ambient), duties.requirement(&connector.name));
    let element = made.map_err(SolveError::error_about(&connector.name))?;
    let mut made = Link::new(&connector.name, element, element_attachments(model, connector), states);
    made.reeving = model.reeving(&connector.name).map(|assembly| assembly.name.clone());
    Ok(made)
}

/// What a pipe is, and what its ends are fixed to.
pub(super) type PipeLink = (Box<dyn ConnectorElement>, Vec<EndAttachment>);

/// The pipe of an assembly of a model, where it has one that acts.
pub(super) fn build_pipe_link(
    model: &Model,
    ambient: &Arc<dyn Ambient>,
    duties: &RunRequirements,
    assembly: &Assembly,
) -> Result<Option<PipeLink>, SolveError> {
    let made = model.pipe(assembly, Some(ambient), duties.requirement(&assembly.name));
    let of = |LaidPipe { supports, element }: LaidPipe| {
        (element, supports.iter().map(|c| end_attachments(model, c)[0]).collect())
    };
    Ok(made.map_err(SolveError::error_about(&assembly.name))?.map(of))
}

impl Link {
    /// Of an element; its states go behind the others.
    pub(super) fn new(
        name: &str,
        element: Box<dyn ConnectorElement>,
        ends: Vec<EndAttachment>,
        states: &mut Vec<f64>,
    ) -> Link {
        let from = states.len();
        states.resize(from + element.states(), 0.0);
        if let Some(own) = states.get_mut(from..) {
            element.start(own);
        }
        Link { name: name.to_string(), element, ends, states: from..states.len(), reeving: None }
    }

    /// What those of its ends are fixed to on which it exerts forces.
    pub(super) fn acting_ends(&self) -> &[EndAttachment] {
        self.ends.get(..self.element.acting_ends()).unwrap_or(&self.ends)
    }

    /// Whether it is a dynamic line.
    pub(super) fn is_dynamic(&self) -> bool {
        self.element.as_dynamic().is_some()
    }
}

/// What the ends of a connector are fixed to.
pub(super) fn end_attachments(model: &Model, connector: &Connector) -> [EndAttachment; 2] {
    let poses = model.end_poses(connector);
    let on_body = |i: usize| {
        let point = connector.points.get(i).and_then(|name| model.points.get(&Model::key(name)))?;
        let body = model.body_of(point)?;
        let index = model.bodies.get_index_of(&Model::key(&body.name))?;
        let at = poses.get(i)?.origin;
        Some(EndAttachment::Body(index, Pose::from_place(&body.position).local(at)))
    };
    let [first, second] = poses;
    [on_body(0).unwrap_or(EndAttachment::Ground(first)), on_body(1).unwrap_or(EndAttachment::Ground(second))]
}

/// What the ends of a connector's element are fixed to: its own, then those of the other spans of its line.
pub(super) fn element_attachments(model: &Model, connector: &Connector) -> Vec<EndAttachment> {
    let others = model.other_spans(&connector.name);
    std::iter::once(connector).chain(others).flat_map(|span| end_attachments(model, span)).collect()
}

pub(super) fn pose_of(end: &EndAttachment, poses: &[Pose]) -> Pose {
    match end {
        EndAttachment::Ground(pose) => *pose,
        EndAttachment::Body(index, at) => {
            let body = poses[*index];
            Pose { origin: body.point(*at), axes: body.axes }
        }
    }
}

/// From the body's origin to the end (m, global).
pub(super) fn arm(end: &EndAttachment, poses: &[Pose]) -> Vector3<f64> {
    match end {
        EndAttachment::Ground(_) => Vector3::zeros(),
        EndAttachment::Body(index, at) => poses[*index].axes * at,
    }
}
