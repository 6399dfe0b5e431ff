//! OrcaFlex text models: what is read, and wrong ones.

#![allow(clippy::unwrap_used)]
#![allow(clippy::expect_used)]

mod bad_input;
mod models;

use windlass_base::diagnostic::{Diagnostic, Severity};
use windlass_base::span::SourceId;
use windlass_orcaflex::Reading;

/// A hose from a vessel and a chain between two fixed places.
const GOOD: &str = include_str!("../../../../tests/data/orcaflex/two_lines.yml");

fn read(text: &str) -> Reading {
    windlass_orcaflex::read(text, SourceId::new(0))
}

/// The first error of a text, with the text under its place.
fn first_error(text: &str) -> (String, String) {
    let reading = read(text);
    let error: &Diagnostic = reading.messages.iter().find(|m| m.severity == Severity::Error).expect(text);
    let span = error.span.expect("a place");
    (error.message.clone(), text[span.start as usize..span.end as usize].to_string())
}
