//! Reading a record's words against its [`CommandSpec`]: data and options in any order, abbreviations, arity, types,
//! ranges, and the one conversion to SI.
//!
//! Source: reference/language.md sections 1 and 2. An option takes its own known number of values; values that may be
//! left out or repeat are taken until a word of another type comes; the remaining words are positional data.

mod convert;

use super::record::Word;
use super::select;
use super::spec::{CommandSpec, Kind, OptionSpec, ValueSpec, expected};
use super::token::Kind as Lex;
use convert::{convert, take};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::units::UnitSystem;
use windlass_base::values::{Args, Given};

/// Reads the words behind a command word.
///
/// # Errors
/// An unknown or ambiguous option, an option given twice, a missing or surplus value, text for a number, a number out
/// of range: each at its word, with what was expected.
pub fn read(spec: &'static CommandSpec, command: Span, words: &[Word], units: UnitSystem) -> Outcome<Args> {
    let mut args = Args { span: command, data: Vec::new(), options: Vec::new() };
    let mut data: Vec<&Word> = Vec::new();
    // words behind an option that could have been its choice and are none of it
    let mut declined: Vec<(&Word, &'static OptionSpec, &'static ValueSpec)> = Vec::new();
    let mut at = 0;
    while let Some(word) = words.get(at) {
        if word.kind == Lex::Option {
            let what = format!("option of {}", spec.name);
            let option = select::choose(&word.text, word.span, &what, spec.option_names())?;
            if !option.many
                && let Some(first) = args.options.iter().find(|g| g.name == option.name)
            {
                return Err(Diagnostic::error(format!("{} is given twice", option.name), word.span)
                    .other(first.span, "first given here"));
            }
            let taken = words.get(at + 1..).map_or(&[][..], |rest| take(option, rest));
            let owner = format!("{} of {}", option.name, spec.name);
            let values = convert(option.values, option.repeat, &owner, word.span, &refs(taken), units)
                .map_err(|error| hint(error, &option.syntax()))?;
            args.options.push(Given { name: option.name, span: word.span, values, after: data.len() });
            at += 1 + taken.len();
            if let (Some(next), Some(value)) = (words.get(at), option.values.get(taken.len()))
                && matches!(value.kind, Kind::Choice(_))
            {
                declined.push((next, option, value));
            }
        } else {
            data.push(word);
            at += 1;
        }
    }
    args.data = convert(spec.data, spec.repeat, spec.name, command, &data, units).map_err(|error| {
        let meant = declined.iter().find(|(word, ..)| error.span == Some(word.span));
        match meant {
            Some((word, option, value)) => Diagnostic::error(
                format!("{} of {} of {} must be {}", value.name, option.name, spec.name, expected(value.kind, units)),
                word.span,
            )
            .label(format!("nor can this be a datum: {}", error.message)),
            None => hint(error, &spec.syntax()),
        }
    })?;
    Ok(args)
}

fn refs(words: &[Word]) -> Vec<&Word> {
    words.iter().collect()
}

/// Adds the record's form to an error that is about its form.
fn hint(error: Box<Diagnostic>, syntax: &str) -> Box<Diagnostic> {
    if error.help.is_empty() { error.help(format!("form: {syntax}")) } else { error }
}
