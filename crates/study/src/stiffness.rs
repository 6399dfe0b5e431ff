//! The column `stiffness`: by which axial stiffness of fibre ropes a case is run, and what of it is judged.

use crate::record::CaseRecord;
use serde::{Deserialize, Serialize};

/// The column.
pub const STIFFNESS: &str = "stiffness";

/// The axial stiffness of the fibre ropes of a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CaseStiffness {
    /// The least: offsets are judged.
    Lower,
    /// The largest: tensions are judged.
    Upper,
    /// By how fast ropes are pulled and by their mean tension: both are judged.
    Dynamic,
}

impl CaseStiffness {
    /// Its word in a table.
    pub fn word(self) -> &'static str {
        match self {
            CaseStiffness::Lower => "lower",
            CaseStiffness::Upper => "upper",
            CaseStiffness::Dynamic => "dynamic",
        }
    }

    /// From a cell.
    ///
    /// # Errors
    /// Another word.
    pub fn parse(cell: &str) -> Result<Self, String> {
        let known = [CaseStiffness::Lower, CaseStiffness::Upper, CaseStiffness::Dynamic];
        let found = known.into_iter().find(|stiffness| stiffness.word().eq_ignore_ascii_case(cell));
        found.ok_or_else(|| format!("`{cell}` is no stiffness: lower, upper or dynamic"))
    }
}

impl CaseRecord {
    /// The stiffness of its fibre ropes, where its table has the column.
    pub fn stiffness(&self) -> Option<CaseStiffness> {
        let (_, cell) = self.values.iter().find(|(name, _)| name.eq_ignore_ascii_case(STIFFNESS))?;
        CaseStiffness::parse(cell).ok()
    }

    /// Whether tensions of lines, pulls at anchors and fatigue are judged by it: not with ropes at their least stiffness.
    pub fn judges_tension(&self) -> bool {
        self.stiffness() != Some(CaseStiffness::Lower)
    }

    /// Whether offsets are judged by it: not with ropes at their largest stiffness.
    pub fn judges_offset(&self) -> bool {
        self.stiffness() != Some(CaseStiffness::Upper)
    }
}
