//! Motion of one installed tether across its axis, in both planes, by the two stages of the manual (seed 003, 3.6).
//!
//! The axis moves with the attachment: unknowns are deflections from it and slopes against it, none at the ends. With the place x, the
//! velocity v and the step h each stage solves `(M + b h^2/2 K) a = F - K (x + b h v)`; M is consistent with the added mass of a wholly
//! submerged tether, K holds bending, tension (both as the stage finds them) and the springs of the ends, and F, by four Gauss points at the
//! deflected place, is
//! - `rho A (1 + Ca) a_n` of the water's acceleration, and drag `1/2 rho Cd D |u_r| u_r` of its velocity against the tether;
//! - weight in water across the axis;
//! - `-M` times the acceleration of the axis, s/L of that of the attachment.
//!
//! End springs are at rest where the tether is vertical at the anchor, and upright in the structure at its other end.

use super::axis::{Attachment, Axis, tilt};
use super::tension::{Axial, Tension};
use super::tether::{Constraint, InstalledTether, RIGID};
use crate::model::ClassError;
use crate::tether::banded::{Banded, Factors};
use crate::tether::beam::{self, Vector4};
use crate::tether::structure::flow::FlowAt;
use nalgebra::Vector3;

/// How far a stage looks ahead with the stiffness (seed 003, 3.6: the best of its tests).
pub const LOOK_AHEAD: f64 = 0.54;
/// Rotational stiffness over 4 EI/L of its element from which on an end is held: it gives way by no more than rounding.
const HELD: f64 = 1e6;
/// Stiffness of an opening's edge over that at which a node's mass would swing in a step: it is soft enough for the step, and gives way by
/// little.
const EDGE: f64 = 10.0;

/// What an element has per length of it, unstretched where it is steel.
#[derive(Clone, Copy, Debug)]
struct Cell {
    length: f64,
    bending: f64,
    /// Wall and what is inside (kg/m), and the water that goes along (kg/m).
    mass: [f64; 2],
    /// The water it displaces and that which goes along (kg/m).
    inertia: f64,
    /// `1/2 rho Cd D`.
    drag: f64,
    /// Weight in water (N/m), unstretched.
    weight: f64,
}

/// Deflections and slopes of a plane.
#[derive(Clone, Debug)]
pub struct Motion {
    /// Deflection (m) and slope (rad) of each node.
    pub place: Vec<f64>,
    /// Their velocities.
    pub velocity: Vec<f64>,
}

/// The matrices of a plane, for its modes.
#[derive(Debug)]
pub struct Matrices {
    /// Bending, tension and springs; what is held has its diagonal alone.
    pub stiffness: Banded,
    /// Mass; what is held has none.
    pub mass: Banded,
    /// Of each element bending stiffness (N m2), tension (N) and length (m).
    pub beams: Vec<[f64; 3]>,
    /// Rotational springs of the ends (N m/rad).
    pub springs: [f64; 2],
}

/// What the axis does at one stage.
#[derive(Clone, Copy, Debug)]
pub struct Stage<'a> {
    /// The axis.
    pub axis: &'a Axis,
    /// Its end at the structure.
    pub attachment: &'a Attachment,
    /// The tension.
    pub tension: &'a Tension,
    /// The water at the stage's time.
    pub water: &'a FlowAt<'a>,
    /// Length of the step (s).
    pub dt: f64,
}

/// One tether across its axis.
#[derive(Clone, Debug)]
pub struct Bending {
    cells: Vec<Cell>,
    /// Unstretched distance of each node from the anchor over the length.
    shares: Vec<f64>,
    length: f64,
    /// Rotational springs by end and plane (N m/rad); those of a held end are zero.
    springs: [[f64; 2]; 2],
    /// Slopes at which the springs are at rest, by end and plane (rad).
    rest: [[f64; 2]; 2],
    /// Unknowns that do not go by their forces, by plane.
    held: [Vec<(usize, Hold)>; 2],
    openings: Vec<(usize, f64)>,
    stiffness: [Banded; 2],
    mass: Banded,
    system: Banded,
    factors: Factors,
    loads: [Vec<Vector4>; 2],
    right: Vec<f64>,
    ahead: Vec<f64>,
    frame: Vec<f64>,
    /// At the start of the step, by plane.
    pub now: [Motion; 2],
    /// As predicted for its end.
    pub trial: [Motion; 2],
    /// Acceleration found by the first and by the second stage, by plane.
    pub found: [[Vec<f64>; 2]; 2],
    /// What the openings and the constraints on the structure did at the last stage: force (N) on the structure with its place (m, global).
    pub pushes: Vec<(Vector3<f64>, Vector3<f64>)>,
}

/// What an unknown is held to.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Hold {
    /// The axis: an end.
    Axis,
    /// A place across, vertical over the anchor.
    Fixed,
    /// The middle of an opening.
    Opening,
    /// The vertical.
    Vertical,
    /// The structure's upright axis.
    Upright,
}

impl Bending {
    /// That of a tether in water of a density (kg/m3) under a gravity (m/s2), straight and at rest.
    pub fn of(tether: &InstalledTether, density: f64, gravity: f64) -> Self {
        let line = &tether.line;
        let cell = |e: &crate::tether::TetherElement| {
            let tube = e.tube();
            let displaced = density * tube.external_area();
            let mass = e.mass_per_length() + tether.fluid.density * tube.internal_area();
            Cell {
                length: e.length,
                bending: e.bending_stiffness(),
                mass: [mass, displaced * e.added_mass],
                inertia: displaced * (1.0 + e.added_mass),
                drag: 0.5 * density * e.drag * e.outer_diameter,
                weight: (mass - displaced) * gravity,
            }
        };
        let cells: Vec<Cell> = line.elements().iter().map(cell).collect();
        let order = 2 * line.nodes();
        let mut held = [vec![(0, Hold::Axis)], vec![(0, Hold::Axis)]];
        let mut springs = [tether.anchor_springs, tether.vessel_springs].map(|s| [s.rotation[1], s.rotation[0]]);
        let stiff = |cell: Option<&Cell>| cell.map_or(RIGID, |c| 4.0 * c.bending / c.length) * HELD;
        let limits = [stiff(cells.first()), stiff(cells.last())];
        for plane in 0..2 {
            held[plane].push((order - 2, Hold::Axis));
            for (end, limit) in limits.iter().enumerate() {
                if springs[end][plane] >= *limit {
                    springs[end][plane] = 0.0;
                    held[plane].push(if end == 0 { (1, Hold::Vertical) } else { (order - 1, Hold::Upright) });
                }
            }
        }
        let mut openings = Vec::new();
        for constraint in &tether.constraints {
            let at = 2 * constraint.node();
            let hold = match constraint {
                Constraint::FixedLateral { .. } => (at, Hold::Fixed),
                Constraint::FixedRotation { .. } => (at + 1, Hold::Vertical),
                Constraint::VesselRotation { .. } => (at + 1, Hold::Upright),
                Constraint::VesselLateral { gap: 0.0, .. } => (at, Hold::Opening),
                Constraint::VesselLateral { gap, .. } => {
                    openings.push((at, *gap));
                    continue;
                }
            };
            held.iter_mut().filter(|list| !list.iter().any(|h| h.0 == hold.0)).for_each(|list| list.push(hold));
        }
        let zeros = || vec![0.0; order];
        let rest = || Motion { place: zeros(), velocity: zeros() };
        let length = line.length();
        Bending {
            shares: line.distances().iter().map(|s| s / length).collect(),
            length,
            springs,
            rest: [[0.0; 2]; 2],
            held,
            pushes: Vec::with_capacity(2 * tether.constraints.len()),
            openings,
            stiffness: [Banded::zeros(order), Banded::zeros(order)],
            mass: Banded::zeros(order),
            system: Banded::zeros(order),
            factors: Factors::with_room(order),
            loads: [vec![[0.0; 4]; cells.len()], vec![[0.0; 4]; cells.len()]],
            right: zeros(),
            ahead: zeros(),
            frame: zeros(),
            now: [rest(), rest()],
            trial: [rest(), rest()],
            found: [[zeros(), zeros()], [zeros(), zeros()]],
            cells,
        }
    }

    /// The matrices of a plane in a tension.
    pub fn matrices(&self, plane: usize, tension: &Tension, axial: &Axial) -> Matrices {
        let (order, stretch) = (self.mass.order(), tension.length / self.length);
        let (mut stiffness, mut mass) = (Banded::zeros(order), Banded::zeros(order));
        let mut beams = Vec::with_capacity(self.cells.len());
        for (index, cell) in self.cells.iter().enumerate() {
            let (length, pull) = (cell.length * stretch, axial.middle(index, tension));
            beam::assemble(&mut stiffness, index, 1.0, &beam::stiffness(cell.bending, length));
            beam::assemble(&mut stiffness, index, 1.0, &beam::geometric(pull, length));
            beam::assemble(&mut mass, index, 1.0, &beam::mass(cell.mass[0] / stretch + cell.mass[1], length));
            beams.push([cell.bending, pull, length]);
        }
        let springs = [0, 1].map(|end| self.springs[end][plane]);
        stiffness.add(1, 1, springs[0]);
        stiffness.add(order - 1, order - 1, springs[1]);
        for (unknown, _) in &self.held[plane] {
            stiffness.hold(*unknown, 1.0);
            mass.hold(*unknown, 0.0);
        }
        Matrices { stiffness, mass, beams, springs }
    }

    /// How much longer the tether is than its axis (m): `1/2 int w'^2 ds` with the cubic of each element, of a length altogether (m).
    pub fn arc(&self, motion: &[Motion; 2], length: f64) -> f64 {
        let stretch = length / self.length;
        let of = |(index, cell): (usize, &Cell)| -> f64 {
            let part =
                |m: &Motion| beam::twice_energy(0.0, 1.0, cell.length * stretch, &beam::of_element(&m.place, index));
            0.5 * motion.iter().map(part).sum::<f64>()
        };
        self.cells.iter().enumerate().map(of).sum()
    }

    /// Takes the springs of the ends for at rest along an axis, the structure standing as it does.
    pub fn rest_along(&mut self, axis: &Axis, upright: Vector3<f64>) {
        let vessel = tilt(upright);
        self.rest = [axis.tilt, [0, 1].map(|p| axis.tilt[p] - vessel[p])];
    }

    /// Puts what is held where it is held, at the start of a step.
    pub fn place_held(&mut self, stage: &Stage) {
        for plane in 0..2 {
            for index in 0..self.held[plane].len() {
                let (unknown, hold) = self.held[plane][index];
                let [place, velocity, _] = self.target(unknown, hold, plane, stage);
                self.now[plane].place[unknown] = place;
                self.now[plane].velocity[unknown] = velocity;
            }
        }
    }

    /// What an unknown is held to: place, velocity and acceleration in the moving axis.
    fn target(&self, unknown: usize, hold: Hold, plane: usize, stage: &Stage) -> [f64; 3] {
        let Stage { axis, attachment, tension, .. } = stage;
        let parts = |v: Vector3<f64>| axis.parts(v)[plane];
        let [rate, growth] =
            [parts(attachment.velocity) / tension.length, parts(attachment.acceleration) / tension.length];
        let share = self.shares.get(unknown / 2).copied().unwrap_or_default();
        // the springs' rest counts at the ends alone
        let last = self.right.len() - 1;
        let rest = |end: usize| if unknown == [1, last][end] { self.rest[end][plane] } else { 0.0 };
        let turn = |v: Vector3<f64>| if plane == 0 { v.y } else { -v.x };
        match hold {
            Hold::Axis => [0.0; 3],
            Hold::Vertical => [rest(0) - axis.tilt[plane], -rate, -growth],
            Hold::Upright => {
                let [spin, change] = attachment.spin;
                let place = rest(1) + tilt(attachment.upright)[plane] - axis.tilt[plane];
                [place, turn(spin) - rate, turn(change) - growth]
            }
            Hold::Fixed => {
                let at = anchor(stage) + Vector3::z() * (share * tension.length);
                let [here, speed, change] = self.on_axis(share, stage);
                [parts(at - here), -parts(speed), -parts(change)]
            }
            Hold::Opening => {
                let [at, velocity, acceleration] = self.opening(share, stage);
                let [here, speed, change] = self.on_axis(share, stage);
                [parts(at - here), parts(velocity - speed), parts(acceleration - change)]
            }
        }
    }

    /// A point of the axis: place, velocity, acceleration (global).
    fn on_axis(&self, share: f64, stage: &Stage) -> [Vector3<f64>; 3] {
        let end = stage.attachment;
        let at = end.at - stage.axis.along * ((1.0 - share) * stage.tension.length);
        [at, end.velocity * share, end.acceleration * share]
    }

    /// The middle of an opening of the structure: place, velocity, acceleration (global).
    fn opening(&self, share: f64, stage: &Stage) -> [Vector3<f64>; 3] {
        let end = stage.attachment;
        let arm = -end.upright * ((1.0 - share) * stage.tension.length);
        let [spin, change] = end.spin;
        let turning = spin.cross(&arm);
        [end.at + arm, end.velocity + turning, end.acceleration + change.cross(&arm) + spin.cross(&turning)]
    }

    /// Matrices and loads of a stage, with the deflected place at that stage.
    fn gather(&mut self, second: bool, stage: &Stage, axial: &Axial) {
        let stretch = stage.tension.length / self.length;
        self.stiffness.iter_mut().for_each(Banded::clear);
        self.mass.clear();
        let motion = if second { &self.trial } else { &self.now };
        for (index, cell) in self.cells.iter().enumerate() {
            let length = cell.length * stretch;
            let pull = axial.middle(index, stage.tension);
            for matrix in &mut self.stiffness {
                beam::assemble(matrix, index, 1.0, &beam::stiffness(cell.bending, length));
                beam::assemble(matrix, index, 1.0, &beam::geometric(pull, length));
            }
            beam::assemble(&mut self.mass, index, 1.0, &beam::mass(cell.mass[0] / stretch + cell.mass[1], length));
            let start = self.shares.get(index).copied().unwrap_or_default();
            let [x, y] = &mut self.loads;
            let (Some(x), Some(y)) = (x.get_mut(index), y.get_mut(index)) else { continue };
            (*x, *y) = ([0.0; 4], [0.0; 4]);
            let places = [0, 1].map(|p| beam::of_element(&motion[p].place, index));
            let speeds = [0, 1].map(|p| beam::of_element(&motion[p].velocity, index));
            let share = cell.length / self.length;
            for (a, weight) in beam::GAUSS {
                let shape = beam::deflection(a, length);
                let [w, dw] = [&places, &speeds].map(|of| [beam::dot(&of[0], &shape), beam::dot(&of[1], &shape)]);
                let force = cell.force(start + a * share, [w, dw], stage);
                beam::add(x, weight * length * (force[0] - cell.weight / stretch * stage.axis.across[0].z), &shape);
                beam::add(y, weight * length * (force[1] - cell.weight / stretch * stage.axis.across[1].z), &shape);
            }
        }
    }

    /// Finds the accelerations of a stage; those of the first also predict the end of the step.
    ///
    /// # Errors
    /// A matrix that is not positive (a tether that buckles on its lower stop within the step), or a load without a value.
    pub fn stage(&mut self, second: bool, stage: &Stage, axial: &Axial) -> Result<(), ClassError> {
        self.gather(second, stage, axial);
        self.pushes.clear();
        let last = self.right.len() - 1;
        let vessel = tilt(stage.attachment.upright);
        let dt = stage.dt;
        let implicit = 0.5 * LOOK_AHEAD * dt * dt;
        for plane in 0..2 {
            self.frame_acceleration(plane, stage);
            self.mass.times(&self.frame, &mut self.right);
            self.right.iter_mut().for_each(|r| *r = -*r);
            for (index, loads) in self.loads[plane].iter().enumerate() {
                beam::gather(&mut self.right, index, loads);
            }
            let lean = stage.axis.tilt[plane];
            for (end, unknown, against) in [(0, 1, lean), (1, last, lean - vessel[plane])] {
                let spring = self.springs[end][plane];
                self.stiffness[plane].add(unknown, unknown, spring);
                self.right[unknown] -= spring * (against - self.rest[end][plane]);
            }
            self.edges(second, plane, stage);
            let now = &self.now[plane];
            for (ahead, (x, v)) in self.ahead.iter_mut().zip(now.place.iter().zip(&now.velocity)) {
                *ahead = x + LOOK_AHEAD * dt * v;
            }
            // the frame's work space is free again
            self.stiffness[plane].times(&self.ahead, &mut self.frame);
            self.right.iter_mut().zip(&self.frame).for_each(|(r, k)| *r -= k);
            self.system.clear();
            self.system.add_scaled(1.0, &self.mass);
            self.system.add_scaled(implicit, &self.stiffness[plane]);
            self.hold(plane, stage);
            self.system.factor_into(&mut self.factors)?;
            self.factors.solve(&mut self.right);
            if !self.right.iter().all(|a| a.is_finite()) {
                return Err(ClassError::new("its acceleration has no value"));
            }
            self.found[usize::from(second)][plane].copy_from_slice(&self.right);
            self.react(plane, stage, implicit);
        }
        if !second {
            for plane in 0..2 {
                let (now, ahead) = (&self.now[plane], &mut self.trial[plane]);
                for (i, a) in self.found[0][plane].iter().enumerate() {
                    ahead.velocity[i] = now.velocity[i] + a * dt;
                    ahead.place[i] = now.place[i] + 0.5 * (now.velocity[i] + ahead.velocity[i]) * dt;
                }
            }
        }
        Ok(())
    }

    /// The acceleration of the axis at the nodes.
    fn frame_acceleration(&mut self, plane: usize, stage: &Stage) {
        let end = stage.axis.parts(stage.attachment.acceleration)[plane];
        for (node, share) in self.frame.chunks_exact_mut(2).zip(&self.shares) {
            node[0] = share * end;
            node[1] = end / stage.tension.length;
        }
    }

    /// The edge of each opening that a node is at, as a spring.
    fn edges(&mut self, second: bool, plane: usize, stage: &Stage) {
        for index in 0..self.openings.len() {
            let (unknown, gap) = self.openings[index];
            let motion = if second { &self.trial } else { &self.now };
            let share = self.shares.get(unknown / 2).copied().unwrap_or_default();
            let [here, ..] = self.on_axis(share, stage);
            let [middle, ..] = self.opening(share, stage);
            let middle = stage.axis.parts(middle - here);
            let off = [0, 1].map(|p| motion[p].place[unknown] - middle[p]);
            let far = off[0].hypot(off[1]);
            if far <= gap {
                continue;
            }
            let spring = EDGE * self.mass.get(unknown, unknown) / (stage.dt * stage.dt);
            let edge = middle[plane] + off[plane] * (gap / far);
            self.stiffness[plane].add(unknown, unknown, spring);
            self.right[unknown] += spring * edge;
            let push = stage.axis.across[plane] * (spring * (motion[plane].place[unknown] - edge));
            self.pushes.push((push, here + middle[0] * stage.axis.across[0] + middle[1] * stage.axis.across[1]));
        }
    }

    /// Gives what is held its acceleration.
    fn hold(&mut self, plane: usize, stage: &Stage) {
        for index in 0..self.held[plane].len() {
            let (unknown, hold) = self.held[plane][index];
            let [_, _, acceleration] = self.target(unknown, hold, plane, stage);
            if acceleration != 0.0 {
                let reach = unknown.saturating_sub(3)..(unknown + 4).min(self.right.len());
                for other in reach.filter(|other| *other != unknown) {
                    self.right[other] -= self.system.get(other.max(unknown), other.min(unknown)) * acceleration;
                }
            }
            self.system.hold(unknown, 1.0);
            self.right[unknown] = acceleration;
        }
    }

    /// What the constraints on the structure do to it, by what is missing in the balance of the unknowns they hold.
    fn react(&mut self, plane: usize, stage: &Stage, implicit: f64) {
        if !self.held[plane].iter().any(|h| h.1 == Hold::Opening) {
            return;
        }
        self.frame_acceleration(plane, stage);
        for (frame, a) in self.frame.iter_mut().zip(&self.right) {
            *frame += a;
        }
        for (ahead, a) in self.ahead.iter_mut().zip(&self.right) {
            *ahead += implicit * a;
        }
        for index in 0..self.held[plane].len() {
            let (unknown, hold) = self.held[plane][index];
            if hold != Hold::Opening {
                continue;
            }
            let reach = unknown.saturating_sub(3)..(unknown + 4).min(self.right.len());
            let mut push = 0.0;
            for other in reach {
                let (row, column) = (other.max(unknown), other.min(unknown));
                push += self.mass.get(row, column) * self.frame[other];
                push += self.stiffness[plane].get(row, column) * self.ahead[other];
            }
            let element = unknown / 2;
            let load = |e: Option<usize>, i: usize| e.and_then(|e| self.loads[plane].get(e)).map_or(0.0, |l| l[i]);
            push -= load(Some(element), 0) + load(element.checked_sub(1), 2);
            let share = self.shares.get(element).copied().unwrap_or_default();
            let [at, ..] = self.opening(share, stage);
            self.pushes.push((stage.axis.across[plane] * -push, at));
        }
    }

    /// What each end of an element bears at a stage, by plane: force across and moment of its slope on it, `K x + M a - F` with the place that
    /// the stage looks ahead to, so that those of two elements at a node balance.
    pub fn end_loads(&self, element: usize, second: bool, stage: &Stage, axial: &Axial) -> [Vector4; 2] {
        let Some(cell) = self.cells.get(element) else { return [[0.0; 4]; 2] };
        let stretch = stage.tension.length / self.length;
        let length = cell.length * stretch;
        let mass = beam::mass(cell.mass[0] / stretch + cell.mass[1], length);
        let (bends, pulls) =
            (beam::stiffness(cell.bending, length), beam::geometric(axial.middle(element, stage.tension), length));
        let ends = [element, element + 1].map(|node| self.shares.get(node).copied().unwrap_or_default());
        [0, 1].map(|plane| {
            let end = stage.axis.parts(stage.attachment.acceleration)[plane];
            let turn = end / stage.tension.length;
            let frame = [ends[0] * end, turn, ends[1] * end, turn];
            let a = beam::of_element(&self.found[usize::from(second)][plane], element);
            let x = beam::of_element(&self.now[plane].place, element);
            let v = beam::of_element(&self.now[plane].velocity, element);
            let ahead: Vector4 = std::array::from_fn(|i| x[i] + LOOK_AHEAD * stage.dt * (v[i] + 0.5 * stage.dt * a[i]));
            let all: Vector4 = std::array::from_fn(|i| a[i] + frame[i]);
            let mut sum = beam::times(&bends, &ahead);
            beam::add(&mut sum, 1.0, &beam::times(&pulls, &ahead));
            beam::add(&mut sum, 1.0, &beam::times(&mass, &all));
            beam::add(&mut sum, -1.0, &self.loads[plane].get(element).copied().unwrap_or_default());
            sum
        })
    }

    /// The end of the step: `v' = v + (a1 + a2) h/2`, `x' = x + (v + v') h/2`.
    pub fn advance(&mut self, dt: f64) {
        for plane in 0..2 {
            let [first, second] = [&self.found[0][plane], &self.found[1][plane]];
            let Motion { place, velocity } = &mut self.now[plane];
            for (i, (a, b)) in first.iter().zip(second).enumerate() {
                let before = velocity[i];
                velocity[i] += 0.5 * (a + b) * dt;
                place[i] += 0.5 * (before + velocity[i]) * dt;
            }
        }
    }

    /// What the structure bears across the axis, by plane (N): stiffness times place less the load at the top, of bending and tension, so that
    /// it is exact at rest. The load is that of the stage before, and the inertia of half an element is left out.
    pub fn top_shear(&self, motion: &[Motion; 2], tension: &Tension, axial: &Axial) -> [f64; 2] {
        let last = self.cells.len().saturating_sub(1);
        let Some(cell) = self.cells.get(last) else { return [0.0; 2] };
        let length = cell.length * tension.length / self.length;
        let (bends, pulls) =
            (beam::stiffness(cell.bending, length), beam::geometric(axial.middle(last, tension), length));
        [0, 1].map(|plane| {
            let x = beam::of_element(&motion[plane].place, last);
            let load = self.loads[plane].get(last).map_or(0.0, |l| l[2]);
            beam::dot(&bends[2], &x) + beam::dot(&pulls[2], &x) - load
        })
    }

    /// Slopes at the structure by plane (rad).
    pub fn top_slopes(&self, motion: &[Motion; 2]) -> [f64; 2] {
        [0, 1].map(|p| motion[p].place.last().copied().unwrap_or_default())
    }

    /// What the coil at the structure does to it by plane (N m), against the slope.
    pub fn coil(&self, motion: &[Motion; 2], axis: &Axis, upright: Vector3<f64>) -> [f64; 2] {
        let (slopes, vessel) = (self.top_slopes(motion), tilt(upright));
        [0, 1].map(|p| self.springs[1][p] * (slopes[p] + axis.tilt[p] - vessel[p] - self.rest[1][p]))
    }
}

/// The anchor of a stage's axis.
fn anchor(stage: &Stage) -> Vector3<f64> {
    stage.attachment.at - stage.axis.along * stage.axis.chord
}

impl Cell {
    /// What the water does across the axis to a length of the tether, at a share of it, with a deflection and its velocity by plane.
    fn force(&self, share: f64, [w, dw]: [[f64; 2]; 2], stage: &Stage) -> [f64; 2] {
        let axis = stage.axis;
        let at = stage.attachment.at - axis.along * ((1.0 - share) * stage.tension.length)
            + axis.across[0] * w[0]
            + axis.across[1] * w[1];
        let found = stage.water.kinematics(at);
        let [u, a] = [axis.parts(found.velocity - stage.attachment.velocity * share), axis.parts(found.acceleration)];
        let relative = [u[0] - dw[0], u[1] - dw[1]];
        let speed = relative[0].hypot(relative[1]);
        [0, 1].map(|p| self.inertia * a[p] + self.drag * speed * relative[p])
    }
}
