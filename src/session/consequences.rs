//! What follows in a script from a record that was refused: one line each, so that one mistake gives one message.

use super::Session;
use super::check_report::Judgement;
use windlass_base::diagnostic::{Diagnostic, Severity};
use windlass_base::span::Span;
use windlass_language::record::{Record, Word};
use windlass_language::token::TokenKind;

/// Commands that define a name, and which of their words it is.
static DEFINERS: &[(&str, usize)] = &[
    ("&DESCRIBE", 2),
    ("COPY_BLOCK", 2),
    ("REFLECT_BLOCK", 2),
    ("RENAME_BLOCK", 2),
    ("ASSEMBLY", 2),
    ("PGEN", 1),
    ("BLOCK", 1),
    ("MESH", 1),
    ("TUBE", 1),
    ("UNION", 1),
    ("INTERSECT", 1),
    ("DIFFERENCE", 1),
    ("CONNECTOR", 1),
    ("BEAM", 1),
    ("PLATE", 1),
    ("ENV", 1),
    ("&ENV", 1),
    ("&SELECT", 1),
    ("C_PROFILE", 1),
    ("P_SPECTRUM", 1),
    ("F_SPECTRUM", 1),
    ("M_GROWTH", 1),
    ("W_HISTORY", 1),
    ("LT_MULTIPLIER", 1),
    ("CT_LENGTH", 1),
    ("EFFICIENCY", 1),
    ("CS_VELOCITY", 1),
    ("AM_PRESSURE", 1),
];
/// The fewest letters that stand for a command of [`DEFINERS`].
const SHORTEST_COMMAND: usize = 3;

/// What of refused records later ones may need.
#[derive(Debug, Default)]
pub(super) struct RefusedRecords {
    /// Names that were not defined, in upper case, each with the position of its record.
    names: Vec<(String, String)>,
    /// Words that errors were said of.
    words: Vec<Span>,
    /// The position of the record that would have begun the body or part that descriptions belong to.
    body: Option<String>,
}

/// The word of a record that it defines a name by.
pub fn defined_name(words: &[Word]) -> Option<&Word> {
    let [first, ..] = words else { return None };
    if matches!(first.kind, TokenKind::Point | TokenKind::Class | TokenKind::Selector) {
        return Some(first);
    }
    let word = first.text.to_ascii_uppercase();
    let (_, index) = DEFINERS
        .iter()
        .find(|(name, _)| *name == word)
        .or_else(|| DEFINERS.iter().find(|(name, _)| word.len() >= SHORTEST_COMMAND && name.starts_with(&word)))?;
    words.get(*index).filter(|named| named.kind != TokenKind::Option)
}

fn is_within(inner: Span, outer: Span) -> bool {
    inner.source == outer.source && outer.start <= inner.start && inner.end <= outer.end
}

/// Whether a record begins a body or a part.
fn begins_body(words: &[Word]) -> bool {
    let [first, kind, ..] = words else { return false };
    let word = first.text.to_ascii_uppercase();
    let begins = |kind: &str| ["BODY", "PART"].iter().any(|whole| whole.eq_ignore_ascii_case(kind));
    word.len() >= SHORTEST_COMMAND && "&DESCRIBE".starts_with(&word) && begins(&kind.text)
}

impl Session {
    /// Reports the error of a record; where it follows from a record that was refused before, in one line, and not at all in a check.
    pub(super) fn report_refusal(&mut self, record: &Record, words: &[Word], error: Diagnostic) {
        if self.interactive {
            return self.report(error);
        }
        if let Some(why) = self.find_cause(record, words, &error) {
            let what = words.first().map_or("", |word| word.text.as_ref());
            return self.report_consequence(record.whole(), what, &why);
        }
        let position = self.interpreter.sources.location(record.whole());
        self.keep_missing_names(defined_name(words).map(|word| word.text.as_ref()), &position);
        if begins_body(words) {
            self.refused.body = Some(position);
        }
        self.refused.words.extend(error.span);
        self.report(error);
    }

    /// A record was done: descriptions belong to the body or part that it began.
    pub(super) fn note_body(&mut self, words: &[Word]) {
        if self.refused.body.is_some() && begins_body(words) {
            self.refused.body = None;
        }
    }

    /// Keeps names that a record at a position does not define.
    pub(super) fn keep_missing_names<'n>(&mut self, names: impl IntoIterator<Item = &'n str>, position: &str) {
        self.refused.names.extend(names.into_iter().map(|name| (name.to_ascii_uppercase(), position.to_string())));
    }

    /// Reports what the end of a menu found wrong, as the error of a record.
    pub(super) fn report_at_end(&mut self, diagnostic: Diagnostic) {
        let cause = diagnostic.span.filter(|_| !self.interactive).and_then(|span| Some((span, self.text_at(span)?)));
        match cause.and_then(|(span, named)| Some((span, self.find_missing_name(&diagnostic, &named)?))) {
            Some((span, why)) => self.report_consequence(span, "a record that names it", &why),
            None => self.report(diagnostic),
        }
    }

    /// One line on what is not done, and why; nothing in a check, which counts it.
    fn report_consequence(&mut self, span: Span, what: &str, why: &str) {
        self.errors_of_absent += 1;
        if let Some(check) = &mut self.check {
            check.judged = Some(Judgement::Follows);
            return;
        }
        let position = self.interpreter.sources.location(span);
        self.report(Diagnostic::plain(Severity::Error, format!("{position}: {what} is not done: {why}")));
    }

    fn text_at(&self, span: Span) -> Option<String> {
        let source = self.interpreter.sources.get(span.source)?;
        source.text.get(span.start as usize..span.end as usize).map(str::to_ascii_uppercase)
    }

    /// What refused record the error of another follows from, as the reason why it is not done.
    fn find_cause(&self, record: &Record, words: &[Word], error: &Diagnostic) -> Option<String> {
        let span = error.span.filter(|_| error.severity == Severity::Error)?;
        if let Some(position) = self.refused.body.as_ref().filter(|_| lacks_body(error)) {
            return Some(format!("the record of its body at {position} was refused"));
        }
        if !is_within(span, record.whole()) {
            let position = self.interpreter.sources.location(span);
            return self.refused.words.contains(&span).then(|| format!("{} ({position})", error.message));
        }
        let named = words.iter().skip(1).find(|word| word.span == span)?.text.to_ascii_uppercase();
        self.find_missing_name(error, &named)
    }

    /// The refused record of a name that an error does not know.
    fn find_missing_name(&self, error: &Diagnostic, named: &str) -> Option<String> {
        const OF_WORDS: [&str; 5] =
            ["unknown value", "unknown option", "unknown kind", "unknown action", "unknown command"];
        let begins = |head: &&str| error.message.starts_with(head);
        let is_missing = ["unknown ", "nothing among "].iter().any(begins) && !OF_WORDS.iter().any(begins);
        let (_, position) = self.refused.names.iter().rev().find(|(name, _)| is_missing && *name == named)?;
        Some(format!("the record of {named} at {position} was refused"))
    }
}

/// Whether an error says that a body is wanted.
fn lacks_body(error: &Diagnostic) -> bool {
    error.help.iter().any(|help| help.contains("&DESCRIBE BODY"))
}
