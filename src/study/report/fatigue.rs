//! Fatigue over a study: the damage of each case by how often it occurs, and its life against the code.

use super::StudyView;
use super::lines::natural_order;
use super::page::{ReportCell, ReportTable, Section, Tone};
use std::collections::BTreeMap;
use windlass_study::kept::{LineRow, LineVerdict, MooringCondition};
use windlass_study::lost::PROBABILITY;
use windlass_study::record::CaseRecord;

/// By how much the probabilities of a study may be above one together.
const PROBABILITY_SLACK: f64 = 1e-6;
/// By how much they may be below one before it is said: rounding of printed per cents.
const NOTABLE_REST: f64 = 1e-3;

/// A segment in a condition, in the order of tables.
type SegmentKey = (MooringCondition, (String, u64, String), Option<usize>);

/// Miner's sum of a segment over the cases of a condition.
#[derive(Clone, Debug, Default)]
pub struct FatigueLife {
    label: String,
    cases: usize,
    /// Sum of the probabilities.
    probability: f64,
    /// Sum of probability times damage in a year.
    damage: f64,
    /// The largest of these, and its case.
    largest: (f64, String),
    /// Cases without a probability.
    unweighted: usize,
    /// Years and factor that the script asks for (`CODE_CHECK -LIFE`).
    asked: Option<(f64, f64)>,
    /// Whether factor and curve are confirmed in all cases.
    confirmed: bool,
}

impl FatigueLife {
    /// Damage in a year; none where it is not known how often a case occurs.
    fn annual_damage(&self) -> Option<f64> {
        (self.unweighted == 0 && !self.is_above_one()).then_some(self.damage)
    }

    fn is_above_one(&self) -> bool {
        self.probability > 1.0 + PROBABILITY_SLACK
    }

    /// Design life times factor over the life.
    fn utilisation(&self) -> Option<f64> {
        let (years, factor) = self.asked?;
        Some(self.annual_damage()? * years * factor)
    }

    /// What the check of the life comes to.
    pub fn verdict(&self) -> Option<LineVerdict> {
        self.utilisation().map(|used| match used <= 1.0 {
            false => LineVerdict::Fail,
            true if self.confirmed => LineVerdict::Pass,
            true => LineVerdict::Unconfirmed,
        })
    }
}

/// The sums of the segments that have damage.
pub fn fatigue_lives(view: &StudyView) -> Vec<(MooringCondition, FatigueLife)> {
    // a script that checks twice has two rows of a segment, with one damage
    let is_first = |record: &CaseRecord, at: usize, row: &LineRow| {
        let earlier = record.lines.get(..at).unwrap_or_default();
        !earlier.iter().any(|e| e.line == row.line && e.segment == row.segment && e.annual_damage.is_some())
    };
    let probability = |record: &CaseRecord| {
        let (_, text) = record.values.iter().find(|(name, _)| name.eq_ignore_ascii_case(PROBABILITY))?;
        text.parse::<f64>().ok().filter(|p| p.is_finite() && *p >= 0.0)
    };
    let mut sums: BTreeMap<SegmentKey, FatigueLife> = BTreeMap::new();
    for record in view.judging_tension() {
        for (at, row) in record.lines.iter().enumerate() {
            let Some(damage) = row.annual_damage.filter(|_| is_first(record, at, row)) else { continue };
            let key = (row.condition, natural_order(&row.line), row.segment);
            let new = || FatigueLife { label: row.label(), confirmed: true, ..FatigueLife::default() };
            let sum = sums.entry(key).or_insert_with(new);
            sum.cases += 1;
            if let Some((years, factor)) = row.design_life.zip(row.fatigue_factor) {
                let (known_years, known_factor) = sum.asked.unwrap_or_default();
                sum.asked = Some((years.max(known_years), factor.max(known_factor)));
            }
            sum.confirmed &= row.fatigue_confirmed != Some(false);
            let Some(p) = probability(record) else {
                sum.unweighted += 1;
                continue;
            };
            sum.probability += p;
            sum.damage += p * damage;
            if p * damage > sum.largest.0 {
                sum.largest = (p * damage, record.case.clone());
            }
        }
    }
    sums.into_iter().map(|((condition, ..), sum)| (condition, sum)).collect()
}

/// Fatigue of each segment.
pub fn fatigue_section(view: &StudyView, lives: &[(MooringCondition, FatigueLife)]) -> Section {
    let mut section = Section::new("fatigue", "Fatigue");
    if lives.is_empty() {
        section.say("No case keeps fatigue damage: FATIGUE before CODE_CHECK in the script does.");
        return section;
    }
    let mut table = ReportTable::new(&[
        "Condition",
        "Line and segment",
        "Cases",
        "Sum of probabilities",
        "Damage a year",
        "Life (years)",
        "Most damage in case",
        "Its share",
        "Design life (years)",
        "Factor",
        "Utilisation",
        "Verdict",
    ]);
    for (condition, sum) in lives {
        let damage = sum.annual_damage();
        let life = damage.filter(|damage| *damage > 0.0).map(f64::recip);
        let verdict = sum.asked.map_or_else(|| ReportCell::text(""), |_| view.verdict(sum.verdict()));
        table.rows.push(vec![
            ReportCell::text(condition.word()),
            ReportCell::text(&sum.label),
            ReportCell::number(Some(sum.cases as f64), 0),
            ReportCell::figures((sum.unweighted < sum.cases).then_some(sum.probability), 4),
            ReportCell::figures(damage, 4),
            ReportCell::figures(life, 4),
            ReportCell::text(damage.map_or("", |_| &sum.largest.1)),
            ReportCell::number(damage.filter(|damage| *damage > 0.0).map(|damage| sum.largest.0 / damage), 3),
            ReportCell::figures(sum.asked.map(|(years, _)| years), 4),
            ReportCell::number(sum.asked.map(|(_, factor)| factor), 2),
            ReportCell::number(sum.utilisation(), 3).toned(verdict.tone),
            verdict,
        ]);
    }
    section.show(table.without_empty_columns());
    section.say(
        "The damage of each case, as if it lasted a year, times its column probability, the share of the time that it occurs. The life is \
         the inverse of their sum; the utilisation is design life times factor over it.",
    );
    let unweighted: usize = lives.iter().map(|(_, sum)| sum.unweighted).sum();
    if unweighted > 0 {
        section.say_in(
            Tone::Unconfirmed,
            format!("{unweighted} rows have no number in a column {PROBABILITY}: how often they occur is not known, and so neither is the life."),
        );
    }
    if lives.iter().any(|(_, sum)| sum.is_above_one()) {
        section.say_in(
            Tone::Unconfirmed,
            "Probabilities are above 1 together: no life is given. Members of one sea share its probability.",
        );
    }
    if unweighted == 0 && lives.iter().any(|(_, sum)| sum.probability < 1.0 - NOTABLE_REST) {
        section.say_in(
            Tone::Unconfirmed,
            "Probabilities are below 1 together: the rest of the time does no damage in these numbers.",
        );
    }
    if lives.iter().all(|(_, sum)| sum.asked.is_none()) {
        section.say("No life is asked for: CODE_CHECK -LIFE YEARS in the script judges it by the factor of the code.");
    }
    section
}
