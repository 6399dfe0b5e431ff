//! What a name may be: one rule for everything that gets a name.
//!
//! Source: [MOSES-REF ams_cmd_menu, men_select]; MOSES takes 8 characters, we take 64.

use windlass_base::diagnostic::{Diagnostic, Outcome, with_article};
use windlass_base::printable::is_acted_on;
use windlass_base::span::Span;

/// Longest name taken (characters, the marker included).
pub const MAX_NAME_CHARACTERS: usize = 64;

/// The rule, as `&HELP` states it.
pub const RULE: &str = "A name has 1 to 64 characters, a marker (~ class, * point, : selector) among them and at least \
                        one more behind it; no blanks, commas or quotes, no @ or / (wild characters), no other :, and \
                        it does not begin with & $ - # % = + or @.";

/// The marker a name begins with: that of a class, a point or a selector.
pub fn marker(name: &str) -> Option<char> {
    name.chars().next().filter(|c| "~*:".contains(*c))
}

/// Sees that a new name follows the [`RULE`]; `what` is what it is to name, `mark` the marker that has to be there.
///
/// # Errors
/// What the rule forbids, at the word.
pub fn check(name: &str, mark: Option<char>, what: &str, span: Span) -> Outcome<()> {
    let refuse = |why: String| {
        Err(Diagnostic::error(format!("`{name}` cannot name {}", with_article(what)), span)
            .label(why)
            .help(RULE.to_string()))
    };
    let bare = match (mark, marker(name)) {
        (Some(wanted), Some(found)) if wanted == found => name.get(1..).unwrap_or_default(),
        (Some(wanted), _) => return refuse(format!("expected {wanted}NAME")),
        (None, Some(found)) => return refuse(format!("{found} is a marker")),
        (None, None) => name,
    };
    if bare.is_empty() {
        return refuse("there is no character besides the marker".into());
    }
    let count = name.chars().count();
    if count > MAX_NAME_CHARACTERS {
        return refuse(format!("this has {count} characters, and at most {MAX_NAME_CHARACTERS} are taken"));
    }
    if let Some(first) = name.chars().next().filter(|c| "&$-#%=+@".contains(*c)) {
        return refuse(format!("a name does not begin with {first}"));
    }
    let wrong = |c: &char| c.is_whitespace() || is_acted_on(*c) || "@/:,'\"".contains(*c);
    match bare.chars().find(wrong) {
        Some(c) if c.is_whitespace() => refuse("a name has no blanks".into()),
        Some(c) if is_acted_on(c) => refuse("a name has no such character".into()),
        Some(c) => refuse(format!("a name has no {c}")),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn name_rule_holds_with_and_without_a_marker() {
        let good = |name: &str, mark: Option<char>| check(name, mark, "thing", Span::default()).is_ok();
        for name in ["A", "5", "TBRG", "END_A", "a.b", "A-B", "A$", "\u{e9}", &"N".repeat(64)] {
            assert!(good(name, None), "{name}");
        }
        let long = "N".repeat(65);
        for name in [
            "",
            "A B",
            "A\tB",
            "A@",
            "@",
            "A/B",
            "A:",
            ":A",
            "~A",
            "*A",
            "&A",
            "$A",
            "-A",
            "#A",
            "%A",
            "=A",
            "+A",
            "=cmd|calc",
            "A\u{202e}",
            "A\u{9b}",
            &long,
        ] {
            assert!(!good(name, None), "{name}");
        }
        assert!(good("~A", Some('~')) && good("*-1", Some('*')) && good(":S", Some(':')));
        for (name, mark) in [("~", '~'), ("*", '*'), ("*@", '*'), ("*/", '*'), ("A", '*'), ("~A", '*'), ("::A", ':')] {
            assert!(!good(name, Some(mark)), "{name}");
        }
        assert!(!good(&format!("~{}", "N".repeat(64)), Some('~')));
    }
}
