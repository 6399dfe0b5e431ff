//! What the connectors of one body do to it at a place: their sum and their tensions, without how they change. A solver
//! that moves a body to many places pays for no stiffness.

use super::link::{EndAttachment, Link, arm, pose_of};
use super::system::{SolveError, System, SystemState};
use windlass_base::pose::{Pose, Six};
use windlass_hydro::move_wrench;
use windlass_model::{ClassError, ConnectorSummary, End, Situation, SolverCache};

/// The connectors on one body, followed from place to place.
#[derive(Debug)]
pub struct BodyConnectors {
    body: usize,
    /// Their numbers in the system.
    links: Vec<usize>,
    caches: Vec<SolverCache>,
}

/// What the connectors of a body do to it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ConnectorPull {
    /// Sum of their forces and moments about the body's origin, global axes (N, N m).
    pub wrench: Six,
    /// Force of each on the body (N): of a line, the tension at that end.
    pub tensions: Vec<f64>,
}

impl BodyConnectors {
    /// Those on a body that act, in the order of the model.
    ///
    /// # Errors
    /// None acts on it.
    pub fn on_body(system: &System, body: usize) -> Result<Self, SolveError> {
        let holds = |link: &Link| link.ends.iter().any(|e| matches!(e, EndAttachment::Body(b, _) if *b == body));
        let links: Vec<usize> = (0..system.links.len()).filter(|i| system.links.get(*i).is_some_and(holds)).collect();
        if links.is_empty() {
            let who = system.nodes.get(body).map(|n| n.name.clone());
            let error =
                ClassError::new("no connector acts on it").help("CONNECTOR makes one; &STATUS G_CONNECTOR lists them");
            return Err(SolveError { who, error });
        }
        let caches = links.iter().map(|_| SolverCache::new()).collect();
        Ok(BodyConnectors { body, links, caches })
    }

    fn links<'a>(&'a self, system: &'a System) -> impl Iterator<Item = &'a Link> {
        self.links.iter().filter_map(|i| system.links.get(*i))
    }

    /// Their names, as written.
    pub fn names<'a>(&'a self, system: &'a System) -> impl Iterator<Item = &'a str> {
        self.links(system).map(|l| l.name.as_str())
    }

    /// The largest distance between the ends of one of them (m).
    pub fn size(&self, system: &System, poses: &[Pose]) -> f64 {
        let distance = |link: &Link| {
            let positions: Vec<_> = link.ends.iter().map(|end| pose_of(end, poses).origin).collect();
            positions.iter().zip(positions.iter().skip(1)).fold(0.0, |most: f64, (a, b)| most.max((a - b).norm()))
        };
        self.links(system).map(distance).fold(0.0, f64::max)
    }

    /// Their forces with the bodies in these poses.
    ///
    /// # Errors
    /// A connector that has no answer there.
    pub fn pull(&mut self, system: &System, poses: &[Pose], out: &mut ConnectorPull) -> Result<(), SolveError> {
        out.wrench = Six::zeros();
        out.tensions.clear();
        let (mut ends, mut wrenches) = (Vec::new(), Vec::new());
        for (index, cache) in self.links.iter().zip(&mut self.caches) {
            let Some(link) = system.links.get(*index) else { continue };
            ends.clear();
            ends.extend(link.ends.iter().map(|end| End::at_rest(pose_of(end, poses))));
            let committed = &system.states[link.states.clone()];
            let at = Situation { ends: &ends, step: None, surroundings: &system.surroundings };
            link.element
                .evaluate_wrenches(&at, committed, cache, &mut wrenches)
                .map_err(SolveError::error_about(&link.name))?;
            let mut tension = 0.0;
            for (end, wrench) in link.ends.iter().zip(&wrenches) {
                if matches!(end, EndAttachment::Body(body, _) if *body == self.body) {
                    out.wrench += move_wrench(wrench, arm(end, poses));
                    tension = wrench.fixed_rows::<3>(0).norm();
                }
            }
            out.tensions.push(tension);
        }
        Ok(())
    }

    /// What is reported of each with the bodies in these poses.
    ///
    /// # Errors
    /// A connector that has no answer there.
    pub fn summaries(&self, system: &System, poses: &[Pose]) -> Result<Vec<ConnectorSummary>, SolveError> {
        self.links(system).map(|link| summary(system, link, poses)).collect()
    }
}

impl System {
    /// What is reported of each connector with the bodies in the poses of a state: its name first.
    ///
    /// # Errors
    /// Of each connector that has no answer there, why.
    pub fn summaries<'a>(
        &'a self,
        state: &'a SystemState,
    ) -> impl Iterator<Item = (&'a str, Result<ConnectorSummary, SolveError>)> + use<'a> {
        self.links.iter().map(|link| (link.name.as_str(), summary(self, link, &state.poses)))
    }
}

fn summary(system: &System, link: &Link, poses: &[Pose]) -> Result<ConnectorSummary, SolveError> {
    let ends: Vec<End> = link.ends.iter().map(|end| End::at_rest(pose_of(end, poses))).collect();
    let committed = &system.states[link.states.clone()];
    let at = Situation { ends: &ends, step: None, surroundings: &system.surroundings };
    link.element.summary(&at, committed).map_err(SolveError::error_about(&link.name))
}
