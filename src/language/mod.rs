//! The command language: tokens, records, numbers, variables, control flow, macros, option specs, units and
//! diagnostics. It knows nothing of ships.

pub mod units;
