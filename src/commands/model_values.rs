//! Values kept in the model as a record would give them now: in the present units.

use windlass_base::units::eight_figures;
use windlass_base::units::{Dim, UnitSystem};
use windlass_base::values::{Given, Value};

/// An option as a record would give it now: values in the present units.
pub fn option_as_written(given: &Given, units: UnitSystem) -> String {
    let mut words = vec![given.name().to_string()];
    words.extend(as_written(&given.values, units));
    words.join(" ")
}

/// Values as a record would give them now; those left out are commas.
pub fn as_written(values: &[Value], units: UnitSystem) -> Vec<String> {
    values
        .iter()
        .map(|value| match (value.word(), value.integer(), value.number()) {
            (Some(word), _, _) => word.to_string(),
            (_, Some(whole), _) => whole.to_string(),
            (_, _, Some(number)) => shortest(value.dim, number, units),
            _ => ",".to_string(),
        })
        .collect()
}

/// A number in user units with at most eight figures, the digits a record is likely to have had.
fn shortest(dim: Dim, si: f64, units: UnitSystem) -> String {
    eight_figures(dim.from_si(si, units))
}
