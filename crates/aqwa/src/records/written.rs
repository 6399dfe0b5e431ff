//! How records are written: numbers in native units, lines, remarks, and what had to be refused.

use crate::units::Units;
use windlass_base::diagnostic::Diagnostic;

/// Digits kept of a number that is reckoned from those of the cards: a difference of places, a product with the factor of a unit. A
/// double has 15 to 17, of which the last ones of such a number are rounding; without them the digits of the cards show again.
const DIGITS: i32 = 13;
/// From here on a number is written with an exponent.
const LARGE: f64 = 1e9;
/// Below this too.
const SMALL: f64 = 1e-4;

/// A number as a record has it: the shortest text that reads back as it.
pub(super) fn number(value: f64) -> String {
    // a zero has no sign here
    let value = value + 0.0;
    let size = value.abs();
    if value == 0.0 || (SMALL..LARGE).contains(&size) { format!("{value}") } else { format!("{value:E}") }
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
    let power = DIGITS - 1 - size.log10().floor() as i32;
    let kept = if power >= 0 {
        (value * 10f64.powi(power)).round() / 10f64.powi(power)
    } else {
        (value / 10f64.powi(-power)).round() * 10f64.powi(-power)
    };
    if kept.is_finite() { kept } else { value }
}

/// A reckoned number without what is rounding.
pub(super) fn rounded(value: f64) -> f64 {
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
    pub(super) fn of(units: &Units) -> Self {
        Scale { metres: units.length, kilograms: units.mass }
    }

    /// A number of a card times the factor of its unit; one that keeps its unit is not touched.
    fn times(value: f64, factor: f64) -> f64 {
        if factor == 1.0 { value } else { rounded(value * factor) }
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

    /// Force times a length to a power (kN m^p).
    pub(super) fn force(&self, value: f64, power: i32) -> f64 {
        Self::times(value, self.kilograms * self.metres.powi(1 + power) / 1000.0)
    }

    /// Pressure, modulus (Pa).
    pub(super) fn pascals(&self, value: f64) -> f64 {
        Self::times(value, self.kilograms / self.metres)
    }
}

/// Records being written.
#[derive(Debug)]
pub(super) struct Script {
    /// The factors of the units.
    pub(super) scale: Scale,
    /// The lines so far.
    pub(super) lines: Vec<String>,
    /// What could not be written.
    pub(super) wrong: Vec<Diagnostic>,
}

impl Script {
    pub(super) fn new(scale: Scale) -> Self {
        Script { scale, lines: Vec::new(), wrong: Vec::new() }
    }

    /// Adds a record.
    pub(super) fn record(&mut self, text: impl Into<String>) {
        self.lines.push(text.into());
    }

    /// Adds a remark line.
    pub(super) fn remark(&mut self, text: &str) {
        // what comes from a deck may hold anything; a remark is one line
        let text: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        let text = format!("$ {text}");
        if self.lines.last() != Some(&text) {
            self.lines.push(text);
        }
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
    fn a_number_reads_back_as_it_is() {
        for value in [0.0, -0.0, 27.787, 1e15, 1.3367e24, -1e-10, 0.1 + 0.2, 2.15e11, 329.73543, 1e-4] {
            assert_eq!(windlass_language::number::evaluate(&number(value)), Ok(value + 0.0), "{value}");
        }
        assert_eq!((number(27.787).as_str(), number(-0.0).as_str()), ("27.787", "0"));
    }

    #[test]
    fn reckoned_numbers_have_the_digits_of_the_cards() {
        assert_eq!(difference(7.503 + 27.787 * 9.0, 7.503 + 27.787 * 8.0), 27.787);
        assert_eq!((difference(28.5, 63.6), difference(0.1 + 0.2, 0.3)), (-35.1, 0.0));
        let scale = Scale::of(&Units { length: 1.0, mass: 1000.0, name: "" });
        assert_eq!((scale.density(7.81694), scale.density(1.025), scale.force(0.5, -1)), (7816.94, 1025.0, 0.5));
        assert_eq!((opposite(180.0), opposite(0.0), opposite(-90.0), opposite(-180.0)), (0.0, 180.0, 90.0, 0.0));
    }
}
