//! Stress of a riser by [API-RP-2RD], working stress design.
//!
//! Confirmed by what others publish of it: the stresses of plain pipe, radial, hoop and axial with the moment at the middle of the wall,
//! and their von Mises stress (manual of Flexcom, "Von Mises Stress, API-2RD Method"); the basic allowable C_a of 2/3 of the yield stress, and
//! usage 0.67, 0.8 and 1.0 for operating, extreme and survival loads [BAI-2001 table 21.2]. Its text
//! could not be read, so equation numbers are not given.

use super::{CheckedTube, SectionLoads};
use crate::SeriesError;
use windlass_base::choices;

choices! {
    /// Design case, by its factor C_f on the basic allowable stress.
    #[derive(Default)]
    pub enum DesignCase {
        /// Normal operation.
        #[default]
        Operating = "OPERATING",
        /// Extreme: the storm of a hundred years.
        Extreme = "EXTREME",
        /// Survival.
        Survival = "SURVIVAL",
    }
}

impl DesignCase {
    /// The design case factor C_f (no unit).
    pub fn factor(self) -> f64 {
        match self {
            DesignCase::Operating => 1.0,
            DesignCase::Extreme => 1.2,
            DesignCase::Survival => 1.5,
        }
    }
}

/// Von Mises stress (Pa) at the middle of the wall, the larger of the two sides of the bend.
pub fn membrane(tube: &CheckedTube, acting: &SectionLoads) -> f64 {
    let (outer, bore) = (tube.diameter, tube.bore());
    let [whole, hole] = tube.areas();
    let SectionLoads { moment, wall, inside, outside, .. } = *acting;
    let radial = -(outside * outer + inside * bore) / (outer + bore);
    let hoop = (inside - outside) * outer / (2.0 * tube.wall) - inside;
    let bending = moment * (outer - tube.wall) / (2.0 * tube.second_moment());
    let of_side = |side: f64| {
        let axial = wall / (whole - hole) + side * bending;
        let squares = (radial - hoop).powi(2) + (hoop - axial).powi(2) + (axial - radial).powi(2);
        (0.5 * squares).sqrt()
    };
    of_side(1.0).max(of_side(-1.0))
}

/// That stress over what is allowed, `C_f 2/3` of the yield stress; it holds up to 1.
///
/// # Errors
/// What is no tube.
pub fn utilisation(tube: &CheckedTube, acting: &SectionLoads, case: DesignCase) -> Result<f64, SeriesError> {
    tube.check()?;
    Ok(membrane(tube, acting) / (case.factor() * 2.0 / 3.0 * tube.yield_stress))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TUBE: CheckedTube =
        CheckedTube { diameter: 0.3, wall: 0.02, yield_stress: 4e8, tensile: 5e8, modulus: 2e11, poisson: 0.3 };

    #[test]
    fn tension_alone_equals_von_mises_stress() {
        let area = std::f64::consts::PI * 0.28 * 0.02;
        let acting = SectionLoads { wall: area * 2e8, ..SectionLoads::default() };
        assert!((membrane(&TUBE, &acting) / 2e8 - 1.0).abs() < 1e-12);
        for (case, want) in [(DesignCase::Operating, 0.75), (DesignCase::Extreme, 0.625), (DesignCase::Survival, 0.5)] {
            assert!((utilisation(&TUBE, &acting, case).unwrap() - want).abs() < 1e-12);
        }
    }

    #[test]
    fn closed_tube_in_sea_has_pressure_stress_only() {
        // a solid state of equal pressure on all sides has no von Mises stress: wall tension is that of capped ends
        let [whole, hole] = TUBE.areas();
        let p = 3e7;
        let acting = SectionLoads { wall: -p * (whole - hole), inside: p, outside: p, ..SectionLoads::default() };
        assert!(membrane(&TUBE, &acting) < 1e-3, "{}", membrane(&TUBE, &acting));
    }

    #[test]
    fn bending_stress_is_at_mid_wall_on_its_worse_side() {
        let acting = SectionLoads { moment: 1e5, ..SectionLoads::default() };
        let want = 1e5 * 0.14 / TUBE.second_moment();
        assert!((membrane(&TUBE, &acting) / want - 1.0).abs() < 1e-12);
        let pulled = SectionLoads { wall: -1e6, ..acting };
        let pushed = SectionLoads { wall: 1e6, ..acting };
        assert!((membrane(&TUBE, &pulled) - membrane(&TUBE, &pushed)).abs() < 1e-6);
        assert!(utilisation(&CheckedTube { wall: 0.2, ..TUBE }, &acting, DesignCase::Operating).is_err());
    }
}
