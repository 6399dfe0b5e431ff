//! Checks of lines over seeds: of each segment the statistic that its code checks of the largest tensions of the cases of an ensemble, and
//! what that comes to.
//!
//! The largest tensions of the seeds, one each, have a Gumbel distribution (by moments, [`windlass_signal::ensemble`]). With a mean m and a
//! deviation s of them, scale b = s sqrt(6) / pi, and a storm of duration D over records that last T, the most probable maximum is
//! m - 0.5772 b + b ln(D/T), the mean of the maxima m + b ln(D/T), mean plus *a* deviations m + a s + b ln(D/T).

use super::tables::{RowSource, cell_of, input_column, input_heads, number_column, text_column};
use crate::report::stored::StoredColumn;
use indexmap::IndexMap;
use std::f64::consts::PI;
use std::ops::Range;
use windlass_signal::ensemble::{Estimate, FEWEST_SEEDS, GumbelFit, SeedExtremes};
use windlass_signal::extremes::EULER;
use windlass_study::ensemble::{Ensemble, ensembles, is_seed_column};
use windlass_study::kept::{LineRow, LineVerdict, SeedCheck, SeedStatistic};
use windlass_study::record::CaseStatus;
use windlass_study::records::RecordView;
use windlass_study::store::Study;

/// Confidence level of the interval.
const LEVEL: f64 = 0.95;
/// Records of one sea are as long as each other within this share: an end that an adaptive step has passed by a little is none of another sea.
const SAME_STORM: f64 = 0.01;
/// Ensembles whose rows are made at once.
const ENSEMBLES_AT_ONCE: usize = 1 << 12;

/// A segment over the seeds of a sea.
pub(super) struct SegmentOverSeeds {
    /// The row of its first case: line, segment, condition, code, strength.
    pub(super) first: LineRow,
    /// Mean of the mean tensions (N).
    pub(super) mean_tension: f64,
    /// How many seeds have it.
    pub(super) seeds: usize,
    /// What came of it, or why nothing did.
    pub(super) judged: Result<JudgedSegment, String>,
}

/// What a check over seeds came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct JudgedSegment {
    /// The characteristic tension with its interval (N).
    pub(super) tension: Estimate,
    /// Load over strength; it holds up to 1.
    pub(super) utilisation: f64,
    /// The same with the upper end of the interval.
    pub(super) utilisation_high: f64,
    /// Whether it holds.
    pub(super) verdict: LineVerdict,
}

/// What is checked, in a word.
pub(super) fn statistic_word(statistic: &SeedStatistic, seeds: usize) -> String {
    match statistic {
        SeedStatistic::MostProbable => "MPM".to_owned(),
        SeedStatistic::Mean => "mean of maxima".to_owned(),
        SeedStatistic::MeanPlus(steps) => match deviations(steps, seeds) {
            Some(deviations) => format!("mean of maxima + {deviations} s"),
            None => "mean of maxima + a s".to_owned(),
        },
        SeedStatistic::Refused(_) => String::new(),
    }
}

/// The deviations of the most seeds that are no more than these.
fn deviations(steps: &[(usize, f64)], seeds: usize) -> Option<f64> {
    steps.iter().take_while(|(least, _)| *least <= seeds).last().map(|(_, deviations)| *deviations)
}

/// Judges the largest tensions of some seeds, their mean tension and strength (N).
fn judge(check: &SeedCheck, maxima: &[f64], (mean, strength): (f64, f64)) -> Result<JudgedSegment, String> {
    let variate = match &check.statistic {
        SeedStatistic::MostProbable => 0.0,
        SeedStatistic::Mean => EULER,
        SeedStatistic::MeanPlus(steps) => {
            let deviations = deviations(steps, maxima.len());
            let fewest = steps.first().map_or(0, |(least, _)| *least);
            let deviations = deviations.ok_or_else(|| format!("the code has deviations for {fewest} seeds or more"))?;
            EULER + deviations * PI / 6f64.sqrt()
        }
        SeedStatistic::Refused(reason) => return Err(reason.clone()),
    };
    let wrong = |error: windlass_signal::SeriesError| error.to_string();
    let fit = SeedExtremes::fit(maxima, GumbelFit::Moments).map_err(wrong)?;
    let tension = fit.at_reduced_variate(variate + check.storm_ratio.ln(), LEVEL).map_err(wrong)?;
    let utilisation = |tension: f64| {
        let load = check.mean * mean + check.characteristic * tension.max(mean) + check.added;
        load.max(0.0) / strength
    };
    let (used, high) = (utilisation(tension.value), utilisation(tension.interval.1));
    if !(used.is_finite() && high.is_finite()) {
        return Err("the fit is beyond the range of numbers".into());
    }
    let verdict = match (used <= 1.0, check.is_confirmed) {
        (true, true) => LineVerdict::Pass,
        (true, false) => LineVerdict::Unconfirmed,
        (false, _) => LineVerdict::Fail,
    };
    Ok(JudgedSegment { tension, utilisation: used, utilisation_high: high, verdict })
}

/// The segments of an ensemble: those of runs that CODE_CHECK has judged, in the order of their first cases. Failed cases, and those that judge
/// no tensions, are left out.
pub(super) fn segments(ensemble: &Ensemble) -> Vec<SegmentOverSeeds> {
    let mut found: IndexMap<(String, Option<usize>, Option<String>), Vec<LineRow>> = IndexMap::new();
    let judges = |case: &RecordView| case.status() != CaseStatus::Failed && case.judges_tension();
    for case in ensemble.cases().filter(judges) {
        let mut seen: Vec<(String, Option<usize>, Option<String>)> = Vec::new();
        for row in case.lines().filter(|row| row.seeds.is_some()) {
            let key = (row.line.clone(), row.segment, row.code.clone());
            // a script that checks a segment twice by one code has two rows of it: the first counts
            if !seen.contains(&key) {
                seen.push(key.clone());
                found.entry(key).or_default().push(row);
            }
        }
    }
    let segment = |rows: Vec<LineRow>| {
        let of = |of: fn(&LineRow) -> Option<f64>| rows.iter().filter_map(of).collect::<Vec<f64>>();
        let (maxima, means) = (of(|row| row.largest_tension), of(|row| row.mean_tension));
        let mean_tension = means.iter().sum::<f64>() / means.len() as f64;
        let first = rows.first()?.clone();
        let check = first.seeds.as_deref()?;
        let is_alike = |row: &LineRow| {
            let other = row.seeds.as_deref();
            let is_same = |other: &SeedCheck| {
                let factors = |check: &SeedCheck| (check.mean, check.characteristic, check.added);
                factors(other) == factors(check)
                    && other.statistic == check.statistic
                    && (other.storm_ratio / check.storm_ratio - 1.0).abs() < SAME_STORM
            };
            other.is_some_and(is_same) && row.condition == first.condition && row.breaking_load == first.breaking_load
        };
        let judged = if maxima.len() < FEWEST_SEEDS {
            Err(format!("{} seeds: {FEWEST_SEEDS} are needed", maxima.len()))
        } else if !rows.iter().all(is_alike) {
            Err("its cases are checked in different ways".to_owned())
        } else {
            let strength = first.breaking_load.ok_or_else(|| "it has no strength".to_owned());
            strength.and_then(|strength| judge(check, &maxima, (mean_tension, strength)))
        };
        Some(SegmentOverSeeds { mean_tension, seeds: maxima.len(), judged, first })
    };
    found.into_values().filter_map(segment).collect()
}

/// The rows of `seed_checks.csv`.
pub(super) struct SeedCheckRows<'a> {
    ensembles: Vec<Ensemble<'a>>,
    inputs: Vec<(&'a str, bool)>,
}

impl<'a> SeedCheckRows<'a> {
    /// None where no ensemble of two cases and more has a line that is checked.
    pub(super) fn new(study: &'a Study) -> Option<Self> {
        let mut ensembles = ensembles(&study.records);
        ensembles.retain(|ensemble| ensemble.len() > 1);
        let is_checked = |case: RecordView| {
            case.status() != CaseStatus::Failed && case.judges_tension() && case.lines().any(|row| row.seeds.is_some())
        };
        if !ensembles.iter().any(|ensemble| ensemble.cases().any(is_checked)) {
            return None;
        }
        let mut inputs = input_heads(ensembles.iter().filter_map(|ensemble| ensemble.cases().next()));
        inputs.retain(|(name, _)| !is_seed_column(name));
        Some(SeedCheckRows { ensembles, inputs })
    }
}

impl RowSource for SeedCheckRows<'_> {
    fn count(&self) -> usize {
        self.ensembles.len()
    }

    fn at_once(&self) -> usize {
        ENSEMBLES_AT_ONCE
    }

    fn columns(&self, range: Range<usize>) -> Vec<StoredColumn> {
        let ensembles = range.filter_map(|place| self.ensembles.get(place));
        let rows: Vec<(Option<RecordView>, SegmentOverSeeds)> = ensembles
            .flat_map(|ensemble| segments(ensemble).into_iter().map(|row| (ensemble.cases().next(), row)))
            .collect();
        let texts = |of: &dyn Fn(&SegmentOverSeeds) -> Option<String>| rows.iter().map(|(_, row)| of(row)).collect();
        let numbers = |of: &dyn Fn(&SegmentOverSeeds) -> Option<f64>| {
            rows.iter().map(|(_, row)| of(row).filter(|number| number.is_finite())).collect::<Vec<_>>()
        };
        let judged = |of: fn(&JudgedSegment) -> f64| numbers(&|row| row.judged.as_ref().ok().map(of));
        let first = rows.iter().map(|(first, _)| first.map(|case| case.case().to_owned()));
        let mut columns = vec![text_column("first_case", first.collect())];
        for (input, is_number) in &self.inputs {
            columns.push(input_column(
                input,
                *is_number,
                rows.iter().map(|(first, _)| cell_of((*first)?, input)).collect(),
            ));
        }
        let statistic = |row: &SegmentOverSeeds| {
            let word = statistic_word(&row.first.seeds.as_deref()?.statistic, row.seeds);
            Some(word).filter(|word| !word.is_empty())
        };
        let (verdict, reason): (Vec<_>, Vec<_>) = rows
            .iter()
            .map(|(_, row)| match &row.judged {
                Ok(judged) => (Some(judged.verdict.word().to_owned()), None),
                Err(reason) => (None, Some(reason.clone())),
            })
            .unzip();
        columns.extend([
            text_column("line", texts(&|row| Some(row.first.line.clone()))),
            number_column("segment", "", numbers(&|row| row.first.segment.map(|n| n as f64))),
            text_column("analysis", texts(&|row| Some(row.first.analysis?.word().to_owned()))),
            text_column("condition", texts(&|row| Some(row.first.condition.word().to_owned()))),
            text_column("lost", texts(&|row| Some(row.first.lost.join(" ")).filter(|text| !text.is_empty()))),
            text_column("code", texts(&|row| row.first.code.clone())),
            text_column("statistic", texts(&statistic)),
            number_column("seeds", "", numbers(&|row| Some(row.seeds as f64))),
            number_column("mean_tension", "N", numbers(&|row| Some(row.mean_tension))),
            number_column("tension", "N", judged(|judged| judged.tension.value)),
            number_column("tension_low", "N", judged(|judged| judged.tension.interval.0)),
            number_column("tension_high", "N", judged(|judged| judged.tension.interval.1)),
            number_column("breaking_load", "N", numbers(&|row| row.first.breaking_load)),
            number_column("utilisation", "", judged(|judged| judged.utilisation)),
            number_column("utilisation_high", "", judged(|judged| judged.utilisation_high)),
            number_column(
                "safety_factor",
                "",
                numbers(&|row| Some(row.first.breaking_load? / row.judged.as_ref().ok()?.tension.value)),
            ),
            number_column("required_safety_factor", "", numbers(&|row| row.first.required_safety_factor)),
            text_column("verdict", verdict),
            text_column("reason", reason),
        ]);
        columns
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(statistic: SeedStatistic, storm_ratio: f64) -> SeedCheck {
        SeedCheck { mean: 0.0, characteristic: 2.0, added: 0.0, storm_ratio, statistic, is_confirmed: true }
    }

    /// Eight largest tensions (N): tests/data/study_line_ensembles.py.
    const MAXIMA: [f64; 8] = [700e3, 662e3, 741e3, 718e3, 689e3, 803e3, 676e3, 730e3];

    #[test]
    fn statistics_of_seeds_and_their_intervals_are_those_of_scipy() {
        // scipy: gumbel_r by moments; the mode of the largest of three records by its fractile exp(-1/3); intervals by Student's t and the
        // variance s^2 (1 + k skewness + k^2 (kurtosis - 1) / 4) / n, skewness and kurtosis by gumbel_r.stats; of the mean t.interval
        let steps = SeedStatistic::MeanPlus(vec![(5, 0.6), (8, 0.3), (20, 0.1)]);
        for (statistic, ratio, value, half) in [
            (SeedStatistic::MostProbable, 1.0, 694_830.933_8, 31_372.687_7),
            (SeedStatistic::MostProbable, 3.0, 732_980.725_6, 47_756.166_2),
            (SeedStatistic::Mean, 1.0, 714_875.0, 37_233.950_2),
            (steps, 1.0, 728_236.131_0, 44_694.144_4),
        ] {
            let found = judge(&check(statistic.clone(), ratio), &MAXIMA, (400e3, 1.5e6)).unwrap();
            let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-3, "{statistic:?}: {a} is not {b}");
            near(found.tension.value, value);
            near(found.tension.interval.0, value - half);
            near(found.tension.interval.1, value + half);
            // twice the tension over 1.5 MN
            assert!((found.utilisation - 2.0 * value / 1.5e6).abs() < 1e-9);
            assert!((found.utilisation_high - 2.0 * (value + half) / 1.5e6).abs() < 1e-9);
        }
    }

    #[test]
    fn verdict_is_by_the_statistic_and_never_a_pass_by_what_is_not_confirmed() {
        let most = check(SeedStatistic::MostProbable, 1.0);
        // 1.39 MN is needed
        let verdict = |check: &SeedCheck, strength| judge(check, &MAXIMA, (400e3, strength)).map(|j| j.verdict);
        assert_eq!(verdict(&most, 1.390e6), Ok(LineVerdict::Pass));
        assert_eq!(verdict(&most, 1.389e6), Ok(LineVerdict::Fail));
        assert_eq!(verdict(&SeedCheck { is_confirmed: false, ..most.clone() }, 1.5e6), Ok(LineVerdict::Unconfirmed));
        // class 1 of partial factors: (1.10 0.4 + 1.50 (0.694831 - 0.4)) MN on 1 MN is 0.882246
        let partial = SeedCheck { mean: 1.10 - 1.50, characteristic: 1.50, ..most.clone() };
        let found = judge(&partial, &MAXIMA, (400e3, 1e6)).unwrap();
        assert!((found.utilisation - 0.882_246).abs() < 1e-6, "{}", found.utilisation);
        // fewer seeds than the code has deviations for, numbers that are not to be used, seeds that are all alike
        let of_twenty = check(SeedStatistic::MeanPlus(vec![(20, 0.1)]), 1.0);
        assert_eq!(verdict(&of_twenty, 1e6), Err("the code has deviations for 20 seeds or more".into()));
        assert_eq!(verdict(&check(SeedStatistic::Refused("not given".into()), 1.0), 1e6), Err("not given".into()));
        assert!(judge(&most, &[5.0; 4], (1.0, 1e6)).is_err());
    }
}
