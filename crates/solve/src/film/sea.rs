//! The waves of a film.

use crate::time::Run;
use std::f64::consts::{PI, TAU};
use windlass_hydro::sea::Sea;

/// Harmonics kept of a regular wave that is not a cosine.
const STORED_HARMONICS: usize = 8;
/// Samples of such a wave over a period.
const SAMPLES_PER_PERIOD: usize = 64;

/// One wave of the surface: `amplitude cos(number (toward . (x, y)) - frequency t + phase)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmWave {
    /// Frequency (rad/s).
    pub frequency: f64,
    /// Wave number (1/m).
    pub number: f64,
    /// Amplitude (m).
    pub amplitude: f64,
    /// Unit vector of travel.
    pub toward: [f64; 2],
    /// Phase (rad).
    pub phase: f64,
}

/// The surface as waves added up.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmWaves {
    /// The waves.
    pub waves: Vec<FilmWave>,
    /// Time over which they grow from nothing, by `(1 - cos(pi t / T)) / 2` (s).
    pub ramp: f64,
    /// Time at which they begin to grow (s).
    pub ramp_start: f64,
    /// Since when they are there (s).
    pub since: f64,
}

impl FilmWaves {
    /// Those of a run.
    pub(super) fn from_run(run: &Run, notes: &mut Vec<String>) -> Option<FilmWaves> {
        let since = run.seas.iter().skip(1).last().map_or(f64::NEG_INFINITY, |(time, _)| *time);
        let sea = run.sea.as_deref();
        if since.is_finite() {
            notes.push(format!("an action changed the environment at {since} s: the surface is flat before"));
        }
        sea.map(|sea| FilmWaves { waves: waves(sea), ramp: sea.ramp, ramp_start: sea.ramp_start, since })
    }

    /// Height of the surface above the mean level (m).
    pub fn elevation(&self, x: f64, y: f64, time: f64) -> f64 {
        if time < self.since {
            return 0.0;
        }
        let share = || ((time - self.ramp_start) / self.ramp).clamp(0.0, 1.0);
        let factor = if self.ramp > 0.0 { 0.5 * (1.0 - (PI * share()).cos()) } else { 1.0 };
        let wave = |w: &FilmWave| {
            let [tx, ty] = w.toward;
            w.amplitude * (w.number * (tx * x + ty * y) - w.frequency * time + w.phase).cos()
        };
        factor * self.waves.iter().map(wave).sum::<f64>()
    }
}

/// The components of a sea; those of one regular wave by the harmonics its surface has, so that a steep one keeps its form.
fn waves(sea: &Sea) -> Vec<FilmWave> {
    let linear = |c: &windlass_hydro::sea::Component| FilmWave {
        frequency: c.frequency,
        number: c.number,
        amplitude: c.amplitude,
        toward: c.toward,
        phase: c.phase,
    };
    let [only] = sea.components.as_slice() else { return sea.components.iter().map(linear).collect() };
    // behind the ramp, over one period at one place
    let period = TAU / only.frequency;
    let start = ((sea.ramp_start + sea.ramp.max(0.0)) / period).ceil() * period;
    let samples: Vec<f64> = (0..SAMPLES_PER_PERIOD)
        .map(|n| {
            let angle = TAU * n as f64 / SAMPLES_PER_PERIOD as f64;
            // angle = phase - w t, at a time behind the ramp
            let turns = ((only.phase - angle) / TAU).rem_euclid(1.0);
            sea.elevation(0.0, 0.0, start + turns * period)
        })
        .collect();
    let harmonic = |n: usize| {
        let part = |f: fn(f64) -> f64| {
            let sum: f64 =
                samples.iter().enumerate().map(|(i, v)| v * f(TAU * (n * i) as f64 / SAMPLES_PER_PERIOD as f64)).sum();
            2.0 * sum / SAMPLES_PER_PERIOD as f64
        };
        let (cos, sin) = (part(f64::cos), part(f64::sin));
        let order = n as f64;
        FilmWave {
            frequency: order * only.frequency,
            number: order * only.number,
            amplitude: cos.hypot(sin),
            toward: only.toward,
            phase: order * only.phase + (-sin).atan2(cos),
        }
    };
    let all: Vec<FilmWave> = (1..=STORED_HARMONICS).map(harmonic).collect();
    let largest = all.iter().map(|w| w.amplitude).fold(0.0, f64::max);
    all.into_iter().filter(|w| w.amplitude > 1e-9 * largest).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use windlass_hydro::sea::{Component, Water};
    use windlass_model::Stretching;

    fn component(frequency: f64, amplitude: f64, phase: f64) -> Component {
        Component { frequency, number: frequency * frequency / 9.81, amplitude, toward: [0.8, -0.6], phase }
    }

    #[test]
    fn film_surface_matches_sea() {
        let water = Water { depth: None, level: 0.0, gravity: 9.81, density: 1025.0 };
        for components in [vec![component(0.6, 1.5, 0.4)], vec![component(0.5, 1.0, 0.1), component(0.9, 0.4, -2.0)]] {
            let mut sea = Sea::airy(components, water, 20.0, Stretching::Linear);
            sea.ramp_start = 15.0;
            let made =
                FilmWaves { waves: waves(&sea), ramp: sea.ramp, ramp_start: sea.ramp_start, since: f64::NEG_INFINITY };
            for n in 0..60 {
                let (x, y, t) = (13.0 * f64::from(n), -7.0 * f64::from(n), 1.7 * f64::from(n));
                // sums of a few cosines of arguments up to 1e3
                assert!((made.elevation(x, y, t) - sea.elevation(x, y, t)).abs() < 1e-11, "{n}");
            }
        }
    }
}
