//! Choosing names: minimum uniqueness for keywords, wild characters for selectors.
//!
//! Source: [MOSES-REF men_select].

use windlass_base::choice::Choice;
use windlass_base::diagnostic::{Diagnostic, Outcome, did_you_mean};
use windlass_base::span::Span;
pub use windlass_base::spec::Owner;

/// What a keyword search found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SearchResult<T> {
    /// Exactly one.
    One(T),
    /// Several begin with the word; their names.
    Several(Vec<&'static str>),
    /// None begins with the word.
    None,
}

/// Selects among keywords: an exact name wins, else the only name of MOSES that begins so, else the only other one.
pub fn keyword<T: Copy + PartialEq>(
    word: &str,
    names: impl Iterator<Item = (&'static str, Owner, T)> + Clone,
) -> SearchResult<T> {
    let begins = |name: &str| name.get(..word.len()).is_some_and(|head| head.eq_ignore_ascii_case(word));
    if word.is_empty() {
        return SearchResult::None;
    }
    if let Some((_, _, found)) = names.clone().find(|(name, _, _)| name.eq_ignore_ascii_case(word)) {
        return SearchResult::One(found);
    }
    for moses in [true, false] {
        let mut hits = names.clone().filter(|(name, owner, _)| (*owner == Owner::Moses) == moses && begins(name));
        if let Some((first, _, found)) = hits.next() {
            // several spellings of the same thing are one hit
            let rest: Vec<&'static str> =
                hits.filter(|(_, _, other)| *other != found).map(|(name, _, _)| name).collect();
            if rest.is_empty() {
                return SearchResult::One(found);
            }
            return SearchResult::Several(std::iter::once(first).chain(rest).collect());
        }
    }
    SearchResult::None
}

/// As [`choose`], among the words of an enum.
///
/// # Errors
/// As [`choose`].
pub fn choose_word<T: Choice>(word: &str, span: Span, what: &str) -> Outcome<T> {
    choose(word, span, what, T::ALL.iter().map(|choice| (choice.word(), Owner::Moses, *choice)))
}

/// As [`keyword`], with the error a user sees: `what` says what is being chosen, e.g. `option of B_CAT`.
///
/// # Errors
/// An ambiguous word (the candidates are listed) or an unknown one (the nearest names are listed).
pub fn choose<T: Copy + PartialEq>(
    word: &str,
    span: Span,
    what: &str,
    names: impl Iterator<Item = (&'static str, Owner, T)> + Clone,
) -> Outcome<T> {
    match keyword(word, names.clone()) {
        SearchResult::One(found) => Ok(found),
        SearchResult::Several(list) => Err(Diagnostic::error(format!("ambiguous {what} `{word}`"), span)
            .label(format!("could be {}", list.join(", ")))),
        SearchResult::None => {
            let mut error = Diagnostic::error(format!("unknown {what} `{word}`"), span);
            match did_you_mean(word, names.clone().map(|(name, _, _)| name)) {
                Some(help) => error.help.push(help),
                None => {
                    let all: Vec<&str> = names.map(|(name, _, _)| name).collect();
                    if all.len() <= MOST_LISTED {
                        error.help.extend(list_known(&all));
                    }
                }
            }
            Err(error)
        }
    }
}

/// Names that are listed where a name is none of them and near none.
const MOST_LISTED: usize = 24;

/// The names there are, for a help line; `None` of none.
pub fn list_known(names: &[&str]) -> Option<String> {
    (!names.is_empty()).then(|| format!("known: {}", names.join(" ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    const NAMES: [(&str, Owner, u8); 5] = [
        ("-L_TENSION", Owner::Moses, 1),
        ("-L_HORIZONTAL", Owner::Moses, 2),
        ("-LENGTH", Owner::Moses, 3),
        ("-LEN", Owner::Moses, 4),
        ("-LENS", Owner::Ours, 5),
    ];

    #[test]
    fn exact_match_wins_then_unique_moses_prefix() {
        let find = |w: &str| keyword(w, NAMES.iter().copied());
        assert_eq!(find("-len"), SearchResult::One(4));
        assert_eq!(find("-L_T"), SearchResult::One(1));
        assert_eq!(find("-LENG"), SearchResult::One(3));
        assert_eq!(find("-LENS"), SearchResult::One(5));
        assert_eq!(find("-L_"), SearchResult::Several(vec!["-L_TENSION", "-L_HORIZONTAL"]));
        assert_eq!(find("-X"), SearchResult::None);
    }

    #[test]
    fn unknown_word_without_candidates_lists_nothing() {
        let none: [(&'static str, Owner, u8); 0] = [];
        let help = |names: &[(&'static str, Owner, u8)]| {
            choose("-Q", Span::default(), "option of A", names.iter().copied()).unwrap_err().help
        };
        assert!(help(&none).is_empty());
        assert_eq!(help(&NAMES), ["known: -L_TENSION -L_HORIZONTAL -LENGTH -LEN -LENS"]);
    }
}
