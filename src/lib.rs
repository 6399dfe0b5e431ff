//! windlass, the program: a MOSES-style command interpreter for marine mooring analysis.
//!
//! From top to bottom: `cli` and `repl` (the two front doors), `session` (records one after the other), `commands` (a spec and a
//! handler each), `report` (tables, files, plots, films). The engines are crates of their own, `windlass-*`, and the dependency
//! graph of Cargo keeps their order; none of them knows of commands, files or printing. `verification` runs scripts and compares
//! their results with numbers that windlass did not make; `study` runs tables of cases, a process each. `hosted` is a session for
//! programs that call it. `format_scripts` lays scripts out; `lsp` serves editors; `assist` is what they and the terminal offer while a
//! record is typed.

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod assist;
pub mod cli;
pub mod commands;
pub mod format_scripts;
pub mod hosted;
pub mod lsp;
mod man_page;
pub mod manual;
pub mod repl;
pub mod report;
pub mod session;
pub mod study;
pub mod verification;
