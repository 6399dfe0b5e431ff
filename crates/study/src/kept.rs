//! What a script keeps of a case: named results and rows of lines.

use serde::{Deserialize, Serialize};

/// Longest name of a result.
const MAX_NAME: usize = 80;

/// Why a result is not kept.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum KeptError {
    /// A name that would not do as the heading of a column.
    #[error("`{0}` cannot name a result: a name is a letter, then letters, digits and _, {MAX_NAME} at most")]
    Name(String),
    /// A second result of a name, in capitals or not.
    #[error("a result {0} has been kept before: each needs a name of its own")]
    Twice(String),
    /// A number that is not finite.
    #[error("the result {name} is not finite: {value}")]
    NotFinite {
        /// Its name.
        name: String,
        /// Its value.
        value: f64,
    },
}

/// A number that a script keeps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct KeptResult {
    /// Its name, as written: a letter, then letters, digits and `_`.
    pub name: String,
    /// Its value, in `unit`. Finite.
    pub value: f64,
    /// Its unit as text, empty of a pure number.
    pub unit: String,
}

impl KeptResult {
    /// A result.
    ///
    /// # Errors
    /// A name that cannot be the heading of a column; a value that is not finite.
    pub fn new(name: impl Into<String>, value: f64, unit: impl Into<String>) -> Result<Self, KeptError> {
        let name = name.into();
        let begins = name.starts_with(|c: char| c.is_ascii_alphabetic());
        if !begins || name.len() > MAX_NAME || !name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') {
            return Err(KeptError::Name(name));
        }
        if !value.is_finite() {
            return Err(KeptError::NotFinite { name, value });
        }
        Ok(KeptResult { name, value, unit: unit.into() })
    }
}

/// How the forces of a line were found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LineAnalysis {
    /// A static line whose ends move.
    QuasiStatic,
    /// A dynamic line.
    Dynamic,
    /// Linear response about the equilibrium.
    FrequencyDomain,
}

/// The state of the mooring that a row is about.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MooringCondition {
    /// Every line acts.
    #[default]
    Intact,
    /// Lines are lost, and the unit has come to rest without them.
    Damaged,
    /// Lines are lost during the run.
    Transient,
}

/// What a case says of a line, or of one of its segments. SI units; what was not computed is `None`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct LineRow {
    /// Name of the connector.
    pub line: String,
    /// Segment from 1, from the fairlead; `None` of the line as a whole.
    pub segment: Option<usize>,
    /// How its forces were found.
    pub analysis: Option<LineAnalysis>,
    /// Intact, damaged or transient.
    pub condition: MooringCondition,
    /// Names of the lines lost.
    pub lost: Vec<String>,
    /// Mean tension (N).
    pub mean_tension: Option<f64>,
    /// Dynamic part of the characteristic tension: the characteristic value less the mean (N).
    pub dynamic_tension: Option<f64>,
    /// Characteristic tension that is checked (N).
    pub max_tension: Option<f64>,
    /// Maxima or samples that the characteristic value is estimated from.
    pub maxima: Option<usize>,
    /// Most probable maximum of the tension (N).
    pub mpm: Option<f64>,
    /// Lower end of the 95 per cent interval of the most probable maximum (N).
    pub mpm_low: Option<f64>,
    /// Upper end of it (N).
    pub mpm_high: Option<f64>,
    /// Breaking load that the check takes (N).
    pub breaking_load: Option<f64>,
    /// Characteristic tension, with its factors, over the breaking load.
    pub utilisation: Option<f64>,
    /// Breaking load over the characteristic tension.
    pub safety_factor: Option<f64>,
    /// The safety factor that the code asks for.
    pub required_safety_factor: Option<f64>,
    /// Name of the code.
    pub code: Option<String>,
    /// Horizontal force at the anchor (N).
    pub anchor_horizontal: Option<f64>,
    /// Vertical force at the anchor, up (N).
    pub anchor_vertical: Option<f64>,
    /// Whether the anchor is pulled upward.
    pub uplift: Option<bool>,
    /// Least length on the seabed (m).
    pub grounded_length: Option<f64>,
    /// Largest horizontal offset of the body (m).
    pub offset: Option<f64>,
}

/// What a script has kept so far.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Kept {
    /// Named results, in the order of the script.
    results: Vec<KeptResult>,
    /// Rows of lines.
    pub lines: Vec<LineRow>,
}

impl Kept {
    /// Keeps a result.
    ///
    /// # Errors
    /// There is one of this name, in capitals or not.
    pub fn add(&mut self, result: KeptResult) -> Result<(), KeptError> {
        if self.results.iter().any(|known| known.name.eq_ignore_ascii_case(&result.name)) {
            return Err(KeptError::Twice(result.name));
        }
        self.results.push(result);
        Ok(())
    }

    /// The named results, in the order of the script.
    pub fn results(&self) -> &[KeptResult] {
        &self.results
    }
}
