//! Selectors: sets of names by pattern.
//!
//! Source: reference/language.md section 11. First all that fit one of the patterns, then without those that fit an
//! exception.

use super::Model;
use crate::language::select::matches;
use crate::language::source::Span;

/// A selector of `&SELECT`.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Selector {
    /// Its name as written, with `:`.
    pub name: String,
    /// Patterns that take in.
    pub select: Vec<String>,
    /// Patterns that take out again.
    pub except: Vec<String>,
    /// Where it was defined.
    pub span: Span,
}

impl Selector {
    /// Whether a name is selected; patterns may be selectors themselves, to a depth of 16.
    pub fn takes(&self, name: &str, model: &Model) -> bool {
        takes(&self.select, &self.except, name, model, 0)
    }
}

fn takes(select: &[String], except: &[String], name: &str, model: &Model, depth: usize) -> bool {
    let fits = |pattern: &String| match pattern.strip_prefix(':') {
        Some(_) if depth < 16 => model
            .selectors
            .get(&Model::key(pattern))
            .is_some_and(|s| takes(&s.select, &s.except, name, model, depth + 1)),
        Some(_) => false,
        None => matches(pattern, name) || matches(name, pattern),
    };
    select.iter().any(fits) && !except.iter().any(fits)
}
