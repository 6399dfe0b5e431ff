//! Selectors: sets of names by pattern.
//!
//! Source: [MOSES-REF men_select]. First all that fit one of the patterns, then without those that fit an
//! exception.

use super::Model;
use windlass_base::span::Span;
use windlass_base::wildcard::matches;

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
    pub fn matches(&self, name: &str, model: &Model) -> bool {
        matches_any(&self.select, &self.except, name, model, 0)
    }
}

impl Model {
    /// Whether a selector selects by the one of this key, directly or through others, or is it.
    pub fn refers_to(&self, selector: &str, key: &str) -> bool {
        let mut seen = vec![Model::key(selector)];
        let mut at = 0;
        while let Some(next) = seen.get(at).cloned() {
            if next == key {
                return true;
            }
            let names = self.selectors.get(&next).into_iter().flat_map(|s| s.select.iter().chain(&s.except));
            for name in names.map(|n| Model::key(n)).filter(|n| n.starts_with(':')) {
                if !seen.contains(&name) {
                    seen.push(name);
                }
            }
            at += 1;
        }
        false
    }
}

fn matches_any(select: &[String], except: &[String], name: &str, model: &Model, depth: usize) -> bool {
    let fits = |pattern: &String| match pattern.strip_prefix(':') {
        Some(_) if depth < 16 => model
            .selectors
            .get(&Model::key(pattern))
            .is_some_and(|s| matches_any(&s.select, &s.except, name, model, depth + 1)),
        Some(_) => false,
        None => matches(pattern, name) || matches(name, pattern),
    };
    select.iter().any(fits) && !except.iter().any(fits)
}
