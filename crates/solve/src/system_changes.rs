//! Changes of a system under way: connectors that come and go or change their length, loads of another environment.

use super::link::{EndAttachment, Link, end_attachments, link};
use super::system::{BodyInteraction, SolveError, System, moving_nodes};
use super::time::{CompressionOnset, LinkEnds, LoadMemory};
use std::sync::Arc;
use windlass_hydro::ambient;
use windlass_hydro::sea::Sea;
use windlass_model::{ClassError, Connector, ConnectorElement, GivenMotion, Model};

/// What is said of a connector that an action is about though a pipe lies on it.
const HOLDS_PIPE: &str = "a pipe lies on it, which acts in its place: actions do nothing to the supports of a pipe";

/// A connector of a model.
fn connector<'a>(model: &'a Model, name: &str) -> Result<&'a Connector, SolveError> {
    model.connectors.get(&Model::key(name)).ok_or_else(|| {
        let error = ClassError::new("there is no such connector");
        SolveError { who: Some(name.to_string()), error }
    })
}

/// The body at each end.
fn bodies(ends: &[EndAttachment]) -> Vec<Option<usize>> {
    ends.iter().map(|e| if let EndAttachment::Body(body, _) = e { Some(*body) } else { None }).collect()
}

/// How many nodes an element reports at most, and whether they have bending.
fn nodes(element: &dyn ConnectorElement) -> (usize, bool) {
    element.as_nodal().map_or((0, false), |nodal| (nodal.max_nodes(), nodal.has_bending()))
}

/// How rows report compression, of an element that takes it.
fn pushing(element: &dyn ConnectorElement, ends: &[EndAttachment]) -> Option<CompressionOnset> {
    CompressionOnset::new(element.compression_onset()?, ends, element.pulling_end())
}

impl System {
    /// Its connectors, as a layout is made of them.
    pub fn link_ends(&self) -> Vec<LinkEnds> {
        let of = |l: &Link| LinkEnds {
            name: l.name.clone(),
            ends: bodies(l.acting_ends()),
            pulling: l.element.pulling_end(),
            nodes: nodes(l.element.as_ref()),
            pushing: pushing(l.element.as_ref(), &l.ends),
        };
        self.links.iter().map(of).collect()
    }

    /// A connector of a model, which need not act, as a layout is made of it.
    ///
    /// # Errors
    /// There is no such connector, or a pipe lies on it.
    pub fn ends_of(&self, model: &Model, name: &str) -> Result<LinkEnds, SolveError> {
        let found = connector(model, name)?;
        if model.holds_pipe(name) {
            return Err(SolveError::error_about(name)(ClassError::new(HOLDS_PIPE)));
        }
        // one that cannot be made says so when it is to act
        let element = self.element(model, found).ok();
        let ends = end_attachments(model, found);
        Ok(LinkEnds {
            name: found.name.clone(),
            ends: bodies(&ends),
            pulling: 0,
            nodes: element.as_ref().map_or((0, false), |e| nodes(e.as_ref())),
            pushing: element.and_then(|e| pushing(e.as_ref(), &ends)),
        })
    }

    /// Whether a connector of this name is a dynamic line.
    pub(super) fn is_dynamic_line(&self, name: &str) -> bool {
        self.links.iter().any(|l| l.is_dynamic() && l.name.eq_ignore_ascii_case(name))
    }

    /// A connector acts no more, and with a span of a line over pulleys the other spans.
    pub fn leave_out(&mut self, name: &str) {
        let reeving = self.links.iter().find(|l| l.name.eq_ignore_ascii_case(name)).and_then(|l| l.reeving.clone());
        let spans = self.links.iter().filter(|l| reeving.is_some() && l.reeving == reeving);
        let spans: Vec<String> = spans.map(|l| l.name.clone()).filter(|l| !l.eq_ignore_ascii_case(name)).collect();
        spans.iter().for_each(|span| self.remove_link(span));
        self.remove_link(name);
    }

    fn remove_link(&mut self, name: &str) {
        let Some(at) = self.links.iter().position(|l| l.name.eq_ignore_ascii_case(name)) else { return };
        let gone = self.links.remove(at).states;
        self.states.drain(gone.clone());
        for link in self.links.iter_mut().filter(|l| l.states.start >= gone.end) {
            link.states = link.states.start - gone.len()..link.states.end - gone.len();
        }
    }

    /// A connector of the model acts from now on, made between its ends where they stand in the model.
    ///
    /// # Errors
    /// A connector that makes no element.
    pub fn activate_connector(&mut self, model: &Model, name: &str) -> Result<(), SolveError> {
        if self.links.iter().any(|l| l.name.eq_ignore_ascii_case(name)) {
            return Ok(());
        }
        if let Some(assembly) = model.reeving(name) {
            let text = format!("it is a span of the line of {}, which cannot be activated in a run", assembly.name);
            return Err(SolveError::error_about(name)(ClassError::new(text)));
        }
        let made = link((model, &self.ambient, &self.duties), connector(model, name)?, &mut self.states)?;
        self.links.push(made);
        Ok(())
    }

    /// A connector of which the model has another length now. What it remembers stays.
    ///
    /// # Errors
    /// A connector that makes no element.
    pub fn rebuild_connector(&mut self, model: &Model, name: &str) -> Result<(), SolveError> {
        let Some(at) = self.links.iter().position(|l| l.name.eq_ignore_ascii_case(name)) else { return Ok(()) };
        let made = self.element(model, connector(model, name)?).map_err(SolveError::error_about(name))?;
        if let Some(link) = self.links.get_mut(at) {
            link.element = made;
        }
        Ok(())
    }

    /// A connector of a model as its run asks for it.
    fn element(&self, model: &Model, connector: &Connector) -> Result<Box<dyn ConnectorElement>, ClassError> {
        model.element_of_run(connector, Some(&self.ambient), self.duties.requirement(&connector.name))
    }

    /// Loads of the environment now in force in the model; a load that is of the same kind and size as the one in its place
    /// remembers what that did.
    ///
    /// # Errors
    /// An environment that cannot be computed, or one with other water.
    pub fn rebuild_loads(
        &mut self,
        model: &Model,
        sea: Option<&Arc<Sea>>,
        memory: &LoadMemory,
    ) -> Result<LoadMemory, SolveError> {
        if model.surroundings() != self.surroundings {
            let error = ClassError::new("depth, tide and density cannot change during a run")
                .help("wind, waves and current can: give both environments the same water");
            return Err(SolveError::new(error));
        }
        let mut nodes = moving_nodes(model, sea)?;
        self.ambient = ambient(model, sea).map_err(SolveError::new)?;
        // a pipe stays as it was laid, with what grows on it and is in it
        for link in &mut self.links {
            let made = link.element.as_placed().map(|placed| placed.with_ambient(&self.ambient));
            if let Some(element) = made {
                link.element = element;
            }
        }
        let again = |l: &&Link| l.is_dynamic() && l.element.as_placed().is_none();
        let moving: Vec<String> = self.links.iter().filter(again).map(|l| l.name.clone()).collect();
        for name in &moving {
            self.rebuild_connector(model, name)?;
        }
        for (new, old) in nodes.iter_mut().zip(&mut self.nodes) {
            let given = model.bodies.get(&new.key).and_then(|body| body.prescribed.as_ref());
            // what answers the waves answers those of the new sea
            if !given.is_some_and(|g| matches!(g.motion, GivenMotion::Responses(_))) {
                new.prescribed = old.prescribed.take();
            }
            new.free = old.free;
        }
        let interactions = BodyInteraction::gather(model, &nodes, Some(sea.map(Arc::as_ref)))?;
        let before = std::mem::replace(&mut self.nodes, nodes);
        let between = std::mem::replace(&mut self.interactions, interactions);
        let mut made = LoadMemory::new(self);
        for (body, old) in before.iter().enumerate() {
            made.recall(body, self, memory, old);
        }
        made.recall_interactions(self, memory, &between);
        Ok(made)
    }
}
