//! Seas that are given wave by wave (`-WAVES`), or as the elevation over time at x = y = 0 (`-S_HISTORY`).
//!
//! A history of n values at even steps dt becomes the waves of its discrete Fourier transform: at the frequencies 2 pi j/(n dt), j = 1 .. n/2, with
//! the amplitudes and phases by which their sum passes through every value, less their mean. They repeat with n dt, and travel one way.

use std::f64::consts::TAU;
use windlass_base::units::Dim;
use windlass_model::{ClassError, Environment, GivenWave, Model};

/// Most waves of a history.
pub const MAX_HISTORY_WAVES: usize = 5000;
/// How far a step of a history may be from the mean of its steps, over that.
const UNEVEN_STEP: f64 = 1e-3;

/// Waves under the name of the option that gave them.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenTrain {
    /// `-WAVES`, or the name of the curve of a history.
    pub name: String,
    /// The direction its first wave comes from (rad).
    pub direction: f64,
    /// Its waves, those without height left out.
    pub waves: Vec<GivenWave>,
}

/// The waves an environment gives by themselves; none without `-WAVES` and `-S_HISTORY`.
///
/// # Errors
/// A history whose times are not even, or that is made of too many waves.
pub fn given_trains(model: &Model, env: &Environment) -> Result<Vec<GivenTrain>, ClassError> {
    let mut trains = Vec::new();
    let listed: Vec<GivenWave> = env.waves.iter().filter(|wave| wave.amplitude > 0.0).copied().collect();
    if let Some(first) = listed.first() {
        trains.push(GivenTrain { name: "-WAVES".to_string(), direction: first.direction, waves: listed });
    }
    if let Some(history) = &env.elevation {
        let here = |error: ClassError| error.with_span(history.curve.span);
        let Some(curve) = model.curves.get(&Model::key(&history.curve.kind)) else {
            return Err(here(ClassError::new(format!("there is no curve {}", history.curve.kind))));
        };
        let waves = transform(&curve.points, history.direction, history.highest).map_err(here)?;
        trains.push(GivenTrain { name: curve.name.clone(), direction: history.direction, waves });
    }
    Ok(trains)
}

/// The waves of a history: pairs of time (s) and elevation (m), from a direction (rad), up to a highest frequency (rad/s) where one is given.
///
/// # Errors
/// Fewer than three values, steps that are not even, more than [`MAX_HISTORY_WAVES`] waves.
pub fn transform(points: &[(f64, f64)], direction: f64, highest: Option<f64>) -> Result<Vec<GivenWave>, ClassError> {
    let count = points.len();
    let (Some((start, _)), Some((end, _)), true) = (points.first(), points.last(), count > 2) else {
        return Err(ClassError::new("a history of the elevation has at least three values"));
    };
    let step = (end - start) / (count - 1) as f64;
    let uneven = points.windows(2).find(|pair| match pair {
        [(a, _), (b, _)] => ((b - a) / step - 1.0).abs() > UNEVEN_STEP,
        _ => false,
    });
    if let Some([(from, _), (to, _)]) = uneven {
        let text = "the times of the elevation are not even: from {} to {} is not the mean step of {}";
        return Err(ClassError::with_values(text, &[(*from, Dim::Time), (*to, Dim::Time), (step, Dim::Time)]));
    }
    let base = TAU / (count as f64 * step);
    // the sum of all waves up to half of the sampling frequency passes through every value
    let most = count / 2;
    let kept = highest.map_or(most, |highest| ((highest / base).floor() as usize).min(most));
    if kept > MAX_HISTORY_WAVES {
        let text = format!(
            "the history is made of {kept} waves, and at most {MAX_HISTORY_WAVES} are taken: give a highest frequency"
        );
        return Err(ClassError::new(text));
    }
    let mut waves = Vec::with_capacity(kept);
    for order in 1..=kept {
        // by the index modulo the count: the angle of a long history stays exact
        let angle = |index: usize| TAU * ((order * index) % count) as f64 / count as f64;
        let (mut along, mut across) = (0.0, 0.0);
        for (index, (_, elevation)) in points.iter().enumerate() {
            let (sin, cos) = angle(index).sin_cos();
            along += elevation * cos;
            across += elevation * sin;
        }
        let is_last = 2 * order == count;
        let scale = if is_last { 1.0 } else { 2.0 } / count as f64;
        let amplitude = along.hypot(across) * scale;
        if amplitude > 0.0 {
            // zeta = a cos(phase - w t): the phase at the time of the first value, then at zero
            let frequency = order as f64 * base;
            let phase = (across.atan2(along) + frequency * start).rem_euclid(TAU);
            waves.push(GivenWave { frequency, amplitude, phase, direction });
        }
    }
    Ok(waves)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn history_of_two_sines_gives_their_amplitudes_and_phases() {
        // 40 values of 0.5 s: the 2nd and 5th multiples of 2 pi/20 rad/s, begun at 3 s
        let elevation = |t: f64| {
            let (first, second) = (TAU * 2.0 / 20.0, TAU * 5.0 / 20.0);
            0.3 + 1.5 * (0.4 - first * t).cos() + 0.2 * (2.0 - second * t).cos()
        };
        let points: Vec<(f64, f64)> = (0..40).map(|i| 3.0 + 0.5 * f64::from(i)).map(|t| (t, elevation(t))).collect();
        let waves = transform(&points, 1.0, None).unwrap();
        let large: Vec<&GivenWave> = waves.iter().filter(|wave| wave.amplitude > 1e-9).collect();
        let [first, second] = large[..] else { panic!("{large:?}") };
        for (wave, order, amplitude, phase) in [(first, 2.0, 1.5, 0.4), (second, 5.0, 0.2, 2.0)] {
            assert!((wave.frequency - TAU * order / 20.0).abs() < 1e-12);
            assert!((wave.amplitude - amplitude).abs() < 1e-12 && (wave.phase - phase).abs() < 1e-9, "{wave:?}");
            assert_eq!(wave.direction, 1.0);
        }
        assert_eq!(
            transform(&points, 1.0, Some(TAU * 3.0 / 20.0)).unwrap().iter().filter(|w| w.amplitude > 1e-9).count(),
            1
        );
    }

    #[test]
    fn waves_of_a_history_pass_through_its_values_less_their_mean() {
        for count in [9usize, 10] {
            let values: Vec<f64> = (0..count).map(|i| ((i * i * 7 + 3 * i) % 11) as f64 - 5.0).collect();
            let points: Vec<(f64, f64)> = values.iter().enumerate().map(|(i, z)| (i as f64 * 0.25, *z)).collect();
            let mean = values.iter().sum::<f64>() / count as f64;
            let waves = transform(&points, 0.0, None).unwrap();
            for (time, value) in &points {
                let sum: f64 = waves.iter().map(|w| w.amplitude * (w.phase - w.frequency * time).cos()).sum();
                assert!((sum + mean - value).abs() < 1e-12, "{count}: {sum} {value}");
            }
        }
    }

    #[test]
    fn history_with_uneven_times_or_too_many_waves_is_refused() {
        assert!(transform(&[(0.0, 0.0), (1.0, 1.0)], 0.0, None).is_err());
        assert!(transform(&[(0.0, 0.0), (1.0, 1.0), (2.1, 0.0)], 0.0, None).is_err());
        let long: Vec<(f64, f64)> = (0..10_010).map(|i| (f64::from(i), 1.0)).collect();
        assert!(transform(&long, 0.0, None).is_err());
    }
}
