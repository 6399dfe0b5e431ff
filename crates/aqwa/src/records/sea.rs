//! Waves: the spectra and the regular wave of deck 13 as options of `&ENV`.

use super::record_writer::{Script, number, numbers, opposite, round_value};
use crate::Deck;
use crate::waves::{RegularWave, SpectrumCard, SpectrumForm, WaveDeck};
use std::f64::consts::{PI, TAU};
use windlass_base::diagnostic::Diagnostic;
use windlass_hydro::sea::density::{SpectralPeak, Spectrum as Density};

/// Name of the curve of a spectrum without a formula in the language.
const CURVE: &str = "DECK_13";
/// Points of the curve of a Gaussian spectrum, and how many standard deviations they reach from its peak: straight lines between them
/// err by 0.03 % of the density at the peak.
const GAUSSIAN: (i32, f64) = (240, 6.0);
/// Phases on a line.
const PHASES_PER_LINE: usize = 10;
/// Peakedness that the language takes.
const GAMMA: std::ops::RangeInclusive<f64> = 1.0..=20.0;

/// Options of the waves; none for still water.
pub(super) fn options(deck: &Deck, out: &mut Script) -> Vec<String> {
    match &deck.waves {
        WaveDeck::Still => Vec::new(),
        WaveDeck::Regular(wave) => regular(deck, wave, out),
        WaveDeck::Spectra(list) => {
            let Some(first) = list.first() else { return Vec::new() };
            if let Some(second) = list.get(1) {
                out.refuse(
                    Diagnostic::error("deck 13: a run has one spectrum here", second.span)
                        .label("the second one")
                        .other(first.span, "the first one")
                        .help("make a deck of each"),
                );
            }
            irregular(deck, first, out)
        }
    }
}

fn regular(deck: &Deck, wave: &RegularWave, out: &mut Script) -> Vec<String> {
    if wave.amplitude == 0.0 {
        return Vec::new();
    }
    let height = round_value(2.0 * out.scale.length(wave.amplitude));
    let kind = if wave.linear { "REGULAR" } else { "STOKES" };
    let mut options = vec![format!("-SEA {kind} {}", numbers([opposite(wave.direction), height, wave.period]))];
    if !wave.linear {
        options.push("-STOKES 2".into());
    }
    options.push("-STRETCHING EXPONENTIAL".into());
    options.push(format!("-RAMP {}", number(wave.ramp)));
    if wave.ramp > 0.0 && !deck.mooring.tethers.is_empty() {
        out.refuse(
            Diagnostic::error("deck 13, WRMP: the regular wave of a run of tethers does not grow", wave.span)
                .help("leave out the card: the wave acts from the start"),
        );
    }
    options
}

fn irregular(deck: &Deck, sea: &SpectrumCard, out: &mut Script) -> Vec<String> {
    let from = opposite(sea.direction);
    let Some(mut options) = form(deck, sea, from, out) else { return Vec::new() };
    let mut components = format!("-COMPONENTS {} EQUAL_ENERGY", sea.lines);
    let (low, high) = sea.range;
    let given = matches!(sea.form, SpectrumForm::Given(_));
    if !sea.lines_given {
        let text = format!("no NSPL before this spectrum: assumed to have {} spectral lines", sea.lines);
        out.note("deck 13", sea.span, &text);
    }
    if high > 0.0 && !given {
        // from 0 on is from where no wave is long enough for the last digit
        components.push_str(&format!(" {}", numbers([if low > 0.0 { low } else { 1e-3 }, high])));
    } else if !given {
        let text = "no last frequency is given: the spectrum is assumed to have all of its energy";
        out.note("deck 13, columns 21-40", sea.span, text);
    }
    options.push(components);
    if sea.phases.is_empty() {
        options.push(format!("-SEED {}", sea.seed.max(0)));
        let text = "random phases are those of windlass and differ from those of AQWA; PHAS cards give phases";
        out.note("deck 13", sea.span, text);
    } else {
        let rows = sea.phases.chunks(PHASES_PER_LINE).map(|row| numbers(row.iter().copied()));
        options.push(format!("-PHASES \\\n    {}", rows.collect::<Vec<_>>().join(" \\\n    ")));
    }
    options.push("-STRETCHING EXPONENTIAL".into());
    options.push("-RAMP 0".into());
    options
}

/// The spectrum.
fn form(deck: &Deck, sea: &SpectrumCard, from: f64, out: &mut Script) -> Option<Vec<String>> {
    let peaked = |gamma: f64, height: f64, peak: f64, out: &mut Script| {
        if !GAMMA.contains(&gamma) {
            out.refuse(
                Diagnostic::error(format!("deck 13: a gamma of {gamma}"), sea.span).label("1 to 20 belongs here"),
            );
        }
        let values = [from, round_value(height), round_value(TAU / peak), gamma];
        Some(vec![format!("-SEA JONSWAP {}", numbers(values))])
    };
    match &sea.form {
        SpectrumForm::PiersonMoskowitz { height, period } => {
            let values = [from, out.scale.length(*height), *period];
            Some(vec![format!("-SEA ISSC {}", numbers(values)), "-SP_TYPE ZERO_CROSSING".into()])
        }
        SpectrumForm::Jonswap { gamma, alpha, peak } => {
            let gravity = out.scale.length(deck.global.gravity);
            let hump = SpectralPeak::from_alpha(*alpha, *peak, *gamma, gravity);
            let energy = Density::from_peaks(vec![hump], None).moment(0);
            out.remark(&format!(
                "JONS: alpha {}, gamma {}, peak frequency {} rad/s",
                number(*alpha),
                number(*gamma),
                number(*peak)
            ));
            peaked(*gamma, 4.0 * energy.sqrt(), *peak, out)
        }
        SpectrumForm::JonswapHeight { gamma, height, peak } => peaked(*gamma, out.scale.length(*height), *peak, out),
        SpectrumForm::Gaussian { sigma, height, peak } => {
            let height = out.scale.length(*height);
            let (count, reach) = GAUSSIAN;
            let density = |w: f64| {
                height * height / 16.0 / (sigma * (2.0 * PI).sqrt()) * (-0.5 * ((w - peak) / sigma).powi(2)).exp()
            };
            let at = |i: i32| peak + sigma * reach * (2.0 * f64::from(i) / f64::from(count) - 1.0);
            let points =
                (0..=count).map(at).filter(|w| *w > 0.0).map(|w| (round_value(w), round_value(density(w)))).collect();
            let text = format!("the spectrum is a curve of {count} chords over {reach} sigma to each side of its peak");
            out.note("deck 13, GAUS", sea.span, &text);
            curve(points, from, sea, out)
        }
        SpectrumForm::Given(pairs) => {
            let square = out.scale.area(1.0);
            curve(pairs.iter().map(|(w, s)| (*w, round_value(s * square))).collect(), from, sea, out)
        }
    }
}

/// A spectrum by its points: frequency (rad/s), density (m2 s). The language scales a curve to a height and moves its peak to a period;
/// here both are its own.
fn curve(points: Vec<(f64, f64)>, from: f64, sea: &SpectrumCard, out: &mut Script) -> Option<Vec<String>> {
    let energy: f64 = points.windows(2).map(|p| 0.5 * (p[0].1 + p[1].1) * (p[1].0 - p[0].0)).sum();
    let top = points.iter().fold((0.0, 0.0), |best: (f64, f64), p| if p.1 > best.1 { *p } else { best });
    if !(energy > 0.0 && top.0 > 0.0) || points.iter().any(|p| p.1 < 0.0) {
        out.refuse(
            Diagnostic::error("deck 13: this spectrum has no energy", sea.span)
                .label("two frequencies at least, ordinates not below 0 and one above"),
        );
        return None;
    }
    let pairs: Vec<String> = points.iter().map(|(w, s)| numbers([*w, *s])).collect();
    let rows: Vec<String> = pairs.chunks(6).map(|row| row.join("  ")).collect();
    out.record(format!("&DATA CURVES F_SPECTRUM {CURVE} \\\n  {}", rows.join(" \\\n  ")));
    let values = [from, round_value(4.0 * energy.sqrt()), round_value(TAU / top.0)];
    Some(vec![format!("-SEA {CURVE} {}", numbers(values))])
}
