//! What the rows of lines come to: the governing row of each segment in each condition, anchors, how the lines were run.

use super::StudyView;
use super::page::{ReportCell, ReportTable, Section, Tone};
use std::collections::{BTreeMap, BTreeSet};
use windlass_base::units::Dim;
use windlass_study::kept::{LineAnalysis, LineRow, LineVerdict, MooringCondition, SeverityKind};
use windlass_study::record::CaseRecord;

/// Least ratio of the tension of a dynamic line to that of a quasi-static one that is marked.
const NOTABLE_RATIO: f64 = 1.1;

/// A row that governs, with its case.
#[derive(Clone, Copy, Debug)]
pub struct Governing<'a> {
    /// Its case.
    pub record: &'a CaseRecord,
    /// The row.
    pub row: &'a LineRow,
}

/// Which row of a segment is meant: intact before damaged before transient, then in the order of the lines.
type SegmentKey = (MooringCondition, usize);

/// The most severe row of each segment in each condition, of the cases that have not failed.
pub fn governing_rows<'a>(view: &StudyView<'a>) -> Vec<Governing<'a>> {
    let mut order: Vec<(&str, Option<usize>)> = Vec::new();
    let mut best: BTreeMap<SegmentKey, (SeverityKind, f64, Governing<'a>)> = BTreeMap::new();
    for record in view.judging_tension() {
        for row in &record.lines {
            let Some((kind, value)) = row.severity() else { continue };
            let name = (row.line.as_str(), row.segment);
            let at = order.iter().position(|known| *known == name).unwrap_or_else(|| {
                order.push(name);
                order.len() - 1
            });
            let found = (kind, value, Governing { record, row });
            let known = best.entry((row.condition, at)).or_insert(found);
            // a row with a utilisation comes before one without
            if kind < known.0 || (kind == known.0 && value > known.1) {
                *known = found;
            }
        }
    }
    let mut rows: Vec<(SegmentKey, Governing)> = best.into_iter().map(|(key, (_, _, found))| (key, found)).collect();
    let place = |at: usize| order.get(at).copied().unwrap_or_default();
    rows.sort_by(|(a, _), (b, _)| {
        let natural = |at: usize| {
            let (line, segment) = place(at);
            (natural_order(line), segment)
        };
        a.0.cmp(&b.0).then_with(|| natural(a.1).cmp(&natural(b.1)))
    });
    rows.into_iter().map(|(_, found)| found).collect()
}

/// A name split so that L2 comes before L10.
pub(super) fn natural_order(name: &str) -> (String, u64, String) {
    let digits = name.trim_start_matches(|c: char| !c.is_ascii_digit());
    let head = name.get(..name.len() - digits.len()).unwrap_or(name);
    let number = digits.trim_start_matches(|c: char| c.is_ascii_digit());
    let value = digits.get(..digits.len() - number.len()).and_then(|text| text.parse().ok()).unwrap_or(0);
    (head.to_owned(), value, number.to_owned())
}

impl StudyView<'_> {
    /// A verdict as this report says it: where a factor of the study is not confirmed, nothing is a pass.
    pub fn verdict(&self, verdict: Option<LineVerdict>) -> ReportCell {
        let shown = match verdict {
            Some(LineVerdict::Pass) if self.is_unconfirmed => Some(LineVerdict::Unconfirmed),
            other => other,
        };
        let tone = match shown {
            None => Tone::Plain,
            Some(LineVerdict::Pass) => Tone::Pass,
            Some(LineVerdict::Unconfirmed) => Tone::Unconfirmed,
            Some(LineVerdict::Fail) => Tone::Fail,
        };
        ReportCell::text(shown.map_or("not checked", LineVerdict::word)).toned(tone)
    }

    pub(super) fn force(&self, value: Option<f64>) -> ReportCell {
        ReportCell::quantity(value, Dim::Force, self.units)
    }

    pub(super) fn force_head(&self, name: &str) -> String {
        format!("{name} ({})", Dim::Force.label(self.units))
    }
}

/// The lines lost, in a transient case with the instant.
fn lost_text(row: &LineRow) -> String {
    let lost = row.lost.join(" ");
    row.loss.as_ref().map_or(lost.clone(), |loss| format!("{lost} at {:.1} s: {}", loss.time, loss.reason))
}

/// The governing row of each segment and condition, with its safety factor against the code.
pub fn governing_table(view: &StudyView, rows: &[Governing]) -> ReportTable {
    let force = |name: &str| view.force_head(name);
    let heads = [
        "Condition".to_owned(),
        "Line and segment".to_owned(),
        "Case".to_owned(),
        "Lines lost".to_owned(),
        "Safety factor".to_owned(),
        "Required".to_owned(),
        "Utilisation".to_owned(),
        "Verdict".to_owned(),
        force("T char"),
        force("Largest T"),
        force("T mean"),
        force("T dyn"),
        force("Strength"),
        force("95% of MPM, low"),
        force("high"),
        "n".to_owned(),
        "Run as".to_owned(),
    ];
    let row = |found: &Governing| {
        let row = found.row;
        let verdict = view.verdict(row.verdict);
        let tone = verdict.tone;
        let largest = if is_exceeded(row) { Tone::Unconfirmed } else { Tone::Plain };
        vec![
            ReportCell::text(row.condition.word()),
            ReportCell::text(row.label()),
            ReportCell::text(&found.record.case),
            ReportCell::text(lost_text(row)),
            ReportCell::number(row.safety_factor, 2).toned(tone),
            ReportCell::number(row.required_safety_factor, 2),
            ReportCell::number(row.utilisation, 3).toned(tone),
            verdict,
            view.force(row.max_tension),
            view.force(row.largest_tension).toned(largest),
            view.force(row.mean_tension),
            view.force(row.dynamic_tension),
            view.force(row.breaking_load),
            view.force(row.mpm_low),
            view.force(row.mpm_high),
            ReportCell::number(row.maxima.map(|n| n as f64), 0),
            ReportCell::text(row.analysis.map_or("", LineAnalysis::word)),
        ]
    };
    ReportTable { heads: heads.into(), rows: rows.iter().map(row).collect() }.without_empty_columns()
}

/// Whether the record has a tension beyond the characteristic one that is checked.
fn is_exceeded(row: &LineRow) -> bool {
    row.max_tension.zip(row.largest_tension).is_some_and(|(checked, largest)| largest > checked)
}

/// What a reviewer asks first: records in which a tension is larger than what is checked, and how many would not be met by it.
fn exceedances(view: &StudyView, section: &mut Section) {
    let rows = || view.judging_tension().flat_map(|record| record.lines.iter().map(move |row| (record, row)));
    let exceeded: Vec<_> = rows().filter(|(_, row)| is_exceeded(row)).collect();
    if exceeded.is_empty() {
        return;
    }
    let factor = |row: &LineRow| Some(row.breaking_load? / row.largest_tension?);
    let missed = |row: &LineRow| factor(row).zip(row.required_safety_factor).is_some_and(|(had, asked)| had < asked);
    let least = exceeded.iter().filter_map(|(record, row)| Some((factor(row)?, *record, *row)));
    let least = least.reduce(|a, b| if b.0 < a.0 { b } else { a });
    let mut text = format!(
        "In {} of {} rows the largest tension of the record is above the characteristic tension that is checked",
        exceeded.len(),
        rows().count()
    );
    if let Some((factor, record, row)) = least {
        text.push_str(&format!(
            ": strength over it is least {factor:.2} ({}, {}, case {})",
            row.label(),
            row.condition.word(),
            record.case
        ));
    }
    let met = exceeded.iter().filter(|(_, row)| row.verdict != Some(LineVerdict::Fail) && missed(row)).count();
    if met > 0 {
        text.push_str(&format!(
            ". {met} of them {} met by the most probable maximum and would not be by the largest of the record: judge by all seeds \
             together, or check the largest (CODE_CHECK -CHARACTERISTIC LARGEST)",
            if met == 1 { "is" } else { "are" }
        ));
    }
    section.say_in(if met > 0 { Tone::Unconfirmed } else { Tone::Plain }, text + ".");
}

/// Which cases judge what, where fibre ropes have a stiffness by case.
fn say_stiffness(view: &StudyView, section: &mut Section) {
    use windlass_study::stiffness::CaseStiffness::{Dynamic, Lower, Upper};
    let count = |stiffness| view.ended().filter(|record| record.stiffness() == Some(stiffness)).count();
    let (lower, upper, dynamic) = (count(Lower), count(Upper), count(Dynamic));
    if lower + upper + dynamic == 0 {
        return;
    }
    section.say(format!(
        "Fibre rope: offsets are judged by the cases with stiffness lower ({lower}), tensions, anchors and fatigue by those with upper \
         ({upper}), both by those with dynamic ({dynamic})."
    ));
    for (what, missing, word) in
        [("tensions", upper + dynamic == 0, "upper"), ("offsets", lower + dynamic == 0, "lower")]
    {
        if missing {
            let text = format!("No case has the stiffness {word} or dynamic: {what} are not judged.");
            section.say_in(Tone::Unconfirmed, text);
        }
    }
}

/// A line a condition: the segment that governs it.
pub fn summary(view: &StudyView, rows: &[Governing], section: &mut Section) {
    let mut worst: BTreeMap<MooringCondition, Governing> = BTreeMap::new();
    for found in rows {
        let known = worst.entry(found.row.condition).or_insert(*found);
        let order =
            |g: &Governing| g.row.severity().map_or((true, 0.0), |(kind, v)| (kind != SeverityKind::Utilisation, -v));
        let ((a, used), (b, known_used)) = (order(found), order(known));
        if a.cmp(&b).then(used.total_cmp(&known_used)).is_lt() {
            *known = *found;
        }
    }
    let mut table = ReportTable::new(&[
        "Condition",
        "Cases",
        "Governing line",
        "Case",
        "Safety factor",
        "Required",
        "Utilisation",
        "Verdict",
        "Rows that fail",
    ]);
    for (condition, found) in &worst {
        let of_condition = |record: &&CaseRecord| record.lines.iter().any(|row| row.condition == *condition);
        let all = || view.judging_tension().flat_map(|record| &record.lines).filter(|row| row.condition == *condition);
        let failing = all().filter(|row| row.verdict == Some(LineVerdict::Fail)).count();
        let verdict = view.verdict(found.row.verdict);
        table.rows.push(vec![
            ReportCell::text(condition.word()),
            ReportCell::number(Some(view.judging_tension().filter(of_condition).count() as f64), 0),
            ReportCell::text(found.row.label()),
            ReportCell::text(&found.record.case),
            ReportCell::number(found.row.safety_factor, 2).toned(verdict.tone),
            ReportCell::number(found.row.required_safety_factor, 2),
            ReportCell::number(found.row.utilisation, 3).toned(verdict.tone),
            verdict,
            ReportCell::text(format!("{failing} of {}", all().count())),
        ]);
    }
    section.show(table);
    say_stiffness(view, section);
    let sources: BTreeSet<String> = view
        .ended()
        .flat_map(|record| &record.lines)
        .filter_map(|row| Some(format!("{}: {}", row.code.as_ref()?, row.factor_source.as_ref()?)))
        .collect();
    exceedances(view, section);
    sources.into_iter().for_each(|source| section.say(source));
}

/// How the lines were run, and by how much dynamic lines would pull harder.
pub fn analysis_section(view: &StudyView, replayed: &[Replayed]) -> Section {
    let mut section = Section::new("analysis", "How the lines were run");
    #[derive(Default)]
    struct OfLine<'a> {
        cases: [BTreeSet<&'a str>; 3],
        required: BTreeSet<String>,
        ratio: Option<(f64, &'a str)>,
    }
    let mut lines: BTreeMap<(String, u64, String), (&str, OfLine)> = BTreeMap::new();
    for record in view.ended() {
        for row in &record.lines {
            let (_, line) = lines.entry(natural_order(&row.line)).or_insert((&row.line, OfLine::default()));
            let at = match row.analysis {
                Some(LineAnalysis::QuasiStatic) => 0,
                Some(LineAnalysis::Dynamic) => 1,
                Some(LineAnalysis::FrequencyDomain) => 2,
                None => continue,
            };
            line.cases[at].insert(&record.case);
            if let Some(required) = row.required_safety_factor {
                line.required.insert(format!("{} {required}", row.condition.word()));
            }
            if let Some(ratio) = row.screening_ratio
                && line.ratio.is_none_or(|(known, _)| ratio > known)
            {
                line.ratio = Some((ratio, &record.case));
            }
        }
    }
    if lines.is_empty() {
        section.say("No case keeps rows of lines: CODE_CHECK in the script does.");
        return section;
    }
    let mut table = ReportTable::new(&[
        "Line",
        "Cases quasi-static",
        "Cases dynamic",
        "Cases by frequency domain",
        "Safety factors asked for",
        "Largest screening ratio",
        "In case",
    ]);
    for (name, line) in lines.values() {
        let count = |at: usize| {
            ReportCell::number(line.cases.get(at).filter(|cases| !cases.is_empty()).map(|cases| cases.len() as f64), 0)
        };
        let required: Vec<&str> = line.required.iter().map(String::as_str).collect();
        let ratio = ReportCell::number(line.ratio.map(|(ratio, _)| ratio), 3);
        let tone =
            if line.ratio.is_some_and(|(ratio, _)| ratio > NOTABLE_RATIO) { Tone::Unconfirmed } else { Tone::Plain };
        table.rows.push(vec![
            ReportCell::text(*name),
            count(0),
            count(1),
            count(2),
            ReportCell::text(required.join(", ")),
            ratio.toned(tone),
            ReportCell::text(line.ratio.map_or("", |(_, case)| case)),
        ]);
    }
    let quasi_static = lines.values().any(|(_, line)| line.cases.first().is_some_and(|cases| !cases.is_empty()));
    let screened = lines.values().any(|(_, line)| line.ratio.is_some());
    section.show(table.without_empty_columns());
    if quasi_static {
        section.say(
            "A quasi-static line has no inertia and no drag of its own. The screening ratio is the largest tension of the same line \
             as a dynamic one, its ends moved as in the run, over that of the quasi-static line (TDOM -SCREEN). A ratio above one is \
             what the quasi-static factors of the code have to cover.",
        );
        if !screened && replayed.is_empty() {
            section.say_in(
                Tone::Unconfirmed,
                "No run was screened (TDOM -SCREEN NO) and no governing run is kept to be replayed: what quasi-static lines cost is not known.",
            );
        }
    }
    let mut table = ReportTable::new(&["Case", "Line", "Run as", "", "", "Ratio"]);
    for (at, name) in [(3, "Largest T quasi-static"), (4, "Largest T dynamic")] {
        if let Some(head) = table.heads.get_mut(at) {
            *head = view.force_head(name);
        }
    }
    for one in replayed {
        let tone = if one.ratio() > NOTABLE_RATIO { Tone::Unconfirmed } else { Tone::Plain };
        table.rows.push(vec![
            ReportCell::text(&one.case),
            ReportCell::text(&one.line),
            ReportCell::text("quasi-static"),
            view.force(Some(one.quasi_static)),
            view.force(Some(one.dynamic)),
            ReportCell::number(Some(one.ratio()), 3).toned(tone),
        ]);
    }
    if !table.rows.is_empty() {
        section.head("Governing runs, their most loaded lines replayed as dynamic lines for this report");
        section.show(table);
    }
    section
}

/// A line of a governing run that was replayed as a dynamic line.
#[derive(Clone, Debug, PartialEq)]
pub struct Replayed {
    /// The case.
    pub case: String,
    /// The line.
    pub line: String,
    /// Largest tension of the quasi-static line (N).
    pub quasi_static: f64,
    /// Largest tension of the dynamic line (N).
    pub dynamic: f64,
}

impl Replayed {
    fn ratio(&self) -> f64 {
        self.dynamic / self.quasi_static
    }
}

/// The largest pull of each anchor in each condition.
pub fn anchor_section(view: &StudyView) -> Section {
    let mut section = Section::new("anchors", "Anchors");
    let mut best: BTreeMap<(MooringCondition, (String, u64, String)), Governing> = BTreeMap::new();
    let mut lifted: BTreeMap<(MooringCondition, &str), usize> = BTreeMap::new();
    for record in view.judging_tension() {
        for row in record.lines.iter().filter(|row| row.anchor_horizontal.is_some()) {
            let order = |g: &LineRow| {
                let pull = g.anchor_horizontal.unwrap_or(0.0).hypot(g.anchor_vertical.unwrap_or(0.0));
                let used = g.anchor_required_factor.zip(g.anchor_safety_factor).map_or(0.0, |(asked, had)| asked / had);
                (g.anchor_verdict == Some(LineVerdict::Fail), used, pull)
            };
            let found = Governing { record, row };
            let known = best.entry((row.condition, natural_order(&row.line))).or_insert(found);
            let ((a, used, pull), (b, known_used, known_pull)) = (order(row), order(known.row));
            if a.cmp(&b).then(used.total_cmp(&known_used)).then(pull.total_cmp(&known_pull)).is_gt() {
                *known = found;
            }
            if row.uplift == Some(true) {
                *lifted.entry((row.condition, &row.line)).or_default() += 1;
            }
        }
    }
    if best.is_empty() {
        section.say("No case keeps what an anchor bears.");
        return section;
    }
    let heads = [
        "Condition".to_owned(),
        "Line".to_owned(),
        "Case".to_owned(),
        view.force_head("Horizontal"),
        view.force_head("Vertical"),
        "Cases with uplift".to_owned(),
        view.force_head("Capacity"),
        "Safety factor".to_owned(),
        "Required".to_owned(),
        "Verdict".to_owned(),
    ];
    let mut table = ReportTable { heads: heads.into(), rows: Vec::new() };
    for ((condition, _), found) in &best {
        let row = found.row;
        let uplifts = lifted.get(&(*condition, row.line.as_str())).copied().unwrap_or(0);
        let verdict = view.verdict(row.anchor_verdict);
        table.rows.push(vec![
            ReportCell::text(condition.word()),
            ReportCell::text(&row.line),
            ReportCell::text(&found.record.case),
            view.force(row.anchor_horizontal),
            view.force(row.anchor_vertical),
            ReportCell::number(Some(uplifts as f64), 0).toned(if uplifts > 0 {
                Tone::Unconfirmed
            } else {
                Tone::Plain
            }),
            view.force(row.anchor_capacity),
            ReportCell::number(row.anchor_safety_factor, 2).toned(verdict.tone),
            ReportCell::number(row.anchor_required_factor, 2),
            verdict,
        ]);
    }
    section.show(table.without_empty_columns());
    section.say("The largest pull at each anchor, the friction of the line on the bottom in it; of anchors that are checked the one nearest to its factor.");
    if best.values().all(|found| found.row.anchor_capacity.is_none()) {
        section.say("No capacity was given: CODE_CHECK -ANCHOR KIND DIRECTION CAPACITY checks an anchor.");
    }
    section
}
