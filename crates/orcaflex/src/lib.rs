//! OrcaFlex text models [ORCAFLEX-A01], read into [`model::TextModel`]: General, Environment, LineTypes, Vessels (their places), Lines.
//!
//! [`records`] translates a model into records of windlass. Values are in the units of the file: m, te, kN, s, deg.
//! Names of data are those of the examples that Orcina ships, as published [ORCAFLEX-A01]. Data that bear a load and are not read are an error at their place; the
//! rest is named in notes. Directions of waves, current and wind are those they go toward.
//!
//! Not done here: files that a model includes, variable data, motions of vessels, buoys, winches, links, supports.
//!
//! # Example
//! ```
//! use windlass_base::span::SourceId;
//!
//! let text = "\
//! Environment:
//!   Density: 1.025
//!   WaterDepth: 100
//! LineTypes:
//! - Name: chain
//!   OD: 0.15
//!   MassPerUnitLength: 0.2
//!   EA: 800e3
//! Lines:
//! - Name: leg
//!   Connection, ConnectionX, ConnectionY, ConnectionZ:
//!   - [Fixed, 0, 0, -10]
//!   - [Anchored, 300, 0, 0]
//!   LineType, Length, TargetSegmentLength:
//!   - [chain, 350, 5]
//! ";
//! let reading = windlass_orcaflex::read(text, SourceId::new(0));
//! assert!(reading.messages.is_empty());
//! assert_eq!(reading.model.lines[0].sections[0].segments, 70);
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod data;
pub mod model;
pub mod records;
pub mod yaml;

pub use data::Given;
use model::TextModel;
use windlass_base::diagnostic::{Diagnostic, Severity};
use windlass_base::span::SourceId;

/// What came of reading a text model.
#[derive(Clone, Debug, Default)]
pub struct Reading {
    /// The model, as far as it could be read.
    pub model: TextModel,
    /// Errors, warnings and notes.
    pub messages: Vec<Diagnostic>,
}

impl Reading {
    /// Whether there was an error. Such a model is not to be run.
    pub fn is_failed(&self) -> bool {
        self.messages.iter().any(|message| matches!(message.severity, Severity::Error | Severity::Fatal))
    }
}

/// Reads a text model. `source` is the text's id in the places of values and messages.
pub fn read(text: &str, source: SourceId) -> Reading {
    let mut messages = Vec::new();
    let model = match yaml::read(text, source) {
        Ok(tree) => model::read(&tree, &mut messages),
        Err(error) => {
            messages.push(*error);
            TextModel::default()
        }
    };
    Reading { model, messages }
}
