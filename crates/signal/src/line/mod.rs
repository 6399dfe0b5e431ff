//! What a dynamic line comes to along itself: unity checks of its sections, fatigue at its nodes, envelopes.

pub mod envelope;
pub mod fatigue;
pub mod lrfd;
pub mod working_stress;

use super::SeriesError;
use std::f64::consts::FRAC_PI_4;

/// A tube as a check sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CheckedTube {
    /// Outside diameter (m).
    pub diameter: f64,
    /// Wall (m), less what corrodes.
    pub wall: f64,
    /// Yield stress (Pa).
    pub yield_stress: f64,
    /// Tensile strength (Pa).
    pub tensile: f64,
    /// Young's modulus (Pa).
    pub modulus: f64,
    /// Poisson's ratio.
    pub poisson: f64,
}

impl CheckedTube {
    /// Inside diameter (m).
    pub fn bore(&self) -> f64 {
        self.diameter - 2.0 * self.wall
    }

    /// Areas of the outside and of the bore (m2).
    pub fn areas(&self) -> [f64; 2] {
        [self.diameter, self.bore()].map(|d| FRAC_PI_4 * d * d)
    }

    /// Second moment of area (m4).
    pub fn second_moment(&self) -> f64 {
        FRAC_PI_4 / 16.0 * (self.diameter.powi(4) - self.bore().powi(4))
    }

    /// Sees that it is a tube.
    ///
    /// # Errors
    /// A number that is not above zero, a wall thicker than the radius, a ratio of Poisson that no material has.
    pub fn check(&self) -> Result<(), SeriesError> {
        for (what, value) in [
            ("the diameter of a tube", self.diameter),
            ("the wall of a tube, less corrosion", self.wall),
            ("the yield stress of a tube", self.yield_stress),
            ("the tensile strength of a tube", self.tensile),
            ("Young's modulus of a tube", self.modulus),
        ] {
            if !(value.is_finite() && value > 0.0) {
                return Err(SeriesError::Setting { what, expected: "above zero", value });
            }
        }
        if self.bore() < 0.0 {
            let expected = "at most half its diameter";
            return Err(SeriesError::Setting { what: "the wall of a tube", expected, value: self.wall });
        }
        if !(0.0..=0.5).contains(&self.poisson) {
            let expected = "between 0 and 0.5";
            return Err(SeriesError::Setting { what: "Poisson's ratio of a tube", expected, value: self.poisson });
        }
        Ok(())
    }
}

/// What acts on a section of a tube at an instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SectionLoads {
    /// Bending moment (N m); its sign does not matter.
    pub moment: f64,
    /// Effective tension (N); compression is negative.
    pub effective: f64,
    /// Tension in the wall (N).
    pub wall: f64,
    /// Pressure inside above the atmosphere's (Pa).
    pub inside: f64,
    /// Pressure outside above the atmosphere's (Pa).
    pub outside: f64,
}

/// Tension over breaking tension (both N) of a chain or rope; a line that pushes breaks nothing.
///
/// # Errors
/// A breaking tension that is not above zero.
pub fn over_break(tension: f64, breaking: f64) -> Result<f64, SeriesError> {
    if !(breaking.is_finite() && breaking > 0.0) {
        return Err(SeriesError::Setting { what: "the breaking tension", expected: "above zero", value: breaking });
    }
    Ok((tension / breaking).max(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn section_of_tube_matches_two_circles() {
        let tube =
            CheckedTube { diameter: 0.3, wall: 0.02, yield_stress: 4e8, tensile: 5e8, modulus: 2e11, poisson: 0.3 };
        // pi / 4 0.3^2, pi / 4 0.26^2
        let [outer, bore] = tube.areas();
        assert!((outer - 0.070_685_8).abs() < 1e-7 && (bore - 0.053_092_9).abs() < 1e-7);
        // pi / 64 (0.3^4 - 0.26^4)
        assert!((tube.second_moment() - 1.732_903e-4).abs() < 1e-9);
    }

    #[test]
    fn invalid_tube_is_refused() {
        let tube =
            CheckedTube { diameter: 0.3, wall: 0.02, yield_stress: 4e8, tensile: 5e8, modulus: 2e11, poisson: 0.3 };
        assert!(tube.check().is_ok());
        assert!(
            CheckedTube { wall: 0.16, ..tube }.check().is_err() && CheckedTube { wall: 0.0, ..tube }.check().is_err()
        );
        assert!(
            CheckedTube { poisson: 0.6, ..tube }.check().is_err()
                && CheckedTube { modulus: f64::NAN, ..tube }.check().is_err()
        );
        assert_eq!(over_break(2.0, 8.0), Ok(0.25));
        assert_eq!(over_break(-2.0, 8.0), Ok(0.0));
        assert!(over_break(1.0, 0.0).is_err());
    }
}
