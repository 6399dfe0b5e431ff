//! The process entry: arguments and exit code.

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(match windlass::cli::Cli::try_parse() {
        Ok(cli) => windlass::cli::run(cli),
        Err(message) => windlass::cli::say(&message),
    })
}
