//! A spectrum cut in bands, one wave component each.

use super::density::Spectrum;
use std::f64::consts::TAU;
use windlass_base::units::Dim;
use windlass_model::{ClassError, Division};

/// Shares of the energy between which bands of equal width lie when no limits are given. The end bands carry the rest.
const BAND_ENERGY_SHARES: [f64; 2] = [0.001, 0.995];

/// A part of a spectrum that one component stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpectrumBand {
    /// Lowest frequency (rad/s).
    pub low: f64,
    /// Highest frequency (rad/s); may be infinite.
    pub high: f64,
    /// Frequency of its component (rad/s): the centroid of its energy.
    pub frequency: f64,
    /// Its energy (m2): half the square of the amplitude.
    pub energy: f64,
}

impl SpectrumBand {
    /// Mean density over the band (m2 s), as AQWA lists it; `None` where the band has no end.
    pub fn mean_density(&self) -> Option<f64> {
        self.high.is_finite().then(|| self.energy / (self.high - self.low))
    }
}

/// Bands of equal energy or of equal width. Frequencies are those of the centroids, so the sea does not repeat itself as one of
/// frequencies with a common step would.
///
/// # Errors
/// A band without a finite frequency.
pub fn bands(
    spectrum: &Spectrum,
    number: usize,
    division: Division,
    limited: bool,
) -> Result<Vec<SpectrumBand>, ClassError> {
    let number = number.max(1);
    let [low, high] = spectrum.range();
    let share = |i: usize| i as f64 / number as f64;
    let mut cuts: Vec<f64> = match division {
        Division::EqualEnergy => (0..=number).map(|i| spectrum.quantile(share(i))).collect(),
        Division::EqualFrequency => {
            let [first, last] = if limited { [low, high] } else { BAND_ENERGY_SHARES.map(|s| spectrum.quantile(s)) };
            (0..=number).map(|i| first + (last - first) * share(i)).collect()
        }
    };
    if let (Some(first), true) = (cuts.first_mut(), division == Division::EqualEnergy || limited) {
        *first = low;
    }
    if let (Some(last), true) = (cuts.last_mut(), division == Division::EqualEnergy || limited) {
        *last = high;
    }
    let mut made = split_between(spectrum, &cuts, None)?;
    if division == Division::EqualFrequency && !limited {
        let ends = (made.first().map_or(low, |b| b.low), made.last().map_or(high, |b| b.high));
        let (below, whole, above) =
            (spectrum.moments_below(ends.0)[0], spectrum.moment(0), spectrum.moments_below(ends.1)[0]);
        if let Some(first) = made.first_mut() {
            first.energy += below;
        }
        if let Some(last) = made.last_mut() {
            last.energy += whole - above;
        }
    }
    Ok(made)
}

/// One band about each of some periods (s), cut midway between their frequencies; the end bands reach to the spectrum's ends.
///
/// # Errors
/// Periods none of which has energy about it.
pub fn bands_about(spectrum: &Spectrum, periods: &[f64]) -> Result<Vec<SpectrumBand>, ClassError> {
    let mut frequencies: Vec<f64> = periods.iter().map(|t| TAU / t).collect();
    frequencies.sort_by(f64::total_cmp);
    let [low, high] = spectrum.range();
    let middles = frequencies.windows(2).map(|pair| 0.5 * pair.iter().sum::<f64>());
    let mut cuts: Vec<f64> = std::iter::once(low).chain(middles.map(|w| w.clamp(low, high))).collect();
    cuts.push(high);
    split_between(spectrum, &cuts, Some(&frequencies))
}

fn split_between(spectrum: &Spectrum, cuts: &[f64], at: Option<&[f64]>) -> Result<Vec<SpectrumBand>, ClassError> {
    let below: Vec<[f64; 2]> = cuts.iter().map(|w| spectrum.moments_below(*w)).collect();
    let mut made = Vec::with_capacity(cuts.len());
    for (index, (edges, sums)) in cuts.windows(2).zip(below.windows(2)).enumerate() {
        let ([low, high], [a, b]) = (edges, sums) else { continue };
        let (energy, first) = (b[0] - a[0], b[1] - a[1]);
        if energy <= 0.0 {
            continue;
        }
        let frequency = at.and_then(|f| f.get(index)).copied().unwrap_or(first / energy);
        if !(frequency > 0.0 && frequency.is_finite()) {
            let text = "a band of the spectrum from {} on has no mean frequency";
            return Err(
                ClassError::with_values(text, &[(*low, Dim::Frequency)]).help("give -COMPONENTS limits of frequency")
            );
        }
        made.push(SpectrumBand { low: *low, high: *high, frequency, energy });
    }
    if made.is_empty() {
        return Err(ClassError::new("the spectrum has no energy about any component"));
    }
    Ok(made)
}
