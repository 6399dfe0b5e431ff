//! A spectrum as a density over frequency, with its integrals to working precision: moments, quantiles, bands.
//!
//! Most spectra with a formula are sums of humps `x^-N exp(-N/4 x^-4) gamma^exp(-(x-1)^2/(2 s^2))`, x = w/wp, s = 0.07 below
//! and 0.09 above the peak: N = 5 is ISSC (gamma 1) and JONSWAP [DNV-RP-C205 3.5.5], N = 4 L + 1 that of [OCHI-HUBBLE-1976],
//! N = 4 that of [TORSETHAUGEN-HAVER-2004]. Other forms are given as a function and where it is smooth. A curve of the user is
//! straight between its points.

use windlass_base::units::Dim;
use windlass_model::ClassError;
use windlass_nonlinear::NewtonBracket;

/// Nodes and weights of Gauss and Legendre on -1 to 1, of the half above zero (Abramowitz and Stegun 25.4.30, n = 8).
const GAUSS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_5),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_3),
];
/// Where the panels of a hump begin, grow coarser and end, in its peak frequencies: below there is no energy, beyond it is a
/// power of the frequency to the last digit.
const PANEL_LIMITS: [f64; 3] = [0.2, 5.0, 1000.0];
/// Panels of the fine and of the coarse part.
const PANELS: [usize; 2] = [200, 80];

/// One hump of a spectrum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpectralPeak {
    /// Peak frequency (rad/s).
    pub peak: f64,
    /// N: the density falls with the frequency to the power -N; greater than 2, else there is no mean frequency.
    pub exponent: f64,
    /// Peakedness, 1 or more for what is measured.
    pub gamma: f64,
    /// Density (m2 s) by which the form is multiplied.
    pub scale: f64,
}

impl SpectralPeak {
    /// The hump of an energy m0 (m2).
    pub fn from_energy(energy: f64, peak: f64, exponent: f64, gamma: f64) -> Self {
        let unit = SpectralPeak { peak: 1.0, exponent, gamma, scale: 1.0 };
        let whole = Spectrum::from_peaks(vec![unit], None).moment(0);
        SpectralPeak { peak, exponent, gamma, scale: energy / (whole * peak) }
    }

    /// JONSWAP by Phillips' constant: `alpha g^2 w^-5 exp(-1.25 (wp/w)^4) gamma^..`.
    pub fn from_alpha(alpha: f64, peak: f64, gamma: f64, gravity: f64) -> Self {
        SpectralPeak { peak, exponent: 5.0, gamma, scale: alpha * gravity * gravity * peak.powi(-5) }
    }

    /// Density (m2 s) at a frequency (rad/s).
    pub fn density(&self, frequency: f64) -> f64 {
        let x = frequency / self.peak;
        if x < 0.5 * PANEL_LIMITS[0] {
            return 0.0;
        }
        let form = self.scale * (-self.exponent * (x.ln() + 0.25 * x.powi(-4))).exp();
        if self.gamma == 1.0 {
            return form;
        }
        let width = if x <= 1.0 { 0.07 } else { 0.09 };
        form * self.gamma.powf((-0.5 * ((x - 1.0) / width).powi(2)).exp())
    }
}

impl PartialEq for FreeForm {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::fn_addr_eq(self.form, other.form)
            && (&self.parameters, &self.knots, self.scale) == (&other.parameters, &other.knots, other.scale)
    }
}

impl FreeForm {
    /// Density (m2 s) at a frequency (rad/s): none beyond the outer knots.
    fn density(&self, frequency: f64) -> f64 {
        let frequency = frequency / self.scale[0];
        let inside = self.knots.first().is_some_and(|low| frequency >= *low)
            && self.knots.last().is_some_and(|high| frequency <= *high);
        if inside { self.scale[1] * (self.form)(frequency, &self.parameters) } else { 0.0 }
    }
}

/// A part of the frequencies with its integrals, from the lowest frequency on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct FrequencyPanel {
    low: f64,
    high: f64,
    /// Energy (m2) and first moment (m2 rad/s) below it.
    before: [f64; 2],
    /// Those within it.
    within: [f64; 2],
}

/// A density of a form of its own.
#[derive(Clone, Debug)]
struct FreeForm {
    /// Density at a frequency (rad/s), before scaling, by its parameters.
    form: fn(f64, &[f64]) -> f64,
    parameters: Vec<f64>,
    /// Frequencies (rad/s) between which the form is smooth.
    knots: Vec<f64>,
    /// What a frequency of the form becomes, and its density.
    scale: [f64; 2],
}

/// A spectrum of waves over frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    humps: Vec<SpectralPeak>,
    free: Option<FreeForm>,
    /// Frequency (rad/s), density (m2 s).
    curve: Vec<(f64, f64)>,
    panels: Vec<FrequencyPanel>,
}

impl Spectrum {
    /// The sum of humps, between two frequencies (rad/s) or over all.
    pub fn from_peaks(humps: Vec<SpectralPeak>, limits: Option<[f64; 2]>) -> Self {
        let mut knots = Vec::with_capacity(humps.len() * (PANELS[0] + PANELS[1] + 1));
        let grow = |a: f64, b: f64, i: usize, n: usize| a * (b / a).powf(i as f64 / n as f64);
        for hump in &humps {
            knots.extend((0..PANELS[0]).map(|i| hump.peak * grow(PANEL_LIMITS[0], PANEL_LIMITS[1], i, PANELS[0])));
            knots.extend((0..=PANELS[1]).map(|i| hump.peak * grow(PANEL_LIMITS[1], PANEL_LIMITS[2], i, PANELS[1])));
            knots.push(hump.peak);
        }
        let open = limits.is_none_or(|l| knots.iter().all(|k| l[1] > *k));
        let mut made = Spectrum { humps, free: None, curve: Vec::new(), panels: Vec::new() };
        made.divide(knots, limits);
        if open && let Some(last) = made.panels.last().copied() {
            let (low, high) = (last.high, limits.map_or(f64::INFINITY, |l| l[1]));
            let before = [0, 1].map(|i| last.before[i] + last.within[i]);
            let (near, far) = (made.tail_moments(low), made.tail_moments(high));
            made.panels.push(FrequencyPanel { low, high, before, within: [near[0] - far[0], near[1] - far[1]] });
        }
        made
    }

    /// A curve straight between its points: frequency (rad/s, growing), density (m2 s).
    pub fn from_curve(points: Vec<(f64, f64)>, limits: Option<[f64; 2]>) -> Self {
        let knots = points.iter().map(|p| p.0).collect();
        let mut made = Spectrum { humps: Vec::new(), free: None, curve: points, panels: Vec::new() };
        made.divide(knots, limits);
        made
    }

    /// A density (m2 s) of any form of the frequency (rad/s) and parameters, between the first and the last of some frequencies and
    /// smooth between neighbours of them: Gauss' quadrature of eight nodes holds there.
    pub fn from_form(form: fn(f64, &[f64]) -> f64, parameters: Vec<f64>, knots: Vec<f64>) -> Self {
        Spectrum::of_scaled_form(FreeForm { form, parameters, knots, scale: [1.0, 1.0] }, None)
    }

    fn of_scaled_form(free: FreeForm, limits: Option<[f64; 2]>) -> Self {
        let knots: Vec<f64> = free.knots.iter().map(|k| k * free.scale[0]).collect();
        let mut made = Spectrum { humps: Vec::new(), free: Some(free), curve: Vec::new(), panels: Vec::new() };
        made.divide(knots, limits);
        made
    }

    fn divide(&mut self, mut knots: Vec<f64>, limits: Option<[f64; 2]>) {
        if let Some([low, high]) = limits {
            knots.retain(|k| *k > low && *k < high);
            knots.push(low);
            // beyond the last knot of humps the tail goes on by itself
            let last = self.humps.iter().fold(0.0, |last: f64, h| last.max(h.peak * PANEL_LIMITS[2]));
            if high < last || self.humps.is_empty() {
                knots.push(high);
            }
        }
        knots.sort_by(f64::total_cmp);
        knots.dedup_by(|a, b| *a - *b <= 1e-12 * *b);
        let mut before = [0.0, 0.0];
        for pair in knots.windows(2) {
            let [low, high] = *pair else { continue };
            let within = self.integrals(low, high);
            self.panels.push(FrequencyPanel { low, high, before, within });
            before = [before[0] + within[0], before[1] + within[1]];
        }
    }

    /// Density (m2 s) at a frequency (rad/s), whatever the limits.
    pub fn density(&self, frequency: f64) -> f64 {
        let next = self.curve.partition_point(|p| p.0 < frequency);
        let ends = next.checked_sub(1).and_then(|i| self.curve.get(i)).zip(self.curve.get(next));
        let straight = ends.map_or(0.0, |(a, b)| a.1 + (b.1 - a.1) * (frequency - a.0) / (b.0 - a.0));
        let free = self.free.as_ref().map_or(0.0, |free| free.density(frequency));
        straight + free + self.humps.iter().map(|h| h.density(frequency)).sum::<f64>()
    }

    /// Energy and first moment of the tail of the humps beyond a frequency, where they are powers of it.
    fn tail_moments(&self, frequency: f64) -> [f64; 2] {
        if frequency.is_infinite() {
            return [0.0, 0.0];
        }
        self.humps.iter().fold([0.0, 0.0], |sum, h| {
            let size = h.density(frequency) * frequency;
            [sum[0] + size / (h.exponent - 1.0), sum[1] + size * frequency / (h.exponent - 2.0)]
        })
    }

    fn nodes(&self, low: f64, high: f64) -> impl Iterator<Item = (f64, f64)> + '_ {
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        GAUSS.iter().flat_map(move |(at, weight)| {
            [middle - half * at, middle + half * at].map(|w| (w, weight * half * self.density(w)))
        })
    }

    fn integrals(&self, low: f64, high: f64) -> [f64; 2] {
        self.nodes(low, high).fold([0.0, 0.0], |sum, (w, energy)| [sum[0] + energy, sum[1] + energy * w])
    }

    /// Small energies (m2) at their frequencies (rad/s) that stand for the whole: sums over them are its integrals.
    pub fn energies(&self) -> Vec<(f64, f64)> {
        let mut all: Vec<(f64, f64)> = Vec::with_capacity(8 * self.panels.len());
        for panel in &self.panels {
            if self.is_tail(panel) {
                all.extend((panel.within[0] > 0.0).then(|| (panel.within[1] / panel.within[0], panel.within[0])));
                continue;
            }
            let mut nodes: Vec<(f64, f64)> = self.nodes(panel.low, panel.high).filter(|n| n.1 > 0.0).collect();
            nodes.sort_by(|a, b| a.0.total_cmp(&b.0));
            all.extend(nodes);
        }
        all
    }

    fn is_tail(&self, panel: &FrequencyPanel) -> bool {
        !self.humps.is_empty() && self.humps.iter().all(|h| panel.low >= h.peak * PANEL_LIMITS[2] * (1.0 - 1e-9))
    }

    /// The integral of the density times the frequency to a power (m2 (rad/s)^n).
    pub fn moment(&self, power: i32) -> f64 {
        match (power, self.panels.last()) {
            (0, Some(last)) => last.before[0] + last.within[0],
            (1, Some(last)) => last.before[1] + last.within[1],
            _ => self.energies().iter().map(|(w, e)| e * w.powi(power)).sum(),
        }
    }

    /// The lowest and the highest frequency (rad/s); the highest may be infinite.
    pub fn range(&self) -> [f64; 2] {
        [self.panels.first().map_or(0.0, |p| p.low), self.panels.last().map_or(0.0, |p| p.high)]
    }

    /// The frequency (rad/s) of its highest peak, to a part in a million.
    pub fn peak(&self) -> f64 {
        let ends =
            self.panels.iter().map(|p| p.low).chain(self.panels.last().map(|p| p.high)).filter(|w| w.is_finite());
        let knots: Vec<f64> = ends.collect();
        let top = knots.iter().enumerate().fold((0, 0.0), |best: (usize, f64), (i, w)| {
            let density = self.density(*w);
            if density > best.1 { (i, density) } else { best }
        });
        let at = |i: usize| knots.get(i).copied();
        let Some(mut peak) = at(top.0) else { return 0.0 };
        if self.humps.len() < 2 && self.free.is_none() {
            return peak;
        }
        let (mut low, mut high) = (at(top.0.saturating_sub(1)).unwrap_or(peak), at(top.0 + 1).unwrap_or(peak));
        while high - low > 1e-7 * peak {
            let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if self.density(a) < self.density(b) {
                low = a
            } else {
                high = b
            }
            peak = 0.5 * (low + high);
        }
        peak
    }

    /// Energy (m2) and first moment (m2 rad/s) below a frequency (rad/s).
    pub fn moments_below(&self, frequency: f64) -> [f64; 2] {
        let index = self.panels.partition_point(|p| p.high <= frequency);
        let Some(panel) = self.panels.get(index) else { return [self.moment(0), self.moment(1)] };
        if frequency <= panel.low {
            return panel.before;
        }
        let part = if self.is_tail(panel) {
            let (near, far) = (self.tail_moments(panel.low), self.tail_moments(frequency));
            [near[0] - far[0], near[1] - far[1]]
        } else {
            self.integrals(panel.low, frequency)
        };
        [panel.before[0] + part[0], panel.before[1] + part[1]]
    }

    /// The frequency (rad/s) below which a share (0..1) of the energy is.
    pub fn quantile(&self, share: f64) -> f64 {
        let wanted = share * self.moment(0);
        let index = self.panels.partition_point(|p| p.before[0] + p.within[0] < wanted);
        let Some(panel) = self.panels.get(index) else { return self.range()[1] };
        let (low, mut high) = (panel.low, panel.high);
        if high.is_infinite() {
            if share >= 1.0 {
                return high;
            }
            high = 2.0 * low;
            while self.moments_below(high)[0] < wanted && high.is_finite() {
                high *= 2.0;
            }
        }
        let mut bracket = NewtonBracket::new(low, high);
        let mut at = bracket.middle();
        for _ in 0..200 {
            let over = self.moments_below(at)[0] - wanted;
            bracket.record(at, over);
            let next = bracket.step(at - over / self.density(at), || high);
            let moved = (next - at).abs();
            at = next;
            if moved <= 1e-15 * at {
                break;
            }
        }
        at
    }

    /// The same with all frequencies times a factor and the densities such that the energy is `m0` (m2).
    ///
    /// # Errors
    /// Without energy to begin with.
    pub fn with_scaled_frequencies(&self, factor: f64, m0: f64, limits: Option<[f64; 2]>) -> Result<Self, ClassError> {
        let whole = self.moment(0);
        if !(whole > 0.0 && whole.is_finite() && factor > 0.0 && factor.is_finite()) {
            return Err(ClassError::new("a spectrum has no energy"));
        }
        let density = m0 / (whole * factor);
        if !self.curve.is_empty() {
            let points = self.curve.iter().map(|(w, s)| (w * factor, s * density)).collect();
            return Spectrum::from_curve(points, limits).with_energy();
        }
        if let Some(free) = &self.free {
            let scale = [free.scale[0] * factor, free.scale[1] * density];
            return Spectrum::of_scaled_form(FreeForm { scale, ..free.clone() }, limits).with_energy();
        }
        let scale = |h: &SpectralPeak| SpectralPeak { peak: h.peak * factor, scale: h.scale * density, ..*h };
        Spectrum::from_peaks(self.humps.iter().map(scale).collect(), limits).with_energy()
    }

    /// Itself, when it has energy.
    ///
    /// # Errors
    /// Without energy, or with one that is no number.
    pub fn with_energy(self) -> Result<Self, ClassError> {
        let (m0, [low, high]) = (self.moment(0), self.range());
        if m0 > 0.0 && m0.is_finite() && self.moment(1).is_finite() {
            return Ok(self);
        }
        let text = "a spectrum has no energy from {} to {}";
        Err(ClassError::with_values(text, &[(low, Dim::Frequency), (high, Dim::Frequency)]))
    }
}
