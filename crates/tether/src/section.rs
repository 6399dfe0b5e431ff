//! The cross section of a tether: a round tube.

use std::f64::consts::{FRAC_PI_4, PI};

/// A round tube.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TetherTube {
    /// Outer diameter (m).
    pub outer_diameter: f64,
    /// Wall thickness (m), at most the radius (a solid bar).
    pub wall_thickness: f64,
}

impl TetherTube {
    /// Inner diameter (m).
    pub fn inner_diameter(&self) -> f64 {
        (self.outer_diameter - 2.0 * self.wall_thickness).max(0.0)
    }

    /// Area of the wall (m2): `pi/4 (D^2 - d^2)`.
    pub fn area(&self) -> f64 {
        FRAC_PI_4 * (self.outer_diameter.powi(2) - self.inner_diameter().powi(2))
    }

    /// Second moment of area about a diameter (m4): `pi/64 (D^4 - d^4)`.
    pub fn second_moment(&self) -> f64 {
        PI / 64.0 * (self.outer_diameter.powi(4) - self.inner_diameter().powi(4))
    }

    /// Area within the outer diameter (m2), which displaces water: `pi/4 D^2`.
    pub fn external_area(&self) -> f64 {
        FRAC_PI_4 * self.outer_diameter.powi(2)
    }

    /// Area within the inner diameter (m2), which holds internal fluid.
    pub fn internal_area(&self) -> f64 {
        FRAC_PI_4 * self.inner_diameter().powi(2)
    }

    /// Outer radius (m).
    pub fn radius(&self) -> f64 {
        0.5 * self.outer_diameter
    }

    /// Bending stress at the outer fibre of a unit bending moment (1/m3): `(D/2) / I`.
    pub fn stress_of_moment(&self) -> f64 {
        self.radius() / self.second_moment()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solid_bar_section_moments_match_circle() {
        let bar = TetherTube { outer_diameter: 2.0, wall_thickness: 1.0 };
        assert!((bar.area() - PI).abs() < 1e-15 && (bar.second_moment() - PI / 4.0).abs() < 1e-15);
        assert_eq!((bar.area(), bar.internal_area()), (bar.external_area(), 0.0));
    }

    #[test]
    fn main_body_section_matches_manual() {
        // [AQWA-TETHER 8.2 listing]: area 0.1289, I 0.018801, external area 0.981
        let tube = TetherTube { outer_diameter: 1.1176, wall_thickness: 0.038 };
        assert!((tube.area() - 0.1289).abs() < 5e-5);
        assert!((tube.second_moment() - 0.018_801).abs() < 5e-7);
        assert!((tube.external_area() - 0.981).abs() < 5e-4);
    }
}
