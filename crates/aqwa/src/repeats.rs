//! Cards that are given twice: what would be in force cannot be determined, so that the second one is refused with both places.
//!
//! Each [`CardLayout`] says how often its card may come ([`Repeats`]); a card is allowed once unless its layout says otherwise.

use super::layout::{CardLayout, CardRecord, Repeats};
use super::reader::matches;
use super::remarks::Remarks;
use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::Span;

/// A card that may not be given again.
struct SingleCard<'a> {
    /// What it gives: its keyword, or the name that cards of the same meaning share.
    what: &'a str,
    keyword: &'a str,
    /// Values of the fields that distinguish one such card from another.
    key: Vec<i64>,
    span: Span,
    until: &'static [&'static str],
}

/// Refuses the cards of a deck that are given twice; `label` names the deck.
pub fn check(label: &str, layouts: &'static [CardLayout], records: &[CardRecord], remarks: &mut Remarks) {
    let mut list: Vec<SingleCard<'_>> = Vec::new();
    for record in records {
        let keyword = record.keyword.as_str();
        list.retain(|given| !given.until.contains(&keyword));
        let Some(layout) = layouts.iter().find(|layout| matches(layout.keyword, keyword)) else { continue };
        let Repeats::Once { same, by, until } = layout.repeats else { continue };
        let what = if same.is_empty() { keyword } else { same };
        let key: Vec<i64> = by.iter().map(|column| record.int(*column).value).collect();
        let Some(earlier) = list.iter().find(|given| given.what == what && given.key == key) else {
            list.push(SingleCard { what, keyword, key, span: record.span, until });
            continue;
        };
        let which = by.iter().zip(&key).map(|(column, value)| format!(" of {} {value}", layout.name_of(*column)));
        let which: String = which.collect();
        let message = if earlier.keyword == keyword {
            format!("{label}, {keyword}: this card{which} is given twice")
        } else {
            format!("{label}, {keyword}: {}{which} is given already", earlier.keyword)
        };
        remarks.add(
            Diagnostic::error(message, record.span)
                .label("leave out one of the two")
                .other(earlier.span, "given here first"),
        );
    }
}
