//! The values of a record, whatever their form was: SI numbers, words and names, each with its place.

use crate::span::Span;
use crate::units::Dim;
use std::sync::Arc;

/// What a name refers to; drives completion and the wording of errors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Noun {
    /// A class, `~NAME`.
    Class,
    /// A point, `*NAME`.
    Point,
    /// A body.
    Body,
    /// A part.
    Part,
    /// A connector.
    Connector,
    /// A connector, or a pipe, `&PIPE`.
    Line,
    /// A curve.
    Curve,
    /// An environment.
    Environment,
    /// A selector, `:NAME`, or a name that may hold wild characters.
    Selector,
    /// A macro.
    Macro,
    /// A bottom over a grid.
    Bathymetry,
    /// What pipes hold, kept under a name.
    Filling,
    /// A line type of the library.
    LineType,
    /// A new name, not to be looked up.
    New,
}

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
    /// What a number measures.
    pub dim: Dim,
    /// What a name refers to; none of what is no name.
    pub noun: Option<Noun>,
    /// Where it stands.
    pub span: Span,
}

/// An option as given in a record.
#[derive(Clone, Debug, PartialEq)]
pub struct Given {
    /// Full name of the option.
    pub name: &'static str,
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

impl Value {
    /// A value left out between commas, at its place.
    pub fn empty(span: Span) -> Self {
        Value { content: Content::Empty, dim: Dim::None, noun: None, span }
    }

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
        self.values.iter().filter(move |value| value.noun == Some(noun))
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
        self.options.iter().rev().find(|g| g.name == name)
    }

    /// Every occurrence of an option.
    pub fn all<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a Given> {
        self.options.iter().filter(move |g| g.name == name)
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
