//! Motion of one installed tether across its axis, in both planes, by the two stages of the manual [AQWA-TETHER 3.6].
//!
//! The axis moves with the attachment: unknowns are deflections from it and slopes against it, none at the ends. With the place x, the
//! velocity v and the step h each stage solves `(M + b h^2/2 K) a = F - K (x + b h v)`; M is consistent with the added mass of a wholly
//! submerged tether, K holds bending, tension (both as the stage finds them) and the springs of the ends, and F, by four Gauss points at the
//! deflected place, is
//! - `rho A (1 + Ca) a_n` of the water's acceleration, and drag `1/2 rho Cd D |u_r| u_r` of its velocity against the tether;
//! - weight in water across the axis;
//! - `-M` times the acceleration of the axis, s/L of that of the attachment.
//!
//! The tension of a taut tether goes with its arc, `1/2 int w'^2`: a node that is held to one side of the axis has slopes in which a small
//! deflection stretches the tether, stiffer than bending and tension by far. Of tethers with such a node each stage therefore finds the tension
//! where it looks ahead, too: `k g g^T` joins K, with k the axial stiffness and g the slope of the arc by the unknowns, by a correction of rank one.
//!
//! End springs are at rest where the tether is vertical at the anchor, and upright in the structure at its other end.

mod constraints;
mod ends;

use super::axis::{AxisAttachment, TetherAxis, tilt};
use super::tension::{TensionCase, TensionModel, TetherTension};
use super::tether::{InstalledTether, NodeConstraint, RIGID_STIFFNESS};
use crate::beam::{self, PlaneMatrix, Vector4};
use crate::structure::flow::FlowAt;
use constraints::DofConstraint;
use nalgebra::Vector3;
use windlass_model::ClassError;

/// How far a stage looks ahead with the stiffness ([AQWA-TETHER 3.6]: the best of its tests).
pub const LOOK_AHEAD: f64 = 0.54;
/// Rotational stiffness over 4 EI/L of its element from which on an end is held: it gives way by no more than rounding.
const FIXED_END_STIFFNESS_RATIO: f64 = 1e6;
/// Stiffness of an opening's edge over that at which a node's mass would swing in a step: it is soft enough for the step, and gives way by
/// little.
const OPENING_EDGE_STIFFNESS_RATIO: f64 = 10.0;

/// What an element has per length of it, unstretched where it is steel.
#[derive(Clone, Copy, Debug)]
struct PerLength {
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
pub struct PlaneMotion {
    /// Deflection (m) and slope (rad) of each node.
    pub deflection: Vec<f64>,
    /// Their velocities.
    pub velocity: Vec<f64>,
}

/// The matrices of a plane, for its modes.
#[derive(Debug)]
pub struct PlaneMatrices {
    /// Bending, tension and springs; what is held has its diagonal alone.
    pub stiffness: PlaneMatrix,
    /// Mass; what is held has none.
    pub mass: PlaneMatrix,
    /// Of each element bending stiffness (N m2), tension (N) and length (m).
    pub beams: Vec<[f64; 3]>,
    /// Rotational springs of the ends (N m/rad).
    pub springs: [f64; 2],
}

/// What the axis does at one stage.
#[derive(Clone, Copy, Debug)]
pub struct Stage<'a> {
    /// The axis.
    pub axis: &'a TetherAxis,
    /// Its end at the structure.
    pub attachment: &'a AxisAttachment,
    /// The tension.
    pub tension: &'a TetherTension,
    /// The water at the stage's time.
    pub water: &'a FlowAt<'a>,
    /// Length of the step (s).
    pub dt: f64,
}

/// One tether across its axis.
#[derive(Clone, Debug)]
pub struct Bending {
    cells: Vec<PerLength>,
    /// Unstretched distance of each node from the anchor over the length.
    shares: Vec<f64>,
    length: f64,
    /// Rotational springs by end and plane (N m/rad); those of a held end are zero.
    springs: [[f64; 2]; 2],
    /// Slopes at which the springs are at rest, by end and plane (rad).
    rest: [[f64; 2]; 2],
    /// Unknowns that do not go by their forces, by plane.
    held: [Vec<(usize, DofConstraint)>; 2],
    openings: Vec<(usize, f64)>,
    /// Whether a node is held across the axis, so that the tension is looked ahead.
    holds_across: bool,
    /// Axial stiffness at the stage (N/m); zero where the tension does not go with the arc.
    axial: f64,
    /// Slope of the arc by the unknowns at the stage, and the accelerations a force along it makes, by plane.
    arc_slope: [Vec<f64>; 2],
    arc_response: [Vec<f64>; 2],
    /// By how much the tension that each stage looks ahead to exceeds that of its place (N).
    tension_ahead: [f64; 2],
    stiffness: [PlaneMatrix; 2],
    mass: PlaneMatrix,
    system: PlaneMatrix,
    factors: PlaneMatrix,
    loads: [Vec<Vector4>; 2],
    right: Vec<f64>,
    ahead: Vec<f64>,
    frame: Vec<f64>,
    /// At the start of the step, by plane.
    pub now: [PlaneMotion; 2],
    /// As predicted for its end.
    pub trial: [PlaneMotion; 2],
    /// Acceleration found by the first and by the second stage, by plane.
    pub found: [[Vec<f64>; 2]; 2],
    /// What the openings and the constraints on the structure did at the last stage: force (N) on the structure with its place (m, global).
    pub pushes: Vec<(Vector3<f64>, Vector3<f64>)>,
}

impl Bending {
    /// Writes what it remembers from one step to the next: springs at rest, motion, the accelerations found last.
    pub(in crate::installed) fn write(&self, out: &mut Vec<f64>) {
        out.extend(self.rest.iter().flatten());
        for motion in &self.now {
            out.extend(motion.deflection.iter().chain(&motion.velocity));
        }
        out.extend(self.found.iter().flatten().flatten());
    }

    /// Takes it back; what is left of the numbers, or nothing where there are too few.
    pub(in crate::installed) fn take_up<'n>(&mut self, numbers: &'n [f64]) -> Option<&'n [f64]> {
        let mut rest = numbers;
        let mut take = |into: &mut [f64]| -> Option<()> {
            let (own, behind) = rest.split_at_checked(into.len())?;
            into.copy_from_slice(own);
            rest = behind;
            Some(())
        };
        self.rest.iter_mut().try_for_each(|end| take(end))?;
        for motion in &mut self.now {
            take(&mut motion.deflection)?;
            take(&mut motion.velocity)?;
        }
        self.found.iter_mut().flatten().try_for_each(|list| take(list))?;
        Some(rest)
    }

    /// That of a tether in water of a density (kg/m3) under a gravity (m/s2), straight and at rest.
    pub fn new(tether: &InstalledTether, density: f64, gravity: f64) -> Self {
        let line = &tether.line;
        let cell = |e: &crate::TetherElement| {
            let tube = e.tube();
            let displaced = density * tube.external_area();
            let mass = e.mass_per_length() + tether.fluid.density * tube.internal_area();
            PerLength {
                length: e.length,
                bending: e.bending_stiffness(),
                mass: [mass, displaced * e.added_mass],
                inertia: displaced * (1.0 + e.added_mass),
                drag: 0.5 * density * e.drag * e.outer_diameter,
                weight: (mass - displaced) * gravity,
            }
        };
        let cells: Vec<PerLength> = line.elements().iter().map(cell).collect();
        let order = 2 * line.nodes();
        let mut held = [vec![(0, DofConstraint::Axis)], vec![(0, DofConstraint::Axis)]];
        let mut springs = [tether.anchor_springs, tether.vessel_springs].map(|s| [s.rotation[1], s.rotation[0]]);
        let stiff = |cell: Option<&PerLength>| {
            cell.map_or(RIGID_STIFFNESS, |c| 4.0 * c.bending / c.length) * FIXED_END_STIFFNESS_RATIO
        };
        let limits = [stiff(cells.first()), stiff(cells.last())];
        for plane in 0..2 {
            held[plane].push((order - 2, DofConstraint::Axis));
            for (end, limit) in limits.iter().enumerate() {
                if springs[end][plane] >= *limit {
                    springs[end][plane] = 0.0;
                    held[plane].push(if end == 0 {
                        (1, DofConstraint::Vertical)
                    } else {
                        (order - 1, DofConstraint::Upright)
                    });
                }
            }
        }
        let mut openings = Vec::new();
        for constraint in &tether.constraints {
            let at = 2 * constraint.node();
            let hold = match constraint {
                NodeConstraint::FixedLateral { .. } => (at, DofConstraint::Fixed),
                NodeConstraint::FixedRotation { .. } => (at + 1, DofConstraint::Vertical),
                NodeConstraint::VesselRotation { .. } => (at + 1, DofConstraint::Upright),
                NodeConstraint::VesselLateral { gap: 0.0, .. } => (at, DofConstraint::Opening),
                NodeConstraint::VesselLateral { gap, .. } => {
                    openings.push((at, *gap));
                    continue;
                }
            };
            held.iter_mut().filter(|list| !list.iter().any(|h| h.0 == hold.0)).for_each(|list| list.push(hold));
        }
        let zeros = || vec![0.0; order];
        let rest = || PlaneMotion { deflection: zeros(), velocity: zeros() };
        let length = line.length();
        Bending {
            shares: line.distances().iter().map(|s| s / length).collect(),
            length,
            springs,
            rest: [[0.0; 2]; 2],
            held,
            pushes: Vec::with_capacity(2 * tether.constraints.len()),
            openings,
            holds_across: tether
                .constraints
                .iter()
                .any(|c| matches!(c, NodeConstraint::FixedLateral { .. } | NodeConstraint::VesselLateral { .. })),
            axial: 0.0,
            arc_slope: [zeros(), zeros()],
            arc_response: [zeros(), zeros()],
            tension_ahead: [0.0; 2],
            stiffness: [PlaneMatrix::new(order), PlaneMatrix::new(order)],
            mass: PlaneMatrix::new(order),
            system: PlaneMatrix::new(order),
            factors: PlaneMatrix::new(order),
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
    pub fn matrices(&self, plane: usize, tension: &TetherTension, axial: &TensionModel) -> PlaneMatrices {
        let (order, stretch) = (self.mass.order(), tension.length / self.length);
        let (mut stiffness, mut mass) = (PlaneMatrix::new(order), PlaneMatrix::new(order));
        let mut beams = Vec::with_capacity(self.cells.len());
        for (index, cell) in self.cells.iter().enumerate() {
            let (length, pull) = (cell.length * stretch, axial.middle(index, tension));
            beam::assemble(&mut stiffness, index, &beam::stiffness(cell.bending, length));
            beam::assemble(&mut stiffness, index, &beam::geometric(pull, length));
            beam::assemble(&mut mass, index, &beam::mass(cell.mass[0] / stretch + cell.mass[1], length));
            beams.push([cell.bending, pull, length]);
        }
        let springs = [0, 1].map(|end| self.springs[end][plane]);
        stiffness.add(1, 1, springs[0]);
        stiffness.add(order - 1, order - 1, springs[1]);
        for (unknown, _) in &self.held[plane] {
            stiffness.hold(*unknown, 1.0);
            mass.hold(*unknown, 0.0);
        }
        PlaneMatrices { stiffness, mass, beams, springs }
    }

    /// Finds matrices and loads of a stage, with the place and velocity at that stage. The acceleration of the attachment need not be known.
    pub fn gather(&mut self, second: bool, stage: &Stage, axial: &TensionModel) {
        let stretch = stage.tension.length / self.length;
        self.stiffness.iter_mut().for_each(PlaneMatrix::clear);
        self.mass.clear();
        let taut = stage.tension.standing == TensionCase::Taut;
        self.axial = if self.holds_across && taut { axial.stiffness() } else { 0.0 };
        self.arc_slope.iter_mut().for_each(|slope| slope.fill(0.0));
        let motion = if second { &self.trial } else { &self.now };
        for (index, cell) in self.cells.iter().enumerate() {
            let length = cell.length * stretch;
            let pull = axial.middle(index, stage.tension);
            for matrix in &mut self.stiffness {
                beam::assemble(matrix, index, &beam::stiffness(cell.bending, length));
                beam::assemble(matrix, index, &beam::geometric(pull, length));
            }
            beam::assemble(&mut self.mass, index, &beam::mass(cell.mass[0] / stretch + cell.mass[1], length));
            let start = self.shares[index];
            let [x, y] = &mut self.loads;
            let (Some(x), Some(y)) = (x.get_mut(index), y.get_mut(index)) else { continue };
            (*x, *y) = ([0.0; 4], [0.0; 4]);
            let positions = [0, 1].map(|p| beam::of_element(&motion[p].deflection, index));
            let speeds = [0, 1].map(|p| beam::of_element(&motion[p].velocity, index));
            if self.axial > 0.0 {
                let unit = beam::geometric(1.0, length);
                for (slope, position) in self.arc_slope.iter_mut().zip(&positions) {
                    beam::gather(slope, index, &beam::times(&unit, position));
                }
            }
            let share = cell.length / self.length;
            for (a, weight) in beam::GAUSS {
                let shape = beam::deflection(a, length);
                let [w, dw] = [&positions, &speeds].map(|of| [beam::dot(&of[0], &shape), beam::dot(&of[1], &shape)]);
                let force = cell.force(start + a * share, [w, dw], stage);
                beam::add(x, weight * length * (force[0] - cell.weight / stretch * stage.axis.across[0].z), &shape);
                beam::add(y, weight * length * (force[1] - cell.weight / stretch * stage.axis.across[1].z), &shape);
            }
        }
    }

    /// Finds the accelerations of a stage that is gathered; those of the first also predict the end of the step.
    ///
    /// # Errors
    /// A matrix that is not positive (a tether that buckles on its lower stop within the step), or a load without a value.
    pub fn stage(&mut self, second: bool, stage: &Stage) -> Result<(), ClassError> {
        self.pushes.clear();
        let last = self.right.len() - 1;
        let dt = stage.dt;
        let implicit = 0.5 * LOOK_AHEAD * dt * dt;
        for (plane, vessel) in tilt(stage.attachment.upright).into_iter().enumerate() {
            self.frame_acceleration(plane, stage);
            self.mass.times(&self.frame, &mut self.right);
            self.right.iter_mut().for_each(|r| *r = -*r);
            for (index, loads) in self.loads[plane].iter().enumerate() {
                beam::gather(&mut self.right, index, loads);
            }
            let lean = stage.axis.tilt[plane];
            for (end, unknown, against) in [(0, 1, lean), (1, last, lean - vessel)] {
                let spring = self.springs[end][plane];
                self.stiffness[plane].add(unknown, unknown, spring);
                self.right[unknown] -= spring * (against - self.rest[end][plane]);
            }
            self.edges(second, plane, stage);
            let now = &self.now[plane];
            for (ahead, (x, v)) in self.ahead.iter_mut().zip(now.deflection.iter().zip(&now.velocity)) {
                *ahead = x + LOOK_AHEAD * dt * v;
            }
            // the frame's work space is free again
            self.stiffness[plane].times(&self.ahead, &mut self.frame);
            self.right.iter_mut().zip(&self.frame).for_each(|(r, k)| *r -= k);
            self.system.clear();
            self.system.add_scaled(1.0, &self.mass);
            self.system.add_scaled(implicit, &self.stiffness[plane]);
            self.hold(plane, stage);
            beam::factor(&self.system, &mut self.factors)?;
            self.factors.solve(&mut self.right);
            self.found[usize::from(second)][plane].copy_from_slice(&self.right);
            if self.axial > 0.0 {
                let response = &mut self.arc_response[plane];
                response.copy_from_slice(&self.arc_slope[plane]);
                self.held[plane].iter().for_each(|(unknown, _)| response[*unknown] = 0.0);
                self.factors.solve(response);
            }
        }
        self.look_ahead_with_tension(second, dt);
        if !self.found[usize::from(second)].iter().flatten().all(|a| a.is_finite()) {
            return Err(ClassError::new("its acceleration has no value")
                .help("a shorter time step may do: its motion across the axis grew from step to step"));
        }
        for plane in 0..2 {
            self.react(second, plane, stage);
        }
        if !second {
            for plane in 0..2 {
                let (now, ahead) = (&self.now[plane], &mut self.trial[plane]);
                for (i, a) in self.found[0][plane].iter().enumerate() {
                    ahead.velocity[i] = now.velocity[i] + a * dt;
                    ahead.deflection[i] = now.deflection[i] + 0.5 * (now.velocity[i] + ahead.velocity[i]) * dt;
                }
            }
        }
        Ok(())
    }

    /// Takes the tension that the stage looks ahead to into its accelerations: with the slope g of the arc, its response `y = S^-1 g` and the
    /// accelerations a without it, `a - y (r + c k g.a)/(1 + c k g.y)`, r being what the arc grows by anyway.
    fn look_ahead_with_tension(&mut self, second: bool, dt: f64) {
        let stage = usize::from(second);
        self.tension_ahead[stage] = 0.0;
        if self.axial == 0.0 {
            return;
        }
        let implicit = 0.5 * LOOK_AHEAD * dt * dt;
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let (mut growth, mut driven, mut yielding) = (0.0, 0.0, 0.0);
        for plane in 0..2 {
            let (slope, now) = (&self.arc_slope[plane], &self.now[plane]);
            let positions = if second { &self.trial[plane].deflection } else { &now.deflection };
            let ahead = now.deflection.iter().zip(&now.velocity).map(|(x, v)| x + LOOK_AHEAD * dt * v);
            growth += slope
                .iter()
                .zip(ahead.zip(positions))
                .map(|(g, (ahead, position))| g * (ahead - position))
                .sum::<f64>();
            driven += dot(slope, &self.found[stage][plane]);
            yielding += dot(slope, &self.arc_response[plane]);
        }
        let more = self.axial * (growth + implicit * driven) / (1.0 + implicit * self.axial * yielding);
        for (found, response) in self.found[stage].iter_mut().zip(&self.arc_response) {
            found.iter_mut().zip(response).for_each(|(a, y)| *a -= more * y);
        }
        self.tension_ahead[stage] = more;
    }

    /// The acceleration of the axis at the nodes.
    fn frame_acceleration(&mut self, plane: usize, stage: &Stage) {
        let end = stage.axis.parts(stage.attachment.acceleration)[plane];
        for (node, share) in self.frame.chunks_exact_mut(2).zip(&self.shares) {
            node[0] = share * end;
            node[1] = end / stage.tension.length;
        }
    }

    /// The end of the step: `v' = v + (a1 + a2) h/2`, `x' = x + (v + v') h/2`.
    pub fn advance(&mut self, dt: f64) {
        for plane in 0..2 {
            let [first, second] = [&self.found[0][plane], &self.found[1][plane]];
            let PlaneMotion { deflection, velocity } = &mut self.now[plane];
            for (i, (a, b)) in first.iter().zip(second).enumerate() {
                let before = velocity[i];
                velocity[i] += 0.5 * (a + b) * dt;
                deflection[i] += 0.5 * (before + velocity[i]) * dt;
            }
        }
    }
}

impl PerLength {
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
