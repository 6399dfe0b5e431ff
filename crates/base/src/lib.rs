//! What every crate of windlass speaks: units, tables, places and poses, the values of records, diagnostics, band and dense
//! factorisations.
//!
//! Values are SI (m, kg, s, N, rad, K). A number meets the user's units twice: where a record is read and where a report is
//! written; both go through [`units::Dim`].
//!
//! # Example
//! ```
//! use windlass_base::table::{Digits, Table};
//! use windlass_base::units::{Dim, ForceUnit, LengthUnit, UnitSystem};
//!
//! let lengths = [Dim::Length.to_si(500.0, UnitSystem::default())];
//! let table = Table::new("Lines").with_rows(&lengths).column("", "Length", Dim::Length, Digits::Usual, |l| *l).build();
//! let metres = UnitSystem { length: LengthUnit::Meters, force: ForceUnit::Kilonewtons };
//! let length = table.columns()[0].numbers()[0];
//! assert!((Dim::Length.from_si(length, metres) - 500.0 * 0.3048).abs() < 1e-12);
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod band;
pub mod choice;
pub mod dense;
pub mod diagnostic;
pub mod fortran;
pub mod geometry;
pub mod message;
pub mod pose;
pub mod printable;
pub mod span;
pub mod spec;
pub mod table;
pub mod units;
pub mod values;
pub mod wildcard;
