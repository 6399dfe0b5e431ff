//! Reading a record's words against its [`CommandSpec`]: data and options in any order, abbreviations, arity, types,
//! ranges, and the one conversion to SI.
//!
//! Source: reference/language.md sections 1 and 2. An option takes its own known number of values; values that may be
//! left out or repeat are taken until a word of another type comes; the remaining words are positional data.

mod convert;

use super::diagnostic::{Diagnostic, Outcome};
use super::record::Word;
use super::select;
use super::source::Span;
use super::spec::{CommandSpec, Kind, Noun, OptionSpec, ValueSpec, expected};
use super::token::Kind as Lex;
use super::units::UnitSystem;
use convert::{convert, take};
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
