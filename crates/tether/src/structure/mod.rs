//! The structure that installed tethers hold: what acts on it besides them, and its inertia.
//!
//! A structure is asked for its forces at a time, a place and a velocity ([`Structure`]). [`tubes::Tubes`] is one of round members under
//! Morison's formula, as the tension leg platform of [AQWA-TETHER 8.2]; [`floating_body::Afloat`] takes what the hydrodynamic floor makes of a body of
//! the model, so that hulls and hydrodynamic databases serve.

pub mod floating_body;
pub mod flow;
mod submergence;
pub mod tubes;
pub mod wave;

use flow::FlowAt;
use nalgebra::Matrix6;
use std::fmt::Debug;
use windlass_base::dense::{Cholesky, never};
use windlass_base::pose::Six;
use windlass_hydro::BodyStep;
use windlass_model::ClassError;

/// Forces (N) and moments (N m) about the centre of gravity, global axes, by what makes them, and the inertia they move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StructureForces {
    /// Weight.
    pub gravity: Six,
    /// Hydrostatic pressure up to the surface as it is.
    pub hydrostatic: Six,
    /// Drag of the water on members, friction along them and Munk's moment in it.
    pub drag: Six,
    /// Pressure of the undisturbed wave.
    pub froude_krylov: Six,
    /// What the acceleration of the water does to the added mass.
    pub wave_inertia: Six,
    /// Waves, radiation, drift, wind and current of a body whose loads come from the hydrodynamic floor.
    pub floating: Six,
    /// What the turning axes add to inertia, as a force.
    pub gyroscopic: Six,
    /// Tethers, mooring lines and other connectors.
    pub mooring: Six,
    /// Inertia with added mass, global axes (kg, kg m, kg m2).
    pub inertia: Matrix6<f64>,
}

impl Default for StructureForces {
    fn default() -> Self {
        let none = Six::zeros();
        StructureForces {
            gravity: none,
            hydrostatic: none,
            drag: none,
            froude_krylov: none,
            wave_inertia: none,
            floating: none,
            gyroscopic: none,
            mooring: none,
            inertia: Matrix6::zeros(),
        }
    }
}

impl StructureForces {
    /// Names of the kinds, in the order of [`StructureForces::kinds`]; the total is the last.
    pub const KINDS: [&'static str; 9] = [
        "GRAVITY",
        "HYDROSTATIC",
        "MORISON DRAG",
        "FROUDE KRYLOV",
        "WAVE INERTIA",
        "DIFFRACTION",
        "GYROSCOPIC",
        "MOORING",
        "TOTAL FORCE",
    ];

    /// Each kind, and the sum of all.
    pub fn kinds(&self) -> [Six; 9] {
        [
            self.gravity,
            self.hydrostatic,
            self.drag,
            self.froude_krylov,
            self.wave_inertia,
            self.floating,
            self.gyroscopic,
            self.mooring,
            self.total(),
        ]
    }

    /// The sum of all.
    pub fn total(&self) -> Six {
        self.gravity
            + self.hydrostatic
            + self.drag
            + self.froude_krylov
            + self.wave_inertia
            + self.floating
            + self.gyroscopic
            + self.mooring
    }

    /// The acceleration of the centre of gravity (m/s2) and of the rotation (rad/s2), global axes.
    ///
    /// # Errors
    /// An inertia that is not positive; forces that are not finite.
    pub fn acceleration(&self) -> Result<Six, ClassError> {
        Cholesky::new(self.inertia, &never).and_then(|factor| factor.solve(&self.total())).map_err(|_| {
            ClassError::new(
                "the structure has no acceleration: its inertia is not positive, or a force on it has no value",
            )
            .help("see its mass and radii, and whether the step is too long")
        })
    }
}

/// A rigid structure.
pub trait Structure: Debug {
    /// What acts on it at a time, its centre of gravity and axes being those of `at.pose` and `at.velocity` that of the centre of gravity.
    /// All of `out` but the mooring is written anew. `accepted` says that this is a state of the history and not the trial of a step's end:
    /// what remembers takes it then, `at.dt` being the step that led there.
    ///
    /// # Errors
    /// A place for which it has no forces.
    fn forces(
        &mut self,
        at: &BodyStep,
        water: &FlowAt,
        accepted: bool,
        out: &mut StructureForces,
    ) -> Result<(), ClassError>;

    /// The actions on it: names, and when they happened (s), where they have.
    fn actions(&self) -> Vec<(String, Option<f64>)> {
        Vec::new()
    }

    /// What it remembers of its history, for a checkpoint.
    fn memory(&self) -> Vec<f64> {
        Vec::new()
    }

    /// Takes back what [`Structure::memory`] gave; whether these are as many numbers as it remembers.
    fn remember(&mut self, numbers: &[f64]) -> bool {
        numbers.is_empty()
    }
}
