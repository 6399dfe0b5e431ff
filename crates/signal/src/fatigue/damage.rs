//! Damage by the rule of Palmgren and Miner, and life.

use super::curve::SnCurve;
use crate::SeriesError;
use crate::rainflow::RainflowCycle;

/// Seconds in a day.
const SECONDS_PER_DAY: f64 = 86_400.0;
/// Days in a year, as life is given in.
pub const DAYS_PER_YEAR: f64 = 365.25;

/// What cycles come to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Damage {
    /// Sum of cycles over cycles to failure; failure is expected at 1 over the design factor.
    pub sum: f64,
    /// Cycles counted, halves as halves.
    pub cycles: f64,
}

/// Damage of counted cycles, whose ranges are those of the curve (MPa, or shares of the breaking tension); `mean` is the mean
/// tension over the breaking tension.
///
/// # Errors
/// A damage that is no number: ranges beyond all meaning.
pub fn cycle_damage(cycles: &[RainflowCycle], curve: &SnCurve, mean: f64) -> Result<Damage, SeriesError> {
    let sum: f64 = cycles.iter().map(|c| c.count * curve.damage(c.range, mean)).sum();
    if !sum.is_finite() {
        return Err(SeriesError::Refused(format!("the damage by curve {} is not finite", curve.name)));
    }
    Ok(Damage { sum, cycles: cycles.iter().map(|c| c.count).sum() })
}

/// One environment of a scatter: what a record in it came to, and how long it lasts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScatterState {
    /// Damage of the record.
    pub damage: f64,
    /// Length of the record (s).
    pub record: f64,
    /// How long the environment lasts: its `-DURATION` (s).
    pub duration: f64,
}

/// Damage (Miner's sum, no unit; 1 is failure) of environments one after the other: each record's damage times its environment's duration
/// over its length.
///
/// # Errors
/// A record or duration without length.
pub fn sum_damage(states: &[ScatterState]) -> Result<f64, SeriesError> {
    states.iter().try_fold(0.0, |sum, state| {
        for (what, value) in [("the length of a record", state.record), ("the duration", state.duration)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(SeriesError::Setting { what, expected: "greater than zero", value });
            }
        }
        Ok(sum + state.damage * state.duration / state.record)
    })
}

/// Life in years of 365.25 days when `damage` comes of `duration` (s), with a design fatigue factor (DFF, at least 1);
/// `None` without damage.
///
/// # Errors
/// A factor below 1, a duration that is not greater than zero.
pub fn life(damage: f64, duration: f64, factor: f64) -> Result<Option<f64>, SeriesError> {
    if !(factor.is_finite() && factor >= 1.0) {
        return Err(SeriesError::Setting { what: "the design fatigue factor", expected: "at least 1", value: factor });
    }
    if !(duration.is_finite() && duration > 0.0) {
        return Err(SeriesError::Setting { what: "the duration", expected: "greater than zero", value: duration });
    }
    Ok((damage > 0.0).then(|| duration / SECONDS_PER_DAY / DAYS_PER_YEAR / (damage * factor)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fatigue::find;
    use windlass_model::FatigueSelection;

    #[test]
    fn damage_equals_cycles_over_cycles_to_failure() {
        let chain = find("CHAIN", &FatigueSelection::default()).unwrap();
        let cycles = [(0.1, 1.0), (0.2, 0.5)].map(|(range, count)| RainflowCycle { range, mean: 0.3, count });
        let d = cycle_damage(&cycles, &chain, 0.3).unwrap();
        // K 1000, M 3: 1/1e6 + 0.5/125e3
        assert!((d.sum - (1e-6 + 4e-6)).abs() < 1e-18 && d.cycles == 1.5, "{d:?}");
    }

    #[test]
    fn scatter_damage_adds_by_days_and_life_is_its_inverse() {
        let hour = 3600.0;
        let states = [(1e-6, 300.0), (1e-5, 65.25)].map(|(damage, days)| ScatterState {
            damage,
            record: hour,
            duration: days * SECONDS_PER_DAY,
        });
        let sum = sum_damage(&states).unwrap();
        assert!((sum - (1e-6 * 7200.0 + 1e-5 * 1566.0)).abs() < 1e-12, "{sum}");
        // one year of it, with a factor of 10
        let years = life(sum, DAYS_PER_YEAR * SECONDS_PER_DAY, 10.0).unwrap().unwrap();
        assert!((years - 1.0 / (10.0 * sum)).abs() < 1e-12);
        assert_eq!(life(0.0, 1.0, 1.0), Ok(None));
        assert!(life(1.0, 1.0, 0.5).is_err() && life(1.0, 0.0, 1.0).is_err());
        assert!(sum_damage(&[ScatterState { damage: 0.1, record: 0.0, duration: 1.0 }]).is_err());
    }
}
