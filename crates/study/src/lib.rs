//! Studies: many cases of one model, their results in one table.
//!
//! A case is a row of a table; its values become variables of a script. The script keeps results ([`kept::KeptResult`]) and rows
//! of lines ([`kept::LineRow`]). This crate knows neither commands nor engines: the program runs the cases.
//!
//! # Example
//!
//! ```
//! use windlass_study::kept::{Kept, KeptResult};
//!
//! let mut kept = Kept::default();
//! kept.add(KeptResult::new("OFFSET", 12.5, "m")?)?;
//! assert!(kept.add(KeptResult::new("offset", 13.0, "m")?).is_err());
//! # Ok::<(), windlass_study::kept::KeptError>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod ensemble;
pub mod kept;
pub mod lost;
pub mod packing;
pub mod parts;
pub mod record;
pub mod records;
pub mod runner;
pub mod seeds;
pub mod stiffness;
pub mod store;
pub mod table;
