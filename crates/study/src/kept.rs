//! What a script keeps of a case: named results and rows of lines.

use serde::{Deserialize, Serialize};
use std::cmp::Reverse;

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
    /// Whether its small values matter: it is the least of a storm, as a clearance is, not the largest.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub is_least: bool,
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
        Ok(KeptResult { name, value, unit: unit.into(), is_least: false })
    }

    /// The same as the least of a storm.
    pub fn least(self) -> Self {
        KeptResult { is_least: true, ..self }
    }

    /// Takes the value of another of its name and unit where that is the more extreme.
    pub fn take_extreme(&mut self, other: &KeptResult) {
        let is_more = if self.is_least { other.value < self.value } else { other.value > self.value };
        if is_more && self.unit == other.unit {
            self.value = other.value;
        }
    }
}

/// How the forces of a line were found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LineAnalysis {
    /// A static line whose ends move.
    QuasiStatic,
    /// A dynamic line.
    Dynamic,
    /// Linear response about the equilibrium.
    FrequencyDomain,
}

impl LineAnalysis {
    /// Its word in tables.
    pub fn word(self) -> &'static str {
        match self {
            LineAnalysis::QuasiStatic => "quasi-static",
            LineAnalysis::Dynamic => "dynamic",
            LineAnalysis::FrequencyDomain => "frequency-domain",
        }
    }
}

/// The state of the mooring that a row is about.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
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

impl MooringCondition {
    /// Its word in tables.
    pub fn word(self) -> &'static str {
        match self {
            MooringCondition::Intact => "intact",
            MooringCondition::Damaged => "damaged",
            MooringCondition::Transient => "transient",
        }
    }
}

/// What a check of a line came to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LineVerdict {
    /// Met, by factors that are confirmed.
    Pass,
    /// Met, but by factors that are not confirmed: not a pass.
    Unconfirmed,
    /// Not met.
    Fail,
}

impl LineVerdict {
    /// Its word in tables.
    pub fn word(self) -> &'static str {
        match self {
            LineVerdict::Pass => "pass",
            LineVerdict::Unconfirmed => "UNCONFIRMED",
            LineVerdict::Fail => "FAIL",
        }
    }
}

/// By what rows of a segment are compared, the surest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum SeverityKind {
    /// Utilisation by a code.
    Utilisation,
    /// Characteristic tension over the breaking load.
    TensionOverBreak,
    /// Tension (N).
    Tension,
}

/// When a line of a transient case was lost.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LossTime {
    /// Which of the instants of the case, from 1.
    pub number: usize,
    /// Time (s).
    pub time: f64,
    /// What is there in the intact case.
    pub reason: String,
}

/// How the tensions of a segment are judged over the seeds of a sea: the load is `mean` times the mean tension, plus `characteristic` times the
/// statistic of the largest tensions, plus `added`; it holds up to the breaking load.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SeedCheck {
    /// Factor on the mean tension.
    pub mean: f64,
    /// Factor on the characteristic tension.
    pub characteristic: f64,
    /// What does not depend on either (N).
    pub added: f64,
    /// Duration of the storm that is checked over that of the record.
    pub storm_ratio: f64,
    /// The statistic.
    pub statistic: SeedStatistic,
    /// Whether all factors of the check are confirmed.
    pub is_confirmed: bool,
}

/// What of the largest tensions of the seeds of a sea is checked.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SeedStatistic {
    /// The most probable one.
    MostProbable,
    /// Their mean.
    Mean,
    /// Their mean plus so many standard deviations: for each number of seeds, ascending, how many from it on.
    MeanPlus(Vec<(usize, f64)>),
    /// The code says what, and its numbers are not to be used: why.
    Refused(String),
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
    /// When they were lost, of a transient case.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub loss: Option<Box<LossTime>>,
    /// Mean tension (N).
    pub mean_tension: Option<f64>,
    /// Dynamic part of the characteristic tension: the characteristic value less the mean (N).
    pub dynamic_tension: Option<f64>,
    /// Characteristic tension that is checked (N).
    pub max_tension: Option<f64>,
    /// Largest tension of the record (N); the characteristic one may be larger, or smaller.
    pub largest_tension: Option<f64>,
    /// Least tension of the record (N).
    pub least_tension: Option<f64>,
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
    /// What the check of the tension came to.
    pub verdict: Option<LineVerdict>,
    /// Name of the code.
    pub code: Option<String>,
    /// Edition of the code, clause and source of its factor, and how sure it is.
    pub factor_source: Option<String>,
    /// Largest tension as a dynamic line over that of this quasi-static one, where the run replayed it.
    pub screening_ratio: Option<f64>,
    /// Horizontal force at the anchor (N).
    pub anchor_horizontal: Option<f64>,
    /// Vertical force at the anchor, up (N).
    pub anchor_vertical: Option<f64>,
    /// Whether the anchor is pulled upward.
    pub uplift: Option<bool>,
    /// Capacity of the anchor (N).
    pub anchor_capacity: Option<f64>,
    /// Capacity of the anchor over its pull.
    pub anchor_safety_factor: Option<f64>,
    /// The factor that the code asks of the anchor.
    pub anchor_required_factor: Option<f64>,
    /// What the check of the anchor came to.
    pub anchor_verdict: Option<LineVerdict>,
    /// Fatigue damage in a year of the environment of the case (of all its environments, by their share of the time).
    pub annual_damage: Option<f64>,
    /// The life that it is judged by (years).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub design_life: Option<f64>,
    /// The factor that the code asks of the design life.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fatigue_factor: Option<f64>,
    /// Whether that factor and the fatigue curve are confirmed by their sources.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fatigue_confirmed: Option<bool>,
    /// Least length on the seabed (m).
    pub grounded_length: Option<f64>,
    /// Largest horizontal distance (m) of the body at the first end of the line from where the model has it before the run.
    pub offset: Option<f64>,
    /// How the segment is judged over seeds; none of a line at rest.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seeds: Option<Box<SeedCheck>>,
}

impl LineRow {
    /// Its numbers, in the order of the fields; a number of maxima and the time of a loss are not among them.
    pub(crate) fn numbers_mut(&mut self) -> [&mut Option<f64>; 23] {
        let LineRow {
            line: _,
            segment: _,
            analysis: _,
            condition: _,
            lost: _,
            loss: _,
            mean_tension,
            dynamic_tension,
            max_tension,
            largest_tension,
            least_tension,
            maxima: _,
            mpm,
            mpm_low,
            mpm_high,
            breaking_load,
            utilisation,
            safety_factor,
            required_safety_factor,
            verdict: _,
            code: _,
            factor_source: _,
            screening_ratio,
            anchor_horizontal,
            anchor_vertical,
            uplift: _,
            anchor_capacity,
            anchor_safety_factor,
            anchor_required_factor,
            anchor_verdict: _,
            annual_damage,
            design_life,
            fatigue_factor,
            fatigue_confirmed: _,
            grounded_length,
            offset,
            seeds: _,
        } = self;
        [
            mean_tension,
            dynamic_tension,
            max_tension,
            largest_tension,
            least_tension,
            mpm,
            mpm_low,
            mpm_high,
            breaking_load,
            utilisation,
            safety_factor,
            required_safety_factor,
            screening_ratio,
            anchor_horizontal,
            anchor_vertical,
            anchor_capacity,
            anchor_safety_factor,
            anchor_required_factor,
            annual_damage,
            design_life,
            fatigue_factor,
            grounded_length,
            offset,
        ]
    }

    /// Line and segment as tables have them: `L1 2`, or `L1` of the line as a whole.
    pub fn label(&self) -> String {
        self.segment.map_or_else(|| self.line.clone(), |segment| format!("{} {segment}", self.line))
    }

    /// Takes the place of this row where another of its segment is nearer to its limit; of anchor, offset and length on the bottom the
    /// worse of the two is kept.
    pub fn take_severer(&mut self, mut other: LineRow) {
        // the surest kind first, and any before none
        let order = |row: &LineRow| row.severity().map_or((None, 0.0), |(kind, value)| (Some(Reverse(kind)), value));
        let ((kind, value), (other_kind, other_value)) = (order(self), order(&other));
        if other_kind.cmp(&kind).then(other_value.total_cmp(&value)).is_gt() {
            std::mem::swap(self, &mut other);
        }
        let larger = |a: Option<f64>, b: Option<f64>| a.map_or(b, |a| Some(b.map_or(a, |b| a.max(b))));
        let smaller = |a: Option<f64>, b: Option<f64>| a.map_or(b, |a| Some(b.map_or(a, |b| a.min(b))));
        self.largest_tension = larger(self.largest_tension, other.largest_tension);
        self.least_tension = smaller(self.least_tension, other.least_tension);
        self.anchor_horizontal = larger(self.anchor_horizontal, other.anchor_horizontal);
        self.anchor_vertical = larger(self.anchor_vertical, other.anchor_vertical);
        self.uplift = self.uplift.max(other.uplift);
        self.grounded_length = smaller(self.grounded_length, other.grounded_length);
        self.offset = larger(self.offset, other.offset);
        let is_worse = other.anchor_verdict > self.anchor_verdict
            || (other.anchor_verdict == self.anchor_verdict && other.anchor_safety_factor < self.anchor_safety_factor);
        if is_worse && other.anchor_verdict.is_some() {
            self.anchor_capacity = other.anchor_capacity;
            self.anchor_safety_factor = other.anchor_safety_factor;
            self.anchor_required_factor = other.anchor_required_factor;
            self.anchor_verdict = other.anchor_verdict;
        }
    }

    /// How near the row is to its limit, and by what: of rows of one segment the largest governs. `None` without a tension.
    pub fn severity(&self) -> Option<(SeverityKind, f64)> {
        if let Some(utilisation) = self.utilisation {
            return Some((SeverityKind::Utilisation, utilisation));
        }
        let tension = self.max_tension.or(self.largest_tension)?;
        Some(match self.breaking_load.filter(|load| *load > 0.0) {
            Some(load) => (SeverityKind::TensionOverBreak, tension / load),
            None => (SeverityKind::Tension, tension),
        })
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn severer_row_takes_the_place_and_extremes_of_both_stay() {
        let row = |utilisation, largest, grounded, anchor| LineRow {
            utilisation: Some(utilisation),
            largest_tension: Some(largest),
            grounded_length: Some(grounded),
            anchor_horizontal: Some(anchor),
            ..LineRow::default()
        };
        for (mut first, second) in [
            (row(0.5, 10.0, 40.0, 3.0), row(0.7, 9.0, 60.0, 2.0)),
            (row(0.7, 9.0, 60.0, 2.0), row(0.5, 10.0, 40.0, 3.0)),
        ] {
            first.take_severer(second);
            assert_eq!(first, row(0.7, 10.0, 40.0, 3.0));
        }
        // a row that is checked goes before one that is not
        let mut bare = LineRow { max_tension: Some(99.0), ..LineRow::default() };
        bare.take_severer(LineRow { utilisation: Some(0.1), max_tension: Some(1.0), ..LineRow::default() });
        assert_eq!((bare.utilisation, bare.max_tension), (Some(0.1), Some(1.0)));
        bare.take_severer(LineRow::default());
        assert_eq!(bare.utilisation, Some(0.1));
    }

    #[test]
    fn least_result_takes_the_smaller_value() {
        let result = |value| KeptResult::new("C", value, "m").unwrap();
        let (mut largest, mut least) = (result(4.0), result(4.0).least());
        for value in [3.0, 5.0] {
            largest.take_extreme(&result(value));
            least.take_extreme(&result(value));
        }
        assert_eq!((largest.value, least.value), (5.0, 3.0));
    }
}
