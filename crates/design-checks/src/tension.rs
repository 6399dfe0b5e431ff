//! Line tension against strength: safety factors and partial factors.

use crate::codes::{TensionForm, TensionRule};
use crate::{CheckError, Verdict, above_zero, finite};

/// The tension of a line that is checked (N).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineTension {
    /// Mean tension T_mean.
    pub mean: f64,
    /// Characteristic tension: the most probable maximum, or what else the code takes. Less the mean it is T_dyn.
    pub characteristic: f64,
    /// Pretension without environment, which E301 (2021) takes apart.
    pub pretension: Option<f64>,
}

/// What a check of tension came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TensionCheck {
    /// Strength over characteristic tension; infinite of a line without tension.
    pub safety_factor: f64,
    /// The safety factor that the code asks for; none of partial factors.
    pub required: Option<f64>,
    /// Tension times its factors over strength; it holds up to 1.
    pub utilisation: f64,
    /// Whether it holds.
    pub verdict: Verdict,
}

/// The load that a form of check compares with the strength, as a sum: on the mean tension, on the characteristic one, and what does not
/// depend on either.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadFactors {
    /// On T_mean.
    pub mean: f64,
    /// On the characteristic tension.
    pub characteristic: f64,
    /// Added (N).
    pub added: f64,
}

impl LoadFactors {
    /// Those of a form of check, of a line with this pretension (N) where it is known.
    ///
    /// # Errors
    /// A pretension that the form needs.
    pub fn new(form: &TensionForm, pretension: Option<f64>) -> Result<Self, CheckError> {
        Ok(match *form {
            TensionForm::SafetyFactor(factor) | TensionForm::SingleFactor(factor) => {
                LoadFactors { mean: 0.0, characteristic: factor, added: 0.0 }
            }
            // T_dyn is the characteristic tension less the mean
            TensionForm::PartialFactors { mean, dynamic } => {
                LoadFactors { mean: mean - dynamic, characteristic: dynamic, added: 0.0 }
            }
            TensionForm::PretensionFactors { pretension: factor, environment } => {
                let pulled = pretension
                    .ok_or_else(|| CheckError::Lacks("this form of check needs the pretension of each line".into()))?;
                finite("the pretension", pulled)?;
                LoadFactors { mean: 0.0, characteristic: environment, added: (factor - environment) * pulled }
            }
        })
    }

    /// The load (N) of a mean and a characteristic tension (N); 0 of a line that is pushed.
    pub fn load(&self, mean: f64, characteristic: f64) -> f64 {
        (self.mean * mean + self.characteristic * characteristic + self.added).max(0.0)
    }
}

/// Checks a tension against a strength (N): the breaking load, or the characteristic strength where the rule asks for it.
///
/// - safety factor: `SF T / S`;
/// - one partial factor: `g T / S_C`;
/// - partial factors: `(g_mean T_mean + g_dyn T_dyn) / S_C`;
/// - pretension factors: `(g_pret T_pret + g_env (T - T_pret)) / S_C`.
///
/// # Errors
/// A strength that is not greater than zero, a tension that is not finite or below the mean, a pretension that the rule needs.
pub fn check_tension(tension: &LineTension, strength: f64, rule: &TensionRule) -> Result<TensionCheck, CheckError> {
    above_zero("the strength", strength)?;
    finite("the mean tension", tension.mean)?;
    finite("the characteristic tension", tension.characteristic)?;
    if tension.characteristic < tension.mean {
        let expected = "at least the mean tension";
        return Err(CheckError::Value { what: "the characteristic tension", expected, value: tension.characteristic });
    }
    let largest = tension.characteristic.max(0.0);
    let required = match rule.form {
        TensionForm::SafetyFactor(factor) => Some(factor),
        _ => None,
    };
    let load = LoadFactors::new(&rule.form, tension.pretension)?.load(tension.mean, tension.characteristic);
    let utilisation = load / strength;
    let safety_factor = strength / largest;
    Ok(TensionCheck { safety_factor, required, utilisation, verdict: Verdict::of(utilisation, rule.is_confirmed()) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::codes::{Provenance, Sureness};

    fn rule(form: TensionForm, sure: Sureness) -> TensionRule {
        TensionRule { form, provenance: Provenance { sure, ..Provenance::default() } }
    }

    const TENSION: LineTension = LineTension { mean: 1.2e6, characteristic: 2.0e6, pretension: Some(0.8e6) };

    #[test]
    fn safety_factor_matches_hand_computation() {
        // 5 MN over 2 MN is 2.5; 1.67 2 / 5 = 0.668
        let dynamic = rule(TensionForm::SafetyFactor(1.67), Sureness::SecondHand);
        let checked = check_tension(&TENSION, 5e6, &dynamic).unwrap();
        assert_eq!((checked.safety_factor, checked.required), (2.5, Some(1.67)));
        assert!((checked.utilisation - 0.668).abs() < 1e-12 && checked.verdict == Verdict::Pass);
        // 3.34 MN is just enough, less is not
        assert_eq!(check_tension(&TENSION, 3.34e6, &dynamic).unwrap().verdict, Verdict::Pass);
        assert_eq!(check_tension(&TENSION, 3.33e6, &dynamic).unwrap().verdict, Verdict::Fail);
    }

    #[test]
    fn partial_factors_match_hand_computation() {
        // class 1: 1.10 1.2 + 1.50 0.8 = 2.52 MN on 0.95 4 MN = 3.8: 0.6631579
        let partial = rule(TensionForm::PartialFactors { mean: 1.10, dynamic: 1.50 }, Sureness::SecondHand);
        assert!((check_tension(&TENSION, 3.8e6, &partial).unwrap().utilisation - 0.663_157_9).abs() < 1e-7);
        // one factor on all: 1.7 2 / 3.8 = 0.8947368
        let single = rule(TensionForm::SingleFactor(1.7), Sureness::SecondHand);
        assert!((check_tension(&TENSION, 3.8e6, &single).unwrap().utilisation - 0.894_736_8).abs() < 1e-7);
        // 1.2 0.8 + 1.6 1.2 = 2.88 on 3.8: 0.7578947
        let apart = rule(TensionForm::PretensionFactors { pretension: 1.2, environment: 1.6 }, Sureness::SecondHand);
        assert!((check_tension(&TENSION, 3.8e6, &apart).unwrap().utilisation - 0.757_894_7).abs() < 1e-7);
        let bare = LineTension { pretension: None, ..TENSION };
        assert!(check_tension(&bare, 3.8e6, &apart).unwrap_err().to_string().contains("pretension"));
    }

    #[test]
    fn factor_from_memory_never_passes() {
        let memory = rule(TensionForm::SafetyFactor(1.0), Sureness::FromMemory);
        assert_eq!(check_tension(&TENSION, 5e6, &memory).unwrap().verdict, Verdict::Unconfirmed);
        assert_eq!(check_tension(&TENSION, 1e6, &memory).unwrap().verdict, Verdict::Fail);
    }

    #[test]
    fn impossible_tension_or_strength_is_refused() {
        let rule = rule(TensionForm::SafetyFactor(2.0), Sureness::Confirmed);
        for tension in [f64::NAN, 1.0e6] {
            assert!(check_tension(&LineTension { characteristic: tension, ..TENSION }, 5e6, &rule).is_err());
        }
        assert!(check_tension(&TENSION, 0.0, &rule).is_err() && check_tension(&TENSION, f64::INFINITY, &rule).is_err());
        // a slack line needs no strength
        let slack = LineTension { mean: 0.0, characteristic: 0.0, pretension: None };
        let checked = check_tension(&slack, 5e6, &rule).unwrap();
        assert!(checked.safety_factor.is_infinite() && checked.utilisation == 0.0);
    }
}
