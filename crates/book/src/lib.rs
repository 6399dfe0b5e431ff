//! The preprocessor of the manual: formulas in Markdown become MathML.
//!
//! `$..$` is a formula in the line, `$$..$$` one by itself, as pulldown-cmark reads them; dollars in code stay what they are.
//!
//! # Example
//! ```
//! let text = windlass_book::replace_formulas("the tension $T = \\sqrt{H^2 + V^2}$")?;
//! assert!(text.starts_with("the tension <math") && text.contains("<msqrt>"));
//! # Ok::<(), windlass_book::BookError>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

use pulldown_cmark::{Event, Options, Parser};
use pulldown_latex::config::{DisplayMode, RenderConfig};
use pulldown_latex::{Parser as Formula, Storage};
use serde_json::Value;

/// Why a page is not made.
#[derive(Debug, thiserror::Error)]
pub enum BookError {
    /// A formula is not in the subset of LaTeX that is understood.
    #[error("the formula `{formula}` is not understood: {why}")]
    Formula {
        /// As it stands in the page.
        formula: String,
        /// What the converter says of it.
        why: String,
    },
    /// The input is not what mdBook gives a preprocessor.
    #[error("the input is not that of a preprocessor of mdBook: {0}")]
    Input(String),
}

/// How pages are read: tables and formulas besides the common Markdown.
pub fn markdown_options() -> Options {
    Options::ENABLE_MATH | Options::ENABLE_TABLES
}

/// A formula as MathML, in the line or by itself.
///
/// # Errors
/// [`BookError::Formula`].
pub fn convert_formula(formula: &str, by_itself: bool) -> Result<String, BookError> {
    let storage = Storage::new();
    let events: Result<Vec<_>, _> = Formula::new(formula, &storage).collect();
    let refuse = |why: String| BookError::Formula { formula: formula.to_string(), why };
    let events = events.map_err(|error| refuse(error.to_string()))?;
    let display_mode = if by_itself { DisplayMode::Block } else { DisplayMode::Inline };
    let mut text = String::new();
    let parsed = events.into_iter().map(Ok::<_, pulldown_latex::ParserError>);
    pulldown_latex::push_mathml(&mut text, parsed, RenderConfig { display_mode, ..RenderConfig::default() })
        .map_err(|error| refuse(error.to_string()))?;
    // an empty line would end the block of HTML
    Ok(text.lines().filter(|line| !line.trim().is_empty()).collect::<Vec<_>>().join("\n"))
}

/// A page with its formulas as MathML.
///
/// # Errors
/// [`BookError::Formula`], of the first one that is not understood.
pub fn replace_formulas(page: &str) -> Result<String, BookError> {
    let mut made = String::with_capacity(page.len());
    let mut done = 0;
    for (event, range) in Parser::new_ext(page, markdown_options()).into_offset_iter() {
        let formula = match &event {
            Event::InlineMath(formula) => convert_formula(formula, false)?,
            Event::DisplayMath(formula) => convert_formula(formula, true)?,
            _ => continue,
        };
        made.push_str(&page[done..range.start]);
        made.push_str(&formula);
        done = range.end;
    }
    made.push_str(&page[done..]);
    Ok(made)
}

/// The book that mdBook gives a preprocessor on its standard input, `[context, book]`, with its formulas as MathML: what it takes back.
///
/// # Errors
/// [`BookError::Input`] of what is no such pair, [`BookError::Formula`].
pub fn process_book(input: &str) -> Result<String, BookError> {
    let mut pair: Value = serde_json::from_str(input).map_err(|error| BookError::Input(error.to_string()))?;
    let book = pair.get_mut(1).ok_or_else(|| BookError::Input("it is no pair of a context and a book".into()))?;
    // the list of the book's parts has another name in older versions
    let parts = ["items", "sections"].into_iter().find(|name| book.get(name).is_some());
    let parts = parts.ok_or_else(|| BookError::Input("the book has no chapters".into()))?;
    process_items(&mut book[parts])?;
    Ok(book.to_string())
}

fn process_items(items: &mut Value) -> Result<(), BookError> {
    for item in items.as_array_mut().into_iter().flatten() {
        let Some(chapter) = item.get_mut("Chapter") else { continue };
        if let Some(page) = chapter.get("content").and_then(Value::as_str) {
            chapter["content"] = Value::String(replace_formulas(page)?);
        }
        process_items(&mut chapter["sub_items"])?;
    }
    Ok(())
}
