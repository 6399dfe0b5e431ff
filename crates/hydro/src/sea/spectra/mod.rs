//! Wave spectra with a formula, and regular waves: one file each, listed in [`SPECTRA`]. Heights are in m and periods in s.

mod gaussian;
mod issc;
mod jonswap;
mod ochi_hubble;
mod regular;
mod torsethaugen;
mod two_jonswap;

use super::density::Spectrum;
use windlass_base::units::Dim;
use windlass_model::{ClassError, SeaDefinition};

pub use jonswap::{GAMMA, default_gamma, jonswap};
#[cfg(test)]
pub(super) use ochi_hubble::{most_probable, ochi_hubble};
#[cfg(test)]
pub(super) use torsethaugen::torsethaugen;
pub use windlass_model::PeriodType;

/// Every spectrum, in the order of help and messages.
pub static SPECTRA: &[&WaveSpectrum] = &[
    &issc::ISSC,
    &jonswap::JONSWAP,
    &two_jonswap::TWO_JONSWAP,
    &ochi_hubble::OCHI,
    &ochi_hubble::OCHI_HUBBLE,
    &torsethaugen::TORSETHAUGEN,
    &gaussian::GAUSSIAN,
    &regular::REGULAR,
    &regular::STOKES,
];

/// The names of all, for specs.
pub const NAMES: &[&str] = &names();

const fn names() -> [&'static str; SPECTRA.len()] {
    let mut names = [""; SPECTRA.len()];
    let mut i = 0;
    while i < names.len() {
        names[i] = SPECTRA[i].name;
        i += 1;
    }
    names
}

/// The spectrum of a name, in capitals or not.
pub fn find(name: &str) -> Option<&'static WaveSpectrum> {
    SPECTRA.iter().find(|spectrum| spectrum.name.eq_ignore_ascii_case(name)).copied()
}

/// A wave spectrum as `-SEA` of `&ENV` takes it. One is declared in the file that has its formula, and listed in [`SPECTRA`].
#[derive(Clone, Copy, Debug)]
pub struct WaveSpectrum {
    /// The word that asks for it.
    pub name: &'static str,
    /// One line of help: whose it is, and what its period and parameters are.
    pub help: &'static str,
    /// What it takes behind height and period.
    pub parameters: &'static [ShapeParameter],
    /// What its waves are.
    pub form: WaveForm,
}

/// What the waves of a [`WaveSpectrum`] are.
#[derive(Clone, Copy, Debug)]
pub enum WaveForm {
    /// A regular wave.
    Regular {
        /// Whether it is Stokes' wave; else Airy's.
        stokes: bool,
    },
    /// A sea with a density over frequency.
    Irregular {
        /// What its period is.
        period: PeriodInput,
        /// Its density, with the energy of its significant height.
        build: fn(&SeaState) -> Result<Spectrum, ClassError>,
    },
}

/// What the period of a spectrum is.
#[derive(Clone, Copy, Debug)]
pub enum PeriodInput {
    /// That of its peak; the text names the spectrum where `-SP_TYPE` says otherwise.
    PeakOnly(&'static str),
    /// As `-SP_TYPE` says, without it this.
    AsTyped(PeriodType),
}

/// What a spectrum takes behind height and period.
#[derive(Clone, Copy, Debug)]
pub struct ShapeParameter {
    /// Its name in a record.
    pub name: &'static str,
    /// Its name in a report.
    pub label: &'static str,
    /// Its dimension.
    pub dim: Dim,
    /// The range it must lie in (SI).
    pub range: [f64; 2],
    /// One line of help.
    pub help: &'static str,
    /// What it is where it is not given, from height (m), period (s) and what the period is; none where a record must give it.
    pub default: Option<fn(f64, f64, PeriodType) -> f64>,
}

/// A sea state, as its spectrum sees it.
#[derive(Clone, Debug, PartialEq)]
pub struct SeaState {
    /// Significant height (m).
    pub height: f64,
    /// Period (s).
    pub period: f64,
    /// What the period is.
    pub period_type: PeriodType,
    /// The parameters of its spectrum, in order (SI).
    pub shape: Vec<f64>,
}

impl SeaState {
    /// The energy m0 of the significant height (m2).
    pub fn energy(&self) -> f64 {
        self.height * self.height / 16.0
    }

    /// The parameters (SI) of a spectrum that declares this many.
    pub fn parameters<const N: usize>(&self) -> [f64; N] {
        std::array::from_fn(|index| self.shape.get(index).copied().unwrap_or(f64::NAN))
    }
}

impl WaveSpectrum {
    /// Whether it is a regular wave.
    pub fn is_regular(&self) -> bool {
        matches!(self.form, WaveForm::Regular { .. })
    }

    /// Whether it is a Stokes wave.
    pub fn is_stokes(&self) -> bool {
        matches!(self.form, WaveForm::Regular { stokes: true })
    }

    /// What its period is, where `-SP_TYPE` says `asked`.
    pub fn period_type(&self, asked: Option<PeriodType>) -> PeriodType {
        match self.form {
            WaveForm::Irregular { period: PeriodInput::AsTyped(usual), .. } => asked.unwrap_or(usual),
            _ => PeriodType::Peak,
        }
    }

    /// The values of its parameters for a sea: given, or their defaults; no number of one that has none.
    pub fn shape(&self, sea: &SeaDefinition, period_type: PeriodType) -> Vec<f64> {
        let values = self.parameters.iter().enumerate().map(|(index, parameter)| {
            let given = sea.shape.get(index).copied().flatten();
            given.or_else(|| Some(parameter.default?(sea.height, sea.period, period_type))).unwrap_or(f64::NAN)
        });
        values.collect()
    }
}
