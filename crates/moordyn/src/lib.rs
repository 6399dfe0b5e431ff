//! MoorDyn decks [MOORDYN-2], read into [`Deck`]: version 2, the section names and column orders of version 1, the decks MoorPy
//! [MOORPY-1] writes, and files of MAP++.
//!
//! [`records`] translates a deck into records of windlass. In a [`Deck`] nothing is converted: values are in the units of the deck (SI, angles in degrees; z up from the mean water level). Every value has its
//! place. The columns of a table are taken by the names in its head, where all of them are known; else in the order of version 2, with a
//! warning. MoorDyn 2 itself skips the names: of a table whose names stand in another order it reads other values, which is a warning too.
//!
//! A load that windlass does not compute is an error at its word: vortex-induced vibration, viscoelastic and Syrope ropes, tables of bending
//! stiffness, failures, controls, external loads, currents by time or place. So is an option that is not known, which MoorDyn passes over.
//!
//! Files of MAP++ [MAP-PP] are read into the same tables: [`map`].
//!
//! [`mod@write`] makes the text of a deck of a [`Deck`].
//!
//! Not done here: the files that a deck names are not opened; [`files`] reads their texts.
//!
//! # Example
//! ```
//! use windlass_base::span::SourceId;
//!
//! let text = "\
//! --- LINE TYPES ---
//! TypeName Diam Mass/m EA BA/-zeta EI Cd Ca CdAx CaAx
//! (name) (m) (kg/m) (N) (N-s) (N-m^2) (-) (-) (-) (-)
//! chain 0.1 200 8e8 -1 0 1.2 1 0.4 0.5
//! --- POINTS ---
//! ID Attachment X Y Z Mass Volume CdA Ca
//! (#) (word) (m) (m) (m) (kg) (m^3) (m^2) (-)
//! 1 Fixed 0 0 -100 0 0 0 0
//! 2 Coupled 300 0 -10 0 0 0 0
//! --- LINES ---
//! ID LineType AttachA AttachB UnstrLen NumSegs Outputs
//! (#) (name) (#) (#) (m) (-) (-)
//! 1 chain 1 2 350 40 -
//! --- OPTIONS ---
//! 100 WtrDpth
//! ";
//! let reading = windlass_moordyn::read(text, SourceId::new(0));
//! assert!(reading.messages.is_empty());
//! assert_eq!(reading.deck.lines[0].length.value, 350.0);
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod checks;
pub mod files;
mod layout;
pub mod map;
pub mod options;
pub mod records;
mod row;
mod section;
pub mod tables;
pub mod write;

use map::MapOptions;
use options::Options;
use tables::{Body, Line, LineType, Point, Rod, RodType};
use windlass_base::diagnostic::{Diagnostic, Severity};
use windlass_base::span::{SourceId, Span};

/// A value of a deck and the word it was read from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Given<T> {
    /// The value.
    pub value: T,
    /// The place of its word.
    pub span: Span,
}

/// A deck that was read. Rows stand in the order of the file; their ids are 1, 2, 3 ..
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Deck {
    /// LINE TYPES.
    pub line_types: Vec<LineType>,
    /// ROD TYPES.
    pub rod_types: Vec<RodType>,
    /// BODIES.
    pub bodies: Vec<Body>,
    /// RODS.
    pub rods: Vec<Rod>,
    /// POINTS.
    pub points: Vec<Point>,
    /// LINES.
    pub lines: Vec<Line>,
    /// OPTIONS.
    pub options: Options,
    /// OUTPUTS: the names of channels.
    pub outputs: Vec<Given<String>>,
    /// SOLVER OPTIONS of a file of MAP++; `None`: another deck.
    pub map: Option<MapOptions>,
}

/// What came of reading a deck.
#[derive(Clone, Debug, Default)]
pub struct Reading {
    /// The deck, as far as it could be read.
    pub deck: Deck,
    /// Errors, warnings and notes; those of one table stand together.
    pub messages: Vec<Diagnostic>,
}

impl Reading {
    /// Whether there was an error. Such a deck is not to be run.
    pub fn is_failed(&self) -> bool {
        self.messages.iter().any(|message| matches!(message.severity, Severity::Error | Severity::Fatal))
    }
}

/// Reads the text of a deck. `source` is the text's id in the places of values and messages.
pub fn read(text: &str, source: SourceId) -> Reading {
    let mut messages = Vec::new();
    let is_map = map::is_map(text);
    let mut deck = Deck { map: is_map.then(MapOptions::default), ..Deck::default() };
    for section in section::split(text, source, is_map, &mut messages) {
        tables::read(&section, &mut deck, &mut messages);
    }
    if is_map {
        map::match_names(&mut deck);
    }
    checks::check(&deck, source, &mut messages);
    map::copy(&mut deck, &mut messages);
    Reading { deck, messages }
}
