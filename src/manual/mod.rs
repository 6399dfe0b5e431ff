//! The pages of the manual that are made from the declarations: every command, option, class, function and report, and the
//! state of every record of MOSES. `windlass manual DIR` writes them, and the copy in `docs/` is held to them by a test.

mod grammar;
pub(crate) mod markdown;
mod moses;
mod reference;

pub use grammar::{GRAMMAR_FILE, build_grammar};

/// A page.
#[derive(Clone, Debug, PartialEq)]
pub struct Page {
    /// Where it stands in the manual: `reference/classes.md`.
    pub path: String,
    /// Its Markdown.
    pub text: String,
}

/// Whether a text is such a page, of this or of another version.
pub fn is_made_page(text: &str) -> bool {
    text.contains(reference::MADE.trim_end())
}

/// All pages that are made from declarations, in the order of the manual.
pub fn build_pages() -> Vec<Page> {
    let mut pages = reference::build_pages();
    pages.push(Page { path: "moses.md".into(), text: moses::build_page() });
    pages
}
