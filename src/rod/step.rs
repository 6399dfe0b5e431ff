//! One implicit step in time.

use super::assemble::{HingeAt, Trial, Weights, hinge_sides};
use super::ends::{End, Motion};
use super::error::RodError;
use super::mesh::{Rod, State};
use super::spatial::{spatial, transport, turned};
use super::surroundings::World;
use super::workspace::Workspace;
use nalgebra::Vector3;

/// How a rod is stepped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Spectral radius at infinite frequency of the generalised-alpha scheme, 0 to 1: 1 damps nothing, 0 kills what the step
    /// cannot follow.
    pub rho_inf: f64,
    /// An iteration has converged when no node moves by more than this share of the shortest element.
    pub tolerance: f64,
    /// Iterations after which a step is cut.
    pub iterations: usize,
    /// How often a step may be halved.
    pub halvings: u32,
    /// Whether statics may also end where any push would make the rod leave, as a ring bent out of a straight beam.
    pub unstable: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Settings { rho_inf: 0.2, tolerance: 1e-5, iterations: 20, halvings: 12, unstable: false }
    }
}

/// What a step came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndForces {
    /// Force on each holder from the rod (N, global): end A, end B. For a free end what is left of the residual.
    pub force: [Vector3<f64>; 2],
    /// Moment on each holder from the rod about the end (N m).
    pub moment: [Vector3<f64>; 2],
    /// Newton iterations, all parts of a cut step together.
    pub iterations: usize,
    /// Parts the step was made in: 1 if it was not cut.
    pub parts: usize,
}

/// Why one attempt failed.
#[derive(Clone, Debug)]
pub(super) struct Failure {
    pub node: usize,
    pub why: &'static str,
}

/// Steps rods. It holds the memory of one rod; nothing is allocated in a step.
#[derive(Clone, Debug)]
pub struct Solver {
    pub(super) settings: Settings,
    pub(super) work: Workspace,
    pub(super) trial: Trial,
    pub(super) change: Vec<f64>,
    /// Where the last trial ended.
    next: State,
    /// Where the part before it ended, when a step is cut.
    part: State,
    pub(super) weights: Weights,
}

/// The scheme's constants for one step length: generalised-alpha (Chung and Hulbert 1993) in the form of Arnold and Bruels 2007, in which
/// equilibrium holds at the end of the step.
#[derive(Clone, Copy, Debug)]
struct Scheme {
    h: f64,
    /// The new averaged acceleration by the move beyond v h, and by the old one.
    new_by_u: f64,
    new_by_old: f64,
    /// The velocity by the old and new averaged accelerations.
    v_by_old: f64,
    v_by_new: f64,
    /// The acceleration by the new and old averaged ones, and by the last.
    a_by_new: f64,
    a_by_old: f64,
    a_by_last: f64,
}

/// Takes what is smaller than 1e-136 as zero: a motion that dies away would end in denormal numbers, which cost a hundred times
/// as much as others.
#[inline(always)]
fn flush(v: Vector3<f64>) -> Vector3<f64> {
    const TINY: f64 = 1e-120;
    v.map(|c| (c + TINY) - TINY)
}

impl Scheme {
    fn new(h: f64, rho: f64) -> Self {
        let (alpha_m, alpha_f) = ((2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0));
        let gamma = 0.5 + alpha_f - alpha_m;
        let beta = 0.25 * (1.0 + alpha_f - alpha_m).powi(2);
        Scheme {
            h,
            new_by_u: 1.0 / (beta * h * h),
            new_by_old: (0.5 - beta) / beta,
            v_by_old: (1.0 - gamma) * h,
            v_by_new: gamma * h,
            a_by_new: (1.0 - alpha_m) / (1.0 - alpha_f),
            a_by_old: alpha_m / (1.0 - alpha_f),
            a_by_last: alpha_f / (1.0 - alpha_f),
        }
    }

    fn weights(&self) -> Weights {
        Weights {
            k: 1.0,
            c: self.v_by_new * self.new_by_u,
            m: self.a_by_new * self.new_by_u,
        }
    }

    /// Averaged acceleration, velocity and acceleration of node `i` moved by `u` from where the step began.
    #[inline(always)]
    fn follow(&self, from: &State, i: usize, u: Vector3<f64>) -> [Vector3<f64>; 3] {
        let (v, a, acc) = (&from.velocity[i], &from.averaged[i], &from.acceleration[i]);
        let new = flush((u - v * self.h) * self.new_by_u - a * self.new_by_old);
        let velocity = flush(v + a * self.v_by_old + new * self.v_by_new);
        let acceleration = flush(new * self.a_by_new + a * self.a_by_old - acc * self.a_by_last);
        [new, velocity, acceleration]
    }
}

impl Solver {
    /// Memory for a rod.
    pub fn new(rod: &Rod, settings: Settings) -> Self {
        let nodes = rod.nodes();
        let zero = vec![Vector3::zeros(); nodes];
        let state = State {
            time: 0.0,
            position: zero.clone(),
            velocity: zero.clone(),
            acceleration: zero.clone(),
            averaged: zero.clone(),
            director: if rod.twists() { vec![Vector3::x(); nodes - 1] } else { Vec::new() },
            bedding: vec![0.0; nodes],
        };
        let still = super::surroundings::UniformFluid::none().0;
        let trial = Trial {
            time: 0.0,
            x: zero.clone(),
            v: zero.clone(),
            a: zero.clone(),
            fluid: vec![still; nodes],
            lay: zero,
            soft: vec![0.0; nodes],
            ends: [End::FREE; 2],
            loose: false,
            director: state.director.clone(),
        };
        let work = Workspace::of(rod);
        Solver {
            settings,
            change: vec![0.0; work.stride() * nodes],
            work,
            trial,
            part: state.clone(),
            next: state,
            weights: Weights { k: 1.0, c: 0.0, m: 0.0 },
        }
    }

    /// Tries the step from `state` to `time`, at which the ends move as given; the state stays as it is until
    /// [`Solver::accept`], so that a body can try again with another motion of an end.
    ///
    /// A step that does not converge is cut in halves, with the ends moving along cubics in between.
    ///
    /// # Errors
    /// [`RodError::Step`] when the shortest step fails as well.
    pub fn trial(
        &mut self,
        rod: &Rod,
        state: &State,
        world: &World,
        time: f64,
        ends: [End; 2],
    ) -> Result<EndForces, RodError> {
        let whole = time - state.time;
        if !(whole > 0.0 && whole.is_finite()) {
            let why = format!("a step from {} s to {time} s goes nowhere", state.time);
            return Err(RodError::Shape { rod: rod.name.clone(), why });
        }
        match self.attempt(rod, state, world, time, ends) {
            Ok(iterations) => Ok(self.end_forces(rod, iterations, 1)),
            Err(failure) => self.cut(rod, state, world, time, ends, failure),
        }
    }

    /// Takes the last trial as the new state.
    pub fn accept(&mut self, state: &mut State) {
        std::mem::swap(&mut self.next, state);
    }

    /// A trial and its acceptance.
    ///
    /// # Errors
    /// As [`Solver::trial`]; the state is then as before.
    pub fn step(
        &mut self,
        rod: &Rod,
        state: &mut State,
        world: &World,
        time: f64,
        ends: [End; 2],
    ) -> Result<EndForces, RodError> {
        let made = self.trial(rod, state, world, time, ends)?;
        self.accept(state);
        Ok(made)
    }

    /// The step in parts, each as long as converges.
    fn cut(
        &mut self,
        rod: &Rod,
        state: &State,
        world: &World,
        time: f64,
        ends: [End; 2],
        mut failure: Failure,
    ) -> Result<EndForces, RodError> {
        let whole = time - state.time;
        let (mut level, mut done, mut parts, mut iterations) = (1u32, 0u64, 0usize, self.settings.iterations);
        // positions in the step are counted in the smallest parts, so that the last one ends at `time` exactly
        let all = 1u64 << self.settings.halvings.min(40);
        copy(state, &mut self.part);
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
            let from = std::mem::replace(&mut self.part, State::empty());
            let made = self.attempt(rod, &from, world, target, between);
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

    /// Newton's iterations of one step; the iterations it took.
    fn attempt(
        &mut self,
        rod: &Rod,
        from: &State,
        world: &World,
        time: f64,
        ends: [End; 2],
    ) -> Result<usize, Failure> {
        let scheme = Scheme::new(time - from.time, self.settings.rho_inf.clamp(0.0, 1.0));
        let (h, last) = (scheme.h, rod.elements.len());
        self.weights = scheme.weights();
        let shortest = rod.elements.iter().map(|e| e.rest).fold(f64::INFINITY, f64::min);
        let (tolerance, wild) = (self.settings.tolerance * shortest, 10.0 * rod.length());
        self.trial.time = time;
        self.trial.ends = ends;
        lay(rod, from, world, &mut self.trial.lay);
        soften(from, world, &mut self.trial.soft);
        self.next.bedding.copy_from_slice(&from.bedding);
        let next = &mut self.next;
        next.time = time;
        for i in 0..=last {
            let known = if i == 0 { ends[0].motion } else if i == last { ends[1].motion } else { None };
            match known {
                Some(m) => {
                    next.position[i] = m.position;
                    next.velocity[i] = m.velocity;
                    next.acceleration[i] = m.acceleration;
                    next.averaged[i] = m.acceleration;
                }
                None => {
                    let u = (from.velocity[i] + from.averaged[i] * (0.5 * h)) * h;
                    next.position[i] = from.position[i] + u;
                    let [averaged, v, a] = scheme.follow(from, i, u);
                    (next.averaged[i], next.velocity[i], next.acceleration[i]) = (averaged, v, a);
                }
            }
        }
        next.director.copy_from_slice(&from.director);
        carry(&mut next.director, &from.position, &next.position);
        let stride = self.work.stride();
        let known = [ends[0].motion.is_some(), ends[1].motion.is_some()];
        let (mut before, mut last_move) = (f64::INFINITY, f64::INFINITY);
        for iteration in 1..=self.settings.iterations {
            std::mem::swap(&mut self.trial.x, &mut self.next.position);
            std::mem::swap(&mut self.trial.v, &mut self.next.velocity);
            std::mem::swap(&mut self.trial.a, &mut self.next.acceleration);
            std::mem::swap(&mut self.trial.director, &mut self.next.director);
            if iteration <= 2 {
                sample(world, time, &mut self.trial);
            }
            // while the moves shrink fast the factors of the iteration before do as well
            let fresh = iteration == 1 || last_move > 1e-3 * shortest || last_move > 0.2 * before;
            let size = self.iterate(rod, world, known, fresh);
            std::mem::swap(&mut self.trial.x, &mut self.next.position);
            std::mem::swap(&mut self.trial.v, &mut self.next.velocity);
            std::mem::swap(&mut self.trial.a, &mut self.next.acceleration);
            std::mem::swap(&mut self.trial.director, &mut self.next.director);
            let size = size?;
            if !(size.is_finite() && size < wild) {
                return Err(Failure { node: self.work.worst(known).0, why: "the iteration runs away" });
            }
            let next = &mut self.next;
            turn(&mut next.director, &next.position, &self.change, stride, known);
            for i in 0..=last {
                if (i == 0 && known[0]) || (i == last && known[1]) {
                    continue;
                }
                let d = &self.change[stride * i..stride * i + 3];
                next.position[i] += Vector3::new(d[0], d[1], d[2]);
                let u = next.position[i] - from.position[i];
                let [averaged, v, a] = scheme.follow(from, i, u);
                (next.averaged[i], next.velocity[i], next.acceleration[i]) = (averaged, v, a);
            }
            if size <= tolerance {
                return Ok(iteration);
            }
            if iteration > 6 && size > last_move {
                return Err(Failure { node: self.work.worst(known).0, why: "the iteration does not settle" });
            }
            before = last_move;
            last_move = size;
        }
        Err(Failure { node: self.work.worst(known).0, why: "the iteration does not settle" })
    }

    /// One Newton iteration at the trial, with a fresh tangent or the factors at hand: largest change of a coordinate (m). The forces of the ends are kept, taken on to the
    /// changed positions by their tangent.
    fn iterate(&mut self, rod: &Rod, world: &World, known: [bool; 2], fresh: bool) -> Result<f64, Failure> {
        let last = rod.elements.len();
        if fresh {
            self.work.assemble(rod, world, &self.trial, self.weights, 0..last);
            self.work.keep_rows();
        } else {
            self.work.forces(rod, world, &self.trial);
        }
        self.work.keep_ends();
        for (side, node) in [(0, 0), (1, last)] {
            if known[side] {
                self.work.drop_residual(node);
                if fresh {
                    self.work.fix(node);
                }
            }
        }
        if fresh {
            self.work.factor().map_err(|node| Failure { node, why: "its stiffness vanishes" })?;
        }
        self.work.newton(&mut self.change);
        self.work.carry_ends(&self.change);
        // a maximum would pass over a value that is no number
        let sum: f64 = self.change.iter().sum();
        if !sum.is_finite() {
            return Err(Failure { node: self.work.worst(known).0, why: "a force is no number" });
        }
        Ok(self.change.iter().fold(0.0, |most: f64, c| most.max(c.abs())))
    }

    /// Takes the end of the last trial as the trial's motion.
    pub(super) fn follow_next(&mut self) {
        self.trial.x.copy_from_slice(&self.next.position);
        self.trial.v.copy_from_slice(&self.next.velocity);
        self.trial.a.copy_from_slice(&self.next.acceleration);
        self.trial.director.copy_from_slice(&self.next.director);
    }

    fn end_forces(&self, rod: &Rod, iterations: usize, parts: usize) -> EndForces {
        let moment = [0, 1].map(|side| end_moment(rod, &self.next, &self.trial.ends[side], side));
        EndForces { force: self.work.end_forces(), moment, iterations, parts }
    }
}

/// Moment of the rod on the holder of an end (N m): the hinge turns the rod toward the held direction, and the holder back.
pub(super) fn end_moment(rod: &Rod, state: &State, end: &End, side: usize) -> Vector3<f64> {
    let (i, element) = if side == 0 { (0, rod.elements.first()) } else { (rod.elements.len() - 1, rod.elements.last()) };
    if rod.twists() {
        let at = if side == 0 { HingeAt::A } else { HingeAt::B };
        let mut ends = [End::FREE; 2];
        ends[side] = *end;
        return hinge_sides(rod, &state.position, &state.director, &ends, at).map_or_else(Vector3::zeros, |(k, kt, e, f)| {
            let gradient = spatial(k, kt, &e, &f).0;
            let (near, first) = if side == 0 { (f, 3) } else { (e, 0) };
            let force = gradient.fixed_rows::<3>(first).into_owned();
            near.direction.cross(&force) * near.length + near.direction * gradient[if side == 0 { 7 } else { 6 }]
        });
    }
    let hinge = element.and_then(|e| end.hinge(e));
    let Some((stiffness, direction)) = hinge else { return Vector3::zeros() };
    let t = (state.position[i + 1] - state.position[i]).normalize();
    let axis = direction.cross(&t);
    let sine = axis.norm();
    if sine > 0.0 { axis * (stiffness * sine.atan2(direction.dot(&t)) / sine) } else { axis }
}

impl State {
    fn empty() -> Self {
        State { time: 0.0, position: vec![], velocity: vec![], acceleration: vec![], averaged: vec![], director: vec![], bedding: vec![] }
    }
}

/// Copies a state into memory that is there.
fn copy(from: &State, to: &mut State) {
    to.time = from.time;
    to.position.copy_from_slice(&from.position);
    to.velocity.copy_from_slice(&from.velocity);
    to.acceleration.copy_from_slice(&from.acceleration);
    to.averaged.copy_from_slice(&from.averaged);
    to.director.copy_from_slice(&from.director);
    to.bedding.copy_from_slice(&from.bedding);
}

/// Takes directors along from one position of the nodes to another.
fn carry(directors: &mut [Vector3<f64>], from: &[Vector3<f64>], to: &[Vector3<f64>]) {
    for ((director, a), b) in directors.iter_mut().zip(from.windows(2)).zip(to.windows(2)) {
        *director = transport(director, &(a[1] - a[0]).normalize(), &(b[1] - b[0]).normalize());
    }
}

/// Takes directors along with a change of the unknowns that is about to be made, and turns them by it.
pub(super) fn turn(directors: &mut [Vector3<f64>], x: &[Vector3<f64>], change: &[f64], stride: usize, known: [bool; 2]) {
    let last = x.len() - 1;
    let moved = |i: usize| {
        if (i == 0 && known[0]) || (i == last && known[1]) {
            return x[i];
        }
        x[i] + Vector3::new(change[stride * i], change[stride * i + 1], change[stride * i + 2])
    };
    for (i, director) in directors.iter_mut().enumerate() {
        let (from, to) = ((x[i + 1] - x[i]).normalize(), (moved(i + 1) - moved(i)).normalize());
        *director = turned(&transport(director, &from, &to), &to, change[stride * i + 3]);
    }
}

/// Asks the fluid at the nodes of a trial.
pub(super) fn sample(world: &World, time: f64, trial: &mut Trial) {
    if world.fluid.uniform() {
        let everywhere = world.fluid.at(&trial.x[0], time);
        trial.fluid.fill(everywhere);
    } else {
        for (fluid, x) in trial.fluid.iter_mut().zip(&trial.x) {
            *fluid = world.fluid.at(x, time);
        }
    }
}

/// Direction of the rod at each node, where friction needs it.
pub(super) fn lay(rod: &Rod, state: &State, world: &World, lay: &mut [Vector3<f64>]) {
    if world.bottom.is_some_and(|(_, g)| g.friction_along > 0.0 || g.friction_across > 0.0) {
        let last = rod.elements.len();
        for (i, direction) in lay.iter_mut().enumerate() {
            let d = state.position[(i + 1).min(last)] - state.position[i.saturating_sub(1)];
            *direction = d.try_normalize(1e-12).unwrap_or_else(Vector3::zeros);
        }
    }
}

/// Penetration over which the bottom's stiffness grows at each node: the bottom's own, or the mesh's where it is larger.
pub(super) fn soften(state: &State, world: &World, soft: &mut [f64]) {
    if let Some((_, ground)) = &world.bottom {
        for (soft, bedding) in soft.iter_mut().zip(&state.bedding) {
            *soft = bedding.max(ground.soft);
        }
    }
}

/// An end part of the way through a step: a cubic through position and velocity at both ends of it.
fn interpolate(state: &State, node: usize, end: &End, whole: f64, share: f64) -> End {
    let Some(to) = end.motion.filter(|_| share < 1.0) else { return *end };
    let (x0, v0) = (state.position[node], state.velocity[node] * whole);
    let (x1, v1) = (to.position, to.velocity * whole);
    let (s, d) = (share, x1 - x0);
    let (b, c) = (d * 3.0 - v0 * 2.0 - v1, v0 + v1 - d * 2.0);
    let motion = Motion {
        position: x0 + v0 * s + b * (s * s) + c * (s * s * s),
        velocity: (v0 + b * (2.0 * s) + c * (3.0 * s * s)) / whole,
        acceleration: (b * 2.0 + c * (6.0 * s)) / (whole * whole),
    };
    End { motion: Some(motion), ..*end }
}
