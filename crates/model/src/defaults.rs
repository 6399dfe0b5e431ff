//! Defaults of `&DEFAULT`, printed by `&STATUS DEFAULTS`.
//!
//! Source: [W-DEFAULTS].

use windlass_base::choices;
use windlass_base::geometry::Place;
use windlass_base::units::{METRES_PER_INCH, NEWTONS_PER_KIP, STANDARD_GRAVITY};
use windlass_base::values::Given;

/// Material of a section where a record gives none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DefaultMaterial {
    /// Mass density (kg/m3).
    pub density: f64,
    /// Young's modulus (Pa).
    pub emodulus: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Thermal expansion (1/K).
    pub expansion: f64,
    /// Yield stress (Pa).
    pub yield_stress: f64,
    /// Ultimate stress (Pa); `None`: yield / 0.6.
    pub ultimate_stress: Option<f64>,
}

/// How coordinates of points are written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Coordinates {
    /// x y z.
    Rectangular,
    /// radius, angle (deg) from +X toward +Y, z.
    Cylindrical,
    /// radius, angle (deg) in the plane, angle (deg) above the plane.
    Spherical,
    /// x y z in a system that stands here in the part.
    Placed(Place),
}

/// What `&DEFAULT` holds of waves and their statistics.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WaveDefaults {
    /// Periods of RAO (s); none: those of the databases.
    pub periods: Vec<f64>,
    /// Headings of RAO (rad); none: those of the databases.
    pub headings: Vec<f64>,
    /// Time at which the components of a sea are in phase (s), of environments defined from then on.
    pub reinforcement: Option<f64>,
    /// The statistic of reports, where the environment gives none.
    pub probability: Option<Given>,
}

choices! {
    /// The axial stiffness of a fibre rope, which grows with how fast it is pulled and with how it has been pulled before.
    pub enum RopeStiffness {
        /// The least, of a rope that is new and pulled slowly: offsets are judged by it.
        Lower = "LOWER",
        /// The largest, of a rope that storms have worked: tensions are judged by it.
        Upper = "UPPER",
        /// By how fast it is pulled and by its mean tension, of dynamic lines.
        Dynamic = "DYNAMIC",
    }
}

/// Everything `&DEFAULT` holds, and the stiffness of fibre ropes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Defaults {
    /// Material.
    pub material: DefaultMaterial,
    /// Sea water (kg/m3).
    pub water_density: f64,
    /// Air (kg/m3).
    pub air_density: f64,
    /// Gravity (m/s2).
    pub gravity: f64,
    /// Water depth (m); there is no default depth.
    pub depth: Option<f64>,
    /// Ramp of a time-domain run (s).
    pub ramp: f64,
    /// Coordinate mode of points.
    pub coordinates: Coordinates,
    /// Local z of beams, in the part; the second where a beam runs along the first.
    pub beam_direction: [[f64; 3]; 2],
    /// Stiffness of fibre ropes of classes defined from then on (`&PARAMETER -STIFFNESS`); none: dynamic where a rope has that, else the
    /// least.
    pub rope_stiffness: Option<RopeStiffness>,
}

impl Default for Defaults {
    fn default() -> Self {
        let ksi = NEWTONS_PER_KIP / (METRES_PER_INCH * METRES_PER_INCH);
        Defaults {
            material: DefaultMaterial {
                density: 7850.0,
                emodulus: 29_000.0 * ksi,
                poisson: 0.3,
                expansion: 1.17e-5,
                yield_stress: 36.0 * ksi,
                ultimate_stress: None,
            },
            water_density: 1025.0,
            air_density: 1.226,
            gravity: STANDARD_GRAVITY,
            depth: None,
            ramp: 0.0,
            coordinates: Coordinates::Rectangular,
            beam_direction: [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]],
            rope_stiffness: None,
        }
    }
}

impl DefaultMaterial {
    /// Ultimate stress (Pa): as given, else yield / 0.6 ([MOSES-REF cls] rounds 1/0.6 to 1.66).
    pub fn ultimate(&self) -> f64 {
        self.ultimate_stress.unwrap_or(self.yield_stress / 0.6)
    }
}
