//! A towed tether: a chain of tubes on or near the surface, free but for soft springs at its ends, in waves and current.
//!
//! Source: [AQWA-TETHER chapter 3], with the formulas of [W-TOWED], which give the numbers of its listing. Force
//! across the axis per length, with the surface `s` above the axis, on the wet part of the cross section:
//! gravity, buoyancy, Froude-Krylov and wave inertia, drag, slam ([`wet_section`], [`loads`]). Tension is zero (chapter 4). Wave and
//! current act at the deflected place; motions along the axis do not exist.
//!
//! The frame moves with the tow. Water runs past it with the current less the tow, and waves meet it with the encounter
//! frequency `w + k . (current - tow)`; their wave number and their accelerations are those of the frequency `w` in still water.
//!
//! Not in it, as not in the manual: a drag coefficient that goes with the Reynolds number, slam across y, and the forces of
//! added mass that a current along a bent tether makes.

pub mod compatibility;
mod description;
pub mod loads;
pub mod run;
pub mod scheme;
pub mod water;
pub mod wet_section;

use super::beam::{self, Matrix4, PlaneMatrix};
use super::line::TetherLine;
use super::modes::{self, NaturalMode, Pencil};
use windlass_base::units::Dim;
use windlass_hydro::sea::Component;
use windlass_hydro::sea::stokes::Stokes;
use windlass_model::ClassError;

pub use compatibility::TowedCompatibility;
pub use run::{TowedHistory, TowedObserver, TowedRecord, TowedSteps};
use wet_section::SubmergedSection;

/// More waves than this are refused: memory goes with them times the elements.
pub const MAX_WAVES: usize = 10_000;

/// Springs of one end of a towed tether (cards TSPA, TSPV), slack where the tether is straight on its axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EndSpring {
    /// Along the axis (N/m): only the description reports it, nothing moves along the axis.
    pub along: f64,
    /// Along y (N/m).
    pub y: f64,
    /// Along z (N/m).
    pub z: f64,
}

/// Factors on the forces of the water (deck 17: cards DRGM, ADMM, SLMM).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WaterForceMultipliers {
    /// On drag.
    pub drag: f64,
    /// On added mass, and with it on wave inertia and slam.
    pub added_mass: f64,
    /// On slam; 0 leaves it out.
    pub slam: f64,
}

impl Default for WaterForceMultipliers {
    /// Those of the manual: no slam.
    fn default() -> Self {
        WaterForceMultipliers { drag: 1.0, added_mass: 1.0, slam: 0.0 }
    }
}

/// A towed tether in its water.
#[derive(Clone, Debug, PartialEq)]
pub struct Towed {
    /// Its elements from the trailing end.
    pub line: TetherLine,
    /// Place of the trailing end on the straight axis (m); z from the still water level.
    pub origin: [f64; 3],
    /// Direction of the axis toward the vessel (rad from global +X toward +Y). AQWA knows 0 only.
    pub heading: f64,
    /// Springs of the trailing end and of the vessel's.
    pub springs: [EndSpring; 2],
    /// Density of the water (kg/m3).
    pub density: f64,
    /// Gravity (m/s2).
    pub gravity: f64,
    /// Depth (m); `None`: deep.
    pub depth: Option<f64>,
    /// The waves; phases at the global origin.
    pub waves: Vec<Component>,
    /// The Stokes wave that the only one of `waves` stands for: surface, velocities and accelerations are its.
    pub stokes: Option<Stokes>,
    /// Current: height from the still water level (m) and velocity of the water along global X and Y (m/s), heights falling.
    /// Straight between them, and constant above the first and below the last. Empty: none.
    pub current: Vec<(f64, [f64; 2])>,
    /// Velocity of the tow over the ground (m/s), along global X and Y (card TOWS).
    pub tow: [f64; 2],
    /// Factors on the forces of the water.
    pub multipliers: WaterForceMultipliers,
    /// Which program's peculiarities are kept.
    pub compatibility: TowedCompatibility,
}

impl Towed {
    /// Whether it can be reckoned with.
    ///
    /// # Errors
    /// A number that is not finite; a density, gravity, depth, wave frequency or wave number that is not positive; a negative
    /// spring or multiplier; too many waves; current heights that do not fall.
    pub fn check(&self) -> Result<(), ClassError> {
        let fail = |what: &str, value: f64, dim: Dim| {
            Err(ClassError::with_values(format!("the towed tether has {what} of {{}}"), &[(value, dim)]))
        };
        let positive = [
            ("a density of the water", Some(self.density), Dim::None),
            ("a gravity", Some(self.gravity), Dim::None),
            ("a depth of the water", self.depth, Dim::Length),
        ];
        for (what, value, dim) in positive {
            if let Some(value) = value
                && !(value.is_finite() && value > 0.0)
            {
                return fail(what, value, dim);
            }
        }
        let [anchor, vessel] = &self.springs;
        let m = &self.multipliers;
        let not_negative = [
            ("a spring", [anchor.along, anchor.y, anchor.z]),
            ("a spring", [vessel.along, vessel.y, vessel.z]),
            ("a multiplier", [m.drag, m.added_mass, m.slam]),
        ];
        for (what, values) in not_negative {
            for value in values {
                if !(value.is_finite() && value >= 0.0) {
                    return fail(what, value, Dim::None);
                }
            }
        }
        let [x, y, z] = self.origin;
        for value in [x, y, z, self.heading, self.tow[0], self.tow[1]] {
            if !value.is_finite() {
                return fail("a place, heading or tow", value, Dim::None);
            }
        }
        for (height, velocity) in &self.current {
            if ![*height, velocity[0], velocity[1]].iter().all(|v| v.is_finite()) {
                return fail("a current that is not finite at a height", *height, Dim::Length);
            }
        }
        for pair in self.current.windows(2) {
            if pair[1].0 >= pair[0].0 {
                return fail("a current whose heights do not fall, with one", pair[1].0, Dim::Length);
            }
        }
        self.check_waves()
    }

    /// Whether there are such waves.
    fn check_waves(&self) -> Result<(), ClassError> {
        if self.waves.len() > MAX_WAVES {
            let message = format!("{} wave components are more than the {MAX_WAVES} allowed", self.waves.len());
            return Err(ClassError::new(message));
        }
        for (wave, number) in self.waves.iter().zip(1..) {
            let given = [wave.frequency, wave.number, wave.amplitude, wave.phase, wave.toward[0], wave.toward[1]];
            if !(given.iter().all(|v| v.is_finite()) && wave.frequency > 0.0 && wave.number > 0.0) {
                let message =
                    format!("wave component {number} has no positive frequency and wave number, or is not finite");
                return Err(ClassError::new(message));
            }
        }
        if self.stokes.is_some() && self.waves.len() != 1 {
            let message = format!("a Stokes wave is one wave component, and there are {}", self.waves.len());
            return Err(ClassError::new(message));
        }
        Ok(())
    }

    /// What the user should know before a run [AQWA-TETHER 8.1.14]: springs of zero leave the tether a mechanism.
    pub fn warnings(&self) -> Vec<String> {
        let mut found = Vec::new();
        for (end, spring) in ["trailing", "vessel's"].iter().zip(&self.springs) {
            for (axis, value) in [("y", spring.y), ("z", spring.z)] {
                if value == 0.0 {
                    found.push(format!(
                        "the spring of the {end} end of the towed tether along {axis} is zero: nothing holds it there, and \
                         it may drift away; give it a soft spring"
                    ));
                }
            }
        }
        found
    }

    /// Natural modes of both planes on the straight axis in still water, lowest frequency first. Bending, end springs and mass
    /// with that of the water at that depth; buoyancy has no stiffness here, as in the manual.
    ///
    /// # Errors
    /// Those of [`Towed::check`] and [`modes::modes`].
    pub fn modes(&self, number: usize) -> Result<Vec<NaturalMode>, ClassError> {
        let [y, z] = self.of_planes(|pencil| modes::modes(pencil, number))?;
        Ok(modes::together(&y, &z, number))
    }

    /// How many natural modes have a period below [`modes::SHORTEST_PERIOD`].
    ///
    /// # Errors
    /// Those of [`Towed::modes`].
    pub fn count_fast_modes(&self) -> Result<usize, ClassError> {
        let [y, z] = self.of_planes(|pencil| modes::count_below_period(pencil, modes::SHORTEST_PERIOD))?;
        Ok(y + z)
    }

    /// What a function finds in the eigenvalue problem of each plane.
    fn of_planes<T>(&self, find: impl Fn(&Pencil) -> Result<T, ClassError>) -> Result<[T; 2], ClassError> {
        self.check()?;
        let of = |plane: usize| {
            let stiffness = self.stiffness(plane);
            let mass = self.mass_at_rest(plane);
            let energy = |x: &[f64]| self.twice_energy(plane, x);
            find(&Pencil { stiffness: &stiffness, mass: &mass, twice_energy: &energy })
        };
        Ok([of(0)?, of(1)?])
    }

    /// Spring of an end in a plane (0: y, 1: z).
    fn spring(&self, end: usize, plane: usize) -> f64 {
        let spring = &self.springs[end];
        if plane == 0 { spring.y } else { spring.z }
    }

    /// Stiffness of a plane, springs included.
    fn stiffness(&self, plane: usize) -> PlaneMatrix {
        let order = 2 * self.line.nodes();
        let mut k = PlaneMatrix::new(order);
        for (i, e) in self.line.elements().iter().enumerate() {
            beam::assemble(&mut k, i, &beam::stiffness(e.bending_stiffness(), e.length));
        }
        k.add(0, 0, self.spring(0, plane));
        k.add(order - 2, order - 2, self.spring(1, plane));
        k
    }

    /// Twice the energy of a plane, springs included.
    fn twice_energy(&self, plane: usize, x: &[f64]) -> f64 {
        let last = x.len() - 2;
        let springs = self.spring(0, plane) * x[0] * x[0] + self.spring(1, plane) * x[last] * x[last];
        let elements = self.line.elements().iter().enumerate();
        springs
            + elements
                .map(|(i, e)| beam::twice_energy(e.bending_stiffness(), 0.0, e.length, &beam::of_element(x, i)))
                .sum::<f64>()
    }

    /// Mass of a plane on the straight axis in still water.
    fn mass_at_rest(&self, plane: usize) -> PlaneMatrix {
        let mut m = PlaneMatrix::new(2 * self.line.nodes());
        for (i, e) in self.line.elements().iter().enumerate() {
            let wet = SubmergedSection::new(-self.origin[2], e.outer_diameter);
            let added = self.density * e.added_mass * self.multipliers.added_mass * wet.added[plane];
            let all: Matrix4 = beam::mass(e.mass_per_length() + added, e.length);
            beam::assemble(&mut m, i, &all);
        }
        m
    }
}
