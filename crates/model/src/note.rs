//! Remarks whose values are printed in the user's units.

use windlass_base::diagnostic::Severity;
use windlass_base::message::Message;
use windlass_base::table::TableNote;
use windlass_base::units::{Dim, UnitSystem};

/// A sentence with values; `{}` in it stands for each of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Note {
    /// How serious.
    pub severity: Severity,
    message: Message,
}

impl Note {
    /// A sentence with values in SI and what they measure.
    pub fn new(sentence: impl AsRef<str>, values: &[(f64, Dim)]) -> Self {
        Note { severity: Severity::Note, message: Message::with_values(sentence, values) }
    }

    /// A warning.
    pub fn warning(sentence: impl Into<Message>) -> Self {
        Note { severity: Severity::Warning, message: sentence.into() }
    }

    /// The sentence without its values, for where no units are known.
    pub fn without_values(&self) -> String {
        self.severity.mark().to_string() + &self.message.without_values()
    }

    /// The remark for a table, in these units.
    pub fn for_table(&self, units: UnitSystem) -> TableNote {
        TableNote { severity: self.severity, text: self.sentence(units) }
    }

    /// The same for a table made where no units are known.
    pub fn for_table_without_values(&self) -> TableNote {
        TableNote { severity: self.severity, text: self.message.without_values() }
    }

    /// The sentence with its values to so many decimals in these units, without its severity.
    pub fn sentence(&self, units: UnitSystem) -> String {
        const DECIMALS: usize = 2;
        self.message.text(units, |value| format!("{value:.DECIMALS$}"))
    }
}

impl From<String> for Note {
    fn from(sentence: String) -> Self {
        Note { severity: Severity::Note, message: sentence.into() }
    }
}

impl From<&str> for Note {
    fn from(sentence: &str) -> Self {
        sentence.to_string().into()
    }
}
