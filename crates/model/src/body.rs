//! Bodies, their parts, and points.

use super::database::AttachedDatabase;
use super::hull::{LinearHydrostatics, Piece};
use super::prescribed::Prescription;
use nalgebra::{Matrix3, Vector3};
use windlass_base::choice::Dof;
use windlass_base::geometry::{Place, Position};
use windlass_base::span::Span;

/// The part that points outside of any body belong to: fixed in the global system.
pub const GROUND: &str = "GROUND";

/// The part that surfaces given in `&SURFACE` before any body belong to, until `EMIT` puts them into a body: it has none.
pub const LOOSE_SURFACES: &str = "&SURFACE";

/// A rigid body.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Body {
    /// Its name as written.
    pub name: String,
    /// Where it stands now.
    pub position: Place,
    /// Where it stood before the last `&INSTATE` or equilibrium.
    pub previous: Place,
    /// Degrees of freedom left out (X Y Z RX RY RZ).
    pub ignored: Vec<Dof>,
    /// What it is when it is no rigid body but a point where connectors meet.
    pub junction: Option<Junction>,
    /// Buoyancy by a constant stiffness, instead of that of a hull.
    pub linear: Option<LinearHydrostatics>,
    /// What potential flow says of it: radiation and excitation by waves.
    pub database: Option<AttachedDatabase>,
    /// The motion it is given, where forces do not move it.
    pub prescribed: Option<Prescription>,
    /// Where it was defined.
    pub span: Span,
}

/// A point in the sea, or on its bottom, where connectors meet; its weight is that of its part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Junction {
    /// Buoyancy when it is all under water (N): that of a sphere in the water of the defaults when it was defined.
    pub displacement: f64,
    /// Volume of that sphere (m3).
    pub volume: f64,
}

/// A part of a body; every attribute of a body belongs to a part.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Part {
    /// Its name as written.
    pub name: String,
    /// Its body.
    pub body: String,
    /// Where it stands in its body.
    pub position: Place,
    /// Weights it carries.
    pub weights: Vec<Weight>,
    /// Surfaces of its hull.
    pub pieces: Vec<Piece>,
    /// Where it was defined.
    pub span: Span,
}

/// The category of loads that name none [MOSES-REF load_g].
pub const EXTRA: &str = "EXTRA";

/// The category of structural elements that name none, as samples multiply it [MOSES-RUNS install/two_blk].
pub const STR_MODEL: &str = "STR_MODEL";

/// A weight at a place of a part.
#[derive(Clone, Debug, PartialEq)]
pub struct Weight {
    /// Its centre, in the part (m).
    pub at: Position,
    /// The weight (N).
    pub weight: f64,
    /// Radii of gyration about axes through its centre, along those of the part (m).
    pub radii: [f64; 3],
    /// Its category.
    pub category: String,
    /// The load group it belongs to; none: that of its part.
    pub group: Option<String>,
    /// The stations it is spread between for longitudinal strength, x in the part (m).
    pub spread: Option<[f64; 2]>,
    /// The structural element it is of; none of another weight.
    pub element: Option<String>,
    /// What `&APPLY` multiplies it by; kept up to date by [`crate::Model::refresh_weight_multipliers`].
    pub multiplier: f64,
    /// Where it was given.
    pub span: Span,
}

impl Default for Weight {
    fn default() -> Self {
        Weight {
            at: [0.0; 3],
            weight: 0.0,
            radii: [0.0; 3],
            category: EXTRA.to_string(),
            group: None,
            spread: None,
            element: None,
            multiplier: 1.0,
            span: Span::default(),
        }
    }
}

/// Mass of a rigid body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mass {
    /// Mass (kg).
    pub mass: f64,
    /// Centre of gravity, in the body (m).
    pub centre: Vector3<f64>,
    /// Moments of inertia about the body's origin, body axes (kg m2).
    pub inertia: Matrix3<f64>,
}

impl Part {
    /// A part without weights and pieces.
    pub fn new(name: &str, body: &str, position: Place, span: Span) -> Self {
        let (name, body) = (name.to_string(), body.to_string());
        Part { name, body, position, weights: Vec::new(), pieces: Vec::new(), span }
    }
}

impl Default for Mass {
    fn default() -> Self {
        Mass { mass: 0.0, centre: Vector3::zeros(), inertia: Matrix3::zeros() }
    }
}

impl Mass {
    /// That of all weights of parts, each placed in the body, under this gravity (m/s2).
    pub fn from_parts<'a>(parts: impl Iterator<Item = &'a Part>, gravity: f64) -> Self {
        let mut sum = Mass::default();
        let mut first = Vector3::zeros();
        for part in parts {
            let turn = *part.position.rotation().matrix();
            for weight in &part.weights {
                let mass = weight.weight * weight.multiplier / gravity;
                let at = Vector3::from(part.position.apply(weight.at));
                let own = weight.radii.map(|k| mass * k * k);
                let own = turn * Matrix3::from_diagonal(&own.into()) * turn.transpose();
                sum.mass += mass;
                first += mass * at;
                sum.inertia += own + mass * (Matrix3::identity() * at.norm_squared() - at * at.transpose());
            }
        }
        if sum.mass != 0.0 {
            sum.centre = first / sum.mass;
        }
        sum
    }

    /// The sum with another mass of the same body.
    #[must_use]
    pub fn combine(&self, other: &Mass) -> Mass {
        let mass = self.mass + other.mass;
        let first = self.centre * self.mass + other.centre * other.mass;
        let centre = if mass != 0.0 { first / mass } else { Vector3::zeros() };
        Mass { mass, centre, inertia: self.inertia + other.inertia }
    }

    /// Moments of inertia about another point of the body (m), its axes (kg m2).
    pub fn inertia_about(&self, point: Vector3<f64>) -> Matrix3<f64> {
        let of = |arm: Vector3<f64>| self.mass * (Matrix3::identity() * arm.norm_squared() - arm * arm.transpose());
        // Steiner: from the origin to the centre of gravity, and on to the point
        self.inertia - of(self.centre) + of(self.centre - point)
    }

    /// Radii of gyration about axes through the centre of gravity along those of the body (m); `None` where the moment of
    /// inertia is negative or there is no mass.
    pub fn radii(&self) -> [Option<f64>; 3] {
        let about = self.inertia_about(self.centre);
        [0, 1, 2].map(|i| {
            let (square, size) = (about[(i, i)] / self.mass, self.inertia[(i, i)] / self.mass);
            // of a point away from the origin rounding leaves a little of either sign
            let square = if square.abs() <= 1e-12 * size.abs() { 0.0 } else { square };
            (square >= 0.0).then(|| square.sqrt())
        })
    }
}

/// A named point.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Its name as written, with its `*`.
    pub name: String,
    /// Its part, or [`GROUND`].
    pub part: String,
    /// Coordinates in the part (m).
    pub at: Position,
    /// Where it stood when it was marked as a point of interest (m, global); none of a point that is not marked.
    pub interest: Option<Position>,
    /// Where it was defined.
    pub span: Span,
}
