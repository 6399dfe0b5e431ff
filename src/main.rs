//! The process entry: arguments and exit code.

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(windlass::cli::run(windlass::cli::Cli::parse()))
}
