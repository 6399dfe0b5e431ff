//! The system of bodies and connectors: who hangs on whom, what acts on each body, how that changes with their places.

use super::link::{EndAttachment, Link, arm, build_pipe_link, link, pose_of};
use super::modes::solve_least_motion;
use super::parts::BodySubset;
use super::ties::Ties;
use super::time::{Prescribed, RunRequirements, build_prescribed};
use nalgebra::{DMatrix, DVector, Matrix3, Matrix6};
use std::sync::Arc;
use windlass_base::choice::Dof;
use windlass_base::dense::DenseError;
use windlass_base::geometry::Place;
use windlass_base::pose::{Pose, Six};
use windlass_hydro::database::interaction::{GatheredInteraction, InteractionLoad, gather_interactions};
use windlass_hydro::sea::Sea;
use windlass_hydro::{Category, Floating, Load, ambient, heading_axes, move_stiffness, move_wrench, turning};
use windlass_model::{
    Ambient, Body, ClassError, ConnectorResponse, End, Mass, Model, Situation, SolveKind, SolverCache, Surroundings,
};

/// Degrees of freedom of a body, in order.
pub const DOFS: [&str; 6] = ["X", "Y", "Z", "RX", "RY", "RZ"];

/// Why a system could not be made or solved.
#[derive(Clone, Debug, PartialEq)]
pub struct SolveError {
    /// The connector or body it is about, as written.
    pub who: Option<String>,
    /// What is wrong.
    pub error: ClassError,
}

impl SolveError {
    /// An error of the whole system.
    pub fn new(error: ClassError) -> Self {
        SolveError { who: None, error }
    }

    pub(super) fn error_about(who: &str) -> impl Fn(ClassError) -> SolveError + '_ {
        move |error| SolveError { who: Some(who.to_string()), error }
    }
}

/// A body of the system.
#[derive(Debug)]
pub struct SystemBody {
    /// Its name as written.
    pub name: String,
    /// Its key in the model.
    pub key: String,
    /// What acts on it besides connectors.
    pub floating: Floating,
    /// Whether it is a point where connectors meet, which may be without weight.
    pub junction: bool,
    /// Which of its degrees of freedom move.
    pub free: [bool; 6],
    /// Whether it has linear damping.
    pub damped: bool,
    /// Whether it has added mass.
    pub added: bool,
    /// Its motion in time, where that is given.
    pub prescribed: Option<Box<dyn Prescribed>>,
}

impl SystemBody {
    fn new(model: &Model, key: &str, body: &Body, floating: Floating) -> Self {
        // what moves as it is given stands still for forces
        let idle = model.idle_hook(body) || body.prescribed.is_some();
        let free = Dof::SIX.map(|dof| !idle && !body.ignored.contains(&dof));
        let (damped, added) = (floating.damping != Matrix6::zeros(), floating.added_mass != Matrix6::zeros());
        let (name, key, junction) = (body.name.clone(), key.to_string(), body.junction.is_some());
        SystemBody { name, key, floating, junction, free, damped, added, prescribed: None }
    }

    /// Whether a degree of freedom moves as forces make it.
    pub fn moves(&self, dof: usize) -> bool {
        self.prescribed.is_none() && self.free[dof]
    }
}

/// A force on a body that is listed by itself.
#[derive(Clone, Debug, PartialEq)]
pub struct Contribution {
    /// The body's number.
    pub body: usize,
    /// The connector, or none for a load of the body itself.
    pub connector: Option<String>,
    /// Its category.
    pub category: Category,
    /// Force and moment about the body's origin, global axes.
    pub load: Load,
}

/// Where everything is, and what is left unbalanced there.
#[derive(Debug, Default)]
pub struct SystemState {
    /// Poses of the bodies.
    pub poses: Vec<Pose>,
    /// Sum of forces and moments about the origins of the bodies, six a body, global axes.
    pub residual: DVector<f64>,
    /// -d(residual)/d(motion of the bodies), six a body.
    pub stiffness: DMatrix<f64>,
    /// Largest force of a connector on each body (N): the measure of a body without weight.
    pub pull: Vec<f64>,
    /// Stiff ties, whose forces a search holds.
    pub(super) ties: Ties,
    caches: Vec<SolverCache>,
    response: ConnectorResponse,
    trial: Vec<f64>,
}

impl SystemState {
    /// Bodies in these poses, with nothing evaluated yet.
    pub fn from_poses(poses: Vec<Pose>) -> Self {
        SystemState { poses, ..SystemState::default() }
    }
}

/// Bodies and connectors as engines see them.
#[derive(Debug)]
pub struct System {
    /// Its bodies, in the order of the model.
    pub nodes: Vec<SystemBody>,
    pub(super) links: Vec<Link>,
    /// States of all connectors, committed.
    pub states: Vec<f64>,
    pub(super) surroundings: Surroundings,
    /// What surrounds connectors that feel it all along themselves.
    pub(super) ambient: Arc<dyn Ambient>,
    /// What a run asks of dynamic lines.
    pub(super) duties: RunRequirements,
    /// Acceleration of gravity (m/s2).
    pub gravity: f64,
    /// Forces and moments that act on bodies besides all others, about their origins, global axes; they keep their
    /// directions.
    pub applied: Vec<(usize, Six)>,
    /// Radiated waves of bodies as they act on others.
    pub(super) interactions: Vec<BodyInteraction>,
}

/// Radiated waves of a body as they act on another, by their numbers.
#[derive(Debug)]
pub(super) struct BodyInteraction {
    pub on: usize,
    pub by: usize,
    /// Added mass at infinite frequency, rows in the axes of the first body, columns in those of the second.
    infinite: Matrix6<f64>,
    /// In time; none at rest.
    pub load: Option<InteractionLoad>,
}

impl BodyInteraction {
    /// Those of a model among bodies with these keys.
    pub(super) fn gather(
        model: &Model,
        nodes: &[SystemBody],
        under_way: Option<Option<&Sea>>,
    ) -> Result<Vec<Self>, SolveError> {
        let number = |key: &String| nodes.iter().position(|node| node.key == *key);
        let all = gather_interactions(model, under_way).map_err(SolveError::new)?;
        let made = all.into_iter().filter_map(|GatheredInteraction { bodies: [on, by], infinite, load }| {
            Some(BodyInteraction { on: number(&on)?, by: number(&by)?, infinite, load })
        });
        Ok(made.collect())
    }
}

/// A matrix of a database between two bodies, rows in the axes of the heading of one and columns in those of the other, in global axes.
pub(super) fn between_headings(matrix: &Matrix6<f64>, on: &Pose, by: &Pose) -> Matrix6<f64> {
    let (on, by) = (heading_axes(on), heading_axes(by));
    let mut turned = Matrix6::zeros();
    for (row, column) in [(0, 0), (0, 3), (3, 0), (3, 3)] {
        let block = on * matrix.fixed_view::<3, 3>(row, column) * by.transpose();
        turned.fixed_view_mut::<3, 3>(row, column).copy_from(&block);
    }
    turned
}

impl System {
    /// The system of a model in its present configuration and environment; `left_out` names connectors that do not act
    /// beside those that are inactive.
    ///
    /// # Errors
    /// The connector or body that makes no part of it, and why.
    pub fn new(model: &Model, left_out: &[String]) -> Result<Self, SolveError> {
        model.check_effects(SolveKind::Statics).map_err(SolveError::new)?;
        let node = |(key, body): (&String, &Body)| {
            let floating = Floating::at_rest(model, body).map_err(SolveError::error_about(&body.name))?;
            Ok(SystemBody::new(model, key, body, floating))
        };
        let nodes = model.bodies.iter().map(node).collect::<Result<Vec<_>, SolveError>>()?;
        let interactions = BodyInteraction::gather(model, &nodes, None)?;
        System::build(model, (nodes, None), left_out, RunRequirements::default(), interactions)
    }

    /// The system of a model under way: bodies with what a sea does to them, lines as a run asks for them.
    ///
    /// # Errors
    /// As [`System::new`].
    pub fn under_way(model: &Model, sea: Option<&Arc<Sea>>, duties: RunRequirements) -> Result<Self, SolveError> {
        model.check_effects(SolveKind::Statics).map_err(SolveError::new)?;
        let nodes = moving_nodes(model, sea)?;
        let interactions = BodyInteraction::gather(model, &nodes, Some(sea.map(Arc::as_ref)))?;
        System::build(model, (nodes, sea), &[], duties, interactions)
    }

    fn build(
        model: &Model,
        (nodes, sea): (Vec<SystemBody>, Option<&Arc<Sea>>),
        left_out: &[String],
        duties: RunRequirements,
        interactions: Vec<BodyInteraction>,
    ) -> Result<Self, SolveError> {
        let ambient = ambient(model, sea).map_err(SolveError::new)?;
        let mut states = Vec::new();
        let mut links: Vec<Link> = Vec::new();
        for connector in model.connectors.values() {
            if !connector.active
                || model.holds_pipe(&connector.name)
                || model.is_unreeved(&connector.name)
                || left_out.iter().any(|name| name.eq_ignore_ascii_case(&connector.name))
            {
                continue;
            }
            links.push(link((model, &ambient, &duties), connector, &mut states)?);
        }
        for assembly in model.assemblies.values() {
            if let Some((element, ends)) = build_pipe_link(model, &ambient, &duties, assembly)? {
                links.push(Link::new(&assembly.name, element, ends, &mut states));
            }
        }
        let (surroundings, gravity) = (model.surroundings(), model.defaults.gravity);
        Ok(System { nodes, links, states, surroundings, ambient, duties, gravity, applied: Vec::new(), interactions })
    }

    /// Dynamic lines begin a run in these states, given for all connectors.
    pub(super) fn begin_dynamic_lines(&mut self, states: &[f64]) {
        for link in self.links.iter().filter(|l| l.is_dynamic()) {
            self.states[link.states.clone()].copy_from_slice(&states[link.states.clone()]);
        }
    }

    /// A state with the bodies where they stand in the model.
    pub fn state(&self, model: &Model) -> SystemState {
        let poses = self
            .nodes
            .iter()
            .map(|n| model.bodies.get(&n.key).map(|b| Pose::from_place(&b.position)).unwrap_or_default());
        SystemState::from_poses(poses.collect())
    }

    /// Evaluates everything at the poses of a state.
    ///
    /// # Errors
    /// The connector or body that has no answer there.
    pub fn evaluate(&self, state: &mut SystemState) -> Result<(), SolveError> {
        self.evaluate_part(state, None)
    }

    /// Evaluates a part at the poses of a state, `None` for everything; what belongs to other bodies stays as it is.
    ///
    /// # Errors
    /// As [`System::evaluate`].
    pub(super) fn evaluate_part(&self, state: &mut SystemState, part: Option<&BodySubset>) -> Result<(), SolveError> {
        let size = 6 * self.nodes.len();
        state.residual.resize_vertically_mut(size, 0.0);
        if state.stiffness.nrows() != size {
            state.stiffness = DMatrix::zeros(size, size);
        }
        state.pull.resize(self.nodes.len(), 0.0);
        state.ties.begin(self.links.len(), self.nodes.len());
        state.caches.resize_with(self.links.len(), SolverCache::new);
        state.trial.resize(self.states.len(), 0.0);
        let belongs = |body: usize| part.is_none_or(|p| p[body]);
        let bodies: Vec<usize> = (0..self.nodes.len()).filter(|body| belongs(*body)).collect();
        for body in &bodies {
            state.residual.fixed_rows_mut::<6>(6 * body).fill(0.0);
            for column in &bodies {
                state.stiffness.fixed_view_mut::<6, 6>(6 * body, 6 * column).fill(0.0);
            }
            state.pull[*body] = 0.0;
        }
        for (index, (node, pose)) in self.nodes.iter().zip(&state.poses).enumerate().filter(|(i, _)| belongs(*i)) {
            for load in &node.floating.loads {
                let load = load.mean_load(pose).map_err(SolveError::error_about(&node.name))?;
                let mut at = state.residual.fixed_rows_mut::<6>(6 * index);
                at += load.wrench;
                let mut block = state.stiffness.fixed_view_mut::<6, 6>(6 * index, 6 * index);
                block += load.stiffness;
            }
        }
        for (body, wrench) in self.applied.iter().filter(|(body, _)| *body < self.nodes.len() && belongs(*body)) {
            let mut at = state.residual.fixed_rows_mut::<6>(6 * body);
            at += wrench;
        }
        let (mut ends, mut arms) = (Vec::new(), Vec::new());
        for (index, (link, cache)) in self.links.iter().zip(&mut state.caches).enumerate() {
            let joined = |end: &EndAttachment| matches!(end, EndAttachment::Body(body, _) if belongs(*body));
            if part.is_some() && !link.ends.iter().any(joined) {
                continue;
            }
            ends.clear();
            ends.extend(link.ends.iter().map(|end| End::at_rest(pose_of(end, &state.poses))));
            let committed = &self.states[link.states.clone()];
            let trial = &mut state.trial[link.states.clone()];
            let at = Situation { ends: &ends, step: None, surroundings: &self.surroundings };
            arms.clear();
            arms.extend(link.ends.iter().map(|end| arm(end, &state.poses)));
            let held = state.ties.forces.get(index).and_then(Option::as_ref);
            match state.ties.holds.then(|| link.element.as_stiff_tie()).flatten() {
                Some(tie) => {
                    let tie = tie.evaluate_tie(&at, held, &mut state.response);
                    let tie = tie.map_err(SolveError::error_about(&link.name))?;
                    state.ties.take(index, tie, &state.response.stiffness, (&link.ends, &arms));
                }
                None => link
                    .element
                    .evaluate(&at, committed, trial, cache, &mut state.response)
                    .map_err(SolveError::error_about(&link.name))?,
            }
            let count = link.ends.len();
            for (i, ((end, wrench), own)) in link.ends.iter().zip(&state.response.wrench).zip(&arms).enumerate() {
                let EndAttachment::Body(body, _) = end else { continue };
                let mut at = state.residual.fixed_rows_mut::<6>(6 * body);
                at += move_wrench(wrench, *own);
                let force = wrench.fixed_rows::<3>(0).norm();
                state.pull[*body] = state.pull[*body].max(force);
                for (j, (other, far)) in link.ends.iter().zip(&arms).enumerate() {
                    let EndAttachment::Body(column, _) = other else { continue };
                    let Some(block) = state.response.stiffness.get(count * i + j) else { continue };
                    let mut moved = move_stiffness(block, *own, *far);
                    if i == j {
                        moved += turning(wrench, *own);
                    }
                    let mut at = state.stiffness.fixed_view_mut::<6, 6>(6 * body, 6 * column);
                    at += moved;
                }
            }
        }
        Ok(())
    }

    /// Every force on every body, listed one by one: loads of the body by category, and each connector.
    ///
    /// # Errors
    /// As [`System::evaluate`].
    pub fn contributions(&self, poses: &[Pose]) -> Result<Vec<Contribution>, SolveError> {
        let mut list = Vec::new();
        for (body, (node, pose)) in self.nodes.iter().zip(poses).enumerate() {
            for load in &node.floating.loads {
                let (category, load) =
                    (load.category(), load.mean_load(pose).map_err(SolveError::error_about(&node.name))?);
                list.push(Contribution { body, connector: None, category, load });
            }
        }
        let (mut response, mut trial) = (ConnectorResponse::default(), vec![0.0; self.states.len()]);
        for link in &self.links {
            let ends: Vec<End> = link.ends.iter().map(|end| End::at_rest(pose_of(end, poses))).collect();
            let committed = &self.states[link.states.clone()];
            let own = &mut trial[link.states.clone()];
            let at = Situation { ends: &ends, step: None, surroundings: &self.surroundings };
            let evaluated = link.element.evaluate(&at, committed, own, &mut SolverCache::new(), &mut response);
            evaluated.map_err(SolveError::error_about(&link.name))?;
            let category = Category::from(link.element.category());
            for (i, end) in link.acting_ends().iter().enumerate() {
                let EndAttachment::Body(body, _) = end else { continue };
                let (own, count) = (arm(end, poses), link.ends.len());
                let wrench = &response.wrench[i];
                let mut stiffness = turning(wrench, own);
                // all ends on the body move with it
                for (j, far) in link.ends.iter().enumerate() {
                    if let (EndAttachment::Body(other, _), Some(block)) = (far, response.stiffness.get(count * i + j))
                        && other == body
                    {
                        stiffness += move_stiffness(block, own, arm(far, poses));
                    }
                }
                let load = Load { wrench: move_wrench(wrench, own), stiffness };
                list.push(Contribution { body: *body, connector: Some(link.name.clone()), category, load });
            }
        }
        Ok(list)
    }

    /// The stiffness of one body in an evaluated state: other bodies held, junctions following to where nothing is left on
    /// them (N/m, N, N m/rad; about its origin, global axes).
    ///
    /// # Errors
    /// A stiffness that is not finite; an interrupt.
    pub fn followed_stiffness(&self, state: &SystemState, body: usize) -> Result<Matrix6<f64>, SolveError> {
        let own: Vec<usize> = (6 * body..6 * body + 6).collect();
        let junctions = self.nodes.iter().enumerate().filter(|(index, n)| n.junction && *index != body);
        let follow: Vec<usize> = junctions
            .flat_map(|(index, n)| n.free.iter().enumerate().filter(|(_, f)| **f).map(move |(i, _)| 6 * index + i))
            .collect();
        let part = |r: &[usize], c: &[usize]| state.stiffness.select_rows(r).select_columns(c);
        let mut made = part(&own, &own);
        let moved = solve_least_motion(part(&follow, &follow), &part(&follow, &own), &|| self.is_interrupted());
        made -= part(&own, &follow) * moved.map_err(|e| self.singular_matrix_error("stiffness", &follow, e))?;
        Ok(made.fixed_view::<6, 6>(0, 0).into_owned())
    }

    /// Whether whoever waits for a solution wants none any more.
    pub(super) fn is_interrupted(&self) -> bool {
        self.ambient.is_interrupted()
    }

    /// The error of a matrix that has no factors, each of whose rows belongs to a degree of freedom, six a body.
    pub(super) fn singular_matrix_error(&self, what: &str, rows: &[usize], error: DenseError) -> SolveError {
        match error {
            DenseError::NotFinite { row, .. } => {
                let at = rows[row];
                let name = self.nodes.get(at / 6).map(|n| n.name.clone());
                let dof = DOFS.get(at % 6).copied().unwrap_or_default();
                SolveError { who: name, error: ClassError::new(format!("the {what} in {dof} is not finite")) }
            }
            DenseError::Interrupted => SolveError::new(ClassError::new("interrupted").lasting()),
            other => SolveError::new(ClassError::new(format!("the {what} has no factors: {other}"))),
        }
    }

    /// Whether a connector was made for the place of its ends, so that the system is to be made anew where it comes to rest.
    pub fn has_placed_elements(&self) -> bool {
        self.links.iter().any(|l| l.element.as_placed().is_some())
    }

    /// The mass matrix of all bodies about their origins in these poses, global axes, six a body (kg, kg m, kg m2), with
    /// added mass.
    pub fn mass_matrix(&self, poses: &[Pose]) -> DMatrix<f64> {
        let size = 6 * self.nodes.len();
        let mut matrix = DMatrix::zeros(size, size);
        for (index, (node, pose)) in self.nodes.iter().zip(poses).enumerate() {
            let block = mass_block(&node.floating.mass, pose) + node.floating.added_mass(pose);
            matrix.fixed_view_mut::<6, 6>(6 * index, 6 * index).copy_from(&block);
        }
        // under way they are loads
        for between in self.interactions.iter().filter(|between| between.load.is_none()) {
            let (Some(on), Some(by)) = (poses.get(between.on), poses.get(between.by)) else { continue };
            let mut block = matrix.fixed_view_mut::<6, 6>(6 * between.on, 6 * between.by);
            block += between_headings(&between.infinite, on, by);
        }
        matrix
    }

    /// Puts the bodies of a model where a state has them, remembering where they were.
    pub fn position(&self, state: &SystemState, model: &mut Model) {
        let before: Vec<_> = model.bodies.values().map(|b| b.position).collect();
        for (body, position) in model.bodies.values_mut().zip(before) {
            body.previous = position;
        }
        for (node, pose) in self.nodes.iter().zip(&state.poses) {
            if let Some(body) = model.bodies.get_mut(&node.key) {
                body.position = without_rounding(pose.position(&body.position));
            }
        }
    }
}

/// A place with what is less than any solution is exact to left out: a tenth of a nanometre, and that on a kilometre.
pub(super) fn without_rounding(position: Place) -> Place {
    let kept = |least: f64| move |v: f64| if v.abs() < least { 0.0 } else { v };
    Place { shift: position.shift.map(kept(1e-10)), turn: position.turn.map(kept(1e-13)) }
}

/// The bodies of a model under way.
pub(super) fn moving_nodes(model: &Model, sea: Option<&Arc<Sea>>) -> Result<Vec<SystemBody>, SolveError> {
    let node = |(key, body): (&String, &Body)| {
        let floating = Floating::under_way(model, body, sea).map_err(SolveError::error_about(&body.name))?;
        let mut made = SystemBody::new(model, key, body, floating);
        made.prescribed =
            build_prescribed(body, sea, model.environment.run_start).map_err(SolveError::error_about(&body.name))?;
        Ok(made)
    };
    model.bodies.iter().map(node).collect()
}

pub(super) fn mass_block(mass: &Mass, pose: &Pose) -> Matrix6<f64> {
    let mut block = Matrix6::zeros();
    let arm = (pose.axes * mass.centre).cross_matrix() * mass.mass;
    block.fixed_view_mut::<3, 3>(0, 0).copy_from(&(Matrix3::identity() * mass.mass));
    block.fixed_view_mut::<3, 3>(0, 3).copy_from(&-arm);
    block.fixed_view_mut::<3, 3>(3, 0).copy_from(&arm);
    block.fixed_view_mut::<3, 3>(3, 3).copy_from(&(pose.axes * mass.inertia * pose.axes.transpose()));
    block
}
