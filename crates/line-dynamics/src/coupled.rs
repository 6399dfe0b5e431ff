//! Dynamic lines for a program that moves their fairleads: motions in, forces out, one step after the other.
//!
//! Each line is held at an anchor, which stays, and at a fairlead, which the program moves. [`CoupledLines::step`] takes where all fairleads
//! are at a time and how fast they move, and gives the force of each line on its fairlead. Between two calls a fairlead moves along the
//! cubic of its places and velocities at both, cut in equal steps no longer than the one the lines were made with; its accelerations are
//! those of that cubic.

use super::ends::{RodEnd, RodEndMotion};
use super::environment::{FluidField, FluidState, LineEnvironment, PlaneBottom, SeabedLaw, UniformFluid};
use super::error::RodError;
use super::mesh::Rod;
use super::scheme::RodSettings;
use super::solver::RodSolver;
use super::state::RodState;
use nalgebra::Vector3;
use std::cell::RefCell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use windlass_model::{Ambient, Flow};

/// What surrounds the lines: water that moves at one velocity and by waves, and a plane bottom.
#[derive(Clone, Debug)]
pub struct Surroundings {
    /// The water, with its surface at z = 0 where it has no waves; its velocity is everywhere.
    pub water: UniformFluid,
    /// Waves, and currents and wind that change with the height; their velocities come to that of the water. Lines at rest feel no waves.
    pub ambient: Option<Arc<dyn Ambient>>,
    /// The bottom and its contact law; none for lines that never meet it.
    pub bottom: Option<(PlaneBottom, SeabedLaw)>,
    /// Acceleration of gravity (m/s2), downward.
    pub gravity: f64,
}

/// One line between an anchor and a fairlead.
#[derive(Clone, Debug)]
pub struct CoupledLine {
    /// The line; its end A is the fairlead.
    pub rod: Rod,
    /// Where the anchor is (m, global).
    pub anchor: Vector3<f64>,
    /// Where the fairlead is at the start (m, global).
    pub fairlead: Vector3<f64>,
}

#[derive(Clone, Debug)]
struct CoupledRod {
    line: CoupledLine,
    solver: RodSolver,
    state: RodState,
    /// The motion of the fairlead at the present time.
    position: Vector3<f64>,
    velocity: Vector3<f64>,
    /// Force on the fairlead and on the anchor (N, global).
    force: [Vector3<f64>; 2],
}

/// Lines at rest or on their way.
#[derive(Clone, Debug)]
pub struct CoupledLines {
    rods: Vec<CoupledRod>,
    around: Surroundings,
    longest_step: f64,
    time: f64,
    /// Set by another thread to end what is under way.
    stop: Arc<AtomicBool>,
}

/// Lowest place below the bottom at which an end still is on it (m).
const BELOW_BOTTOM_M: f64 = 1e-6;

/// Steps that one call is cut into at most.
const MAX_STEPS: f64 = 1e6;

/// The water of surroundings, as a rod asks for it.
struct CoupledWater<'a> {
    around: &'a Surroundings,
    /// Whether waves are left out: at rest.
    mean: bool,
    /// Room for what is asked.
    flows: RefCell<Vec<Flow>>,
    stop: &'a AtomicBool,
}

impl FluidField for CoupledWater<'_> {
    fn sample(&self, position: &Vector3<f64>, time: f64) -> FluidState {
        let mut found = [self.around.water.0];
        self.sample_into(std::slice::from_ref(position), time, &mut found);
        found[0]
    }

    fn sample_into(&self, positions: &[Vector3<f64>], time: f64, out: &mut [FluidState]) {
        let still = self.around.water.0;
        let Some(ambient) = &self.around.ambient else { return out.fill(still) };
        let mut flows = self.flows.borrow_mut();
        flows.clear();
        flows.resize(positions.len(), Flow::still_water(still.surface));
        if self.mean {
            ambient.mean(positions, &mut flows);
        } else {
            ambient.flow(time, positions, &mut flows);
        }
        for (out, Flow { velocity, acceleration, surface, head, wind }) in out.iter_mut().zip(flows.iter().copied()) {
            *out = FluidState { velocity: velocity + still.velocity, acceleration, surface, head, wind, ..still };
        }
    }

    fn uniform(&self) -> bool {
        self.around.ambient.is_none()
    }

    fn is_interrupted(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
            || self.around.ambient.as_ref().is_some_and(|ambient| ambient.is_interrupted())
    }
}

impl Surroundings {
    fn water<'a>(&'a self, mean: bool, stop: &'a AtomicBool) -> CoupledWater<'a> {
        CoupledWater { around: self, mean, flows: RefCell::default(), stop }
    }

    fn environment<'a>(&'a self, water: &'a CoupledWater<'a>) -> LineEnvironment<'a> {
        let mut world = LineEnvironment::new(water, self.gravity);
        world.bottom = self.bottom.as_ref().map(|(plane, law)| (plane as &dyn super::SeabedShape, *law));
        world
    }
}

impl CoupledLines {
    /// Lines at rest with their fairleads at their first places, at time 0; a step is no longer than `longest_step` (s).
    ///
    /// # Errors
    /// A step that is no length of time; an end below the bottom; what [`RodSolver::statics`] says of a line that finds no rest.
    pub fn new(lines: Vec<CoupledLine>, around: Surroundings, longest_step: f64) -> Result<Self, RodError> {
        Self::with_interrupt(lines, around, longest_step, Arc::default())
    }

    /// As [`CoupledLines::new`]. `stop`, while it is set, ends the search for rest and every step that is under way with
    /// [`RodError::Interrupted`]; the lines are then as before the step.
    ///
    /// # Errors
    /// Those of [`CoupledLines::new`], and the interruption.
    pub fn with_interrupt(
        lines: Vec<CoupledLine>,
        around: Surroundings,
        longest_step: f64,
        stop: Arc<AtomicBool>,
    ) -> Result<Self, RodError> {
        if !(longest_step > 0.0 && longest_step.is_finite()) {
            let why = format!("its longest step of {longest_step} s is no length of time");
            return Err(RodError::Shape { rod: "system of lines".into(), why });
        }
        let water = around.water(true, &stop);
        let world = around.environment(&water);
        let mut rods = Vec::with_capacity(lines.len());
        for line in lines {
            let (fairlead, anchor) = (line.fairlead, line.anchor);
            above_bottom(&line.rod, around.bottom.as_ref(), [("fairlead", fairlead), ("anchor", anchor)])?;
            let points = start_shape(&line.rod, fairlead, anchor, around.bottom.as_ref().map(|(plane, _)| *plane));
            let mut state = RodState::along_points(&line.rod, &points)?;
            let mut solver = RodSolver::new(&line.rod, RodSettings::default());
            let ends = [fairlead, anchor].map(RodEnd::pin);
            let held = solver.statics(&line.rod, &mut state, &world, ends)?;
            let velocity = Vector3::zeros();
            rods.push(CoupledRod { line, solver, state, position: fairlead, velocity, force: held.force });
        }
        drop(water);
        Ok(CoupledLines { rods, around, longest_step, time: 0.0, stop })
    }

    /// Takes the lines on to a time (s) at which the fairleads are at `positions` (m, global) and move at `velocities` (m/s). The time at
    /// which they are changes nothing.
    ///
    /// # Errors
    /// A time before that of the lines, other than one position and velocity a line, numbers that are not finite, a fairlead below the bottom, or a step that does not
    /// converge: the lines are then as before the call.
    pub fn step(&mut self, time: f64, positions: &[Vector3<f64>], velocities: &[Vector3<f64>]) -> Result<(), RodError> {
        let refuse = |why: String| Err(RodError::Shape { rod: "system of lines".into(), why });
        let count = self.rods.len();
        if positions.len() != count || velocities.len() != count {
            let given = (positions.len(), velocities.len());
            return refuse(format!("it has {count} fairleads, and {} positions with {} velocities", given.0, given.1));
        }
        if let Some(at) =
            (positions.iter().zip(velocities)).position(|(x, v)| x.iter().chain(v.iter()).any(|c| !c.is_finite()))
        {
            return refuse(format!("the motion of fairlead {} is not finite", at + 1));
        }
        for (rod, fairlead) in self.rods.iter().zip(positions) {
            above_bottom(&rod.line.rod, self.around.bottom.as_ref(), [("fairlead", *fairlead)])?;
        }
        let interval = time - self.time;
        if interval == 0.0 && positions.iter().zip(&self.rods).all(|(x, rod)| *x == rod.position) {
            return Ok(());
        }
        if !(interval > 0.0 && interval.is_finite()) {
            return refuse(format!("a step from {} s to {time} s goes nowhere", self.time));
        }
        let steps = (interval / self.longest_step * (1.0 - 1e-12)).ceil().max(1.0);
        if steps > MAX_STEPS {
            return refuse(format!(
                "a step from {} s to {time} s is more than {MAX_STEPS} of its longest steps",
                self.time
            ));
        }
        let before: Vec<RodState> = self.rods.iter().map(|rod| rod.state.clone()).collect();
        let stop = Arc::clone(&self.stop);
        let water = self.around.water(false, &stop);
        let world = self.around.environment(&water);
        let mut forces = Vec::with_capacity(count);
        for (rod, (position, velocity)) in self.rods.iter_mut().zip(positions.iter().zip(velocities)) {
            let path = Cubic { interval, from: [rod.position, rod.velocity], to: [*position, *velocity] };
            match rod.follow(&path, (self.time, time), steps as u64, &world) {
                Ok(force) => forces.push(force),
                Err(error) => {
                    for (rod, state) in self.rods.iter_mut().zip(before) {
                        rod.state = state;
                        // what the solver remembers is of steps that are no more
                        rod.solver = RodSolver::new(&rod.line.rod, RodSettings::default());
                    }
                    return Err(error);
                }
            }
        }
        for (at, rod) in self.rods.iter_mut().enumerate() {
            if let (Some(x), Some(v), Some(force)) = (positions.get(at), velocities.get(at), forces.get(at)) {
                (rod.position, rod.velocity, rod.force) = (*x, *v, *force);
            }
        }
        self.time = time;
        Ok(())
    }

    /// The longest step that a call is cut into (s).
    pub fn longest_step(&self) -> f64 {
        self.longest_step
    }

    /// The time at which the lines are (s).
    pub fn time(&self) -> f64 {
        self.time
    }

    /// How many lines there are.
    pub fn len(&self) -> usize {
        self.rods.len()
    }

    /// Whether there is no line.
    pub fn is_empty(&self) -> bool {
        self.rods.is_empty()
    }

    /// The force of each line on its fairlead (N, global).
    pub fn fairlead_forces(&self) -> Vec<Vector3<f64>> {
        self.rods.iter().map(|rod| rod.force[0]).collect()
    }

    /// The force of each line on its anchor (N, global).
    pub fn anchor_forces(&self) -> Vec<Vector3<f64>> {
        self.rods.iter().map(|rod| rod.force[1]).collect()
    }

    /// Where each fairlead is (m, global).
    pub fn fairleads(&self) -> Vec<Vector3<f64>> {
        self.rods.iter().map(|rod| rod.position).collect()
    }

    /// Where the nodes of a line are (m, global), from the fairlead; none of a line that is not there.
    pub fn node_positions(&self, line: usize) -> Option<Vec<Vector3<f64>>> {
        self.rods.get(line).map(|rod| rod.state.node_positions())
    }
}

impl CoupledRod {
    /// Steps along the way of the fairlead; the forces at its end.
    fn follow(
        &mut self,
        path: &Cubic,
        (from, to): (f64, f64),
        steps: u64,
        world: &LineEnvironment,
    ) -> Result<[Vector3<f64>; 2], RodError> {
        let mut force = self.force;
        for step in 1..=steps {
            if world.fluid.is_interrupted() {
                return Err(RodError::Interrupted { rod: self.line.rod.name().into() });
            }
            let share = step as f64 / steps as f64;
            let at = if step < steps { from + share * (to - from) } else { to };
            let ends = [RodEnd::from_motion(path.at(share)), RodEnd::pin(self.line.anchor)];
            force = self.solver.step(&self.line.rod, &mut self.state, world, at, ends)?.force;
        }
        Ok(force)
    }
}

/// Refuses ends below the bottom.
fn above_bottom<const N: usize>(
    rod: &Rod,
    bottom: Option<&(PlaneBottom, SeabedLaw)>,
    ends: [(&str, Vector3<f64>); N],
) -> Result<(), RodError> {
    let Some((plane, _)) = bottom else { return Ok(()) };
    for (end, at) in ends {
        let ground = super::SeabedShape::height(plane, at.x, at.y).0;
        if at.z < ground - BELOW_BOTTOM_M * ground.abs().max(1.0) {
            let why = format!("its {end} at z {} m is below the bottom at {ground} m", at.z);
            return Err(RodError::Shape { rod: rod.name().into(), why });
        }
    }
    Ok(())
}

/// The way of a fairlead over an interval (s): position and velocity at both ends of it.
struct Cubic {
    interval: f64,
    from: [Vector3<f64>; 2],
    to: [Vector3<f64>; 2],
}

impl Cubic {
    /// The motion at a share of the interval.
    fn at(&self, s: f64) -> RodEndMotion {
        let (h, [x0, v0], [x1, v1]) = (self.interval, self.from, self.to);
        let way = x1 - x0;
        // Hermite's form, with the way in it so that a long distance from the origin costs no digits
        let position =
            x0 + way * (s * s * (3.0 - 2.0 * s)) + (v0 * (s * (1.0 - s) * (1.0 - s)) - v1 * (s * s * (1.0 - s))) * h;
        let velocity =
            way * (6.0 * s * (1.0 - s) / h) + v0 * ((1.0 - s) * (1.0 - 3.0 * s)) + v1 * (s * (3.0 * s - 2.0));
        let acceleration =
            way * ((6.0 - 12.0 * s) / (h * h)) + (v0 * (6.0 * s - 4.0) + v1 * (6.0 * s - 2.0)) * (1.0 / h);
        let at_end = s >= 1.0;
        RodEndMotion {
            position: if at_end { x1 } else { position },
            velocity: if at_end { v1 } else { velocity },
            acceleration,
        }
    }
}

/// A first shape of about the length of the line: slack hangs down to the bottom, and lies there toward the anchor.
fn start_shape(
    rod: &Rod,
    fairlead: Vector3<f64>,
    anchor: Vector3<f64>,
    bottom: Option<PlaneBottom>,
) -> Vec<Vector3<f64>> {
    let middle = 0.5 * (fairlead + anchor);
    let straight = (fairlead - anchor).norm();
    let slack = rod.length() - straight;
    if slack <= 0.0 {
        return vec![fairlead, anchor];
    }
    // two equal legs of the line's length meet below the middle
    let half = 0.5 * rod.length();
    let across = 0.5 * (fairlead - anchor).xy().norm();
    let depth = (half * half - across * across).max(0.0).sqrt();
    let low = middle.z - depth;
    let ground = bottom.map_or(f64::NEG_INFINITY, |plane| super::SeabedShape::height(&plane, middle.x, middle.y).0);
    vec![fairlead, Vector3::new(middle.x, middle.y, low.max(ground)), anchor]
}
