//! The command language: tokens, records, numbers, variables, control flow, macros, option specs, units and
//! diagnostics. It knows nothing of ships.

pub mod args;
pub mod flow;
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
