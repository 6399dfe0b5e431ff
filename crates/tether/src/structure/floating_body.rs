//! A body of the model as the structure of tethers: hull, members, hydrodynamic database, wind and current as the hydrodynamic floor has them.

use super::flow::FlowAt;
use super::{Structure, StructureForces};
use nalgebra::{Matrix3, Matrix6, Vector3};
use windlass_base::pose::{Pose, Six};
use windlass_hydro::{BodyLoad, BodyStep, Category, Floating, in_pose, move_stiffness, move_wrench};
use windlass_model::ClassError;

/// A body with its loads, about its centre of gravity.
#[derive(Debug)]
pub struct Afloat {
    loads: Vec<Box<dyn BodyLoad>>,
    /// What each load remembers.
    states: Vec<Vec<f64>>,
    /// The centre of gravity in the axes of the body (m).
    centre: Vector3<f64>,
    /// Mass and added mass about the centre of gravity, axes of the body.
    inertia: Matrix6<f64>,
    /// Moments of inertia of its own mass about the centre of gravity, axes of the body (kg m2).
    turning: Matrix3<f64>,
    /// Linear damping about the centre of gravity, axes of the body.
    damping: Matrix6<f64>,
}

impl Afloat {
    /// A body under way ([`Floating::under_way`]), whose sea should be that of the tethers' water.
    ///
    /// # Errors
    /// A body without mass.
    pub fn new(floating: Floating) -> Result<Self, ClassError> {
        let Floating { mass, loads, added_mass, damping } = floating;
        if mass.mass <= 0.0 {
            return Err(ClassError::new("the structure that the tethers hold has no mass"));
        }
        let centre = mass.centre;
        let about = |matrix: &Matrix6<f64>| move_stiffness(matrix, -centre, -centre);
        let outer = centre * centre.transpose();
        let turning = mass.inertia - (Matrix3::identity() * centre.norm_squared() - outer) * mass.mass;
        let mut own = Matrix6::identity() * mass.mass;
        own.fixed_view_mut::<3, 3>(3, 3).copy_from(&turning);
        let states = loads.iter().map(|load| vec![0.0; load.as_stateful().map_or(0, |stateful| stateful.states())]);
        Ok(Afloat {
            states: states.collect(),
            loads,
            centre,
            inertia: own + about(&added_mass),
            turning,
            damping: about(&damping),
        })
    }

    /// The centre of gravity in the axes of the body (m).
    pub fn centre(&self) -> Vector3<f64> {
        self.centre
    }
}

impl Structure for Afloat {
    fn forces(
        &mut self,
        at: &BodyStep,
        _: &FlowAt,
        accepted: bool,
        out: &mut StructureForces,
    ) -> Result<(), ClassError> {
        let mooring = out.mooring;
        *out = StructureForces { mooring, ..StructureForces::default() };
        let arm = at.pose.axes * self.centre;
        let spin = Vector3::new(at.velocity[3], at.velocity[4], at.velocity[5]);
        let origin = Pose { origin: at.pose.origin - arm, axes: at.pose.axes };
        let mut moves = *at.velocity;
        let turning = spin.cross(&arm);
        for i in 0..3 {
            moves[i] -= turning[i];
        }
        let own = BodyStep { pose: &origin, velocity: &moves, ..*at };
        out.inertia = in_pose(&self.inertia, at.pose);
        for (load, state) in self.loads.iter().zip(&mut self.states) {
            let stateful = load.as_stateful();
            if let Some(stateful) = stateful {
                stateful.begin(&own, state)?;
            }
            let wrench = move_wrench(&load.dynamic_load(&own, state)?.load.wrench, -arm);
            if let Some(more) = load.as_inertial().map(|inertial| inertial.inertia(state)) {
                out.inertia += move_stiffness(&more, -arm, -arm);
            }
            match load.category() {
                Category::Weight => out.gravity += wrench,
                Category::Buoyancy => out.hydrostatic += wrench,
                _ => out.floating += wrench,
            }
            if let Some(stateful) = stateful.filter(|_| accepted) {
                stateful.commit(&own, state);
            }
        }
        out.floating -= in_pose(&self.damping, at.pose) * at.velocity;
        let axes = at.pose.axes;
        let turned: Vector3<f64> = axes * self.turning * axes.transpose() * spin;
        let gyroscopic = -spin.cross(&turned);
        out.gyroscopic = Six::new(0.0, 0.0, 0.0, gyroscopic.x, gyroscopic.y, gyroscopic.z);
        Ok(())
    }

    fn memory(&self) -> Vec<f64> {
        self.states.iter().flatten().copied().collect()
    }

    fn remember(&mut self, numbers: &[f64]) -> bool {
        let mut rest = numbers.iter();
        for (value, number) in self.states.iter_mut().flatten().zip(&mut rest) {
            *value = *number;
        }
        numbers.len() == self.states.iter().map(Vec::len).sum::<usize>()
    }
}
