//! Messages with a place: what is wrong, the word it is wrong with, what was expected, and the nearest known name.

use crate::span::Span;

/// How serious a message is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// Worth knowing; nothing was refused.
    Note,
    /// Accepted, but probably not what was meant.
    Warning,
    /// The record was refused and changed nothing.
    Error,
    /// The run ends.
    Fatal,
}

impl Severity {
    /// What a remark of this severity begins with where it is printed with others, in a table or a list.
    pub const fn mark(self) -> &'static str {
        match self {
            Severity::Warning => "warning: ",
            Severity::Note | Severity::Error | Severity::Fatal => "",
        }
    }
}

/// A message about a place in the input.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// How serious.
    pub severity: Severity,
    /// One sentence without a full stop.
    pub message: String,
    /// The word it is about.
    pub span: Option<Span>,
    /// What stands under the underlined word, e.g. `expected a number`.
    pub label: String,
    /// A second place with its own text, e.g. where a name was defined first.
    pub other: Option<(Span, String)>,
    /// Further lines: what to write instead, candidates, how the place was reached.
    pub help: Vec<String>,
}

/// What almost everything in the language returns.
pub type Outcome<T> = Result<T, Box<Diagnostic>>;

impl Diagnostic {
    /// An error at a word.
    pub fn error(message: impl Into<String>, span: Span) -> Box<Self> {
        Box::new(Self::plain(Severity::Error, message).with_span(span))
    }

    /// A warning at a word.
    pub fn warning(message: impl Into<String>, span: Span) -> Box<Self> {
        Box::new(Self::plain(Severity::Warning, message).with_span(span))
    }

    /// A note at a word.
    pub fn remark(message: impl Into<String>, span: Span) -> Box<Self> {
        Box::new(Self::plain(Severity::Note, message).with_span(span))
    }

    /// A message without a place.
    pub fn plain(severity: Severity, message: impl Into<String>) -> Self {
        Diagnostic {
            severity,
            message: message.into(),
            span: None,
            label: String::new(),
            other: None,
            help: Vec::new(),
        }
    }

    fn with_span(mut self, span: Span) -> Self {
        self.span = Some(span);
        self
    }

    /// Adds the text under the underlined word.
    pub fn label(mut self: Box<Self>, text: impl Into<String>) -> Box<Self> {
        self.label = text.into();
        self
    }

    /// Adds a help line.
    pub fn help(mut self: Box<Self>, text: impl Into<String>) -> Box<Self> {
        self.help.push(text.into());
        self
    }

    /// Adds a second place.
    pub fn other(mut self: Box<Self>, span: Span, text: impl Into<String>) -> Box<Self> {
        self.other = Some((span, text.into()));
        self
    }
}

/// The names nearest to a word, best first, for "did you mean"; at most three, none when nothing is near.
pub fn nearest<'a>(word: &str, names: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let folded = word.to_ascii_uppercase();
    let mut scored: Vec<(f64, &str)> = names
        .into_iter()
        .map(|name| (strsim::jaro_winkler(&folded, &name.to_ascii_uppercase()), name))
        .filter(|(score, _)| *score > 0.8)
        .collect();
    scored.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(b.1)));
    scored.dedup_by(|a, b| a.1 == b.1);
    scored.into_iter().take(3).map(|(_, name)| name).collect()
}

/// `did you mean A, B or C?` for a help line; `None` when nothing is near.
pub fn did_you_mean<'a>(word: &str, names: impl IntoIterator<Item = &'a str>) -> Option<String> {
    let near = nearest(word, names);
    match near.as_slice() {
        [] => None,
        [one] => Some(format!("did you mean {one}?")),
        [first @ .., last] => Some(format!("did you mean {} or {last}?", first.join(", "))),
    }
}

/// A noun with its article: `a curve`, `an environment`.
pub fn with_article(noun: &str) -> String {
    let article = if noun.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" };
    format!("{article} {noun}")
}
