//! How many digits a number is printed with: the one place that decides.

use windlass_base::table::{Cell, Column, Digits};
use windlass_base::units::{Dim, ForceUnit, LengthUnit, UnitSystem};
use windlass_language::functions::exponent;

/// What a cell without a value prints as.
const MISSING: &str = "";

/// A cell of a formatted report: fixed digits, as wide as it needs.
pub fn report(cell: &Cell, dim: Dim, digits: Digits, units: UnitSystem) -> String {
    format_cell(cell, dim, digits, units, 0)
}

/// A cell of `VIEW`: three digits more than the report has.
pub fn view(cell: &Cell, dim: Dim, digits: Digits, units: UnitSystem) -> String {
    format_cell(cell, dim, digits, units, 3)
}

/// A cell of a file: the shortest text that reads back to the same number.
pub fn full(cell: &Cell, dim: Dim, units: UnitSystem) -> String {
    match cell {
        Cell::Number(value) => number_in_full(dim.from_si(*value, units)),
        Cell::Integer(value) => value.to_string(),
        Cell::Text(text) => text.clone(),
        Cell::Missing => String::new(),
    }
}

/// A number for a variable: fifteen figures, so that the rounding of unit conversion does not show.
pub fn fifteen_figures(value: f64) -> String {
    number_in_full(rounded_to_fifteen_figures(value))
}

/// A number rounded to fifteen figures: what was written in user units comes back as it was written.
pub fn rounded_to_fifteen_figures(value: f64) -> f64 {
    format!("{value:.14e}").parse().unwrap_or(value)
}

/// A number as the shortest text that reads back to it; `NaN` and infinities are named.
pub fn number_in_full(value: f64) -> String {
    if value == 0.0 {
        return "0".into();
    }
    if (1e-5..1e16).contains(&value.abs()) { format!("{value}") } else { format!("{value:e}") }
}

fn format_cell(cell: &Cell, dim: Dim, digits: Digits, units: UnitSystem, more: u8) -> String {
    match cell {
        Cell::Missing => MISSING.into(),
        Cell::Text(text) => one_line(text),
        Cell::Integer(value) => value.to_string(),
        Cell::Number(value) => {
            let value = dim.from_si(*value, units);
            if !value.is_finite() {
                return value.to_string();
            }
            match digits {
                Digits::Usual => format_fixed(value, usual(dim, units).saturating_add(more)),
                Digits::Decimals(count) => format_fixed(value, count.saturating_add(more)),
                Digits::Scientific(count) => exponent(value, usize::from(count.saturating_add(more)).saturating_sub(1)),
            }
        }
    }
}

/// Text that keeps to its line and column: line ends, tabs and other control characters become blanks.
fn one_line(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}

/// Fixed decimals; a number that would lose all its digits, or is very long, is printed in E format instead.
fn format_fixed(value: f64, decimals: u8) -> String {
    let decimals = usize::from(decimals);
    let smallest = 10f64.powi(-i32::try_from(decimals).unwrap_or(0));
    if value != 0.0 && (value.abs() <= 0.5 * smallest || value.abs() >= 1e12) {
        return exponent(value, 3);
    }
    let text = format!("{value:.decimals$}");
    if text.trim_start_matches('-').bytes().all(|b| b == b'0' || b == b'.') { text.replace('-', "") } else { text }
}

/// Decimals of a dimension in the user's units.
fn usual(dim: Dim, units: UnitSystem) -> u8 {
    let small_force = matches!(units.force, ForceUnit::Newtons);
    match dim {
        Dim::Length | Dim::Angle | Dim::Time | Dim::TemperatureRise => 2,
        Dim::Velocity | Dim::WindSpeed | Dim::Area | Dim::SectionArea | Dim::Volume => 2,
        Dim::Force | Dim::Moment | Dim::MomentPerRadian => {
            if small_force {
                0
            } else {
                2
            }
        }
        Dim::ForcePerLength => {
            if small_force {
                2
            } else {
                4
            }
        }
        Dim::Section => {
            if units.length == LengthUnit::Feet {
                3
            } else {
                1
            }
        }
        Dim::Stress => {
            if units.length == LengthUnit::Feet {
                2
            } else {
                1
            }
        }
        Dim::Density | Dim::KilogramsPerCubicMetre => 3,
        Dim::Mass | Dim::MassPerLength | Dim::Metres => 2,
        Dim::Acceleration => 5,
        Dim::Newtons | Dim::Pascals | Dim::NewtonSquareMetres => 0,
        Dim::None
        | Dim::Days
        | Dim::Frequency
        | Dim::AngularVelocity
        | Dim::AngularAcceleration
        | Dim::SpectralDensity
        | Dim::AngleDensity
        | Dim::Damping(_)
        | Dim::Derived { .. }
        | Dim::SquareMetres
        | Dim::InSi(_) => 4,
        Dim::ThermalExpansion => 8,
    }
}

/// A column's head in a file or an axis: `X (ft)`.
pub fn head(column: &Column, units: UnitSystem) -> String {
    name_with_unit(&column.name, column.dim, units)
}

/// A name with its unit behind it.
pub fn name_with_unit(name: &str, dim: Dim, units: UnitSystem) -> String {
    let label = dim.label(units);
    if label.is_empty() { name.to_string() } else { format!("{name} ({label})") }
}

/// A tick label of an axis whose ticks are `step` apart and nowhere larger than `largest`: as many decimals as tell
/// the ticks apart, E format where fixed decimals would be long.
pub fn tick(value: f64, step: f64, largest: f64) -> String {
    let position = |v: f64| if v > 0.0 { (v.log10() + 1e-9).floor() as i32 } else { 0 };
    let (finest, coarsest) = (position(step), position(largest));
    if value.abs() < 0.5 * step {
        return "0".into();
    }
    if coarsest >= 9 || finest < -6 {
        let digits = usize::try_from(position(value.abs()) - finest).unwrap_or(0);
        return exponent(value, digits.min(16));
    }
    let decimals = usize::try_from(-finest).unwrap_or(0);
    format!("{value:.decimals$}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn printed_digits_stay_significant_in_every_unit() {
        let us = UnitSystem::default();
        let show = |v: f64, dim: Dim, units| report(&Cell::Number(dim.to_si(v, units)), dim, Digits::Usual, units);
        assert_eq!(show(0.03751, Dim::ForcePerLength, us), "0.0375");
        assert_eq!(show(7536.62, Dim::Length, us), "7536.62");
        assert_eq!(show(1.2e7, Dim::Force, UnitSystem::SI), "12000000");
        assert_eq!(show(1e-9, Dim::Length, us), "1.000E-09");
        assert_eq!(show(-1e-17, Dim::Length, us), "-1.000E-17");
        assert_eq!(show(-0.0, Dim::Length, us), "0.00");
        assert_eq!(report(&Cell::Number(f64::NAN), Dim::Length, Digits::Usual, us), "NaN");
        assert_eq!(report(&Cell::Number(48720.1), Dim::None, Digits::Scientific(4), us), "4.872E+04");
    }

    #[test]
    fn number_in_file_reads_back_to_same_bits() {
        for value in [1.0 / 3.0, 1e-300, 123_456_789.123_456_79, -2.5e17] {
            assert_eq!(number_in_full(value).parse::<f64>().unwrap().to_bits(), value.to_bits());
        }
    }

    #[test]
    fn tick_labels_have_enough_digits_to_differ() {
        let ticks = |step: f64, last: i32| (0..=last).map(|k| tick(f64::from(k) * step, step, step * 10.0)).collect();
        let list: Vec<Vec<String>> = vec![ticks(0.5, 2), ticks(200.0, 2), ticks(2e-9, 2), ticks(5e9, 2)];
        assert_eq!(list[0], ["0", "0.5", "1.0"]);
        assert_eq!(list[1], ["0", "200", "400"]);
        assert_eq!(list[2], ["0", "2E-09", "4E-09"]);
        assert_eq!(list[3], ["0", "5E+09", "1.0E+10"]);
    }

    #[test]
    fn control_characters_do_not_break_a_line() {
        let cell = Cell::Text("a\nb\t\u{1b}[31mc".into());
        assert_eq!(report(&cell, Dim::None, Digits::Usual, UnitSystem::default()), "a b  [31mc");
    }

    fn systems() -> impl Strategy<Value = UnitSystem> {
        let lengths = prop_oneof![Just(LengthUnit::Feet), Just(LengthUnit::Meters)];
        let forces = prop_oneof![
            Just(ForceUnit::Kips),
            Just(ForceUnit::LongTons),
            Just(ForceUnit::ShortTons),
            Just(ForceUnit::Kilonewtons),
            Just(ForceUnit::MetricTons),
            Just(ForceUnit::Newtons),
        ];
        (lengths, forces).prop_map(|(length, force)| UnitSystem { length, force })
    }

    proptest! {
        #[test]
        fn printed_number_is_rounded_and_never_lost(
            value in prop_oneof![-1e7..1e7f64, -1e-3..1e-3f64, any::<f64>().prop_filter("finite", |v| v.is_finite())],
            units in systems(),
            more in 0u8..4,
        ) {
            for dim in [Dim::Length, Dim::Force, Dim::ForcePerLength, Dim::Section, Dim::Stress, Dim::None] {
                let want = dim.from_si(value, units);
                prop_assume!(want.is_finite());
                let text = format_cell(&Cell::Number(value), dim, Digits::Usual, units, more);
                let got: f64 = text.parse().unwrap();
                let position = 10f64.powi(-i32::from(usual(dim, units) + more));
                prop_assert!((got - want).abs() <= (0.5001 * position).max(0.000_51 * want.abs()), "{want} as {text}");
                prop_assert!(want == 0.0 || got != 0.0, "{want} as {text}");
            }
        }
    }
}
