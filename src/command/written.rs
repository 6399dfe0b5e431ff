//! Values kept in the model as a record would give them now: in the present units.

use crate::connector::CLASSES;
use crate::language::args::{Given, Value};
use crate::language::functions::eight_figures;
use crate::language::spec::{Kind, ValueSpec};
use crate::language::units::{Dim, UnitSystem};

/// The data specs of a class type, the repeating group continued without end.
pub fn kind_data(kind: &str) -> impl Iterator<Item = &'static ValueSpec> + use<> {
    let spec = CLASSES.iter().map(|k| k.spec).find(|s| s.name == kind);
    let (data, repeat) = spec.map_or((&[][..], 0), |s| (s.data, s.repeat));
    let group = data.get(data.len() - repeat..).unwrap_or_default();
    data.iter().chain(group.iter().cycle())
}

/// An option as a record would give it now: values in the present units.
pub fn option_as_written(given: &Given, units: UnitSystem) -> String {
    let specs = given.spec.values;
    let group = specs.get(specs.len() - given.spec.repeat.min(specs.len())..).unwrap_or_default();
    let mut words = vec![given.spec.name.to_string()];
    words.extend(as_written(&given.values, specs.iter().chain(group.iter().cycle()), units));
    words.join(" ")
}

/// Values as a record would give them now; those left out are commas.
pub fn as_written(values: &[Value], specs: impl Iterator<Item = &'static ValueSpec>, units: UnitSystem) -> Vec<String> {
    let exponent = values.get(1).and_then(Value::number).unwrap_or(1.0);
    let mut angular = false;
    values
        .iter()
        .zip(specs)
        .map(|(value, spec)| {
            if let Some(word) = value.word() {
                angular = word.len() == 2 && word.starts_with('R');
            }
            let dim = match spec.kind {
                Kind::Number(dim) => dim,
                Kind::StiffnessOfDof if angular => Dim::MomentPerRadian,
                Kind::StiffnessOfDof => Dim::ForcePerLength,
                Kind::ForceOfDof if angular => Dim::Moment,
                Kind::ForceOfDof => Dim::Force,
                Kind::DampingCoefficient => Dim::Damping(exponent),
                _ => Dim::None,
            };
            match (value.word(), value.integer(), value.number()) {
                (Some(word), _, _) => word.to_string(),
                (_, Some(whole), _) => whole.to_string(),
                (_, _, Some(number)) => shortest(dim, number, units),
                _ => ",".to_string(),
            }
        })
        .collect()
}

/// A number in user units with at most eight figures, the digits a record is likely to have had.
fn shortest(dim: Dim, si: f64, units: UnitSystem) -> String {
    eight_figures(dim.from_si(si, units))
}
