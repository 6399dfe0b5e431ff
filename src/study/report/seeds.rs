//! Checks over seeds: for each segment and condition the sea whose statistic of the seeds is nearest to its limit.

use super::StudyView;
use super::page::{ReportCell, ReportTable, Section, Tone};
use crate::study::seed_checks::{SegmentOverSeeds, segments, statistic_word};
use std::collections::BTreeMap;
use windlass_study::ensemble::ensembles;
use windlass_study::kept::{LineVerdict, MooringCondition};

/// A segment over the seeds of a sea, and the first case of that sea.
pub struct SeedRow<'a> {
    case: &'a str,
    segment: SegmentOverSeeds,
}

/// The segments of all ensembles of two cases and more.
pub fn seed_rows<'a>(view: &StudyView<'a>) -> Vec<SeedRow<'a>> {
    let mut rows = Vec::new();
    for ensemble in ensembles(&view.study.records).iter().filter(|ensemble| ensemble.len() > 1) {
        let Some(first) = ensemble.cases().next() else { continue };
        rows.extend(segments(ensemble).into_iter().map(|segment| SeedRow { case: first.case(), segment }));
    }
    rows
}

/// What is said on top: how many checks over seeds are not met.
pub fn say_verdict(view: &StudyView, rows: &[SeedRow], section: &mut Section) {
    let judged = || rows.iter().filter_map(|row| row.segment.judged.as_ref().ok());
    let (count, failing) = (judged().count(), judged().filter(|judged| judged.verdict == LineVerdict::Fail).count());
    let unsure = judged().filter(|judged| judged.utilisation <= 1.0 && judged.utilisation_high > 1.0).count();
    match (count, failing) {
        (0, _) => return,
        (_, 0) if view.is_unconfirmed => {
            section.say(format!("All {count} checks over seeds are met, by factors that are not confirmed."));
        }
        (_, 0) => section.say_in(Tone::Pass, format!("All {count} checks over seeds are met.")),
        (_, n) => section.say_in(Tone::Fail, format!("{n} of {count} checks over seeds are NOT met.")),
    }
    if unsure > 0 {
        section.say_in(
            Tone::Unconfirmed,
            format!(
                "{unsure} of them {} met, and would not be at the upper end of the 95 % interval: more seeds tell.",
                if unsure == 1 { "is" } else { "are" }
            ),
        );
    }
}

/// The section of the checks over seeds.
pub fn seed_section(view: &StudyView, rows: &[SeedRow]) -> Section {
    let mut section = Section::new("seeds", "Checks over seeds");
    if rows.is_empty() {
        section
            .say("No sea has two seeds and more whose lines are checked: each case is judged by its own record alone.");
        return section;
    }
    section.say(
        "For each segment and condition the sea that governs. T is what the code checks of the largest tensions of the seeds, one each: their most \
         probable value (MPM, by a Gumbel distribution), unless it says otherwise, in the storm that is checked. Utilisation at the upper end is \
         that with the upper end of the 95 % interval of T. All seas are in seed_checks.csv.",
    );
    let mut worst: BTreeMap<(MooringCondition, String, Option<String>), (f64, &SeedRow)> = BTreeMap::new();
    for row in rows {
        let Ok(judged) = &row.segment.judged else { continue };
        let first = &row.segment.first;
        let known =
            worst.entry((first.condition, first.label(), first.code.clone())).or_insert((judged.utilisation, row));
        if judged.utilisation > known.0 {
            *known = (judged.utilisation, row);
        }
    }
    let force = |name: &str| view.force_head(name);
    let heads = [
        "Condition".to_owned(),
        "Line and segment".to_owned(),
        "First case".to_owned(),
        "Checked".to_owned(),
        "Seeds".to_owned(),
        force("T"),
        force("95% of T, low"),
        force("high"),
        force("Strength"),
        "Safety factor".to_owned(),
        "Required".to_owned(),
        "Utilisation".to_owned(),
        "At the upper end".to_owned(),
        "Verdict".to_owned(),
    ];
    let cells = |(_, row): &(f64, &SeedRow)| {
        let SegmentOverSeeds { first, seeds, judged, .. } = &row.segment;
        let judged = judged.as_ref().ok()?;
        let verdict = view.verdict(Some(judged.verdict));
        let high = if judged.utilisation_high > 1.0 { Tone::Unconfirmed } else { Tone::Plain };
        let factor = first.breaking_load.map(|strength| strength / judged.tension.value);
        Some(vec![
            ReportCell::text(first.condition.word()),
            ReportCell::text(first.label()),
            ReportCell::text(row.case),
            ReportCell::text(
                first.seeds.as_ref().map_or_else(String::new, |check| statistic_word(&check.statistic, *seeds)),
            ),
            ReportCell::number(Some(*seeds as f64), 0),
            view.force(Some(judged.tension.value)),
            view.force(Some(judged.tension.interval.0)),
            view.force(Some(judged.tension.interval.1)),
            view.force(first.breaking_load),
            ReportCell::number(factor, 2).toned(verdict.tone),
            ReportCell::number(first.required_safety_factor, 2),
            ReportCell::number(Some(judged.utilisation), 3).toned(verdict.tone),
            ReportCell::number(Some(judged.utilisation_high), 3).toned(high),
            verdict,
        ])
    };
    section.show(
        ReportTable { heads: heads.into(), rows: worst.values().filter_map(cells).collect() }.without_empty_columns(),
    );
    let mut reasons: BTreeMap<&str, usize> = BTreeMap::new();
    for reason in rows.iter().filter_map(|row| row.segment.judged.as_ref().err()) {
        *reasons.entry(reason).or_default() += 1;
    }
    for (reason, count) in reasons {
        section.say_in(Tone::Unconfirmed, format!("{count} segments are not judged over seeds: {reason}."));
    }
    section
}
