//! How records are written: numbers in native units, lines, remarks, and what had to be refused.

use crate::units::Units;
use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::Span;

/// Digits kept of a number that is reckoned from those of the cards: a difference of places, a product with the factor of a unit. A
/// double has 15 to 17, of which the last ones of such a number are rounding; without them the digits of the cards show again.
const SIGNIFICANT_DIGITS: i32 = 13;
/// From here on a number is written with an exponent.
const EXPONENT_ABOVE: f64 = 1e9;
/// Below this too.
const EXPONENT_BELOW: f64 = 1e-4;

/// A number as a record has it: the shortest text that reads back as it.
pub(super) fn number(value: f64) -> String {
    // a zero has no sign here
    let value = value + 0.0;
    let size = value.abs();
    if value == 0.0 || (EXPONENT_BELOW..EXPONENT_ABOVE).contains(&size) {
        format!("{value}")
    } else {
        format!("{value:E}")
    }
}

/// Numbers with a blank between them.
pub(super) fn numbers(values: impl IntoIterator<Item = f64>) -> String {
    values.into_iter().map(number).collect::<Vec<_>>().join(" ")
}

/// A number without what is rounding, its size being that of `size`.
fn rounded_to(value: f64, size: f64) -> f64 {
    if value == 0.0 || !(size > 0.0 && size.is_finite()) {
        return value;
    }
    let power = SIGNIFICANT_DIGITS - 1 - size.log10().floor() as i32;
    let kept = if power >= 0 {
        (value * 10f64.powi(power)).round() / 10f64.powi(power)
    } else {
        (value / 10f64.powi(-power)).round() * 10f64.powi(-power)
    };
    if kept.is_finite() { kept } else { value }
}

/// A reckoned number without what is rounding.
pub(super) fn round_value(value: f64) -> f64 {
    rounded_to(value, value.abs())
}

/// A difference of two numbers of cards without what is rounding.
pub(super) fn difference(a: f64, b: f64) -> f64 {
    rounded_to(a - b, a.abs().max(b.abs()))
}

/// A direction (degrees) towards which something travels as the one it comes from, 0 to 360.
pub(super) fn opposite(direction: f64) -> f64 {
    let turned = difference((direction + 180.0).rem_euclid(360.0), 0.0);
    if turned >= 360.0 { 0.0 } else { turned }
}

/// Factors from the units of a deck to those of `&DIMEN -DIMEN METERS K-NTS` and of classes in kg, m, N.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    metres: f64,
    kilograms: f64,
}

impl Scale {
    pub(super) fn from_units(units: &Units) -> Self {
        Scale { metres: units.length, kilograms: units.mass }
    }

    /// A number of a card times the factor of its unit; one that keeps its unit is not touched.
    fn times(value: f64, factor: f64) -> f64 {
        if factor == 1.0 { value } else { round_value(value * factor) }
    }

    /// Length (m).
    pub(super) fn length(&self, value: f64) -> f64 {
        Self::times(value, self.metres)
    }

    /// Section size (mm).
    pub(super) fn section(&self, value: f64) -> f64 {
        Self::times(value, 1000.0 * self.metres)
    }

    /// Area (m2).
    pub(super) fn area(&self, value: f64) -> f64 {
        Self::times(value, self.metres * self.metres)
    }

    /// Mass (kg).
    pub(super) fn mass(&self, value: f64) -> f64 {
        Self::times(value, self.kilograms)
    }

    /// Mass a length (kg/m).
    pub(super) fn line_mass(&self, value: f64) -> f64 {
        Self::times(value, self.kilograms / self.metres)
    }

    /// Density (kg/m3).
    pub(super) fn density(&self, value: f64) -> f64 {
        Self::times(value, self.kilograms / self.metres.powi(3))
    }

    /// Force (N).
    pub(super) fn newtons(&self, value: f64) -> f64 {
        Self::times(value, self.kilograms * self.metres)
    }

    /// Force over a length to a power (N/m^p).
    pub(super) fn newtons_per(&self, value: f64, power: i32) -> f64 {
        Self::times(value, self.kilograms * self.metres.powi(1 - power))
    }

    /// Force times a length to a power (kN m^p).
    pub(super) fn force(&self, value: f64, power: i32) -> f64 {
        Self::times(value, self.kilograms * self.metres.powi(1 + power) / 1000.0)
    }

    /// Pressure, modulus (Pa).
    pub(super) fn pascals(&self, value: f64) -> f64 {
        Self::times(value, self.kilograms / self.metres)
    }
}

/// The card that a record, or an option of one, is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct CardOrigin {
    /// `deck 14, TETH`.
    pub card: String,
    /// The card, or its field.
    pub span: Span,
}

/// A record with what it is made of.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct RecordLine {
    pub(super) text: String,
    /// Where in the text each card begins to speak, in order; the first is at 0.
    pub(super) origins: Vec<(usize, CardOrigin)>,
}

/// Records being written.
#[derive(Debug)]
pub(super) struct Script {
    /// The factors of the units.
    pub(super) scale: Scale,
    /// The lines so far.
    pub(super) lines: Vec<RecordLine>,
    /// The card that the records to come are made of.
    card: CardOrigin,
    /// Words of the next record, in their order, that other cards give.
    words: Vec<(&'static str, CardOrigin)>,
    /// What could not be written.
    pub(super) wrong: Vec<Diagnostic>,
    /// What was assumed, and what has no effect.
    pub(super) notes: Vec<Diagnostic>,
}

impl Script {
    /// A script whose records are made of a card until another one is named.
    pub(super) fn new(scale: Scale, card: &str, span: Span) -> Self {
        let card = CardOrigin { card: card.into(), span };
        Script { scale, lines: Vec::new(), card, words: Vec::new(), wrong: Vec::new(), notes: Vec::new() }
    }

    /// The card that the records to come are made of.
    pub(super) fn card(&mut self, card: impl Into<String>, span: Span) {
        self.card = CardOrigin { card: card.into(), span };
    }

    /// A word of the next record from which on another card gives its values.
    pub(super) fn word(&mut self, word: &'static str, card: impl Into<String>, span: Span) {
        self.words.push((word, CardOrigin { card: card.into(), span }));
    }

    /// Adds a record.
    pub(super) fn record(&mut self, text: impl Into<String>) {
        let text = text.into();
        let mut origins = vec![(0, self.card.clone())];
        for (word, origin) in self.words.drain(..) {
            // a word that is there twice is named twice
            let taken = |at: usize| origins.iter().any(|(other, _)| *other == at);
            let whole = |at: usize| {
                let after = text.get(at + word.len()..).unwrap_or_default();
                text.get(..at).is_some_and(|before| before.ends_with(' ')) && !after.starts_with(|c: char| c != ' ')
            };
            let found = text.match_indices(word).map(|(at, _)| at).find(|at| whole(*at) && !taken(*at));
            origins.extend(found.map(|at| (at, origin)));
        }
        origins.sort_by_key(|(at, _)| *at);
        self.lines.push(RecordLine { text, origins });
    }

    /// Adds a remark line.
    pub(super) fn remark(&mut self, text: &str) {
        // what comes from a deck may hold anything; a remark is one line
        let text: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        let text = format!("$ {text}");
        if self.lines.last().is_none_or(|line| line.text != text) {
            self.lines.push(RecordLine { text, origins: vec![(0, self.card.clone())] });
        }
    }

    /// Tells what was assumed, or has no effect: of a card and its columns, in a remark line and as a note on the card.
    pub(super) fn note(&mut self, card: &str, span: Span, text: &str) {
        self.add_remark(*Diagnostic::remark(format!("{card}: {text}"), span));
    }

    /// The same as a warning: what the user may not have meant.
    pub(super) fn warn(&mut self, card: &str, span: Span, text: &str) {
        self.add_remark(*Diagnostic::warning(format!("{card}: {text}"), span));
    }

    fn add_remark(&mut self, said: Diagnostic) {
        self.remark(&said.message);
        self.notes.push(said);
    }

    /// Notes what cannot be written.
    pub(super) fn refuse(&mut self, error: impl Into<Box<Diagnostic>>) {
        self.wrong.push(*error.into());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_record_word_keeps_its_source_card() {
        let at = |byte: usize| Span::new(Default::default(), byte, byte + 1);
        let mut out = Script::new(Scale::from_units(&Units { length: 1.0, mass: 1.0, name: "" }), "deck 0, JOB", at(0));
        out.card("deck 14, TETH", at(1));
        out.word("-B", "deck 14, TSPA", at(2));
        out.word("-C", "deck 14, TLAC", at(3));
        out.word("-C", "deck 14, TLAV", at(4));
        out.word("-D", "not there", at(5));
        out.record("T -BC 1 -C 2 \\\n  -B 3 -C 4");
        let found: Vec<(usize, u32)> = out.lines[0].origins.iter().map(|(at, o)| (*at, o.span.start)).collect();
        assert_eq!(found, [(0, 1), (8, 3), (17, 2), (22, 4)]);
        out.record("S -B 1");
        assert_eq!(out.lines[1].origins.len(), 1);
    }

    #[test]
    fn written_number_reads_back_equal() {
        for value in [0.0, -0.0, 27.787, 1e15, 1.3367e24, -1e-10, 0.1 + 0.2, 2.15e11, 329.73543, 1e-4] {
            assert_eq!(windlass_language::number::evaluate(&number(value)), Ok(value + 0.0), "{value}");
        }
        assert_eq!((number(27.787).as_str(), number(-0.0).as_str()), ("27.787", "0"));
    }

    #[test]
    fn computed_numbers_have_the_digits_of_the_cards() {
        assert_eq!(difference(7.503 + 27.787 * 9.0, 7.503 + 27.787 * 8.0), 27.787);
        assert_eq!((difference(28.5, 63.6), difference(0.1 + 0.2, 0.3)), (-35.1, 0.0));
        let scale = Scale::from_units(&Units { length: 1.0, mass: 1000.0, name: "" });
        assert_eq!((scale.density(7.81694), scale.density(1.025), scale.force(0.5, -1)), (7816.94, 1025.0, 0.5));
        assert_eq!((opposite(180.0), opposite(0.0), opposite(-90.0), opposite(-180.0)), (0.0, 180.0, 90.0, 0.0));
    }
}
