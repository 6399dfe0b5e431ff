//! What acts on bodies under way, and how it changes with their places and velocities.

use super::ends::end_of;
use super::force_predictor::ForcePredictor;
use super::inertia::rotated_added_inertia;
use super::parallel::LineTask;
use crate::link::{EndAttachment, Link};
use crate::system::{BodyInteraction, SolveError, System, SystemBody};
use crate::ties::Ties;
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use std::ops::Range;
use windlass_base::pose::{Pose, Six};
use windlass_hydro::database::interaction::{InteractionLoad, InteractionStep};
use windlass_hydro::{BodyLoad, BodyStep, Category, DynamicLoad, move_stiffness, move_wrench, turning};
use windlass_model::{AnchoredResponse, ConnectorResponse, End, Situation, SolverCache, TimeStep};

/// Number of categories.
pub const CATEGORY_COUNT: usize = Category::ALL.len();

/// A body's motion at an instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyMotion {
    /// Where it is.
    pub pose: Pose,
    /// Velocity of its origin (m/s) and its rotation (rad/s), global axes.
    pub velocity: Six,
    /// Their derivatives (m/s2, rad/s2).
    pub acceleration: Six,
    /// The scheme's auxiliary acceleration (m/s2, rad/s2).
    pub auxiliary: Six,
    /// How the acceleration changed over the last step, over its length (m/s3, rad/s3): the next step begins its search with it.
    pub jerk: Six,
}

/// What bodies and connectors remember: the states of loads, one vector, each load with its range.
#[derive(Clone, Debug, Default)]
pub struct LoadMemory {
    /// Values of all loads.
    pub loads: Vec<f64>,
    /// Where those of each load of each body stand.
    pub(super) ranges: Vec<Vec<Range<usize>>>,
    /// Where those of each interaction of bodies stand.
    interactions: Vec<Range<usize>>,
    /// What the loads of each body hold ready for the step, beyond what they held for the step before.
    ahead: Vec<Six>,
}

impl LoadMemory {
    /// That of a system before anything has happened.
    pub fn new(system: &System) -> Self {
        let mut memory = LoadMemory::default();
        for node in &system.nodes {
            let mut ranges = Vec::new();
            for load in &node.floating.loads {
                let from = memory.loads.len();
                memory.loads.resize(from + load.as_stateful().map_or(0, |stateful| stateful.states()), 0.0);
                ranges.push(from..memory.loads.len());
            }
            memory.ranges.push(ranges);
        }
        for between in &system.interactions {
            let from = memory.loads.len();
            memory.loads.resize(from + between.load.as_ref().map_or(0, InteractionLoad::states), 0.0);
            memory.interactions.push(from..memory.loads.len());
        }
        memory
    }

    fn body_loads<'a>(
        &'a self,
        system: &'a System,
        body: usize,
    ) -> impl Iterator<Item = (&'a dyn BodyLoad, Range<usize>)> {
        let loads = &system.nodes[body].floating.loads;
        loads.iter().zip(&self.ranges[body]).map(|(load, range)| (load.as_ref(), range.clone()))
    }

    /// Gives the loads of a body what those of an earlier system, in their order, remembered.
    pub(crate) fn recall(&mut self, body: usize, system: &System, memory: &LoadMemory, old: &SystemBody) {
        let (Some(node), Some(ranges)) = (system.nodes.get(body), self.ranges.get(body)) else { return };
        let Some(before) = memory.ranges.get(body) else { return };
        let mut earlier: Vec<_> = old.floating.loads.iter().map(|l| l.category()).zip(before).collect();
        for (load, range) in node.floating.loads.iter().zip(ranges).filter(|(_, r)| !r.is_empty()) {
            let same =
                |(category, r): &(Category, &Range<usize>)| *category == load.category() && r.len() == range.len();
            let Some(found) = earlier.iter().position(same) else { continue };
            let (_, from) = earlier.remove(found);
            self.loads[range.clone()].copy_from_slice(&memory.loads[from.clone()]);
        }
    }

    /// Gives the interactions of bodies what those of an earlier system remembered.
    pub(crate) fn recall_interactions(&mut self, system: &System, memory: &LoadMemory, old: &[BodyInteraction]) {
        for (between, range) in system.interactions.iter().zip(&self.interactions) {
            let same = |(old, from): &(&BodyInteraction, &Range<usize>)| {
                old.on == between.on && old.by == between.by && from.len() == range.len()
            };
            if let Some((_, from)) = old.iter().zip(&memory.interactions).find(same) {
                self.loads[range.clone()].copy_from_slice(&memory.loads[from.clone()]);
            }
        }
    }

    /// Prepares a step of every load, from a start to where the bodies are expected.
    pub(crate) fn begin(
        &mut self,
        system: &System,
        (start, ahead): (&[BodyMotion], &[BodyMotion]),
        TimeStep { time, dt }: TimeStep,
    ) -> Result<(), SolveError> {
        self.ahead.clear();
        for ((node, ranges), (old, motion)) in system.nodes.iter().zip(&self.ranges).zip(start.iter().zip(ahead)) {
            let at = BodyStep { time, dt, pose: &motion.pose, velocity: &motion.velocity };
            // what the loads hold changes while the body turns: by half with the axes of the start, by half with those of the end
            let axes = (old.pose.axes + motion.pose.axes) * 0.5;
            let on_the_way = BodyStep { pose: &Pose { axes, ..motion.pose }, ..at };
            let mut more = Six::zeros();
            for (load, range) in node.floating.loads.iter().zip(ranges) {
                let state = &mut self.loads[range.clone()];
                let prepared = load.as_prepared();
                let before = prepared.map(|prepared| prepared.prepared_wrench(&on_the_way, state));
                if let Some(stateful) = load.as_stateful() {
                    stateful.begin(&at, state).map_err(SolveError::error_about(&node.name))?;
                }
                if let (Some(prepared), Some(before)) = (prepared, before) {
                    more += prepared.prepared_wrench(&on_the_way, state) - before;
                }
            }
            self.ahead.push(more);
        }
        for (between, range) in system.interactions.iter().zip(&self.interactions) {
            let (Some(load), Some(at)) = (&between.load, interaction_step(between, ahead, TimeStep { time, dt }))
            else {
                continue;
            };
            let state = &mut self.loads[range.clone()];
            let before = load.force(&at.by, state).wrench;
            load.begin(&at, state);
            if let Some(more) = self.ahead.get_mut(between.on) {
                *more += load.force(&at.by, state).wrench - before;
            }
        }
        Ok(())
    }

    /// Commits every load to an accepted step.
    pub(super) fn commit(&mut self, system: &System, motions: &[BodyMotion], TimeStep { time, dt }: TimeStep) {
        for ((node, ranges), motion) in system.nodes.iter().zip(&self.ranges).zip(motions) {
            let at = BodyStep { time, dt, pose: &motion.pose, velocity: &motion.velocity };
            for (load, range) in node.floating.loads.iter().zip(ranges).filter(|(_, r)| !r.is_empty()) {
                if let Some(stateful) = load.as_stateful() {
                    stateful.commit(&at, &mut self.loads[range.clone()]);
                }
            }
        }
        for (between, range) in system.interactions.iter().zip(&self.interactions) {
            let at = interaction_step(between, motions, TimeStep { time, dt });
            if let (Some(load), Some(at)) = (&between.load, at) {
                load.commit(&at, &mut self.loads[range.clone()]);
            }
        }
    }
}

/// The two bodies of an interaction at the end of a step.
fn interaction_step<'a>(
    between: &BodyInteraction,
    motions: &'a [BodyMotion],
    TimeStep { time, dt }: TimeStep,
) -> Option<InteractionStep<'a>> {
    let step = |motion: &'a BodyMotion| BodyStep { time, dt, pose: &motion.pose, velocity: &motion.velocity };
    Some(InteractionStep { on: step(motions.get(between.on)?), by: step(motions.get(between.by)?) })
}

/// Forces at an instant, six a body about its origin, global axes.
#[derive(Debug, Default)]
pub struct BodyForces {
    /// All that acts but inertia (N, N m).
    pub sum: DVector<f64>,
    /// -d(sum)/d(motion of the bodies).
    pub stiffness: DMatrix<f64>,
    /// -d(sum)/d(velocity of the bodies).
    pub damping: DMatrix<f64>,
    /// -d(sum)/d(acceleration of the bodies): of connectors with inertia of their own, and of loads.
    pub inertia: DMatrix<f64>,
    /// Largest force of a connector on each body (N).
    pub pull: Vec<f64>,
    /// By body and category, those of inertia left out.
    pub categories: Vec<[Six; CATEGORY_COUNT]>,
    /// Wrench on every end of every connector, in their order, about the end's point.
    pub wrenches: Vec<Six>,
    /// Stiff ties, whose forces a step holds.
    pub(super) ties: Ties,
    /// States of the connectors at the end of the step.
    pub trial: Vec<f64>,
    /// What the solvers of the connectors keep.
    pub(super) caches: Vec<SolverCache>,
    predictor: ForcePredictor,
    /// Whether a connector has inertia of its own.
    pub(super) has_dynamic_lines: bool,
    /// Whether a load adds to the inertia of its body.
    has_load_inertia: bool,
    /// Those of them, evaluated side by side.
    pub(super) line_tasks: Vec<LineTask>,
    made: DynamicLoad,
    response: ConnectorResponse,
    pub(super) ends: Vec<End>,
    arms: Vec<Vector3<f64>>,
}

impl BodyForces {
    fn clear(&mut self, system: &System) {
        let size = 6 * system.nodes.len();
        if self.stiffness.nrows() != size {
            self.sum = DVector::zeros(size);
            self.stiffness = DMatrix::zeros(size, size);
            self.damping = DMatrix::zeros(size, size);
            self.inertia = DMatrix::zeros(size, size);
        }
        self.sum.fill(0.0);
        self.stiffness.fill(0.0);
        self.damping.fill(0.0);
        self.inertia.fill(0.0);
        self.pull.clear();
        self.pull.resize(system.nodes.len(), 0.0);
        self.categories.clear();
        self.categories.resize(system.nodes.len(), [Six::zeros(); CATEGORY_COUNT]);
        self.wrenches.clear();
        self.has_load_inertia = false;
        self.ties.begin(system.links.len(), system.nodes.len());
        self.has_dynamic_lines = system.links.iter().any(|l| l.is_dynamic());
        self.caches.resize_with(system.links.len(), SolverCache::new);
        // connectors write all of it
        self.trial.resize(system.states.len(), 0.0);
    }

    /// Drops what predicts the forces of the next step.
    pub(super) fn clear_predictor(&mut self) {
        self.predictor.clear();
    }

    /// They are those of the end of a step of a length (s).
    pub(super) fn end_step(&mut self, dt: f64) {
        if self.has_dynamic_lines || self.has_load_inertia {
            self.predictor.take_inertia(dt, &self.inertia);
        }
        self.predictor.take(dt, &self.stiffness, &self.damping);
    }

    /// What is expected at a trial of the end of a step, from the forces of its start: by stiffness and damping for the motion and
    /// the change of velocity of each body over the step, with what its loads hold ready. False without a step to go by.
    pub(super) fn predict(
        &mut self,
        (memory, dt): (&LoadMemory, f64),
        motions: (&[BodyMotion], &[BodyMotion], &[Six]),
    ) -> bool {
        for (body, held) in memory.ahead.iter().enumerate() {
            let mut at = self.sum.fixed_rows_mut::<6>(6 * body);
            at += held;
        }
        if self.has_dynamic_lines {
            self.predictor.begin(&self.sum);
        }
        let parts = (motions.0, motions.1);
        if self.has_load_inertia && !self.has_dynamic_lines {
            self.predictor.add_inertia(parts, &mut self.sum);
        }
        self.predictor.add(dt, motions, &mut self.sum)
            && (!self.has_dynamic_lines || self.predictor.add_dynamic(parts, &mut self.sum))
    }

    /// They are those of a trial that holds, of a step of a length (s): what predicts the next learns by it.
    pub(super) fn learn(&mut self, dt: f64, motions: (&[BodyMotion], &[BodyMotion], &[Six])) {
        if self.has_dynamic_lines {
            self.predictor.learn(dt, motions, &self.sum);
        }
    }

    /// Evaluates everything with the bodies in these motions at the end of a step; `dt` zero: at the start of a run.
    ///
    /// # Errors
    /// The connector or body that has no answer there.
    pub fn evaluate(
        &mut self,
        system: &System,
        memory: &LoadMemory,
        motions: &[BodyMotion],
        TimeStep { time, dt }: TimeStep,
    ) -> Result<(), SolveError> {
        self.clear(system);
        for (body, (node, motion)) in system.nodes.iter().zip(motions).enumerate() {
            let at = BodyStep { time, dt, pose: &motion.pose, velocity: &motion.velocity };
            self.made.load.stiffness.fill(0.0);
            self.made.damping.fill(0.0);
            for (load, range) in memory.body_loads(system, body) {
                let state = &memory.loads[range];
                self.made.load.wrench.fill(0.0);
                load.add_dynamic_load(&at, state, &mut self.made).map_err(SolveError::error_about(&node.name))?;
                let wrench = self.made.load.wrench;
                self.add(body, load.category().index(), &wrench);
                if let Some(inertia) = load.as_inertial().map(|inertial| inertial.inertia(state)) {
                    self.add(body, load.category().index(), &-(inertia * motion.acceleration));
                    let mut block = self.inertia.fixed_view_mut::<6, 6>(6 * body, 6 * body);
                    block += inertia;
                    self.has_load_inertia = true;
                }
                let Some(divided) = load.as_divided() else { continue };
                for other in divided.other_categories() {
                    let part = divided.part(*other, &at, state);
                    self.count_as(body, (load.category().index(), other.index()), &part);
                }
            }
            let mut block = self.stiffness.fixed_view_mut::<6, 6>(6 * body, 6 * body);
            block += self.made.load.stiffness;
            let mut block = self.damping.fixed_view_mut::<6, 6>(6 * body, 6 * body);
            block += self.made.damping;
            if node.damped {
                let linear = node.floating.linear_damping(&motion.pose);
                self.add(body, Category::RadiationDrag.index(), &(-(linear * motion.velocity)));
                let mut block = self.damping.fixed_view_mut::<6, 6>(6 * body, 6 * body);
                block += linear;
                // it turns with its body
                let mut block = self.stiffness.fixed_view_mut::<6, 6>(6 * body, 6 * body);
                block += rotated_added_inertia(&linear, &motion.velocity);
            }
        }
        for (between, range) in system.interactions.iter().zip(&memory.interactions) {
            let (Some(load), Some(motion)) = (&between.load, motions.get(between.by)) else { continue };
            let at = BodyStep { time, dt, pose: &motion.pose, velocity: &motion.velocity };
            let made = load.force(&at, &memory.loads[range.clone()]);
            self.add(between.on, Category::RadiationDrag.index(), &made.wrench);
            self.add(between.on, Category::AddedInertia.index(), &-(made.inertia * motion.acceleration));
            let mut block = self.damping.fixed_view_mut::<6, 6>(6 * between.on, 6 * between.by);
            block += made.damping;
            let mut block = self.inertia.fixed_view_mut::<6, 6>(6 * between.on, 6 * between.by);
            block += made.inertia;
            self.has_load_inertia = true;
        }
        for (body, wrench) in system.applied.iter().filter(|(body, _)| *body < system.nodes.len()) {
            self.add(*body, Category::Applied.index(), wrench);
        }
        self.connect(system, motions, TimeStep { time, dt })
    }

    fn add(&mut self, body: usize, category: usize, wrench: &Six) {
        let mut at = self.sum.fixed_rows_mut::<6>(6 * body);
        at += wrench;
        if let Some(counted) = self.categories.get_mut(body).and_then(|c| c.get_mut(category)) {
            *counted += wrench;
        }
    }

    /// Counts a part of what was added in one category in another.
    fn count_as(&mut self, body: usize, (from, to): (usize, usize), part: &Six) {
        let Some(categories) = self.categories.get_mut(body) else { return };
        for (category, share) in [(from, -part), (to, *part)] {
            if let Some(sum) = categories.get_mut(category) {
                *sum += share;
            }
        }
    }

    /// Adds what connectors exert.
    fn connect(
        &mut self,
        system: &System,
        motions: &[BodyMotion],
        TimeStep { time, dt }: TimeStep,
    ) -> Result<(), SolveError> {
        self.evaluate_dynamic_lines(system, motions, TimeStep { time, dt });
        let mut tasks = 0..;
        let flexible = Category::FlexConnectors.index();
        for (index, link) in system.links.iter().enumerate() {
            self.place_ends(link, motions);
            let committed = &system.states[link.states.clone()];
            let trial = &mut self.trial[link.states.clone()];
            if !link.is_dynamic() {
                trial.copy_from_slice(committed);
            }
            let Some(cache) = self.caches.get_mut(index) else { continue };
            let step = (dt > 0.0).then_some(TimeStep { time, dt });
            let at = Situation { ends: &self.ends, step, surroundings: &system.surroundings };
            let anchored = matches!(link.ends.as_slice(), [EndAttachment::Body(..), EndAttachment::Ground(_)]);
            if let Some(element) = link.element.as_anchored().filter(|_| anchored) {
                let found = element.evaluate_anchored(&at, cache).map_err(SolveError::error_about(&link.name))?;
                let AnchoredResponse { wrenches, stiffness } = found;
                self.wrenches.extend_from_slice(&wrenches);
                self.hold(link, &wrenches, &stiffness, flexible);
                continue;
            }
            if link.is_dynamic() {
                let Some(found) = tasks.next().and_then(|at| self.line_tasks.get_mut(at)) else { continue };
                if let Some(error) = found.failed.take() {
                    return Err(SolveError::error_about(&link.name)(error));
                }
                std::mem::swap(&mut self.response, &mut found.response);
            } else {
                let held = self.ties.forces.get(index).and_then(Option::as_ref);
                match self.ties.holds.then(|| link.element.as_stiff_tie()).flatten() {
                    Some(tie) => {
                        let tie = tie.evaluate_tie(&at, held, &mut self.response);
                        let tie = tie.map_err(SolveError::error_about(&link.name))?;
                        self.ties.take(index, tie, &self.response.stiffness, (&link.ends, &self.arms));
                    }
                    None => link
                        .element
                        .evaluate(&at, committed, trial, cache, &mut self.response)
                        .map_err(SolveError::error_about(&link.name))?,
                }
            }
            self.wrenches.extend_from_slice(&self.response.wrench);
            let category = Category::from(link.element.category()).index();
            let count = link.ends.len();
            for (i, (end, own)) in link.ends.iter().zip(&self.arms).enumerate() {
                let EndAttachment::Body(body, _) = end else { continue };
                let wrench = &self.response.wrench[i];
                let about = move_wrench(wrench, *own);
                let mut at = self.sum.fixed_rows_mut::<6>(6 * body);
                at += about;
                if let Some(counted) = self.categories.get_mut(*body).and_then(|c| c.get_mut(category)) {
                    *counted += about;
                }
                self.pull[*body] = self.pull[*body].max(wrench.fixed_rows::<3>(0).norm());
                for (j, (other, far)) in link.ends.iter().zip(&self.arms).enumerate() {
                    let EndAttachment::Body(column, _) = other else { continue };
                    if let Some(block) = self.response.stiffness.get(count * i + j) {
                        let mut moved = move_stiffness(block, *own, *far);
                        if i == j {
                            moved += turning(wrench, *own);
                        }
                        let mut at = self.stiffness.fixed_view_mut::<6, 6>(6 * body, 6 * column);
                        at += moved;
                    }
                    if let Some(block) = self.response.damping.get(count * i + j) {
                        let mut at = self.damping.fixed_view_mut::<6, 6>(6 * body, 6 * column);
                        at += move_stiffness(block, *own, *far);
                    }
                    if let Some(block) = self.response.inertia.get(count * i + j) {
                        let mut at = self.inertia.fixed_view_mut::<6, 6>(6 * body, 6 * column);
                        at += move_stiffness(block, *own, *far);
                    }
                }
            }
        }
        Ok(())
    }

    /// Where the ends of a connector are and how they move, and their arms from the origins of their bodies.
    pub(super) fn place_ends(&mut self, link: &Link, motions: &[BodyMotion]) {
        self.ends.clear();
        self.arms.clear();
        for end in &link.ends {
            let (end, arm) = end_of(end, motions, link.is_dynamic());
            self.ends.push(end);
            self.arms.push(arm);
        }
    }

    /// Adds a force at the first end of a connector that the place of that end alone changes.
    fn hold(&mut self, link: &Link, wrenches: &[Six; 2], stiffness: &Matrix3<f64>, category: usize) {
        let (Some(EndAttachment::Body(body, _)), Some(arm)) = (link.ends.first(), self.arms.first()) else { return };
        let [first, _] = wrenches;
        let force = Vector3::new(first[0], first[1], first[2]);
        let crossed = arm.cross_matrix();
        let moment = arm.cross(&force);
        self.add(*body, category, &Six::new(force.x, force.y, force.z, moment.x, moment.y, moment.z));
        self.pull[*body] = self.pull[*body].max(force.norm());
        // the point moves by -[arm] times the rotation; an arm that turns keeps its force
        let by_turn = -(stiffness * crossed);
        let mut block = self.stiffness.fixed_view_mut::<6, 6>(6 * body, 6 * body);
        for (row, column, part) in [
            (0, 0, *stiffness),
            (0, 3, by_turn),
            (3, 0, crossed * stiffness),
            (3, 3, crossed * by_turn - force.cross_matrix() * crossed),
        ] {
            let mut at = block.fixed_view_mut::<3, 3>(row, column);
            at += part;
        }
    }
}
