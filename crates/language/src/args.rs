//! Reading a record's words against its [`CommandSpec`]: data and options in any order, abbreviations, arity, types,
//! ranges, and the one conversion to SI.
//!
//! Source: [MOSES-REF ams_cmd_menu, men_select]. An option takes its own known number of values; values that may be
//! left out or repeat are taken until a word of another type comes; the remaining words are positional data.

mod convert;

use super::record::Word;
use super::select;
use super::spec::{CommandSpec, Kind, OptionSpec, ValueSpec, describe_expected};
use super::token::TokenKind as Lex;
use convert::{convert, take};
use std::collections::BTreeMap;
use windlass_base::diagnostic::{Diagnostic, Outcome, did_you_mean};
use windlass_base::span::Span;
use windlass_base::units::UnitSystem;
use windlass_base::values::{Args, Given, Value};

/// Reads the words behind a command word.
///
/// # Errors
/// An unknown or ambiguous option, an option given twice, a missing or surplus value, text for a number, a number out
/// of range: each at its word, with what was expected.
pub fn read(spec: &'static CommandSpec, command: Span, words: &[Word], units: UnitSystem) -> Outcome<Args> {
    let mut args = Args { declared: spec.options, declared_data: spec.data, ..Args::empty(command) };
    let mut data: Vec<&Word> = Vec::new();
    // words behind an option that could have been its choice and are none of it
    let mut declined: Vec<DeclinedChoice> = Vec::new();
    // data behind an option's values, each with the option
    let mut behind: Vec<(&Word, &Given)> = Vec::new();
    let mut trailing: Vec<(&Word, usize)> = Vec::new();
    let mut at = 0;
    while let Some(word) = words.get(at) {
        if word.kind == Lex::Option {
            let what = format!("option of {}", spec.name);
            if let Some((name, why)) = spec.absent.iter().find(|(name, _)| name.eq_ignore_ascii_case(&word.text)) {
                return Err(Diagnostic::error(format!("{name} of {} is not supported: {why}", spec.name), word.span));
            }
            let option = select::choose(&word.text, word.span, &what, spec.option_names())?;
            if !option.many
                && let Some(first) = args.options.iter().find(|given| given.is(option))
            {
                return Err(Diagnostic::error(format!("{} is given twice", option.name), word.span)
                    .other(first.span, "first given here"));
            }
            let taken = words.get(at + 1..).map_or(&[][..], |rest| take(option, rest));
            let owner = format!("{} of {}", option.name, spec.name);
            let values = convert(option.values, option.repeat, &owner, word.span, &refs(taken), units)
                .map_err(|error| hint(error, &option.syntax()))?;
            args.options.push(Given { option, span: word.span, values, after: data.len() });
            at += 1 + taken.len();
            if let (Some(next), Some(value)) = (words.get(at), option.values.get(taken.len()))
                && matches!(value.kind, Kind::Choice(_))
            {
                declined.push(DeclinedChoice { word: next, option, value });
            }
        } else {
            if let Some(option) = args.options.len().checked_sub(1) {
                trailing.push((word, option));
            }
            data.push(word);
            at += 1;
        }
    }
    behind.extend(trailing.iter().filter_map(|(word, option)| Some((*word, args.options.get(*option)?))));
    args.data = convert(spec.data, spec.repeat, spec.name, command, &data, units).map_err(|error| {
        let meant = declined.iter().find(|choice| error.span == Some(choice.word.span));
        let stray = behind.iter().find(|(word, _)| error.span == Some(word.span));
        match (meant, stray) {
            (Some(choice), _) => choice.error(spec, units).label(format!("nor can this be a datum: {}", error.message)),
            (None, Some((word, given))) => hint(error, &spec.syntax()).help(missing_option(word, given)),
            (None, None) => hint(error, &spec.syntax()),
        }
    })?;
    strays(spec, &args.data, &behind, &declined, units)?;
    Ok(args)
}

/// A word behind an option that could have been one of its choices and is none.
struct DeclinedChoice<'w> {
    word: &'w Word,
    option: &'static OptionSpec,
    value: &'static ValueSpec,
}

impl DeclinedChoice<'_> {
    /// What the value must be, with the choice that is nearest to the word.
    fn error(&self, spec: &CommandSpec, units: UnitSystem) -> Box<Diagnostic> {
        let expected = describe_expected(self.value.kind, units);
        let text = format!("{} of {} of {} must be {expected}", self.value.name, self.option.name, spec.name);
        let error = Diagnostic::error(text, self.word.span);
        let near = match self.value.kind {
            Kind::Choice(choices) => did_you_mean(&self.word.text, choices.iter().copied()),
            _ => None,
        };
        match near {
            Some(near) => error.help(near),
            None => error,
        }
    }
}

/// Words behind the values of an option that are data by nothing but their place: a unit, a value too many, the values of an option
/// left out. Data may stand behind an option where the record needs them, or where a word shows what it is: a choice, a point, a class.
///
/// # Errors
/// The first such word.
fn strays(
    spec: &CommandSpec,
    data: &[Value],
    behind: &[(&Word, &Given)],
    declined: &[DeclinedChoice],
    units: UnitSystem,
) -> Outcome<()> {
    if spec.interleaved || behind.is_empty() {
        return Ok(());
    }
    let fixed = spec.data.len() - spec.repeat.min(spec.data.len());
    // what was passed over before a word has its place too: the last of a span is the word's
    let key = |span: Span| (span.source, span.start, span.end);
    let positions: BTreeMap<_, usize> =
        data.iter().enumerate().map(|(index, value)| (key(value.span), index)).collect();
    let kind_of = |word: &Word| {
        let index = *positions.get(&key(word.span))?;
        match spec.data.get(index) {
            Some(value) => Some((value, value.is_required())),
            None if spec.repeat > 0 => Some((spec.data.get(fixed + (index - fixed) % spec.repeat)?, false)),
            None => None,
        }
    };
    for run in behind.chunk_by(|(_, one), (_, other)| one.span == other.span) {
        let kinds: Vec<_> = run.iter().filter_map(|(word, given)| Some((word, given, kind_of(word)?))).collect();
        if kinds.iter().any(|(.., (_, required))| *required) {
            continue;
        }
        let by_place = |word: &Word, value: &ValueSpec| {
            let shows = matches!(word.kind, Lex::Selector | Lex::Class | Lex::Point);
            !shows && !matches!(value.kind, Kind::Choice(_))
        };
        if let Some((word, given, (value, _))) = kinds.iter().find(|(word, _, (value, _))| by_place(word, value)) {
            if let Some(choice) = declined.iter().find(|choice| choice.word.span == word.span) {
                return Err(choice
                    .error(spec, units)
                    .label(format!("{} of {} stands before the options", value.name, spec.name))
                    .help(format!("form: {}", spec.syntax())));
            }
            return Err(Diagnostic::error(
                format!("`{}` follows {}, which takes no further value", word.text, given.name()),
                word.span,
            )
            .label(format!("{} of {} stands before the options", value.name, spec.name))
            .help(missing_option(word, given))
            .help(format!("form: {}", spec.syntax())));
        }
    }
    Ok(())
}

/// What may be wrong with a word behind an option.
fn missing_option(word: &Word, given: &Given) -> String {
    const UNITS: [&str; 24] = [
        "m", "mm", "cm", "km", "ft", "in", "feet", "kn", "n", "kips", "kip", "t", "mt", "te", "s", "sec", "deg",
        "knots", "kts", "m/s", "kg", "mpa", "ksi", "rad",
    ];
    if UNITS.contains(&word.text.to_ascii_lowercase().as_str()) {
        return "numbers have no units in a record: &DIMEN sets them".into();
    }
    format!("is an option missing before it? {} has all its values", given.name())
}

fn refs(words: &[Word]) -> Vec<&Word> {
    words.iter().collect()
}

/// Adds the record's form to an error that is about its form.
fn hint(error: Box<Diagnostic>, syntax: &str) -> Box<Diagnostic> {
    if error.help.is_empty() { error.help(format!("form: {syntax}")) } else { error }
}
