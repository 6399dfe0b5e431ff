//! windlass: a MOSES-style command interpreter for marine mooring analysis.
//!
//! The floors of the house, top to bottom (each knows only those below it):
//! `cli, repl | session | command, aqwa | report | solve | rod, tether | connector | hydro | post | model | table |
//! language`. Everything below `session` can be used as a library by somebody who never types a command.

pub mod aqwa;
pub mod cli;
pub mod command;
pub mod repl;
pub mod report;
pub mod session;
