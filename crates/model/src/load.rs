//! Loads of wind, current and waves that records put on parts, and the matrices of `#DRAG`, `#DAMP` and `#AMASS`.
//!
//! Source: [MOSES-REF load_g]; [MOSES-HELP lgroup]. Everything is in the axes of its part; the floors above turn it into
//! forces.

use indexmap::IndexMap;
use nalgebra::Matrix6;
use windlass_base::geometry::Position;
use windlass_base::span::Span;

/// What decides whether a load is one of wind or of current.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fluid {
    /// The global height of its point: wind above the water, current below.
    ByHeight,
    /// Wind, wherever it is.
    Air,
    /// Current, wherever it is.
    Water,
}

/// A kind of load with its values.
#[derive(Clone, Debug, PartialEq)]
pub enum LoadKind {
    /// Areas times shape coefficients along the axes of the part (m2).
    Area([f64; 3]),
    /// A flat plate: its area times drag coefficient (m2), and its normal of length one.
    Plate {
        /// Area times drag coefficient (m2).
        area: f64,
        /// Unit normal, in the part.
        normal: [f64; 3],
    },
    /// Force and moment over the square of the speed, by the direction the stream comes from.
    Coefficients {
        /// Direction in the part (rad, from x toward y), then six coefficients (N s2/m2, N s2/m); directions grow.
        rows: Vec<(f64, [f64; 6])>,
        /// Whether the other side mirrors this one.
        symmetric: bool,
    },
    /// Linear drag: force and moment over velocity and rate, on what moves through the water (N s/m, N s, N m s).
    Drag(Matrix6<f64>),
    /// Linear damping of the body's own motion; no current drives it.
    Damping(Matrix6<f64>),
    /// Added mass (kg, kg m, kg m2).
    AddedMass(Matrix6<f64>),
    /// Mean wave drift in waves from one direction.
    Drift {
        /// Direction in the part that the waves come from (rad).
        heading: f64,
        /// Period (s), then force and moment over the square of the wave amplitude (N/m2, N/m); periods grow.
        rows: Vec<(f64, [f64; 6])>,
        /// Whether the other side mirrors this one.
        symmetric: bool,
    },
}

/// A load on a point of a part.
#[derive(Clone, Debug, PartialEq)]
pub struct PartLoad {
    /// Its part.
    pub part: String,
    /// Where it acts, in the part (m).
    pub at: Position,
    /// Wind or current.
    pub fluid: Fluid,
    /// What it is.
    pub kind: LoadKind,
    /// Where it was given.
    pub span: Span,
}

impl LoadKind {
    /// The name of its record.
    pub const fn name(&self) -> &'static str {
        match self {
            LoadKind::Area(_) => "#AREA",
            LoadKind::Plate { .. } => "#PLATE",
            LoadKind::Coefficients { .. } => "#TABLE",
            LoadKind::Drag(_) => "#DRAG",
            LoadKind::Damping(_) => "#DAMP",
            LoadKind::AddedMass(_) => "#AMASS",
            LoadKind::Drift { .. } => "#DRIFT",
        }
    }
}

/// Multipliers of loads: those of a category, and those of all loads of a part. A load has the product of both.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Multipliers {
    /// By the name of a category.
    pub categories: IndexMap<String, f64>,
    /// By the name of a part in upper case.
    pub parts: IndexMap<String, f64>,
}

impl Multipliers {
    /// The multiplier of a category of loads on a part; one where none was given.
    pub fn factor(&self, category: &str, part: &str) -> f64 {
        let one = |table: &IndexMap<String, f64>, name: &str| table.get(name).copied().unwrap_or(1.0);
        one(&self.categories, category) * one(&self.parts, &part.to_ascii_uppercase())
    }
}
