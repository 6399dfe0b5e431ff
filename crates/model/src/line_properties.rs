//! What a class of lines is made of, in numbers that do not depend on the engine that solves it.

/// Tension by strain.
#[derive(Clone, Debug, PartialEq)]
pub enum AxialLaw {
    /// EA (N).
    Linear(f64),
    /// Strain and tension (N), both growing, straight between.
    Table(Vec<(f64, f64)>),
}

/// What is attached at the end of a segment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AttachedMass {
    /// Mass (kg).
    pub mass: f64,
    /// Displaced volume (m3).
    pub volume: f64,
    /// Drag coefficient times area (m2).
    pub drag_area: f64,
    /// Added mass (kg).
    pub added: f64,
}

/// A segment of a line.
#[derive(Clone, Debug, PartialEq)]
pub struct SegmentProperties {
    /// Unstretched length (m).
    pub length: f64,
    /// Elements that its record cuts it into; none where it says nothing.
    pub elements: Option<usize>,
    /// Mass in air (kg/m).
    pub mass: f64,
    /// Displaced area (m2); 0 where the segment hangs by its weight in water.
    pub displaced: f64,
    /// Outside diameter (m).
    pub outside: f64,
    /// Tension by strain.
    pub axial: AxialLaw,
    /// Tension per rate of strain (N s).
    pub axial_damping: f64,
    /// Bending stiffness (N m2).
    pub bending: f64,
    /// Whether it has a bore: its stretch follows pressure and temperature.
    pub has_bore: bool,
    /// Diameter for drag (m).
    pub drag_diameter: f64,
    /// Drag coefficients across the line, and along it on pi times the diameter.
    pub drag: [f64; 2],
    /// Area for added mass (m2).
    pub added_area: f64,
    /// Added-mass coefficients across and along the line.
    pub added: [f64; 2],
    /// What is attached where the next segment begins.
    pub attached: Option<AttachedMass>,
}

/// The bottom under a line, as its class says.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LineSeabed {
    /// Normal stiffness per area (N/m3), where given.
    pub stiffness: Option<f64>,
    /// Normal damping per area (N s/m3), where given.
    pub damping: Option<f64>,
    /// Coefficient of friction.
    pub friction: f64,
    /// Friction by speed alone: of an area, at a coefficient of one (N s/m3).
    pub friction_damping: Option<f64>,
    /// Depth below z = 0 (m), where the class gives one.
    pub depth: Option<f64>,
}

/// A line class in numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct LineProperties {
    /// Its segments from the first end.
    pub segments: Vec<SegmentProperties>,
    /// The bottom under it; none of a line that does not see one.
    pub seabed: Option<LineSeabed>,
}
