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

/// The nearest names for a help line, else those there are; `None` where there is none. A word with `*` behind its beginning is taken for
/// a pattern of another program.
pub fn suggest<'a>(word: &str, names: impl IntoIterator<Item = &'a str>) -> Option<String> {
    /// Names written out.
    const MAX_NAMES: usize = 8;
    if let Some(hint) = wild_hint(word) {
        return Some(hint);
    }
    let all: Vec<&str> = names.into_iter().collect();
    did_you_mean(word, all.iter().copied()).or_else(|| {
        let listed = all.iter().take(MAX_NAMES).copied().collect::<Vec<_>>().join(" ");
        let more = all.len().saturating_sub(MAX_NAMES);
        let more = if more > 0 { format!(" and {more} more") } else { String::new() };
        (!all.is_empty()).then(|| format!("known: {listed}{more}"))
    })
}

/// What to write instead of a word with `*` or `?` as wild characters; `None` of other words.
pub fn wild_hint(word: &str) -> Option<String> {
    let rest = word.get(1..).unwrap_or_default();
    rest.contains(['*', '?']).then(|| {
        let written: String = word
            .char_indices()
            .map(|(at, c)| match c {
                '*' if at > 0 => '@',
                '?' if at > 0 => '/',
                other => other,
            })
            .collect();
        format!("the wild character is @ for any run of characters, / for one: {written}")
    })
}

/// A noun with its article: `a curve`, `an environment`.
pub fn with_article(noun: &str) -> String {
    let article = if noun.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" };
    format!("{article} {noun}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_unknown_name_gets_the_names_there_are() {
        assert_eq!(suggest("*Q", ["*P1", "*MLA"]).unwrap(), "known: *P1 *MLA");
        assert_eq!(suggest("*MLB", ["*P1", "*MLA"]).unwrap(), "did you mean *MLA?");
        assert_eq!(suggest("C", []), None);
        let many: Vec<String> = (1..=10).map(|n| format!("LINE{n}")).collect();
        assert!(suggest("Q", many.iter().map(String::as_str)).unwrap().ends_with("LINE8 and 2 more"));
    }

    #[test]
    fn star_as_wild_character_is_answered_with_the_right_one() {
        assert!(suggest("TEN*", ["Ten Top"]).unwrap().ends_with(": TEN@"));
        assert!(suggest("*P*", ["*P1"]).unwrap().ends_with(": *P@"));
        assert_eq!((wild_hint("*P"), wild_hint("TEN@"), wild_hint("")), (None, None, None));
    }
}
