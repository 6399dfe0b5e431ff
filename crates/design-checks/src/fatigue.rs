//! Fatigue life with its factor: damage of a scatter diagram weighted by probability.

use crate::codes::FatigueRule;
use crate::{CheckError, Verdict, above_zero};

/// Seconds in a year of 365.25 days.
pub const SECONDS_PER_YEAR: f64 = 365.25 * 86_400.0;
/// How far the probabilities of a scatter diagram may add up beyond 1: rounding of printed per cents.
const PROBABILITY_SLACK: f64 = 1e-3;

/// A state of a scatter diagram.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WeightedDamage {
    /// How often it occurs (0..1).
    pub probability: f64,
    /// Miner's sum of its record.
    pub damage: f64,
    /// Length of the record (s).
    pub record: f64,
}

/// Damage in a year: `sum of p D year / T`; with the sum of the probabilities, below 1 where states are left out.
///
/// # Errors
/// No states; a record without length; a damage or probability that is negative or not finite; probabilities above 1 together.
pub fn annual_damage(states: &[WeightedDamage]) -> Result<(f64, f64), CheckError> {
    if states.is_empty() {
        return Err(CheckError::Lacks("a scatter diagram needs at least one state".into()));
    }
    let (mut damage, mut probability) = (0.0, 0.0);
    for state in states {
        above_zero("the length of a record", state.record)?;
        for (what, value) in [("a probability", state.probability), ("a damage", state.damage)] {
            if !(value.is_finite() && value >= 0.0) {
                return Err(CheckError::Value { what, expected: "finite and at least 0", value });
            }
        }
        damage += state.probability * state.damage * SECONDS_PER_YEAR / state.record;
        probability += state.probability;
    }
    if probability > 1.0 + PROBABILITY_SLACK {
        let expected = "at most 1";
        return Err(CheckError::Value { what: "the sum of the probabilities", expected, value: probability });
    }
    Ok((damage, probability))
}

/// What a check of fatigue life came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FatigueCheck {
    /// Life (years); none without damage.
    pub life: Option<f64>,
    /// Factor on the design life.
    pub factor: f64,
    /// Design life times factor over life; it holds up to 1.
    pub utilisation: f64,
    /// Whether it holds.
    pub verdict: Verdict,
}

/// Checks a damage in a year against a design life (years). `ratio` is the damage of the less over that of the more damaged of two
/// neighbouring lines, where the factor of the code depends on it.
///
/// # Errors
/// A damage that is negative or not finite, a design life that is not greater than zero, a ratio that is missing or not in 0..1.
pub fn check_fatigue(
    annual: f64,
    design_life: f64,
    ratio: Option<f64>,
    rule: &FatigueRule,
) -> Result<FatigueCheck, CheckError> {
    above_zero("the design life", design_life)?;
    if !(annual.is_finite() && annual >= 0.0) {
        return Err(CheckError::Value {
            what: "the damage in a year",
            expected: "finite and at least 0",
            value: annual,
        });
    }
    let factor = rule.factor_at(ratio)?;
    let utilisation = annual * design_life * factor;
    let life = (annual > 0.0).then(|| annual.recip());
    Ok(FatigueCheck { life, factor, utilisation, verdict: Verdict::of(utilisation, rule.is_confirmed()) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::codes::{NeighbourRise, Provenance, Sureness};

    const HOUR: f64 = 3600.0;

    fn rule(factor: f64, rise: Option<NeighbourRise>) -> FatigueRule {
        FatigueRule { factor, rise, provenance: Provenance { sure: Sureness::Confirmed, ..Provenance::default() } }
    }

    #[test]
    fn scatter_is_weighted_by_probability_as_by_hand() {
        // three states of 3 h, 2922 of them in a year:
        // 2922 (0.6 1e-7 + 0.3 8e-7 + 0.1 2.7e-6) = 2922 5.7e-7 = 1.66554e-3
        let states = [(0.6, 1e-7), (0.3, 8e-7), (0.1, 2.7e-6)];
        let states = states.map(|(probability, damage)| WeightedDamage { probability, damage, record: 3.0 * HOUR });
        let (annual, probability) = annual_damage(&states).unwrap();
        assert!((annual - 1.665_54e-3).abs() < 1e-12 && (probability - 1.0).abs() < 1e-12, "{annual}");
        // 20 years, factor 3: 0.0999324; life 600.4 years
        let checked = check_fatigue(annual, 20.0, None, &rule(3.0, None)).unwrap();
        assert!((checked.utilisation - 0.099_932_4).abs() < 1e-9 && checked.verdict == Verdict::Pass);
        assert!((checked.life.unwrap() - 600.406).abs() < 1e-3);
        assert_eq!(check_fatigue(0.02, 20.0, None, &rule(3.0, None)).unwrap().verdict, Verdict::Fail);
        assert_eq!(check_fatigue(0.0, 20.0, None, &rule(3.0, None)).unwrap().life, None);
    }

    #[test]
    fn factor_rises_with_damage_of_neighbouring_line() {
        // 5 up to 0.8, 5 + 3 (0.9 - 0.8) / 0.2 = 6.5 at 0.9, 8 at 1
        let rule = rule(5.0, Some(NeighbourRise { from: 0.8, rise: 3.0 }));
        for (ratio, factor) in [(0.3, 5.0), (0.8, 5.0), (0.9, 6.5), (1.0, 8.0)] {
            let found = check_fatigue(1e-3, 20.0, Some(ratio), &rule).unwrap().factor;
            assert!((found - factor).abs() < 1e-12, "{ratio}: {found}");
        }
        assert!(
            check_fatigue(1e-3, 20.0, None, &rule).is_err() && check_fatigue(1e-3, 20.0, Some(1.5), &rule).is_err()
        );
    }

    #[test]
    fn impossible_scatter_is_refused() {
        let state = WeightedDamage { probability: 0.7, damage: 1e-6, record: HOUR };
        assert!(annual_damage(&[state, state]).unwrap_err().to_string().contains("at most 1"));
        assert!(annual_damage(&[]).is_err() && annual_damage(&[WeightedDamage { record: 0.0, ..state }]).is_err());
        assert!(annual_damage(&[WeightedDamage { damage: -1.0, ..state }]).is_err());
    }
}
