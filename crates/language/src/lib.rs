//! The command language: tokens, records, numbers, variables, control flow, macros and typed specs. It knows nothing of
//! ships.
//!
//! # Example
//! A record is read against the spec of its command: abbreviations, units and errors with places come of themselves. An
//! option is looked up by the constant that the spec lists.
//! ```
//! use windlass_base::units::{Dim, LengthUnit, ForceUnit, UnitSystem};
//! use windlass_language::source::Sources;
//! use windlass_language::spec::{CommandSpec, Kind, OptionSpec, ValueSpec};
//! use windlass_language::{args, record};
//!
//! const LENGTH: OptionSpec =
//!     OptionSpec::new("-LENGTH", &[ValueSpec::new("L", Kind::Number(Dim::Length), "length")], "length of the segment");
//! static CHAIN: CommandSpec = CommandSpec { options: &[LENGTH], ..CommandSpec::new("CHAIN", "a chain") };
//!
//! let mut sources = Sources::default();
//! let text = "CHAIN -LEN 2*250";
//! let id = sources.add("example", text, 1);
//! let (record, _, _) = record::read(text, id, 0);
//! let words = record.words();
//! let units = UnitSystem { length: LengthUnit::Meters, force: ForceUnit::Kilonewtons };
//! let args = args::read(&CHAIN, words[0].span, &words[1..], units).map_err(|e| e.message)?;
//! assert_eq!(args.option_number(&LENGTH), Some(500.0));
//! # Ok::<(), String>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod args;
pub mod flow;
pub mod format;
pub mod functions;
pub mod logic;
pub mod name;
pub mod number;
pub mod record;
pub mod render;
pub mod select;
pub mod source;
pub mod spec;
pub mod substitution;
pub mod token;
pub mod variables;
