//! The tables of a check, and the rows of lines that a study keeps.

use super::loads::{CheckedLine, CheckedMooring, SegmentLoad};
use super::{ANCHOR, CLEARANCE, CheckQuery, GROUNDED, LIFE, OFFSET, PRETENSION, refused};
use crate::commands::Job;
use crate::commands::name_filter::NameFilter;
use windlass_base::choice::Choice;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::table::{Cell, Digits, Table};
use windlass_base::units::Dim;
use windlass_design_checks::anchor::{AnchorCheck, AnchorLoad, check_anchor};
use windlass_design_checks::codes::{
    Analysis, AnchorKind, Code, Condition, FatigueRule, Provenance, PullDirection, SeedsStatistic, TensionRule,
};
use windlass_design_checks::fatigue::{WeightedDamage, annual_damage, check_fatigue};
use windlass_design_checks::limits::{Side, check_limit};
use windlass_design_checks::strength::corroded;
use windlass_design_checks::tension::{LineTension, LoadFactors, TensionCheck, check_tension};
use windlass_design_checks::{CheckError, Verdict};
use windlass_solve::results::{AnchorRecord, ScatterExposure};
use windlass_study::kept::{LineAnalysis, LineRow, LineVerdict, LossTime, MooringCondition, SeedCheck, SeedStatistic};

/// What stands before the title of a table whose factors are not confirmed.
const UNCONFIRMED_TITLE: &str = "UNCONFIRMED: ";

/// The factors of codes.
pub(super) fn code_list(codes: &[&Code]) -> Table {
    let rows: Vec<_> =
        codes.iter().flat_map(|code| code.lines().into_iter().map(|line| (code.name.clone(), line))).collect();
    let mut table = Table::new("Design Codes")
        .with_rows(&rows)
        .text("Code", |(code, _)| code)
        .text("Check", |(_, line)| line.check)
        .text("For", |(_, line)| &line.applies)
        .text("Holds When", |(_, line)| &line.value)
        .text("How Sure", |(_, line)| if line.provenance.is_own { "own file" } else { line.provenance.sure.word() })
        .text("Clause", |(_, line)| &line.provenance.clause)
        .text("Source", |(_, line)| &line.provenance.source)
        .build();
    for code in codes {
        table.note(format!("{}: {}, {}. {}", code.name, code.title, code.edition, code.note).trim_end().to_string());
    }
    table
}

/// A segment of a line with what it came to.
struct SegmentRow<'m> {
    line: &'m CheckedLine,
    segment: usize,
    load: &'m SegmentLoad,
    pretension: Option<f64>,
    strength: f64,
    checked: TensionCheck,
}

struct AnchorRow<'m> {
    line: &'m str,
    load: AnchorRecord,
    kind: AnchorKind,
    direction: PullDirection,
    capacity: f64,
    checked: AnchorCheck,
}

struct LimitRow {
    what: String,
    value: Option<f64>,
    limit: f64,
    side: Side,
    verdict: Option<Verdict>,
}

fn wrong(query: &CheckQuery, who: &str, error: &CheckError) -> Box<Diagnostic> {
    Diagnostic::error(format!("{who}: {error}"), query.args.span)
}

/// The tables of a check, and the rows to keep.
///
/// # Errors
/// A code that has no usable factor for it; a value that cannot be checked.
pub(super) fn check(job: &Job, query: &CheckQuery, mooring: &CheckedMooring) -> Outcome<(Vec<Table>, Vec<LineRow>)> {
    let (code, options) = (query.code, &query.options);
    let of_code = |error| refused(&error, query.args);
    let rule = code.tension_rule(mooring.analysis, mooring.condition, options).map_err(of_code)?;
    let characteristic = if rule.form.is_partial() { code.strength_rule(options).map_err(of_code)? } else { None };
    let (allowance, law, corroded_segments) = query.corrosion();
    let mut rows = Vec::new();
    for line in &mooring.lines {
        for (index, (segment, load)) in line.segments.iter().enumerate() {
            let who = format!("{}, segment {}", line.name, index + 1);
            let number = i64::try_from(index + 1).unwrap_or(i64::MAX);
            let own = if corroded_segments.is_empty() || corroded_segments.contains(&number) { allowance } else { 0.0 };
            let breaking =
                if own > 0.0 { corroded(segment.breaking, segment.od, own, law) } else { Ok(segment.breaking) };
            let breaking = breaking.map_err(|error| wrong(query, &who, &error))?;
            let strength = characteristic.as_ref().map_or(breaking, |rule| rule.share * breaking);
            let pretension = pretension(job, query, &line.name);
            let tension = LineTension { mean: load.mean, characteristic: load.characteristic, pretension };
            let checked = check_tension(&tension, strength, &rule).map_err(|error| wrong(query, &who, &error))?;
            rows.push(SegmentRow { line, segment: index + 1, load, pretension, strength, checked });
        }
    }
    let mut provenances = vec![rule.provenance.clone()];
    provenances.extend(characteristic.as_ref().map(|rule| rule.provenance.clone()));
    let mut lines = line_table(query, mooring, &rows);
    lines.note(format!("by {}: {}", code.name, rule.form));
    if let Some(rule) = &characteristic {
        lines.note(format!("S_C is {} of the breaking load", rule.share));
    }
    if allowance > 0.0 {
        lines.note("Strength is what corrosion leaves of it".to_string());
    }
    let bare = rows.iter().any(|row| row.line.segments.get(row.segment - 1).is_some_and(|(s, _)| !s.break_is_given));
    if bare {
        lines.warn("a breaking load follows from a bare diameter: give it (-BTEN, a line type) before a design is judged by it");
    }
    if let Some(share) = mooring.unbalanced {
        lines.warn(format!(
            "the bodies do not rest where they stand without {}: {:.0} per cent of what is lost there is unbalanced; &EQUI behind \
             &CONNECTOR -INACTIVE brings them to rest",
            mooring.lost.join(", "),
            100.0 * share
        ));
    }
    for (reason, segments) in &mooring.without_mpm {
        lines.warn(format!(
            "{}: the largest tension of the run is checked in place of the most probable maximum of the storm, which may be \
             larger: {reason}; run longer, or choose -CHARACTERISTIC LARGEST",
            segments.join(", ")
        ));
    }
    let mut tables = vec![lines];
    let anchors = anchor_rows(query, mooring, &mut provenances)?;
    tables.extend(anchors.as_ref().map(|(rows, unknown)| anchor_table(rows, unknown)));
    let life = life_rule(job, query)?;
    if let Some(life) = &life {
        tables.push(fatigue(job, query, life)?);
        provenances.push(life.rule.provenance.clone());
    }
    tables.extend(limits(job, query, mooring)?);
    let confirmed = provenances.iter().all(Provenance::is_confirmed);
    if let Some(first) = tables.first_mut() {
        for text in provenance_notes(&provenances) {
            first.note(text);
        }
    }
    if !confirmed {
        for table in &mut tables {
            table.title.insert_str(0, UNCONFIRMED_TITLE);
            // what holds by a confirmed factor is no pass either beside one that is not
            table.map_cells(|_, _, cell| match cell {
                Cell::Text(word) if word == Verdict::Pass.word() => Cell::Text(Verdict::Unconfirmed.word().to_string()),
                other => other.clone(),
            });
        }
        if let Some(first) = tables.first_mut() {
            first.warn("factors from memory: no check of this page is a pass");
        }
    }
    let anchors: Vec<AnchorRow> = anchors.map(|(rows, _)| rows).unwrap_or_default();
    let source =
        format!("{}; {}", query.code.edition, provenance_notes(std::slice::from_ref(&rule.provenance)).join("; "));
    let kept = KeptRows {
        job,
        query,
        mooring,
        anchors: &anchors,
        life: life.as_ref(),
        confirmed,
        rule: &rule,
        source: &source,
    };
    let kept = rows.iter().map(|row| kept.row(row)).collect();
    Ok((tables, kept))
}

/// Where factors come from, each once.
fn provenance_notes(list: &[Provenance]) -> Vec<String> {
    let mut notes: Vec<String> = Vec::new();
    for provenance in list {
        let sure = if provenance.is_own { "from your own file" } else { provenance.sure.word() };
        let parts = [sure, provenance.clause.as_str(), provenance.source.as_str()];
        let parts: Vec<&str> = parts.into_iter().filter(|part| !part.is_empty()).collect();
        let text = format!("factors: {}", parts.join("; "));
        if !notes.contains(&text) {
            notes.push(text);
        }
    }
    notes
}

/// The pretension that a line is given (N).
fn pretension(job: &Job, query: &CheckQuery, line: &str) -> Option<f64> {
    let mut of_line = query
        .each(&PRETENSION)
        .filter(|given| NameFilter::new(given.values.iter().take(1), &job.model).matches(line))
        .filter_map(|given| given.number(const { PRETENSION.number("F") }));
    of_line.next()
}

fn line_table(query: &CheckQuery, mooring: &CheckedMooring, rows: &[SegmentRow]) -> Table {
    let lost = if mooring.lost.is_empty() { "none".to_string() } else { mooring.lost.join(" ") };
    let mut table = Table::new("Code Check of Lines")
        .fact("Code", query.code.name.as_str(), Dim::None)
        .fact("Edition", query.code.edition.as_str(), Dim::None)
        .fact("Analysis", mooring.analysis.word(), Dim::None)
        .fact("Condition", mooring.condition.word(), Dim::None)
        .fact("Lines Lost", lost, Dim::None);
    if let Some(class) = &query.options.class {
        table = table.fact("Class", class.as_str(), Dim::None);
    }
    if mooring.is_run {
        table = table.fact("Duration of MPM", mooring.duration, Dim::Time);
    }
    let force = |table: Table, group: &str, name: &str, cell: &dyn Fn(&SegmentRow) -> Option<f64>| {
        table.with_rows(rows).column(group, name, Dim::Force, Digits::Usual, cell).build()
    };
    let mut table = table
        .with_rows(rows)
        .text("Line", |row| &row.line.name)
        .column("", "Segment", Dim::None, Digits::Usual, |row| row.segment)
        .build();
    table = force(table, "Tension", "T Mean", &|row| Some(row.load.mean));
    table = force(table, "Tension", "T Dyn", &|row| Some(row.load.characteristic - row.load.mean));
    table = force(table, "Tension", "T Char", &|row| Some(row.load.characteristic));
    if mooring.is_run {
        table = table
            .with_rows(rows)
            .text("Is", |row| row.load.method)
            .column("", "n", Dim::None, Digits::Usual, |row| row.load.maxima)
            .column("95% of MPM", "Low", Dim::Force, Digits::Usual, |row| row.load.mpm.map(|(_, (low, _))| low))
            .column("95% of MPM", "High", Dim::Force, Digits::Usual, |row| row.load.mpm.map(|(_, (_, high))| high))
            .build();
    }
    let has_required = rows.iter().any(|row| row.checked.required.is_some());
    table = force(table, "", "Strength", &|row| Some(row.strength));
    table = table
        .with_rows(rows)
        .column("Safety Factor", "S/T", Dim::None, Digits::Decimals(3), |row| {
            Some(row.checked.safety_factor).filter(|factor| factor.is_finite())
        })
        .build();
    if has_required {
        table = table
            .with_rows(rows)
            .column("Safety Factor", "Required", Dim::None, Digits::Decimals(3), |row| row.checked.required)
            .build();
    }
    table
        .with_rows(rows)
        .column("", "Utilisation", Dim::None, Digits::Decimals(3), |row| row.checked.utilisation)
        .text("Verdict", |row| row.checked.verdict.word())
        .build()
}

/// Checks of anchors, and the lines whose anchors' loads are not known.
type AnchorRows<'m> = (Vec<AnchorRow<'m>>, Vec<&'m str>);

/// The checks of anchors that are asked for; none where none is.
fn anchor_rows<'m>(
    query: &CheckQuery,
    mooring: &'m CheckedMooring,
    provenances: &mut Vec<Provenance>,
) -> Outcome<Option<AnchorRows<'m>>> {
    let mut rows = Vec::new();
    let mut unknown: Vec<&str> = Vec::new();
    for given in query.each(&ANCHOR) {
        let kind = given.choice::<AnchorKind>(const { ANCHOR.choice("KIND") });
        let direction = given.choice::<PullDirection>(const { ANCHOR.choice("DIRECTION") });
        let capacity = given.number(const { ANCHOR.number("CAPACITY") });
        let (Some(kind), Some(direction), Some(capacity)) = (kind, direction, capacity) else { continue };
        // a code has no factor of its own for a transient: the anchor is judged as with lines lost
        let condition = if mooring.condition == Condition::Intact { Condition::Intact } else { Condition::Damaged };
        let rule = query
            .code
            .anchor_rule((kind, direction), (mooring.analysis, condition), &query.options)
            .map_err(|error| Diagnostic::error(error.to_string(), given.span))?;
        for line in &mooring.lines {
            let Some(load) = line.anchor else {
                if !unknown.contains(&line.name.as_str()) {
                    unknown.push(&line.name);
                }
                continue;
            };
            let resultant = match direction {
                PullDirection::Line => AnchorLoad { horizontal: load.resultant, vertical: 0.0 },
                _ => AnchorLoad { horizontal: load.horizontal, vertical: load.vertical },
            };
            let mut checked =
                check_anchor(&resultant, capacity, &rule).map_err(|error| wrong(query, &line.name, &error))?;
            if direction == PullDirection::Line {
                let pulled = AnchorLoad { horizontal: load.horizontal, vertical: load.vertical };
                checked.uplift = pulled.is_uplifted();
                if checked.uplift && !kind.bears_uplift() {
                    checked.verdict = Verdict::Fail;
                }
            }
            rows.push(AnchorRow { line: &line.name, load, kind, direction, capacity, checked });
        }
        provenances.push(rule.provenance);
    }
    Ok(Some((rows, unknown)).filter(|(rows, unknown)| !(rows.is_empty() && unknown.is_empty())))
}

fn anchor_table(rows: &[AnchorRow], unknown: &[&str]) -> Table {
    let mut table = Table::new("Code Check of Anchors")
        .with_rows(rows)
        .text("Line", |row| row.line)
        .text("Anchor", |row| row.kind.word().to_lowercase())
        .text("Direction", |row| row.direction.word().to_lowercase())
        .column("Largest Pull", "Horizontal", Dim::Force, Digits::Usual, |row| row.load.horizontal)
        .column("Largest Pull", "Vertical", Dim::Force, Digits::Usual, |row| row.load.vertical)
        .column("Largest Pull", "Resultant", Dim::Force, Digits::Usual, |row| row.load.resultant)
        .text("Uplift", |row| if row.checked.uplift { "yes" } else { "no" })
        .column("", "Capacity", Dim::Force, Digits::Usual, |row| row.capacity)
        .column("Safety Factor", "R/F", Dim::None, Digits::Decimals(3), |row| {
            Some(row.checked.safety_factor).filter(|factor| factor.is_finite())
        })
        .column("Safety Factor", "Required", Dim::None, Digits::Decimals(3), |row| row.checked.required)
        .column("", "Utilisation", Dim::None, Digits::Decimals(3), |row| row.checked.utilisation)
        .text("Verdict", |row| row.checked.verdict.word())
        .build();
    table.note("the pull is the largest seen at the anchor; the friction of the line on the bottom is in it");
    if !unknown.is_empty() {
        table.note_absent(format!("{}: what the anchor bears is not known", unknown.join(", ")));
    }
    table
}

/// What `-LIFE` asks for.
struct LifeRule {
    /// Design life (years).
    years: f64,
    /// Damage of the less over that of the more damaged of neighbouring lines, where it is given.
    ratio: Option<f64>,
    rule: FatigueRule,
    /// Where the option stands.
    span: Span,
}

fn life_rule(job: &Job, query: &CheckQuery) -> Outcome<Option<LifeRule>> {
    let Some(given) = query.args.option(&LIFE) else { return Ok(None) };
    if job.scatter.is_empty() {
        return Err(Diagnostic::error("no fatigue damage has been found yet", given.span)
            .help("FATIGUE of each environment, the later ones with -ADD, comes before"));
    }
    let rule =
        query.code.fatigue_rule(&query.options).map_err(|error| Diagnostic::error(error.to_string(), given.span))?;
    let years = given.number(const { LIFE.number("YEARS") }).unwrap_or(f64::NAN);
    Ok(Some(LifeRule { years, ratio: given.number(const { LIFE.number("RATIO") }), rule, span: given.span }))
}

fn fatigue(job: &Job, query: &CheckQuery, LifeRule { years, ratio, rule, span }: &LifeRule) -> Outcome<Table> {
    let total: f64 = job.scatter.iter().map(|run| run.duration).sum();
    let mut rows = Vec::new();
    for (name, own) in job.scatter.last().map_or(&[][..], |run| &run.lines) {
        for (index, segment) in own.segments.iter().enumerate() {
            let states: Vec<WeightedDamage> = job
                .scatter
                .iter()
                .filter_map(|run| {
                    let (_, line) = run.lines.iter().find(|(known, _)| known == name)?;
                    let damage = line.segments.get(index)?.damage;
                    Some(WeightedDamage { probability: run.duration / total, damage, record: run.record })
                })
                .collect();
            let who = format!("{name}, segment {}", segment.segment);
            if states.len() != job.scatter.len() {
                return Err(Diagnostic::error(
                    format!("{who}: an environment of the scatter reports nothing of it"),
                    *span,
                ));
            }
            let (annual, _) = annual_damage(&states).map_err(|error| wrong(query, &who, &error))?;
            let mut checked =
                check_fatigue(annual, *years, *ratio, rule).map_err(|error| wrong(query, &who, &error))?;
            if segment.unconfirmed && checked.verdict == Verdict::Pass {
                checked.verdict = Verdict::Unconfirmed;
            }
            rows.push((name.as_str(), segment, annual, checked));
        }
    }
    let curves: Vec<&str> = rows.iter().filter(|(_, s, ..)| s.unconfirmed).map(|(_, s, ..)| s.curve.as_str()).collect();
    let mut table = Table::new("Code Check of Fatigue Life")
        .fact("Environments", job.scatter.len(), Dim::None)
        .fact("Design Life, Years", *years, Dim::None)
        .with_rows(&rows)
        .text("Line", |row| row.0)
        .column("", "Segment", Dim::None, Digits::Usual, |row| row.1.segment)
        .text("Curve", |row| &row.1.curve)
        .column("", "Damage a Year", Dim::None, Digits::Scientific(4), |row| row.2)
        .column("", "Life, Years", Dim::None, Digits::Scientific(4), |row| row.3.life)
        .column("", "Factor", Dim::None, Digits::Decimals(2), |row| row.3.factor)
        .column("", "Utilisation", Dim::None, Digits::Decimals(3), |row| row.3.utilisation)
        .text("Verdict", |row| row.3.verdict.word())
        .build();
    table.note("Damage a Year is that of each environment weighted by its share of all durations");
    let mut said: Vec<&str> = Vec::new();
    for curve in curves {
        if !said.contains(&curve) {
            said.push(curve);
            table.warn(format!("the numbers of curve {curve} are not confirmed: life by it is no pass"));
        }
    }
    Ok(table)
}

fn limits(job: &Job, query: &CheckQuery, mooring: &CheckedMooring) -> Outcome<Option<Table>> {
    let mut rows = Vec::new();
    let mut add = |what: String, value: Option<f64>, limit: f64, side: Side| -> Outcome<()> {
        let verdict = value.map(|value| check_limit(value, limit, side)).transpose();
        let verdict = verdict.map_err(|error| wrong(query, &what, &error))?;
        rows.push(LimitRow { what, value, limit, side, verdict });
        Ok(())
    };
    for given in query.each(&OFFSET) {
        let name = given.word(const { OFFSET.word("BODY") }).unwrap_or_default();
        let [limit, x, y] = const { OFFSET.numbers(["LIMIT", "X", "Y"]) }.map(|key| given.number(key));
        let span = given.position(const { OFFSET.word("BODY") });
        let (value, from) = super::loads::largest_offset(job, mooring, (name, span), [x, y])?;
        let text = format!("offset of {name} from ({:.3}, {:.3}) m", from[0], from[1]);
        add(text, Some(value), limit.unwrap_or(f64::NAN), Side::AtMost)?;
    }
    if let Some(least) = query.args.option_number(&GROUNDED) {
        for line in &mooring.lines {
            add(format!("length of {} on the bottom", line.name), line.grounded, least, Side::AtLeast)?;
        }
    }
    for given in query.each(&CLEARANCE) {
        let line = given.word(const { CLEARANCE.word("LINE") }).unwrap_or_default();
        let other = given.word(const { CLEARANCE.word("OTHER") }).unwrap_or_default();
        let least = given.number(const { CLEARANCE.number("LEAST") }).unwrap_or(f64::NAN);
        let segment = given.integer(const { CLEARANCE.integer("SEGMENT") }).and_then(|n| usize::try_from(n).ok());
        let span = given.position(const { CLEARANCE.word("OTHER") });
        let value = super::loads::least_clearance(job, mooring, (line, other, segment), span)?;
        let of = segment.map_or_else(|| line.to_string(), |n| format!("segment {n} of {line}"));
        add(format!("distance of {of} from {other}"), Some(value), least, Side::AtLeast)?;
    }
    if rows.is_empty() {
        return Ok(None);
    }
    let missing = rows.iter().filter(|row| row.value.is_none()).count();
    let mut table = Table::new("Check of Limits")
        .with_rows(&rows)
        .text("What", |row| &row.what)
        .column("", "Value", Dim::Length, Digits::Decimals(3), |row| row.value)
        .text("Must Be", |row| if row.side == Side::AtMost { "at most" } else { "at least" })
        .column("", "Limit", Dim::Length, Digits::Decimals(3), |row| row.limit)
        .text("Verdict", |row| row.verdict.map_or("not known", Verdict::word))
        .build();
    table.note("the limits are the user's");
    if missing > 0 {
        table.absent += missing;
    }
    Ok(Some(table))
}

/// What the rows are made of that a study keeps.
struct KeptRows<'a> {
    job: &'a Job,
    query: &'a CheckQuery<'a>,
    mooring: &'a CheckedMooring,
    anchors: &'a [AnchorRow<'a>],
    life: Option<&'a LifeRule>,
    /// Whether all factors of the check are.
    confirmed: bool,
    /// The rule of the tension.
    rule: &'a TensionRule,
    /// Edition, clause and source of the factor of tension.
    source: &'a str,
}

impl KeptRows<'_> {
    fn verdict(&self, verdict: Verdict) -> LineVerdict {
        match verdict {
            Verdict::Pass if self.confirmed => LineVerdict::Pass,
            Verdict::Pass | Verdict::Unconfirmed => LineVerdict::Unconfirmed,
            Verdict::Fail => LineVerdict::Fail,
        }
    }

    /// Damage in a year of a segment over the environments of the case, where FATIGUE has found it.
    fn annual_damage(&self, row: &SegmentRow) -> Option<f64> {
        let scatter = &self.job.scatter;
        let total: f64 = scatter.iter().map(|run| run.duration).sum();
        let state = |run: &ScatterExposure| {
            let (_, line) = run.lines.iter().find(|(name, _)| *name == row.line.name)?;
            let damage = line.segments.iter().find(|s| s.segment == row.segment)?.damage;
            Some(WeightedDamage { probability: run.duration / total, damage, record: run.record })
        };
        let states: Option<Vec<WeightedDamage>> = scatter.iter().map(state).collect();
        annual_damage(&states?).ok().map(|(damage, _)| damage)
    }

    /// Whether the fatigue curve of a segment is confirmed in every environment.
    fn curve_is_confirmed(&self, row: &SegmentRow) -> bool {
        let lines = self.job.scatter.iter().flat_map(|run| &run.lines).filter(|(name, _)| *name == row.line.name);
        !lines.flat_map(|(_, line)| &line.segments).any(|s| s.segment == row.segment && s.unconfirmed)
    }

    /// How a segment of a run is judged over seeds.
    fn seeds(&self, row: &SegmentRow) -> Option<Box<SeedCheck>> {
        let mooring = self.mooring;
        let storm_ratio = mooring.storm_ratio?;
        let factors = LoadFactors::new(&self.rule.form, row.pretension).ok()?;
        let (statistic, from) = match self.query.code.seeds_rule(mooring.analysis, &self.query.options) {
            Ok(rule) => {
                let statistic = match rule.statistic {
                    SeedsStatistic::MostProbable => SeedStatistic::MostProbable,
                    SeedsStatistic::Mean => SeedStatistic::Mean,
                    SeedsStatistic::MeanPlus(steps) => SeedStatistic::MeanPlus(steps),
                };
                (statistic, rule.provenance)
            }
            Err(error) => (SeedStatistic::Refused(error.to_string()), Vec::new()),
        };
        Some(Box::new(SeedCheck {
            mean: factors.mean,
            characteristic: factors.characteristic,
            added: factors.added,
            storm_ratio,
            statistic,
            is_confirmed: self.confirmed && from.iter().all(Provenance::is_confirmed),
        }))
    }

    /// What a study keeps of a segment.
    fn row(&self, row: &SegmentRow) -> LineRow {
        let mooring = self.mooring;
        let finite = |value: f64| Some(value).filter(|value| value.is_finite());
        let is_last = row.segment == row.line.segments.len();
        let anchor = row.line.anchor.filter(|_| is_last);
        let checks = self.anchors.iter().filter(|anchor| is_last && anchor.line == row.line.name);
        let check = checks.max_by(|a, b| {
            let order = |row: &AnchorRow| (row.checked.verdict, row.checked.utilisation);
            let ((a, used), (b, of_b)) = (order(a), order(b));
            a.cmp(&b).then(used.total_cmp(&of_b))
        });
        let mpm = row.load.mpm;
        let annual_damage = self.annual_damage(row);
        let life = self.life.filter(|_| annual_damage.is_some());
        LineRow {
            line: row.line.name.clone(),
            segment: Some(row.segment),
            analysis: Some(match mooring.analysis {
                Analysis::QuasiStatic => LineAnalysis::QuasiStatic,
                Analysis::Dynamic => LineAnalysis::Dynamic,
            }),
            condition: match mooring.condition {
                Condition::Intact => MooringCondition::Intact,
                Condition::Damaged => MooringCondition::Damaged,
                Condition::Transient => MooringCondition::Transient,
            },
            lost: mooring.lost.clone(),
            loss: self
                .job
                .line_loss
                .as_ref()
                .filter(|_| mooring.condition == Condition::Transient)
                .map(|loss| LossTime { number: loss.number, time: loss.time, reason: loss.reason.clone() })
                .map(Box::new),
            mean_tension: finite(row.load.mean),
            dynamic_tension: finite(row.load.characteristic - row.load.mean),
            max_tension: finite(row.load.characteristic),
            largest_tension: finite(row.load.largest),
            least_tension: finite(row.load.least),
            maxima: row.load.maxima,
            mpm: mpm.map(|(value, _)| value),
            mpm_low: mpm.map(|(_, (low, _))| low),
            mpm_high: mpm.map(|(_, (_, high))| high),
            breaking_load: finite(row.strength),
            utilisation: finite(row.checked.utilisation),
            safety_factor: finite(row.checked.safety_factor),
            required_safety_factor: row.checked.required,
            verdict: Some(self.verdict(row.checked.verdict)),
            code: Some(self.query.code.name.clone()),
            factor_source: Some(self.source.to_owned()),
            screening_ratio: self.job.screened.iter().find(|(line, _)| *line == row.line.name).map(|(_, ratio)| *ratio),
            anchor_horizontal: anchor.map(|load| load.horizontal),
            anchor_vertical: anchor.map(|load| load.vertical),
            uplift: anchor
                .map(|load| AnchorLoad { horizontal: load.horizontal, vertical: load.vertical }.is_uplifted()),
            anchor_capacity: check.map(|check| check.capacity),
            anchor_safety_factor: check.and_then(|check| finite(check.checked.safety_factor)),
            anchor_required_factor: check.map(|check| check.checked.required),
            anchor_verdict: check.map(|check| self.verdict(check.checked.verdict)),
            annual_damage,
            design_life: life.map(|life| life.years),
            fatigue_factor: life.and_then(|life| life.rule.factor_at(life.ratio).ok()),
            fatigue_confirmed: life.map(|life| life.rule.is_confirmed() && self.curve_is_confirmed(row)),
            grounded_length: row.line.grounded,
            offset: row.line.offset,
            seeds: self.seeds(row),
        }
    }
}
