//! Checks of moorings by design codes.
//!
//! Factors are data ([`codes::CodeLibrary`]): every one has its clause, its source and how sure it is. A check takes a tension, a strength
//! and the factors of a code for how the line was analysed (quasi-static or dynamic) and in which condition the mooring was (intact,
//! damaged, transient). A factor that nobody confirmed never gives a pass ([`Verdict`]). Values are SI. Nothing here knows where they
//! come from.
//!
//! # Example
//! ```
//! use windlass_design_checks::codes::{Analysis, CodeLibrary, CodeOptions, Condition};
//! use windlass_design_checks::tension::{LineTension, check_tension};
//!
//! let text = r#"
//! [[code]]
//! name = "COMPANY_2024"
//! title = "Company practice"
//! edition = "2024"
//! [[code.tension]]
//! form = "safety-factor"
//! analysis = "dynamic"
//! condition = "intact"
//! factor = 1.8
//! "#;
//! let library = CodeLibrary::parse_own(text)?;
//! let code = library.find("company_2024")?;
//! let rule = code.tension_rule(Analysis::Dynamic, Condition::Intact, &CodeOptions::default())?;
//! let tension = LineTension { mean: 1.0e6, characteristic: 2.0e6, pretension: None };
//! let checked = check_tension(&tension, 5.0e6, &rule)?;
//! assert_eq!(checked.safety_factor, 2.5);
//! assert_eq!(checked.utilisation, 0.72);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod anchor;
pub mod codes;
pub mod fatigue;
pub mod limits;
pub mod strength;
pub mod tension;

/// What a check came to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// Met, by factors that are confirmed.
    Pass,
    /// Met, but by factors that are not confirmed: not a pass.
    Unconfirmed,
    /// Not met.
    Fail,
}

impl Verdict {
    /// Of a utilisation, which holds up to 1; `is_confirmed` says whether all its factors are.
    pub fn of(utilisation: f64, is_confirmed: bool) -> Verdict {
        match (utilisation <= 1.0, is_confirmed) {
            (true, true) => Verdict::Pass,
            (true, false) => Verdict::Unconfirmed,
            (false, _) => Verdict::Fail,
        }
    }

    /// Its word in tables.
    pub fn word(self) -> &'static str {
        match self {
            Verdict::Pass => "pass",
            Verdict::Unconfirmed => "UNCONFIRMED",
            Verdict::Fail => "FAIL",
        }
    }
}

/// Why a check cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CheckError {
    /// A value out of its range.
    #[error("{what} must be {expected}, not {value}")]
    Value {
        /// Which value.
        what: &'static str,
        /// What it must be.
        expected: &'static str,
        /// What it was.
        value: f64,
    },
    /// A form of check lacks a value that it needs.
    #[error("{0}")]
    Lacks(String),
}

/// Sees that a value is finite and greater than zero.
fn above_zero(what: &'static str, value: f64) -> Result<(), CheckError> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    Err(CheckError::Value { what, expected: "finite and greater than zero", value })
}

/// Sees that a value is finite.
fn finite(what: &'static str, value: f64) -> Result<(), CheckError> {
    if value.is_finite() {
        return Ok(());
    }
    Err(CheckError::Value { what, expected: "finite", value })
}
