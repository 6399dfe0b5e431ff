//! Motions in a sea as spectra.
//!
//! A point is a small band of frequencies with complex amplitudes that add up without phase between them: one for each direction of
//! the waves. The variance of a quantity g is `sum |g v|2` over them; its density the same over the width of the band.

use super::linear::{LinearSystem, Motions};
use super::natural::{Natural, natural};
use super::quantity::{Derivative, LinearQuantity};
use super::trains::{Trains, bounds, even, refine_near_resonance};
use super::{linearise, slow};
use crate::system::SolveError;
use std::f64::consts::TAU;
use windlass_base::units::Dim;
use windlass_model::ClassError;
use windlass_nonlinear::try_bisect;

/// Most numbers kept.
const MAX_NUMBERS: usize = 20_000_000;

/// Motions in a narrow band of frequencies.
#[derive(Clone, Debug, PartialEq)]
pub struct ResponsePoint {
    /// Its frequency (rad/s).
    pub frequency: f64,
    /// Its width (rad/s); `None` for a regular wave or a band without an end.
    pub width: Option<f64>,
    /// Energy of the waves in it (m2); none of slow drift.
    pub energy: f64,
    /// Motions of independent parts, whose squares add up: half the square of an amplitude is one of them squared.
    pub parts: Vec<Motions>,
    /// The frequency of each part (rad/s), where the bodies sail: that of encounter. Empty: all have the frequency of the band.
    pub encounters: Vec<f64>,
}

impl ResponsePoint {
    /// Variance of a quantity, or a derivative of it, in this band: the square of its SI unit.
    pub fn variance(&self, quantity: &LinearQuantity, derivative: Derivative) -> f64 {
        self.moments(quantity, derivative)[0]
    }

    /// Variance of a quantity, or a derivative of it, in this band, and the same of its rate: squares of their SI units.
    pub fn moments(&self, quantity: &LinearQuantity, derivative: Derivative) -> [f64; 2] {
        let met = self.encounters.iter().copied().chain(std::iter::repeat(self.frequency));
        let own = self.parts.iter().zip(met).map(|(v, w)| {
            let variance = quantity.amplitude(v, w, derivative).norm_sqr();
            [variance, variance * w * w]
        });
        own.fold([0.0; 2], |sum, own| [sum[0] + own[0], sum[1] + own[1]])
    }
}

/// Motions in a sea.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrequencyResponse {
    /// At the frequencies of the waves.
    pub waves: Vec<ResponsePoint>,
    /// Slow drift.
    pub slow: Vec<ResponsePoint>,
    /// Rounds of linearisation; 0: nothing was to be linearised.
    pub rounds: usize,
}

/// What of a response is asked for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ResponseOptions {
    /// Frequencies (rad/s), growing; empty: as the sea and the natural periods need them.
    pub frequencies: Vec<f64>,
    /// Linearises what is not linear in velocity, and adds the slow drift.
    pub spectral: bool,
}

/// The response of a system in a sea.
///
/// # Errors
/// A heading in a gap of a database, a motion without bound, a linearisation that does not settle.
pub fn respond(
    linear: &mut LinearSystem,
    trains: &Trains,
    asked: &ResponseOptions,
) -> Result<FrequencyResponse, SolveError> {
    // the same points in every round
    let resonant = resonances(linear)?;
    let mut made = response_within_memory(linear, trains, asked, &resonant)?;
    if asked.spectral {
        made.rounds = linearise::linearise_to_convergence(linear, &mut made, |l| {
            response_within_memory(l, trains, asked, &resonant)
        })?;
    }
    Ok(made)
}

/// The response in a sea with the damping there is.
///
/// # Errors
/// As [`respond`].
pub fn sea_response(
    linear: &LinearSystem,
    trains: &Trains,
    asked: &ResponseOptions,
) -> Result<FrequencyResponse, SolveError> {
    response_within_memory(linear, trains, asked, &resonances(linear)?)
}

/// Natural frequencies (rad/s) with their damping ratios.
fn resonances(linear: &LinearSystem) -> Result<Vec<(f64, f64)>, SolveError> {
    let of = |m: &Natural| Some((TAU / m.mode.period?, m.damping?));
    Ok(natural(linear)?.iter().filter_map(of).filter(|(w, _)| w.is_finite()).collect())
}

fn response_within_memory(
    linear: &LinearSystem,
    trains: &Trains,
    asked: &ResponseOptions,
    resonant: &[(f64, f64)],
) -> Result<FrequencyResponse, SolveError> {
    let waves = waves(linear, trains, asked, resonant)?;
    let slow = if asked.spectral { slow::drift(linear, trains, resonant)? } else { Vec::new() };
    Ok(FrequencyResponse { waves, slow, rounds: 0 })
}

fn waves(
    linear: &LinearSystem,
    trains: &Trains,
    asked: &ResponseOptions,
    resonant: &[(f64, f64)],
) -> Result<Vec<ResponsePoint>, SolveError> {
    let mut points = Vec::new();
    if let Some(range) = trains.range() {
        let resonant = waves_met_at(linear, trains, resonant, range)?;
        let usual = || refine_near_resonance(trains.points(range), &resonant);
        let own = if asked.frequencies.is_empty() { usual() } else { asked.frequencies.clone() };
        let directions: usize = trains.irregular.iter().map(|d| d.toward.len()).sum();
        check_memory(own.len(), directions, linear)?;
        let edges = bounds(&own, [0.0, f64::INFINITY]);
        let below: Vec<Vec<f64>> =
            trains.irregular.iter().map(|d| edges.iter().map(|w| d.spectrum.moments_below(*w)[0]).collect()).collect();
        for (i, frequency) in own.iter().enumerate() {
            let (mut toward, mut energies) = (Vec::new(), Vec::new());
            for (train, below) in trains.irregular.iter().zip(&below) {
                let energy = match below.get(i..i + 2) {
                    Some([low, high]) => (high - low).max(0.0),
                    _ => 0.0,
                };
                if energy > 0.0 {
                    toward.extend_from_slice(&train.toward);
                    let share = energy / train.toward.len().max(1) as f64;
                    energies.extend(train.toward.iter().map(|_| share));
                }
            }
            let width = match edges.get(i..i + 2) {
                Some([low, high]) => Some(high - low).filter(|w| i > 0 && w.is_finite()),
                _ => None,
            };
            points.push(point(linear, *frequency, width, (&toward, &energies))?);
        }
    }
    for (frequency, toward, energy) in &trains.regular {
        points.push(point(linear, *frequency, None, (&[*toward], &[*energy]))?);
    }
    points.sort_by(|a, b| a.frequency.total_cmp(&b.frequency));
    Ok(points)
}

fn point(
    linear: &LinearSystem,
    frequency: f64,
    width: Option<f64>,
    (toward, energies): (&[f64], &[f64]),
) -> Result<ResponsePoint, SolveError> {
    let mut parts = if toward.is_empty() { Vec::new() } else { linear.operators(frequency, toward)? };
    for (part, energy) in parts.iter_mut().zip(energies) {
        part.iter_mut().for_each(|v| *v *= energy.sqrt());
    }
    if parts.iter().flat_map(|p| p.iter()).any(|v| !(v.re.is_finite() && v.im.is_finite())) {
        let text = "the motions at a period of {} are not finite";
        return Err(SolveError::new(ClassError::with_values(text, &[(TAU / frequency, Dim::Time)])));
    }
    let mut encounters = Vec::new();
    if linear.sails() {
        for toward in toward {
            encounters.push(linear.encounter(frequency, *toward)?);
        }
    }
    Ok(ResponsePoint { frequency, width, energy: energies.iter().sum(), parts, encounters })
}

/// The frequencies of the waves in a range (rad/s) that bodies meet at natural frequencies, each with the damping ratio there.
fn waves_met_at(
    linear: &LinearSystem,
    trains: &Trains,
    resonant: &[(f64, f64)],
    range: [f64; 2],
) -> Result<Vec<(f64, f64)>, SolveError> {
    /// Pieces of the range in each of which one such frequency is found at most, and halvings of a piece.
    const PIECES: usize = 200;
    const HALVINGS: usize = 40;
    if !linear.sails() {
        return Ok(resonant.to_vec());
    }
    let mut found = Vec::new();
    let points = even(range, PIECES);
    for toward in trains.irregular.iter().flat_map(|train| &train.toward) {
        for (natural, ratio) in resonant {
            let excess = |w: f64| linear.encounter(w, *toward).map(|met| met.abs() - natural);
            for piece in points.windows(2) {
                let sign = excess(piece[0])? > 0.0;
                if (excess(piece[1])? > 0.0) == sign {
                    continue;
                }
                let is_before = |w: f64| excess(w).map(|above| (above > 0.0) == sign);
                let [low, high] = try_bisect([piece[0], piece[1]], HALVINGS, |_| false, is_before)?;
                found.push((0.5 * (low + high), *ratio));
            }
        }
    }
    Ok(found)
}

/// Refuses more than memory is taken for.
pub(super) fn check_memory(points: usize, parts: usize, linear: &LinearSystem) -> Result<(), SolveError> {
    let size = points.saturating_mul(parts).saturating_mul(6 * linear.system.nodes.len());
    if size > MAX_NUMBERS {
        let text = format!("{points} frequencies with {parts} parts of all bodies are more than are kept");
        return Err(SolveError::new(ClassError::new(text).help("fewer periods, or no -SPREAD")));
    }
    Ok(())
}
