//! Characteristic strength of a line, and what corrosion leaves of it.

use crate::{CheckError, above_zero};

/// Largest coefficient of variation for which the formula of test statistics holds.
const MAX_VARIATION: f64 = 0.10;

/// Characteristic strength (N) of test statistics: `mu (1 - d (3 - 6 d))` with the mean breaking strength mu (N) and its coefficient of
/// variation d, below 0.10 [DNV-OS-E301 Ch.2 Sec.2, from memory].
///
/// # Errors
/// A mean that is not greater than zero; a coefficient that is negative or not below 0.10.
pub fn of_tests(mean: f64, variation: f64) -> Result<f64, CheckError> {
    above_zero("the mean breaking strength", mean)?;
    if !(0.0..MAX_VARIATION).contains(&variation) {
        let expected = "at least 0 and below 0.10";
        return Err(CheckError::Value {
            what: "the coefficient of variation of the strength",
            expected,
            value: variation,
        });
    }
    Ok(mean * (1.0 - variation * (3.0 - 6.0 * variation)))
}

/// Which strength a smaller diameter has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CorrosionLaw {
    /// In proportion to the area that is left.
    #[default]
    Area,
    /// By the formula of catalogues for chain, `d^2 (44 - 0.08 d)` with d in mm [DNV-OS-E302], which is a little more.
    ChainFormula,
}

/// Breaking strength (N) of a diameter (m) less an allowance on the diameter (m).
///
/// # Errors
/// A strength or diameter that is not greater than zero, an allowance that is negative or not less than the diameter; a diameter that
/// the formula of chain does not reach.
pub fn corroded(strength: f64, diameter: f64, allowance: f64, law: CorrosionLaw) -> Result<f64, CheckError> {
    above_zero("the breaking strength", strength)?;
    above_zero("the diameter", diameter)?;
    if !(allowance >= 0.0 && allowance < diameter) {
        let expected = "at least 0 and less than the diameter (m)";
        return Err(CheckError::Value { what: "the corrosion allowance", expected, value: allowance });
    }
    let left = diameter - allowance;
    Ok(match law {
        CorrosionLaw::Area => strength * (left / diameter).powi(2),
        CorrosionLaw::ChainFormula => {
            let catalogue = |d: f64| {
                let mm = 1e3 * d;
                mm * mm * (44.0 - 0.08 * mm)
            };
            // its slope ends at 2 44 / (3 0.08) mm
            if 1e3 * diameter > 366.0 {
                let expected = "at most 0.366 m for the formula of chain";
                return Err(CheckError::Value { what: "the diameter", expected, value: diameter });
            }
            strength * catalogue(left) / catalogue(diameter)
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strength_of_tests_matches_hand_computation() {
        // 5 MN, 5 per cent: 5 (1 - 0.05 2.7) = 4.325
        assert!((of_tests(5e6, 0.05).unwrap() - 4.325e6).abs() < 1e-6);
        assert!(of_tests(5e6, 0.1).is_err() && of_tests(5e6, -0.1).is_err() && of_tests(0.0, 0.05).is_err());
    }

    #[test]
    fn corroded_chain_matches_hand_computation() {
        // 100 mm less 10 mm: 0.81 of the area; 8100 (44 - 7.2) / (10000 (44 - 8)) = 0.828
        assert!((corroded(8e6, 0.1, 0.01, CorrosionLaw::Area).unwrap() - 6.48e6).abs() < 1e-3);
        assert!((corroded(8e6, 0.1, 0.01, CorrosionLaw::ChainFormula).unwrap() - 6.624e6).abs() < 1e-3);
        assert_eq!(corroded(8e6, 0.1, 0.0, CorrosionLaw::Area), Ok(8e6));
        assert!(corroded(8e6, 0.1, 0.1, CorrosionLaw::Area).is_err());
        assert!(corroded(8e6, 0.4, 0.1, CorrosionLaw::ChainFormula).is_err());
    }
}
