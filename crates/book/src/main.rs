//! What `mdbook build docs` calls: reads the book from the standard input and prints it with its formulas as MathML.

use std::io::{Read, Write, stderr, stdin, stdout};
use std::process::ExitCode;

fn main() -> ExitCode {
    // asked whether it makes pages for a renderer
    if std::env::args().nth(1).as_deref() == Some("supports") {
        return ExitCode::SUCCESS;
    }
    let mut input = String::new();
    let made = stdin().read_to_string(&mut input).map_err(|error| error.to_string());
    let made = made.and_then(|_| windlass_book::process_book(&input).map_err(|error| error.to_string()));
    let written = made.and_then(|book| stdout().write_all(book.as_bytes()).map_err(|error| error.to_string()));
    match written {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // nothing else can be done when the message stream is gone
            let _ = writeln!(stderr(), "windlass-book: {error}");
            ExitCode::FAILURE
        }
    }
}
