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
enum Asked {
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
const OPTIONS: &[(&str, Owner, Asked)] = &[
    ("-AMOUNT", Owner::Moses, Asked::Amount),
    ("-PERCENT", Owner::Moses, Asked::Percent),
    ("-FRACTION", Owner::Ours, Asked::Fraction),
    ("-SOUNDING", Owner::Ours, Asked::Sounding),
    ("-VOLUME", Owner::Ours, Asked::Volume),
    ("-CG", Owner::Ours, Asked::Centre),
    ("-SPGR", Owner::Ours, Asked::SpecificGravity),
    ("-HOLES", Owner::Ours, Asked::Holes),
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
    if asked == Asked::Holes {
        return Ok(found.holes.join(" "));
    }
    let state = find_contents(model, found).map_err(|e| e.diagnostic(name.span, job.units))?;
    let gravity = numbers(&[state.density / 1000.0], Dim::None, job);
    let record = |value: f64, dim: Dim| format!("{} {} {gravity}", found.name, numbers(&[value], dim, job));
    Ok(match asked {
        Asked::Amount => record(state.volume * state.density * model.defaults.gravity, Dim::Force),
        Asked::Percent => record(100.0 * state.volume / state.capacity, Dim::None),
        Asked::Fraction => record(state.volume / state.capacity, Dim::None),
        Asked::Sounding => state.sounding.map_or(String::new(), |sounding| record(sounding, Dim::Length)),
        Asked::Volume => numbers(&[state.volume], Dim::Volume, job),
        Asked::Centre => {
            let [x, y, z] = state.centre;
            let centre = x.zip(y).zip(z).map(|((x, y), z)| [x, y, z]);
            centre.map_or(String::new(), |centre| numbers(&centre, Dim::Length, job))
        }
        Asked::SpecificGravity => gravity,
        Asked::Holes => String::new(),
    })
}
