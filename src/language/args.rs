//! Reading a record's words against its [`CommandSpec`]: data and options in any order, abbreviations, arity, types,
//! ranges, and the one conversion to SI.
//!
//! Source: reference/language.md sections 1 and 2. An option takes its own known number of values; values that may be
//! left out or repeat are taken until a word of another type comes; the remaining words are positional data.

use super::diagnostic::{Diagnostic, Outcome};
use super::name;
use super::number;
use super::record::Word;
use super::select::{self, Owner};
use super::source::Span;
use super::spec::{CommandSpec, Kind, Need, Noun, OptionSpec, Range, ValueSpec, expected};
use super::token::{Kind as Lex, is_numeric};
use super::units::{Dim, UnitSystem};
use std::sync::Arc;

/// What a value turned out to be.
#[derive(Clone, Debug, PartialEq)]
pub enum Content {
    /// Left out between commas.
    Empty,
    /// A number in SI.
    Number(f64),
    /// A whole number.
    Integer(i64),
    /// A word: the full keyword of a choice, or a name or text as typed.
    Word(Arc<str>),
}

/// A value with the place it was written.
#[derive(Clone, Debug, PartialEq)]
pub struct Value {
    /// What it is.
    pub content: Content,
    /// Where it stands.
    pub span: Span,
}

/// An option as given in a record.
#[derive(Clone, Debug, PartialEq)]
pub struct Given {
    /// Which option.
    pub spec: &'static OptionSpec,
    /// Where its name stands.
    pub span: Span,
    /// Its values.
    pub values: Vec<Value>,
    /// How many positional data came before it in the record.
    pub after: usize,
}

/// A record read: positional data and options in the order given.
#[derive(Clone, Debug, PartialEq)]
pub struct Args {
    /// Where the command word stands.
    pub span: Span,
    /// Positional data.
    pub data: Vec<Value>,
    /// Options in the order given.
    pub options: Vec<Given>,
}

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
                && let Some(first) = args.options.iter().find(|g| std::ptr::eq(g.spec, option))
            {
                return Err(Diagnostic::error(format!("{} is given twice", option.name), word.span)
                    .other(first.span, "first given here"));
            }
            let taken = words.get(at + 1..).map_or(&[][..], |rest| take(option, rest));
            let owner = format!("{} of {}", option.name, spec.name);
            let values = convert(option.values, option.repeat, &owner, word.span, &refs(taken), units)
                .map_err(|error| hint(error, &option.syntax()))?;
            args.options.push(Given { spec: option, span: word.span, values, after: data.len() });
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

/// The words that belong to an option: a required value takes whatever stands there, an optional or repeated one only
/// a word of its own type.
fn take<'a>(option: &OptionSpec, words: &'a [Word]) -> &'a [Word] {
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
                    == select::Choice::One(())
        }
        Kind::Name(Noun::Class) => word.kind == Lex::Class,
        Kind::Name(Noun::Point) => word.kind == Lex::Point,
        Kind::Name(Noun::Selector) => {
            matches!(word.kind, Lex::Word | Lex::Selector | Lex::Quoted | Lex::Point | Lex::Class)
        }
        Kind::ChoiceOrName(..) | Kind::Name(_) | Kind::Text | Kind::File => {
            matches!(word.kind, Lex::Word | Lex::Quoted) && !numeric
        }
    }
}

/// Converts the words of a record or an option.
fn convert(
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
            values.push(Value { content: Content::Empty, span: word.span });
        }
        let Some(spec) = spec_at(values.len()) else {
            return Err(Diagnostic::error(format!("{owner} takes no further value"), word.span)
                .label(format!("unexpected `{}`", word.text)));
        };
        let before = [1, 2].map(|back| values.len().checked_sub(back).and_then(|i| values.get(i)).cloned());
        values.push(one(spec, word, before, words.get(index + 1).copied(), owner, units)?);
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
        let place = values.last().map_or(at, |v| v.span);
        return Err(Diagnostic::error(format!("{owner} lacks its value {}", spec.name), place).label(format!(
            "expected {} after this: {}",
            expected(spec.kind, units),
            spec.help
        )));
    }
    Ok(values)
}

fn one(
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
                .label(format!("expected {}", expected(spec.kind, units))));
        }
        return Ok(Value { content: Content::Empty, span });
    }
    let angular = before
        .iter()
        .flatten()
        .find_map(|v| match &v.content {
            Content::Word(dof) => Some(dof.len() == 2 && dof.starts_with(['R', 'r'])),
            _ => None,
        })
        .unwrap_or(false);
    let content = match spec.kind {
        Kind::Number(dim) => Content::Number(number_in(spec, word, owner, dim, units)?),
        Kind::StiffnessOfDof => {
            let dim = if angular { Dim::MomentPerRadian } else { Dim::ForcePerLength };
            Content::Number(number_in(spec, word, owner, dim, units)?)
        }
        Kind::ForceOfDof => {
            let dim = if angular { Dim::Moment } else { Dim::Force };
            Content::Number(number_in(spec, word, owner, dim, units)?)
        }
        Kind::DampingCoefficient => {
            let exponent = after.and_then(|w| number::evaluate(&w.text).ok()).unwrap_or(1.0);
            Content::Number(number_in(spec, word, owner, Dim::Damping(exponent), units)?)
        }
        Kind::Integer => {
            let value = number_in(spec, word, owner, Dim::None, units)?;
            if value.fract() != 0.0 || value.abs() > 9.0e15 {
                return Err(Diagnostic::error(format!("{} of {owner} must be a whole number", spec.name), span)
                    .label(format!("this is {value}")));
            }
            Content::Integer(value as i64)
        }
        Kind::Choice(choices) => {
            let what = format!("value of {} of {owner}", spec.name);
            let names = choices.iter().map(|c| (*c, Owner::Moses, *c));
            Content::Word(Arc::from(select::choose(&word.text, span, &what, names)?))
        }
        Kind::Name(noun) => {
            noun_fits(spec, noun, word, owner, units)?;
            Content::Word(word.text.clone())
        }
        Kind::ChoiceOrName(..) | Kind::Text | Kind::File => Content::Word(word.text.clone()),
    };
    Ok(Value { content, span })
}

/// Whether a word can be a name of this sort.
fn noun_fits(spec: &ValueSpec, noun: Noun, word: &Word, owner: &str, units: UnitSystem) -> Outcome<()> {
    let fitting = match noun {
        Noun::Class => word.kind == Lex::Class && word.text.len() > 1,
        Noun::Point => word.kind == Lex::Point && word.text.len() > 1,
        Noun::Selector => true,
        _ => matches!(word.kind, Lex::Word | Lex::Quoted | Lex::Number),
    };
    if !fitting {
        return Err(Diagnostic::error(
            format!("{} of {owner} must be {}", spec.name, expected(spec.kind, units)),
            word.span,
        )
        .label(format!("`{}` is not one", word.text)));
    }
    if word.text.chars().count() > name::LONGEST {
        return Err(Diagnostic::error(format!("a name may have at most {} characters", name::LONGEST), word.span)
            .label(format!("this one has {}", word.text.chars().count())));
    }
    Ok(())
}

fn number_in(spec: &ValueSpec, word: &Word, owner: &str, dim: Dim, units: UnitSystem) -> Outcome<f64> {
    let value = number::evaluate(&word.text).map_err(|error| {
        Diagnostic::error(format!("{} of {owner} must be {}", spec.name, expected(Kind::Number(dim), units)), word.span)
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
            .label(format!("this is {value}")));
    }
    let si = dim.to_si(value, units);
    if !si.is_finite() {
        return Err(Diagnostic::error(format!("{} of {owner} is too large", spec.name), word.span));
    }
    Ok(si)
}

impl Value {
    /// The number, if it is one.
    pub fn number(&self) -> Option<f64> {
        match self.content {
            Content::Number(value) => Some(value),
            Content::Integer(value) => Some(value as f64),
            Content::Word(_) | Content::Empty => None,
        }
    }

    /// The word, if it is one.
    pub fn word(&self) -> Option<&str> {
        match &self.content {
            Content::Word(text) => Some(text),
            _ => None,
        }
    }

    /// The whole number, if it is one.
    pub fn integer(&self) -> Option<i64> {
        match self.content {
            Content::Integer(value) => Some(value),
            _ => None,
        }
    }

    /// True unless it was left out between commas.
    pub fn is_given(&self) -> bool {
        self.content != Content::Empty
    }
}

impl Given {
    /// A value by its position.
    pub fn number(&self, index: usize) -> Option<f64> {
        self.values.get(index).and_then(Value::number)
    }

    /// A word by its position.
    pub fn word(&self, index: usize) -> Option<&str> {
        self.values.get(index).and_then(Value::word)
    }

    /// The values that name a thing of this sort.
    pub fn named(&self, noun: Noun) -> impl Iterator<Item = &Value> {
        let specs = self.spec.values.iter();
        self.values.iter().zip(specs).filter(move |(_, s)| s.kind == Kind::Name(noun)).map(|(value, _)| value)
    }

    /// All numbers in order.
    pub fn numbers(&self) -> Vec<f64> {
        self.values.iter().filter_map(Value::number).collect()
    }
}

impl Args {
    /// A positional number by position; `None` when left out.
    pub fn number(&self, index: usize) -> Option<f64> {
        self.data.get(index).and_then(Value::number)
    }

    /// A positional word by position.
    pub fn word(&self, index: usize) -> Option<&str> {
        self.data.get(index).and_then(Value::word)
    }

    /// A positional whole number by position.
    pub fn integer(&self, index: usize) -> Option<i64> {
        self.data.get(index).and_then(Value::integer)
    }

    /// The place of a positional datum, or of the command when it is not there.
    pub fn place(&self, index: usize) -> Span {
        self.data.get(index).map_or(self.span, |v| v.span)
    }

    /// An option by its full name, if given (the last, when given more than once).
    pub fn option(&self, name: &str) -> Option<&Given> {
        self.options.iter().rev().find(|g| g.spec.name == name)
    }

    /// Every occurrence of an option.
    pub fn all<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a Given> {
        self.options.iter().filter(move |g| g.spec.name == name)
    }

    /// True when an option is given.
    pub fn has(&self, name: &str) -> bool {
        self.option(name).is_some()
    }

    /// The first number of an option.
    pub fn option_number(&self, name: &str) -> Option<f64> {
        self.option(name).and_then(|g| g.number(0))
    }

    /// The first word of an option.
    pub fn option_word(&self, name: &str) -> Option<&str> {
        self.option(name).and_then(|g| g.word(0))
    }

    /// A switch: `-NAME` or `-NAME YES` is true, `-NAME NO` false, absent the default.
    pub fn switch(&self, name: &str, default: bool) -> bool {
        match self.option(name) {
            None => default,
            Some(given) => given.word(0).is_none_or(|w| !w.eq_ignore_ascii_case("NO")),
        }
    }
}
