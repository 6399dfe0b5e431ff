//! Verification cases: scripts whose results are compared with numbers that windlass did not make.
//!
//! A case is a TOML file of `share/verification/`, in the program by `build.rs`: what it shows, its source, the kind of its reference, a
//! script, and quantities, each with the number as its source prints it. `windlass verify` runs them, `cargo test` runs the quick ones, and
//! `docs/verification.md` holds their table.

mod case;
mod command;
mod installation;
mod judge;
mod listing;
mod page;
mod place;
mod printed;
mod run;

pub use case::{Case, CaseError, CaseText, Cost, Quantity, Reference, embedded, read_cases};
pub use command::{VerifyArgs, VerifyEnd, verify};
pub use installation::Installation;
pub use judge::{Tolerance, Verdict};
pub use page::markdown;
pub use printed::Printed;
pub use run::{CaseResult, Comparison, run_case};

/// Names and texts of the cases, and of the files their scripts read.
mod texts {
    include!(concat!(env!("OUT_DIR"), "/verification.rs"));
}
