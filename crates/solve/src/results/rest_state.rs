//! A connector between its ends where a run had them: what a row does not keep follows from its element there.

use super::super::link::{EndAttachment, element_attachments, pose_of};
use super::super::system::SolveError;
use windlass_base::pose::{Pose, Six};
use windlass_model::{Connector, ConnectorElement, End, Model, Situation, SolverCache, Surroundings};

/// What a row does not keep of a connector.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SettledConnector {
    /// Largest tension over own break, or force over allowable.
    pub ratio: f64,
    /// Unstretched length on the bottom (m).
    pub grounded: f64,
    /// What the anchor bears upward (N).
    pub vertical: f64,
    /// What the anchor bears toward the first end (N).
    pub horizontal: f64,
}

impl SettledConnector {
    /// Nothing is known.
    pub const NONE: SettledConnector =
        SettledConnector { ratio: f64::NAN, grounded: f64::NAN, vertical: f64::NAN, horizontal: f64::NAN };
}

/// A connector that is settled between other ends again and again.
pub(super) struct RestSolver<'a> {
    model: &'a Model,
    connector: Connector,
    ends: Vec<EndAttachment>,
    element: Box<dyn ConnectorElement>,
    surroundings: Surroundings,
    /// Length of its first segment now (m).
    length: Option<f64>,
    cache: SolverCache,
    wrenches: Vec<Six>,
    between: Vec<End>,
}

impl<'a> RestSolver<'a> {
    /// A connector of the model of a run, whose bodies stand where the run began. None of a pipe, nor of what remembers: a piston's
    /// force does not follow from its ends alone.
    ///
    /// # Errors
    /// A connector that makes no element.
    pub fn new(model: &'a Model, name: &str) -> Result<Option<Self>, SolveError> {
        let Some(connector) = model.connectors.get(&Model::key(name)) else { return Ok(None) };
        let element = model.element(connector).map_err(SolveError::error_about(name))?;
        if element.states() > 0 {
            return Ok(None);
        }
        Ok(Some(RestSolver {
            model,
            ends: element_attachments(model, connector),
            element,
            surroundings: model.surroundings(),
            length: model.first_length(connector),
            connector: connector.clone(),
            cache: SolverCache::new(),
            wrenches: Vec::new(),
            between: Vec::new(),
        }))
    }

    /// With the bodies in these poses and a length of the first segment (m), where it has one.
    ///
    /// # Errors
    /// No answer there.
    pub fn solve_at(&mut self, poses: &[Pose], length: Option<f64>) -> Result<SettledConnector, SolveError> {
        let name = self.connector.name.as_str();
        if length.is_some() && length != self.length && self.ends.len() == 2 {
            // as the run did when a winch changed it
            let wound = Connector { first_length: length, ..self.connector.clone() };
            self.element = self.model.element(&wound).map_err(SolveError::error_about(name))?;
            self.length = length;
        }
        self.between.clear();
        self.between.extend(self.ends.iter().map(|end| End::at_rest(pose_of(end, poses))));
        let at = Situation { ends: &self.between, step: None, surroundings: &self.surroundings };
        let summary = self.element.summary(&at, &[]).map_err(SolveError::error_about(name))?;
        let far = self.ends.get(1);
        let (mut vertical, mut horizontal) = (f64::NAN, f64::NAN);
        if summary.tension.is_some() && matches!(far, Some(EndAttachment::Ground(_))) {
            self.element
                .evaluate_wrenches(&at, &[], &mut self.cache, &mut self.wrenches)
                .map_err(SolveError::error_about(name))?;
            if let Some(pull) = self.wrenches.get(1) {
                (vertical, horizontal) = (pull[2], pull[0].hypot(pull[1]));
            }
        }
        let known = |value: Option<f64>| value.unwrap_or(f64::NAN);
        Ok(SettledConnector { ratio: known(summary.ratio), grounded: known(summary.grounded), vertical, horizontal })
    }
}
