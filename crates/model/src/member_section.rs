//! Sections of structural members: what BEAM and PLATE make weight, buoyancy and forces of water and wind of.

/// The outline of a section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SectionOutline {
    /// A circle, with its diameter at both ends (m).
    Round([f64; 2]),
    /// A rectangle (m).
    Bar {
        /// Along local y.
        width: f64,
        /// Along local z.
        depth: f64,
    },
    /// A plate of a thickness (m).
    Plate(f64),
}

/// A section of a structural member along a length of it.
#[derive(Clone, Debug, PartialEq)]
pub struct MemberSection {
    /// Its type, e.g. `TUBE`.
    pub kind: &'static str,
    /// What it looks like.
    pub outline: SectionOutline,
    /// Length of the segment (m); none: what the others leave of the member.
    pub length: Option<f64>,
    /// Area of its metal at both ends (m2), of a plate its thickness (m).
    pub metal: [f64; 2],
    /// Area within its walls at both ends (m2), that of the metal where it is open.
    pub enclosed: [f64; 2],
    /// Weight per length in air at both ends (N/m), of a plate per area (N/m2).
    pub weight: [f64; 2],
    /// Buoyancy per length beside that of its diameter (N/m).
    pub displacement: f64,
    /// Diameter that displaces water (m), in place of its own area.
    pub buoyancy_diameter: Option<f64>,
    /// Diameter for drag (m).
    pub drag_diameter: Option<f64>,
    /// Diameter for wind (m).
    pub wind_diameter: Option<f64>,
    /// Diameter for added mass (m).
    pub added_mass_diameter: Option<f64>,
    /// How far its axis is from the nodes, along local z (m).
    pub shift: f64,
    /// A part of its record that changes it and is not known: no solve goes on with it.
    pub unread: Option<&'static str>,
}

impl MemberSection {
    /// Whether water can fill it: a tube or a box.
    pub fn is_closed(&self) -> bool {
        self.enclosed != self.metal
    }

    /// Area that displaces water at both ends (m2): of a cone with a thin wall the mean of both is not that of its volume.
    pub fn displaced_areas(&self, is_flooded: bool) -> [f64; 2] {
        match self.buoyancy_diameter {
            Some(diameter) => [std::f64::consts::FRAC_PI_4 * diameter * diameter; 2],
            None if is_flooded => self.metal,
            None => self.enclosed,
        }
    }
}
