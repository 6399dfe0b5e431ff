//! Remarks whose values are printed in the user's units.

use std::fmt::Display;
use std::ops::Deref;
use windlass_base::units::{Dim, UnitSystem, eight_figures};

/// A sentence with values; `{}` in it stands for each of them. It can be read as text without them.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Note {
    sentence: String,
    values: Vec<(f64, Dim)>,
}

impl Note {
    /// A sentence with values in SI and what they measure.
    pub fn new(sentence: impl Into<String>, values: &[(f64, Dim)]) -> Self {
        Note { sentence: sentence.into(), values: values.to_vec() }
    }

    /// The sentence with its values to so many decimals in these units.
    pub fn text(&self, units: UnitSystem) -> String {
        const DECIMALS: usize = 2;
        fill_sentence(&self.sentence, &self.values, units, |value| format!("{value:.DECIMALS$}"))
    }
}

/// A sentence with its values in these units, each with its unit.
pub(super) fn fill_sentence<T: Display>(
    sentence: &str,
    values: &[(f64, Dim)],
    units: UnitSystem,
    digits: impl Fn(f64) -> T,
) -> String {
    values.iter().fold(sentence.to_string(), |text, (value, dim)| {
        let told = format!("{} {}", digits(dim.from_si(*value, units)), dim.label(units));
        text.replacen("{}", told.trim_end(), 1)
    })
}

/// A sentence with its values in eight figures.
pub(super) fn in_eight_figures(sentence: &str, values: &[(f64, Dim)], units: UnitSystem) -> String {
    fill_sentence(sentence, values, units, eight_figures)
}

impl From<String> for Note {
    fn from(sentence: String) -> Self {
        Note { sentence, values: Vec::new() }
    }
}

impl From<&str> for Note {
    fn from(sentence: &str) -> Self {
        sentence.to_string().into()
    }
}

impl Deref for Note {
    type Target = str;

    fn deref(&self) -> &str {
        &self.sentence
    }
}
