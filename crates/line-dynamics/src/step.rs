//! One implicit step in time: its predictor, Newton's iterations, and the step in parts where they do not converge.

use super::ends::RodEnd;
use super::environment::LineEnvironment;
use super::error::RodError;
use super::euler_fallback::has_jump;
use super::hinges::end_moment;
use super::mesh::Rod;
use super::scheme::{RodSettings, StepScheme};
use super::solver::{RodEndForces, RodSolver, SolverPhase};
use super::state::RodState;
use super::tension::find_overstretched;
use super::trial::{
    StaticFriction, advance_stick_points, interpolate, resample_fluid, sample_fluid, set_friction_directions,
    set_seabed_penetration_scales, transport_directors, turn_directors,
};
use super::viscoelastic::{set_yielded_strains, update_memory};
use super::warm_start::{TrialPrediction, WarmStart};
use nalgebra::Vector3;

/// The move that is left after one by a tangent of its own is at most so many times its square, both in lengths of the shortest element,
/// as long as no element goes slack or taut by it. Newton's iteration is of the second order; of the steps of eight chains of 50 elements
/// in waves, whose nodes come down on the bottom and leave it, the largest such factor of moves below 3e-5 was 3.6e3.
const NEXT_MOVE_BY_SQUARE: f64 = 1e4;

/// Whether a change that was made takes an element across its unstretched length, where its stiffness is another.
fn slackens(rod: &Rod, after: &[Vector3<f64>], change: &[f64], stride: usize) -> bool {
    let changes = change.chunks_exact(stride).zip(change[stride..].chunks_exact(stride));
    let each = rod.elements.iter().zip(after.windows(2)).zip(changes);
    each.fold(false, |any, ((element, x), (a, b))| {
        let (d, square) = (x[1] - x[0], element.rest * element.rest);
        let before = d - Vector3::new(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
        any | ((d.norm_squared() < square) != (before.norm_squared() < square))
    })
}

/// Why one attempt failed.
#[derive(Clone, Debug)]
pub(super) struct Failure {
    pub node: usize,
    pub why: &'static str,
}

/// Where a step ends if its averaged accelerations stay.
fn predict_step(next: &mut RodState, from: &RodState, scheme: &StepScheme, time: f64, ends: &[RodEnd; 2]) {
    next.bedding.copy_from_slice(&from.bedding);
    (next.time, next.origin) = (time, from.origin);
    let last = from.position.len() - 1;
    scheme.predict(from, next);
    for (side, node) in [(0, 0), (1, last)] {
        if let Some(motion) = ends[side].motion {
            next.hold(node, &motion);
        }
    }
    next.director.copy_from_slice(&from.director);
    transport_directors(&mut next.director, &from.position, &next.position);
}

impl RodSolver {
    /// [`RodSolver::trial`] in coordinates from the origin of the state.
    pub(super) fn trial_nearby(
        &mut self,
        rod: &Rod,
        state: &RodState,
        world: &LineEnvironment,
        time: f64,
        ends: [RodEnd; 2],
    ) -> Result<RodEndForces, RodError> {
        let mut iterations = 0;
        if self.is_same_step(state, time, &ends) {
            match self.step_with_fallback(rod, state, world, time, ends, true) {
                Ok(count) => return Ok(self.end_forces(rod, count, 1)),
                Err(_) => iterations = self.settings.iterations,
            }
        }
        self.phase = SolverPhase::Idle;
        self.step_start.copy_from(state);
        let made = match self.step_with_fallback(rod, state, world, time, ends, false) {
            Ok(count) => Ok(self.end_forces(rod, iterations + count, 1)),
            Err(failure) => self.step_in_parts(rod, state, world, time, ends, failure),
        }?;
        (self.phase, self.is_single_part) = (SolverPhase::Trial, made.parts == 1);
        Ok(made)
    }

    /// Whether the last trial was of the same step, made in one part.
    fn is_same_step(&self, state: &RodState, time: f64, ends: &[RodEnd; 2]) -> bool {
        let held = |ends: &[RodEnd; 2]| ends.map(|e| e.motion.is_some());
        self.phase == SolverPhase::Trial
            && self.is_single_part
            && self.next.time == time
            && held(&self.trial.ends) == held(ends)
            && self.step_start.is_same(state)
    }

    /// Newton's iterations of one step, from where the last trial ended if that is `near`, and once more where it was
    /// one of a snap: the iterations it took.
    fn step_with_fallback(
        &mut self,
        rod: &Rod,
        from: &RodState,
        world: &LineEnvironment,
        time: f64,
        ends: [RodEnd; 2],
        near: bool,
    ) -> Result<usize, Failure> {
        // a trial that follows another is made as that one was, so that a body's iteration can end
        self.uses_implicit_euler &= near;
        let done = self.converge(rod, from, world, time, ends, near)?;
        if self.uses_implicit_euler || !has_jump(rod, world, &self.trial, from, &self.next) {
            return Ok(done);
        }
        self.uses_implicit_euler = true;
        Ok(done + self.converge(rod, from, world, time, ends, false)?)
    }

    /// The step in parts, each as long as converges.
    fn step_in_parts(
        &mut self,
        rod: &Rod,
        state: &RodState,
        world: &LineEnvironment,
        time: f64,
        ends: [RodEnd; 2],
        mut failure: Failure,
    ) -> Result<RodEndForces, RodError> {
        let whole = time - state.time;
        let (mut level, mut done, mut parts, mut iterations) = (1u32, 0u64, 0usize, self.settings.iterations);
        // positions in the step are counted in the smallest parts, so that the last one ends at `time` exactly
        let all = 1u64 << self.settings.halvings.min(40);
        self.part.copy_from(state);
        while done < all {
            if level > self.settings.halvings {
                return Err(RodError::Step {
                    rod: rod.name.clone(),
                    time,
                    step: whole / all as f64,
                    element: failure.node.clamp(1, rod.elements.len()),
                    why: failure.why.to_string(),
                });
            }
            let to = done + (all >> level);
            let share = to as f64 / all as f64;
            let target = if to == all { time } else { state.time + whole * share };
            let between = [0, 1].map(|side| {
                let node = if side == 0 { 0 } else { rod.elements.len() };
                interpolate(state, node, &ends[side], whole, share)
            });
            let from = std::mem::take(&mut self.part);
            let supports = world.supports_before(time - target);
            let within = LineEnvironment { supports: &supports, ..*world };
            let made = self.step_with_fallback(rod, &from, &within, target, between, false);
            self.part = from;
            match made {
                Ok(count) => {
                    iterations += count;
                    parts += 1;
                    done = to;
                    std::mem::swap(&mut self.part, &mut self.next);
                    // a longer part where it fits the grid of halvings
                    if level > 1 && done.is_multiple_of(all >> (level - 1)) {
                        level -= 1;
                    }
                }
                Err(found) => {
                    iterations += self.settings.iterations;
                    failure = found;
                    level += 1;
                }
            }
        }
        std::mem::swap(&mut self.part, &mut self.next);
        Ok(self.end_forces(rod, iterations, parts))
    }

    /// Begins a trial where the last one of the step ended; none if that is too far away.
    fn predict_from_last_trial(
        &mut self,
        (rod, world): (&Rod, &LineEnvironment),
        from: &RodState,
        scheme: &StepScheme,
        ends: &[RodEnd; 2],
    ) -> Option<WarmStart> {
        let elsewhere = [0, 1].map(|side: usize| self.trial.ends[side].motion != ends[side].motion);
        self.linearise(rod, world, false, elsewhere)?;
        let RodSolver { trial, system, next, settings: RodSettings { tolerance, .. }, .. } = self;
        let prediction = TrialPrediction { rod, world, scheme, from, trial, system, next, tolerance: *tolerance };
        prediction.move_with_ends(ends, elsewhere)
    }

    /// Newton's iterations of one step, from where the last trial ended if that is `near`: the iterations it took.
    fn converge(
        &mut self,
        rod: &Rod,
        from: &RodState,
        world: &LineEnvironment,
        time: f64,
        ends: [RodEnd; 2],
        near: bool,
    ) -> Result<usize, Failure> {
        let h = time - from.time;
        let scheme =
            if self.uses_implicit_euler { StepScheme::euler(h) } else { StepScheme::new(h, &self.settings.scheme) };
        let last = rod.elements.len();
        self.system.weights = scheme.weights();
        let shortest = rod.shortest();
        let (tolerance, wild) = (self.settings.tolerance * shortest, 10.0 * rod.length());
        let moved = if near { self.predict_from_last_trial((rod, world), from, &scheme, &ends) } else { None };
        self.trial.time = time;
        self.trial.ends = ends;
        match moved {
            None => {
                self.trial.friction = StaticFriction::None;
                self.trial.stuck_at.copy_from_slice(&from.stuck);
                set_friction_directions(rod, from, world, &mut self.trial.friction_direction);
                set_seabed_penetration_scales(from, world, &mut self.trial.seabed_penetration_scale);
                update_memory(rod, from, scheme.h, &mut self.trial.memory);
                predict_step(&mut self.next, from, &scheme, time, &ends);
            }
            Some(WarmStart::Iterate) => {}
            Some(WarmStart::Converged) => {
                set_yielded_strains(rod, &self.trial.memory, &mut self.next);
                advance_stick_points(world, from, &mut self.next);
                return Ok(0);
            }
        }
        let stride = self.system.work.stride();
        let known = [ends[0].motion.is_some(), ends[1].motion.is_some()];
        let (mut before, mut last_move) = (f64::INFINITY, f64::INFINITY);
        // friction goes by its secant, and supports are met where they were
        let exact = world.supports.is_empty() && !world.bottom.is_some_and(|(_, ground)| ground.rough());
        self.system.line_search.reset();
        for iteration in 1..=self.settings.iterations {
            std::mem::swap(&mut self.trial.x, &mut self.next.position);
            std::mem::swap(&mut self.trial.v, &mut self.next.velocity);
            std::mem::swap(&mut self.trial.a, &mut self.next.acceleration);
            std::mem::swap(&mut self.trial.director, &mut self.next.director);
            // the factors are those of the trial before where the nodes are, and so is the fluid unless they have left its place
            let close = iteration == 1 && moved.is_some();
            match iteration {
                1 if !close => sample_fluid(world, time, &mut self.trial),
                _ => resample_fluid(world, &mut self.trial, shortest),
            }
            // while the moves shrink fast the factors of the iteration before do as well
            let shrinks = last_move <= 1e-3 * shortest && last_move <= 0.2 * before;
            let fresh = !close && (iteration == 1 || !shrinks);
            let size = self.system.iterate(rod, world, &self.trial, known, fresh);
            std::mem::swap(&mut self.trial.x, &mut self.next.position);
            std::mem::swap(&mut self.trial.v, &mut self.next.velocity);
            std::mem::swap(&mut self.trial.a, &mut self.next.acceleration);
            std::mem::swap(&mut self.trial.director, &mut self.next.director);
            let size = size?;
            if !(size.is_finite() && size < wild) {
                return Err(Failure {
                    node: self.system.work.largest_residual(known).0,
                    why: "the iteration runs away",
                });
            }
            if !fresh && !close && size > last_move {
                // they do no more, as when an element comes to be slack: the move is not made
                before = last_move;
                self.system.line_search.reset();
                continue;
            }
            self.system.ends.moved += size;
            let next = &mut self.next;
            turn_directors(&mut next.director, &next.position, &self.system.change, stride, known);
            // ends whose motion is given keep it
            let given = [(0, 0), (1, last)].map(|(side, node)| known[side].then(|| (node, next.node_motion(node))));
            next.move_nodes(&self.system.change, stride);
            scheme.set_motions(from, next);
            given.into_iter().flatten().for_each(|(node, motion)| next.set_node_motion(node, motion));
            // what is still missing if the moves go on shrinking as they do, or by a tangent of its own
            let missing = if iteration == 1 { size } else { size * size / (last_move - size).max(0.0) };
            let quadratic = NEXT_MOVE_BY_SQUARE * size * size / shortest;
            let converged = size.min(missing) <= tolerance
                || (fresh
                    && exact
                    && quadratic <= tolerance
                    && !slackens(rod, &next.position, &self.system.change, stride));
            if converged {
                if let Some(element) = find_overstretched(rod, &next.position) {
                    return Err(Failure { node: element + 1, why: "its strain exceeds the limit of its tension law" });
                }
                set_yielded_strains(rod, &self.trial.memory, next);
                advance_stick_points(world, from, next);
                return Ok(iteration);
            }
            if iteration > 6 && size > last_move {
                return Err(Failure {
                    node: self.system.work.largest_residual(known).0,
                    why: "the iteration does not settle",
                });
            }
            before = last_move;
            last_move = size;
        }
        Err(Failure { node: self.system.work.largest_residual(known).0, why: "the iteration does not settle" })
    }

    fn end_forces(&self, rod: &Rod, iterations: usize, parts: usize) -> RodEndForces {
        let moment = [0, 1].map(|side| end_moment(rod, &self.next, &self.trial.ends[side], side));
        RodEndForces { force: self.system.work.end_forces(), moment, iterations, parts }
    }
}
