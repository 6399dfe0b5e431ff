//! `&COMPARTMENT`: what is in a compartment.
//!
//! Source: [MOSES-HELP compart]: the value of `-AMOUNT` is put behind `-AMOUNT` of the record `&COMPARTMENT`, so that it is name, amount and specific
//! gravity. The other options are our reading.

use super::numbers;
use crate::commands::Job;
use crate::commands::status::compartments::find_contents;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::units::Dim;
use windlass_language::record::Word;
use windlass_language::select::{Owner, choose};
use windlass_model::find;

/// What the function gives.
#[derive(Clone, Copy, PartialEq)]
enum CompartmentQuantity {
    Amount,
    Percent,
    Fraction,
    Sounding,
    Volume,
    Centre,
    SpecificGravity,
    Holes,
}

/// The options.
const OPTIONS: &[(&str, Owner, CompartmentQuantity)] = &[
    ("-AMOUNT", Owner::Moses, CompartmentQuantity::Amount),
    ("-PERCENT", Owner::Moses, CompartmentQuantity::Percent),
    ("-FRACTION", Owner::Ours, CompartmentQuantity::Fraction),
    ("-SOUNDING", Owner::Ours, CompartmentQuantity::Sounding),
    ("-VOLUME", Owner::Ours, CompartmentQuantity::Volume),
    ("-CG", Owner::Ours, CompartmentQuantity::Centre),
    ("-SPGR", Owner::Ours, CompartmentQuantity::SpecificGravity),
    ("-HOLES", Owner::Ours, CompartmentQuantity::Holes),
];

/// The value of `&COMPARTMENT(NAME -OPTION)`.
pub(super) fn compartment(job: &Job, name: &Word, rest: &[Word], span: Span) -> Outcome<String> {
    let model = &job.model;
    let found = find(&model.compartments, &name.text, "compartment", name.span)?;
    let Some(option) = rest.first() else {
        let known: Vec<&str> = OPTIONS.iter().map(|(name, ..)| *name).collect();
        return Err(
            Diagnostic::error("&COMPARTMENT lacks its option", span).help(format!("known: {}", known.join(" ")))
        );
    };
    let asked = choose(&option.text, option.span, "option of &COMPARTMENT", OPTIONS.iter().copied())?;
    if asked == CompartmentQuantity::Holes {
        return Ok(found.holes.join(" "));
    }
    let state = find_contents(model, found).map_err(|e| e.diagnostic(name.span, job.units))?;
    let gravity = numbers(&[state.density / 1000.0], Dim::None, job);
    let record = |value: f64, dim: Dim| format!("{} {} {gravity}", found.name, numbers(&[value], dim, job));
    Ok(match asked {
        CompartmentQuantity::Amount => record(state.volume * state.density * model.defaults.gravity, Dim::Force),
        CompartmentQuantity::Percent => record(100.0 * state.volume / state.capacity, Dim::None),
        CompartmentQuantity::Fraction => record(state.volume / state.capacity, Dim::None),
        CompartmentQuantity::Sounding => state.sounding.map_or(String::new(), |sounding| record(sounding, Dim::Length)),
        CompartmentQuantity::Volume => numbers(&[state.volume], Dim::Volume, job),
        CompartmentQuantity::Centre => {
            let [x, y, z] = state.centre;
            let centre = x.zip(y).zip(z).map(|((x, y), z)| [x, y, z]);
            centre.map_or(String::new(), |centre| numbers(&centre, Dim::Length, job))
        }
        CompartmentQuantity::SpecificGravity => gravity,
        CompartmentQuantity::Holes => String::new(),
    })
}
