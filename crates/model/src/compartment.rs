//! Compartments of parts, what is in them, and the holes that water comes in by.
//!
//! Source: [MOSES-REF cmp, cmp_fill, tank].

use windlass_base::span::Span;

/// An interior compartment: a tank, or a space that the sea may enter. Its pieces name it.
#[derive(Clone, Debug, PartialEq)]
pub struct Compartment {
    /// Its name as written.
    pub name: String,
    /// The part it was described in.
    pub part: String,
    /// What it is, in words.
    pub description: String,
    /// The points at the top and the bottom of its sounding tube; none: estimated.
    pub sounding_tube: Option<[String; 2]>,
    /// Share of its volume that can not be pumped out, and that has no free surface.
    pub residual: f64,
    /// Share of its volume that it is filled to at most, but for the sea; 1 where nothing is said.
    pub maximum: f64,
    /// Its holes.
    pub holes: Vec<String>,
    /// What is in it.
    pub contents: TankContents,
    /// Where it was described.
    pub span: Span,
}

/// What is in a compartment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TankContents {
    /// Share of its volume that is filled.
    pub fraction: f64,
    /// Density of the liquid (kg/m3).
    pub density: f64,
    /// What its surface does.
    pub surface: FreeSurface,
    /// Whether it is open to the sea: it is then filled with sea water up to the waterline, whatever the fraction.
    pub is_flooded: bool,
}

/// What the surface of a liquid in a tank does when the body heels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FreeSurface {
    /// It stays level, and the volume stays.
    #[default]
    Level,
    /// The liquid turns with the body as if it were solid.
    Frozen,
}

/// A hole of compartments.
#[derive(Clone, Debug, PartialEq)]
pub struct Hole {
    /// Its name as written.
    pub name: String,
    /// Its sort.
    pub kind: HoleKind,
    /// Where it is.
    pub point: Option<String>,
    /// Its area (m2).
    pub area: Option<f64>,
    /// Its friction factor.
    pub friction: Option<f64>,
    /// Where it was described.
    pub span: Span,
}

/// A sort of hole [MOSES-REF cmp].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HoleKind {
    /// A flood valve.
    FloodValve,
    /// A vent that lets no water in.
    WatertightVent,
    /// A vent that never comes under water.
    MastVent,
    /// A vent that cannot be closed.
    Vent,
    /// A vent that can be closed.
    VentValve,
}
