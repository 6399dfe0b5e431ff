//! Combined loading of a riser by [DNV-ST-F201] (DNV-OS-F201 until 2017), load and resistance factor design.
//!
//! Confirmed by what others publish of the standard: the cubic of collapse with its elastic and plastic pressures and the least
//! ovality 0.005 ([DNV-ST-F101 5.4.4, eqs. 5.12 and 5.14], the same formulas, as [PDOVER2T-PY] has them; [BAI-2001 eq. 2.20]); the bursting
//! pressure; gamma_m 1.15, gamma_SC 1.26 of class High, gamma_F 1.1 and gamma_E 1.3 with 1/gamma_E where the environment relieves
//! (manual of Flexcom); where the standard has them: t2 in section 5 C203, tables 5-2 and 5-5, f0 in section 5 G201 (manual of OrcaFlex,
//! edition of October 2010). Not confirmed by its text, which could not be read: the two forms of combined loading as they are
//! here, which are those known of its editions 2001 to 2018, the formula of alpha_c with its bound 1.20 (that of [DNV-OS-F101], 2000), and
//! gamma_SC 1.04 and 1.14.

use super::CheckedTube;
use crate::SeriesError;
use std::f64::consts::{FRAC_PI_3, PI};
use windlass_base::choices;

choices! {
    /// Safety class.
    #[derive(Default)]
    pub enum SafetyClass {
        /// Low.
        Low = "LOW",
        /// Normal.
        #[default]
        Normal = "NORMAL",
        /// High.
        High = "HIGH",
    }
}

impl SafetyClass {
    /// The safety class factor gamma_SC (no unit).
    pub fn factor(self) -> f64 {
        match self {
            SafetyClass::Low => 1.04,
            SafetyClass::Normal => 1.14,
            SafetyClass::High => 1.26,
        }
    }
}

/// Factors of a check.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LrfdFactors {
    /// Safety class.
    pub class: SafetyClass,
    /// gamma_m.
    pub material: f64,
    /// gamma_F on what acts at rest, or its inverse where that is worse.
    pub functional: f64,
    /// gamma_E on what the environment adds, or its inverse where that is worse.
    pub environmental: f64,
    /// alpha_fab, on the plastic collapse pressure: 1 of seamless pipe, 0.85 of UOE pipe ([DNV-OS-F101 table 5-5], 2012), 0.925 of UO
    /// pipe (not confirmed).
    pub fabrication: f64,
    /// f0, (largest less least diameter) over diameter.
    pub ovality: f64,
}

impl Default for LrfdFactors {
    /// Ultimate limit state, class Normal, seamless pipe with the least ovality of the standard.
    fn default() -> Self {
        LrfdFactors {
            class: SafetyClass::Normal,
            material: 1.15,
            functional: 1.1,
            environmental: 1.3,
            fabrication: 1.0,
            ovality: LEAST_OVALITY,
        }
    }
}

/// The ovality that is not gone below.
pub const LEAST_OVALITY: f64 = 0.005;
/// Most of alpha_c.
const MAX_HARDENING: f64 = 1.20;

/// What a tube resists.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TubeResistance {
    tube: CheckedTube,
    factors: LrfdFactors,
    /// Bursting pressure p_b (Pa).
    pub burst: f64,
    /// Collapse pressure p_c (Pa).
    pub collapse: f64,
}

/// Collapse pressure (Pa) of an elastic and a plastic one (Pa): the root below both of
/// `(p_c - p_el)(p_c^2 - p_p^2) = p_c p_el p_p f0 D/t`, as [DNV-ST-F101 5.4.4] solves it.
pub fn collapse(elastic: f64, plastic: f64, ovality: f64, slenderness: f64) -> f64 {
    // measured by the larger one, so that no cube is too large
    let scale = elastic.max(plastic);
    if !(scale > 0.0 && scale.is_finite()) {
        return 0.0;
    }
    let (el, p) = (elastic / scale, plastic / scale);
    let (b, c, d) = (-el, -(p * p + p * el * ovality * slenderness), el * p * p);
    let u = (c - b * b / 3.0) / 3.0;
    let v = 0.5 * (2.0 * b * b * b / 27.0 - b * c / 3.0 + d);
    let phase = (-v / (-u).powf(1.5)).clamp(-1.0, 1.0).acos();
    scale * (-2.0 * (-u).sqrt() * (phase / 3.0 + FRAC_PI_3).cos() - b / 3.0)
}

impl TubeResistance {
    /// That of a tube.
    ///
    /// # Errors
    /// What is no tube, a factor that is not above zero.
    pub fn new(tube: CheckedTube, factors: LrfdFactors) -> Result<Self, SeriesError> {
        tube.check()?;
        for (what, value) in [
            ("gamma_m", factors.material),
            ("gamma_F", factors.functional),
            ("gamma_E", factors.environmental),
            ("alpha_fab", factors.fabrication),
        ] {
            if !(value.is_finite() && value > 0.0) {
                return Err(SeriesError::Setting { what, expected: "above zero", value });
            }
        }
        if !(0.0..=0.1).contains(&factors.ovality) {
            let expected = "between 0 and 0.1";
            return Err(SeriesError::Setting { what: "the ovality", expected, value: factors.ovality });
        }
        let CheckedTube { diameter, wall, yield_stress, tensile, modulus, poisson } = tube;
        let burst = 2.0 / 3f64.sqrt() * 2.0 * wall / (diameter - wall) * yield_stress.min(tensile / 1.15);
        let elastic = 2.0 * modulus * (wall / diameter).powi(3) / (1.0 - poisson * poisson);
        let plastic = 2.0 * yield_stress * factors.fabrication * wall / diameter;
        let collapse = collapse(elastic, plastic, factors.ovality.max(LEAST_OVALITY), diameter / wall);
        Ok(TubeResistance { tube, factors, burst, collapse })
    }

    /// alpha_c, what strain hardening adds to the plastic moment and tension at a net pressure inside (Pa):
    /// `1 - beta + beta f_u / f_y`, beta falling from 0.4 + q_h at D/t of 15 to none at 60, q_h the hoop stress over yield.
    pub fn hardening(&self, over: f64) -> f64 {
        let slenderness = self.tube.diameter / self.tube.wall;
        let hoop = (over / self.burst).max(0.0) * 2.0 / 3f64.sqrt();
        let beta = (0.4 + hoop) * ((60.0 - slenderness) / 45.0).clamp(0.0, 1.0);
        (1.0 - beta + beta * self.tube.tensile / self.tube.yield_stress).clamp(1.0, MAX_HARDENING)
    }

    /// Plastic moment M_k (N m) and tension T_k (N) at a net pressure inside (Pa).
    pub fn plastic(&self, over: f64) -> [f64; 2] {
        let CheckedTube { diameter, wall, yield_stress, .. } = self.tube;
        let strength = yield_stress * self.hardening(over);
        let middle = diameter - wall;
        [strength * middle * middle * wall, strength * PI * middle * wall]
    }

    /// What the tube uses of what it resists, of a design moment (N m), a design effective tension (N) and pressures inside and outside
    /// (Pa); it holds up to 1. With more pressure inside the left side of the criterion,
    /// `g {|M|/M_k sqrt(1 - (dp/p_b)^2) + (T/T_k)^2} + (dp/p_b)^2`; with more outside the root of
    /// `g^2 {|M|/M_k + (T/T_k)^2}^2 + g^2 (dp/p_c)^2`, so that the two meet where the pressures are equal; g is gamma_SC gamma_m.
    pub fn utilisation(&self, moment: f64, tension: f64, [inside, outside]: [f64; 2]) -> f64 {
        let g = self.factors.class.factor() * self.factors.material;
        let over = inside - outside;
        let [plastic_moment, plastic_tension] = self.plastic(over);
        let (bending, pulling) = (moment.abs() / plastic_moment, (tension / plastic_tension).powi(2));
        if over >= 0.0 {
            let share = (over / self.burst).powi(2);
            g * (bending * (1.0 - share).max(0.0).sqrt() + pulling) + share
        } else {
            g * (bending + pulling).hypot(over / self.collapse)
        }
    }

    /// The same of moments about two directions (N m) and effective tension (N) at rest and now: what acts at rest takes gamma_F,
    /// what the environment adds gamma_E, each or its inverse, whichever uses most.
    pub fn used_now(&self, rest: [f64; 3], now: [f64; 3], pressures: [f64; 2]) -> f64 {
        let both = |factor: f64| [factor, factor.recip()];
        let mut most: f64 = 0.0;
        for functional in both(self.factors.functional) {
            for environmental in both(self.factors.environmental) {
                let mut design = [0.0; 3];
                for ((design, rest), now) in design.iter_mut().zip(rest).zip(now) {
                    *design = functional * rest + environmental * (now - rest);
                }
                let [about_one, about_other, tension] = design;
                most = most.max(self.utilisation(about_one.hypot(about_other), tension, pressures));
            }
        }
        most
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const X65: CheckedTube =
        CheckedTube { diameter: 0.66, wall: 0.0197, yield_stress: 444e6, tensile: 535e6, modulus: 207e9, poisson: 0.3 };

    #[test]
    fn pipe_collapse_pressure_matches_another_program() {
        // [PDOVER2T-PY], examples/DNVGL-ST-F101_pipe_collapse_external_pressure.ipynb: UOE pipe, printed to 0.1 Pa
        let factors = LrfdFactors { fabrication: 0.85, ..LrfdFactors::default() };
        let found = TubeResistance::new(X65, factors).unwrap();
        assert!((found.collapse - 10_831_164.1).abs() < 0.1, "{}", found.collapse);
        assert!((collapse(12_098_341.0, 22_529_636.4, 0.005, 0.66 / 0.0197) - 10_831_164.1).abs() < 0.5);
    }

    #[test]
    fn round_pipe_collapses_at_lower_of_two_pressures() {
        // the cubic then has the roots p_el and p_p; a double root is found to half of the digits
        assert!((collapse(2e7, 5e6, 0.0, 30.0) / 5e6 - 1.0).abs() < 1e-7);
        assert!((collapse(2e6, 5e6, 0.0, 30.0) / 2e6 - 1.0).abs() < 1e-7);
        assert!((collapse(5e6, 5e6, 0.0, 30.0) / 5e6 - 1.0).abs() < 1e-6);
        assert_eq!(collapse(0.0, 0.0, 0.005, 30.0), 0.0);
    }

    #[test]
    fn each_single_load_gives_unit_utilisation_at_its_resistance() {
        let found = TubeResistance::new(X65, LrfdFactors::default()).unwrap();
        let g = 1.14 * 1.15;
        let [moment, tension] = found.plastic(0.0);
        assert!((found.utilisation(-moment / g, 0.0, [0.0; 2]) - 1.0).abs() < 1e-12);
        assert!((found.utilisation(0.0, -tension / g.sqrt(), [0.0; 2]) - 1.0).abs() < 1e-12);
        assert!((found.utilisation(0.0, 0.0, [found.burst, 0.0]) - 1.0).abs() < 1e-12);
        assert!((found.utilisation(0.0, 0.0, [0.0, found.collapse / g]) - 1.0).abs() < 1e-12);
        // a pressure beyond bursting is not made good by a moment
        assert!(found.utilisation(moment, 0.0, [2.0 * found.burst, 0.0]) > 3.9);
        // von Mises' ring: 2 / sqrt 3 of the yield stress by the mean diameter
        assert!((found.burst * (0.66 - 0.0197) / (2.0 * 0.0197) - 2.0 / 3f64.sqrt() * 444e6).abs() < 1.0);
    }

    #[test]
    fn two_interaction_forms_agree_at_equal_pressures() {
        let found = TubeResistance::new(X65, LrfdFactors::default()).unwrap();
        let [inside, outside] = [[1.0, 0.0], [0.0, 1.0]].map(|p| found.utilisation(1e6, 2e6, p));
        assert!((inside - outside).abs() < 1e-6, "{inside} {outside}");
    }

    #[test]
    fn hardening_fades_with_slenderness_and_is_bounded() {
        let of = |diameter: f64, tensile: f64| {
            TubeResistance::new(CheckedTube { diameter, tensile, ..X65 }, LrfdFactors::default())
                .unwrap()
                .hardening(0.0)
        };
        // beta 0.4 up to D/t of 15, half of that at 37.5, none from 60 on
        assert!((of(0.0197 * 14.0, 535e6) - (0.6 + 0.4 * 535.0 / 444.0)).abs() < 1e-12);
        assert!((of(0.0197 * 37.5, 535e6) - (0.8 + 0.2 * 535.0 / 444.0)).abs() < 1e-12);
        assert_eq!(of(0.0197 * 70.0, 535e6), 1.0);
        assert_eq!(of(0.0197 * 14.0, 900e6), 1.2);
    }

    #[test]
    fn relieving_load_gets_inverse_factor() {
        let found = TubeResistance::new(X65, LrfdFactors::default()).unwrap();
        let at = [0.0; 2];
        let worse = found.used_now([1e6, 0.0, 0.0], [1.5e6, 0.0, 0.0], at);
        assert!((worse - found.utilisation(1.1e6 + 0.65e6, 0.0, at)).abs() < 1e-12);
        let relieved = found.used_now([1e6, 0.0, 0.0], [0.5e6, 0.0, 0.0], at);
        assert!((relieved - found.utilisation(1.1e6 - 0.5e6 / 1.3, 0.0, at)).abs() < 1e-12);
        assert!(TubeResistance::new(X65, LrfdFactors { material: 0.0, ..LrfdFactors::default() }).is_err());
    }
}
