//! The words of a record or an option as values: how many are taken, whether they fit, the conversion to SI.

use crate::name;
use crate::number;
use crate::record::Word;
use crate::select::{self, Owner};
use crate::spec::{Kind, Need, OptionSpec, Range, ValueSpec, describe_expected};
use crate::token::{TokenKind as Lex, is_numeric};
use std::sync::Arc;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::units::{Dim, UnitSystem};
use windlass_base::values::{Content, Noun, Value};

/// The words that belong to an option: a required value takes whatever stands there, an optional or repeated one only
/// a word of its own type.
pub(super) fn take<'a>(option: &OptionSpec, words: &'a [Word]) -> &'a [Word] {
    let mut count = 0;
    let fixed = option.values.len() - option.repeat.min(option.values.len());
    let mut index = 0;
    while let Some(word) = words.get(count) {
        let (value, again) = match option.values.get(index) {
            Some(value) => (value, false),
            None if option.repeat > 0 => {
                let within = (index - fixed) % option.repeat;
                match option.values.get(fixed + within) {
                    Some(value) => (value, within == 0),
                    None => break,
                }
            }
            None => break,
        };
        // as in `convert`, an optional value is passed over when the word is of the type of the next one
        let passed = (!value.is_required() || again) && !fits(value.kind, word);
        let next = option.values.get(index + 1).is_some_and(|next| passed && fits(next.kind, word));
        if word.kind == Lex::Option || (passed && !next) {
            break;
        }
        count += usize::from(!passed);
        index += 1;
    }
    words.get(..count).unwrap_or_default()
}

/// Whether a word has the type of a value, judged by its look.
fn fits(kind: Kind, word: &Word) -> bool {
    if word.kind == Lex::Empty {
        return true;
    }
    let numeric = is_numeric(word.kind, &word.text);
    match kind {
        Kind::Number(_) | Kind::Integer | Kind::StiffnessOfDof | Kind::ForceOfDof | Kind::DampingCoefficient => numeric,
        Kind::Choice(choices) => {
            word.kind == Lex::Word
                && select::keyword(&word.text, choices.iter().map(|c| (*c, Owner::Moses, ())))
                    == select::SearchResult::One(())
        }
        Kind::Name(Noun::Class) => word.kind == Lex::Class,
        Kind::Name(Noun::Point) => word.kind == Lex::Point,
        Kind::Name(Noun::Selector) => {
            matches!(word.kind, Lex::Word | Lex::Selector | Lex::Quoted | Lex::Point | Lex::Class)
        }
        Kind::Item => !matches!(word.kind, Lex::Option | Lex::Empty),
        Kind::ChoiceOrName(..) | Kind::Name(_) | Kind::Text | Kind::File => {
            matches!(word.kind, Lex::Word | Lex::Quoted) && !numeric
        }
    }
}

/// Converts the words of a record or an option.
pub(super) fn convert(
    specs: &[ValueSpec],
    repeat: usize,
    owner: &str,
    at: Span,
    words: &[&Word],
    units: UnitSystem,
) -> Outcome<Vec<Value>> {
    let mut values: Vec<Value> = Vec::with_capacity(words.len());
    let fixed = specs.len() - repeat.min(specs.len());
    let spec_at = |index: usize| {
        if index < specs.len() || repeat == 0 { specs.get(index) } else { specs.get(fixed + (index - fixed) % repeat) }
    };
    for (index, word) in words.iter().enumerate() {
        // an optional datum is passed over when the word is of the type of the next one and not of its own
        while let Some(spec) = spec_at(values.len())
            && !spec.is_required()
            && !fits(spec.kind, word)
            && spec_at(values.len() + 1).is_some_and(|next| fits(next.kind, word))
        {
            values.push(Value::empty(word.span));
        }
        let Some(spec) = spec_at(values.len()) else {
            return Err(Diagnostic::error(format!("{owner} takes no further value"), word.span)
                .label(format!("unexpected `{}`", word.text)));
        };
        let before = [1, 2].map(|back| values.len().checked_sub(back).and_then(|i| values.get(i)).cloned());
        values.push(convert_value(spec, word, before, words.get(index + 1).copied(), owner, units)?);
    }
    let given = values.len();
    let missing = if given < specs.len() {
        specs.get(given..).unwrap_or_default().iter().find(|s| s.is_required())
    } else if repeat > 0 && !(given - fixed).is_multiple_of(repeat) {
        specs.get(fixed + (given - fixed) % repeat..).unwrap_or_default().iter().find(|s| s.is_required())
    } else {
        None
    };
    if let Some(spec) = missing {
        let position = values.last().map_or(at, |v| v.span);
        return Err(Diagnostic::error(format!("{owner} lacks its value {}", spec.name), position).label(format!(
            "expected {} after this: {}",
            describe_expected(spec.kind, units),
            spec.help
        )));
    }
    Ok(values)
}

fn convert_value(
    spec: &ValueSpec,
    word: &Word,
    before: [Option<Value>; 2],
    after: Option<&Word>,
    owner: &str,
    units: UnitSystem,
) -> Outcome<Value> {
    let span = word.span;
    if word.kind == Lex::Empty {
        if let Need::Required = spec.need {
            return Err(Diagnostic::error(format!("{} of {owner} may not be left out", spec.name), span)
                .label(format!("expected {}", describe_expected(spec.kind, units))));
        }
        return Ok(Value::empty(span));
    }
    let angular = before
        .iter()
        .flatten()
        .find_map(|v| match &v.content {
            Content::Word(dof) => Some(dof.len() == 2 && dof.starts_with(['R', 'r'])),
            _ => None,
        })
        .unwrap_or(false);
    let dim = match spec.kind {
        Kind::Number(dim) => dim,
        Kind::StiffnessOfDof if angular => Dim::MomentPerRadian,
        Kind::StiffnessOfDof => Dim::ForcePerLength,
        Kind::ForceOfDof if angular => Dim::Moment,
        Kind::ForceOfDof => Dim::Force,
        Kind::DampingCoefficient => Dim::Damping(after.and_then(|w| number::evaluate(&w.text).ok()).unwrap_or(1.0)),
        _ => Dim::None,
    };
    let noun = if let Kind::Name(noun) = spec.kind { Some(noun) } else { None };
    let content = match spec.kind {
        Kind::Number(_) | Kind::StiffnessOfDof | Kind::ForceOfDof | Kind::DampingCoefficient => {
            Content::Number(number_in(spec, word, owner, dim, units)?)
        }
        Kind::Integer => {
            let value = number_in(spec, word, owner, Dim::None, units)?;
            if value.fract() != 0.0 || value.abs() > 9.0e15 {
                return Err(Diagnostic::error(format!("{} of {owner} must be a whole number", spec.name), span)
                    .label(format!("this is {}", in_short(value))));
            }
            Content::Integer(value as i64)
        }
        Kind::Choice(choices) => {
            let what = format!("value of {} of {owner}", spec.name);
            let names = choices.iter().map(|c| (*c, Owner::Moses, *c));
            let known = |mut error: Box<Diagnostic>| {
                // the nearest word is named; a short list shows what else there is
                if error.help.iter().all(|help| !help.starts_with("known: ")) {
                    error.help.extend(select::list_known(choices));
                }
                error
            };
            Content::Word(Arc::from(select::choose(&word.text, span, &what, names).map_err(known)?))
        }
        Kind::Name(noun) => {
            noun_fits(spec, noun, word, owner, units)?;
            Content::Word(word.text.clone())
        }
        Kind::ChoiceOrName(..) | Kind::Text | Kind::Item | Kind::File => Content::Word(word.text.clone()),
    };
    Ok(Value { content, dim, noun, span })
}

/// A number without hundreds of digits.
fn in_short(value: f64) -> String {
    if value != 0.0 && !(1e-5..1e15).contains(&value.abs()) { format!("{value:E}") } else { value.to_string() }
}

/// Whether a word can be a name of this sort.
fn noun_fits(spec: &ValueSpec, noun: Noun, word: &Word, owner: &str, units: UnitSystem) -> Outcome<()> {
    let fitting = match noun {
        Noun::Class => word.kind == Lex::Class && word.text.len() > 1,
        Noun::Point => word.kind == Lex::Point && word.text.len() > 1,
        Noun::Selector => true,
        Noun::Line => matches!(word.kind, Lex::Word | Lex::Quoted | Lex::Number | Lex::Internal),
        _ => matches!(word.kind, Lex::Word | Lex::Quoted | Lex::Number),
    };
    if !fitting {
        return Err(Diagnostic::error(
            format!("{} of {owner} must be {}", spec.name, describe_expected(spec.kind, units)),
            word.span,
        )
        .label(format!("`{}` is not one", word.text)));
    }
    if word.text.chars().count() > name::MAX_NAME_CHARACTERS {
        return Err(Diagnostic::error(
            format!("a name may have at most {} characters", name::MAX_NAME_CHARACTERS),
            word.span,
        )
        .label(format!("this one has {}", word.text.chars().count())));
    }
    Ok(())
}

fn number_in(spec: &ValueSpec, word: &Word, owner: &str, dim: Dim, units: UnitSystem) -> Outcome<f64> {
    let value = number::evaluate(&word.text).map_err(|error| {
        Diagnostic::error(
            format!("{} of {owner} must be {}", spec.name, describe_expected(Kind::Number(dim), units)),
            word.span,
        )
        .label(error.to_string())
    })?;
    let wrong = match spec.range {
        Range::Any => None,
        Range::Positive => (value <= 0.0).then(|| "greater than zero".to_string()),
        Range::NotNegative => (value < 0.0).then(|| "zero or more".to_string()),
        Range::Within(low, high) => (value < low || value > high).then(|| format!("between {low} and {high}")),
    };
    if let Some(want) = wrong {
        return Err(Diagnostic::error(format!("{} of {owner} must be {want}", spec.name), word.span)
            .label(format!("this is {}", in_short(value))));
    }
    dim.checked_si(value, units).map_err(|error| {
        Diagnostic::error(format!("{} of {owner} is too {}", spec.name, error.size()), word.span)
            .label(error.to_string())
    })
}
