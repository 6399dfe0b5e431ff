//! What the records of cases come to: inputs, results, directions, failures, messages, files.

use super::StudyView;
use super::lines::Governing;
use super::page::{ReportCell, ReportTable, Section, Tone, in_units};
use crate::report::plot::{Chart, PlotSize};
use std::collections::{BTreeMap, BTreeSet};
use windlass_base::table::{Cell, Column, Digits, Table};
use windlass_base::units::Dim;
use windlass_study::kept::{LineVerdict, MooringCondition};
use windlass_study::record::{CaseRecord, CaseStatus};

/// Rows of a table of cases, of messages, of extremes; what is left out is said.
const MOST_ROWS: usize = 5000;
/// Different messages that are listed.
const MOST_MESSAGES: usize = 500;
/// Values of a column that are listed.
const MOST_VALUES: usize = 16;
/// Figures of results and inputs.
const FIGURES: usize = 5;
/// Columns that hold a direction, by their usual names.
const DIRECTIONS: [&str; 7] = ["heading", "direction", "dir", "wave_direction", "wave_dir", "head", "bearing"];
/// What a result of an offset has in its name.
const OFFSETS: [&str; 3] = ["OFFSET", "EXCURSION", "DISPLACEMENT"];

/// The columns of the table of cases, in its order; seed_of serves seeds alone.
fn input_names<'a>(view: &StudyView<'a>) -> Vec<&'a str> {
    let mut names: Vec<&str> = Vec::new();
    for record in view.records {
        for (name, _) in &record.values {
            if !names.contains(&name.as_str()) && !name.eq_ignore_ascii_case(windlass_study::table::SEED_OF) {
                names.push(name);
            }
        }
    }
    names
}

/// The named results, with their units, in the order they come in.
fn result_names<'a>(view: &StudyView<'a>) -> Vec<(&'a str, &'a str)> {
    let mut names: Vec<(&str, &str)> = Vec::new();
    for record in view.records {
        for result in &record.results {
            if !names.iter().any(|(name, _)| name.eq_ignore_ascii_case(&result.name)) {
                names.push((&result.name, &result.unit));
            }
        }
    }
    names
}

fn input<'a>(record: &'a CaseRecord, name: &str) -> Option<&'a str> {
    record.values.iter().find(|(known, _)| known == name).map(|(_, value)| value.as_str())
}

fn result(record: &CaseRecord, (name, unit): (&str, &str)) -> Option<f64> {
    let found = record.results.iter().find(|result| result.name.eq_ignore_ascii_case(name))?;
    // of another unit it is no number of the column
    Some(found.value).filter(|_| found.unit == unit)
}

/// Whether a result is an offset by its name.
fn is_offset(name: &str) -> bool {
    let name = name.to_ascii_uppercase();
    OFFSETS.iter().any(|word| name.contains(word))
}

fn input_cell(value: Option<&str>) -> ReportCell {
    let text = value.unwrap_or_default();
    ReportCell { text: text.to_owned(), number: text.parse().ok().filter(|n: &f64| n.is_finite()), tone: Tone::Plain }
}

fn with_unit((name, unit): (&str, &str)) -> String {
    if unit.is_empty() { name.to_owned() } else { format!("{name} ({unit})") }
}

/// The column of directions: that asked for, else the first with a usual name.
///
/// # Errors
/// A column that is not in the table, or holds no numbers.
pub fn direction_column(view: &StudyView, asked: Option<&str>) -> Result<Option<String>, String> {
    let names = input_names(view);
    let is_numeric = |name: &str| {
        view.records.iter().all(|r| input(r, name).is_none_or(|v| v.parse::<f64>().is_ok_and(f64::is_finite)))
    };
    match asked {
        Some(asked) => {
            let Some(name) = names.iter().find(|name| name.eq_ignore_ascii_case(asked)) else {
                let near = windlass_base::diagnostic::did_you_mean(asked, names.iter().copied());
                let near = near.map(|near| format!("; {near}")).unwrap_or_default();
                return Err(format!(
                    "--direction {asked}: the cases have no column of that name, they have {}{near}",
                    names.join(" ")
                ));
            };
            if !is_numeric(name) {
                return Err(format!("--direction {asked}: the column holds values that are no numbers"));
            }
            Ok(Some((*name).to_owned()))
        }
        None => {
            let usual = DIRECTIONS.iter().find_map(|usual| names.iter().find(|name| name.eq_ignore_ascii_case(usual)));
            Ok(usual.filter(|name| is_numeric(name)).map(|name| (*name).to_owned()))
        }
    }
}

/// The columns of the table and the values they take.
pub fn environment_table(view: &StudyView) -> ReportTable {
    let mut table = ReportTable::new(&["Column", "Values", "How many"]);
    for name in input_names(view) {
        let mut values: Vec<&str> = Vec::new();
        let mut known: BTreeSet<&str> = BTreeSet::new();
        for value in view.records.iter().filter_map(|record| input(record, name)) {
            if known.insert(value) {
                values.push(value);
            }
        }
        let numbers: Option<Vec<f64>> = values.iter().map(|v| v.parse::<f64>().ok()).collect();
        if let Some(numbers) = &numbers {
            let mut pairs: Vec<(&str, f64)> = values.iter().copied().zip(numbers.iter().copied()).collect();
            pairs.sort_by(|a, b| a.1.total_cmp(&b.1));
            values = pairs.into_iter().map(|(text, _)| text).collect();
        }
        let shown = match (values.as_slice(), &numbers) {
            (list, _) if list.len() <= MOST_VALUES => list.join(", "),
            ([first, .., last], Some(_)) => format!("from {first} to {last}"),
            (list, _) => format!("{}, ..", list.get(..MOST_VALUES).unwrap_or_default().join(", ")),
        };
        table.rows.push(vec![
            ReportCell::text(name),
            ReportCell::text(shown),
            ReportCell::number(Some(values.len() as f64), 0),
        ]);
    }
    table
}

/// The condition of a case: the gravest of its rows.
fn condition(record: &CaseRecord) -> Option<MooringCondition> {
    record.lines.iter().map(|row| row.condition).max()
}

fn condition_word(condition: Option<MooringCondition>) -> &'static str {
    condition.map_or("all", MooringCondition::word)
}

/// The largest and the least of each result in each condition, with their cases.
pub fn result_section(view: &StudyView) -> Section {
    let mut section = Section::new("results", "Results");
    let mut table =
        ReportTable::new(&["Result", "Condition", "Cases", "Least", "In case", "Mean", "Largest", "In case"]);
    for name in result_names(view) {
        let mut found: BTreeMap<Option<MooringCondition>, Vec<(f64, &str)>> = BTreeMap::new();
        for record in view.ended().filter(|record| !is_offset(name.0) || record.judges_offset()) {
            if let Some(value) = result(record, name) {
                found.entry(condition(record)).or_default().push((value, &record.case));
            }
        }
        for (condition, values) in found {
            let least = values.iter().copied().reduce(|a, b| if b.0 < a.0 { b } else { a });
            let largest = values.iter().copied().reduce(|a, b| if b.0 > a.0 { b } else { a });
            let mean = values.iter().map(|(value, _)| value).sum::<f64>() / values.len() as f64;
            let case = |found: Option<(f64, &str)>| ReportCell::text(found.map_or("", |(_, case)| case));
            table.rows.push(vec![
                ReportCell::text(with_unit(name)),
                ReportCell::text(condition_word(condition)),
                ReportCell::number(Some(values.len() as f64), 0),
                ReportCell::figures(least.map(|(value, _)| value), FIGURES),
                case(least),
                ReportCell::figures(Some(mean), FIGURES),
                ReportCell::figures(largest.map(|(value, _)| value), FIGURES),
                case(largest),
            ]);
        }
    }
    if table.rows.is_empty() {
        section.say("No case keeps a named result: &RESULT, and -RESULT of STATISTIC and EXTREMES do.");
    }
    section.show(table);
    section
}

/// What a direction comes to in a condition.
#[derive(Default)]
struct OfDirection<'a> {
    cases: usize,
    tension: Option<(f64, String)>,
    factor: Option<(f64, String, Option<LineVerdict>)>,
    results: Vec<Option<f64>>,
    case: &'a str,
}

/// Offsets and tensions by direction.
pub fn direction_section(view: &StudyView) -> Section {
    let mut section = Section::new("directions", "Offsets and tensions by direction");
    let Some(column) = &view.direction else {
        section.say("The cases have no column of a usual name for a direction (HEADING, DIRECTION, ..): --direction COLUMN names one.");
        return section;
    };
    let offsets: Vec<(&str, &str)> = result_names(view)
        .into_iter()
        .filter(|(name, _)| {
            let name = name.to_ascii_uppercase();
            let is_other = ["_MEAN", "_SD", "_MIN", "_LEAST"].iter().any(|end| name.ends_with(end));
            is_offset(&name) && !is_other
        })
        .collect();
    let mut found: BTreeMap<Option<MooringCondition>, Vec<(f64, OfDirection)>> = BTreeMap::new();
    for record in view.ended() {
        let Some(direction) = input(record, column).and_then(|text| text.parse::<f64>().ok()) else { continue };
        let list = found.entry(condition(record)).or_default();
        let at = list.iter().position(|(known, _)| *known == direction).unwrap_or_else(|| {
            list.push((direction, OfDirection { results: vec![None; offsets.len()], ..OfDirection::default() }));
            list.len() - 1
        });
        let Some((_, here)) = list.get_mut(at) else { continue };
        here.cases += 1;
        for row in record.lines.iter().filter(|_| record.judges_tension()) {
            if let Some(tension) = row.max_tension.filter(|t| here.tension.as_ref().is_none_or(|(known, _)| t > known))
            {
                here.tension = Some((tension, row.label()));
            }
            if let Some(factor) = row.safety_factor.filter(|f| here.factor.as_ref().is_none_or(|(known, ..)| f < known))
            {
                here.factor = Some((factor, row.label(), row.verdict));
                here.case = &record.case;
            }
        }
        for (known, name) in here.results.iter_mut().zip(&offsets).filter(|_| record.judges_offset()) {
            *known = match (*known, result(record, *name)) {
                (Some(known), Some(value)) => Some(known.max(value)),
                (known, value) => known.or(value),
            };
        }
    }
    for list in found.values_mut() {
        list.sort_by(|a, b| a.0.total_cmp(&b.0));
    }
    let tension_head = format!("Largest T char ({})", Dim::Force.label(view.units));
    let mut heads = vec![column.clone(), "Condition".into(), "Cases".into()];
    heads.extend(offsets.iter().map(|name| format!("Largest {}", with_unit(*name))));
    heads.extend(
        [tension_head.as_str(), "Of line", "Least safety factor", "Of line", "In case", "Verdict"].map(str::to_owned),
    );
    let mut table = ReportTable { heads, rows: Vec::new() };
    for (condition, list) in &found {
        for (direction, here) in list {
            let verdict = view.verdict(here.factor.as_ref().and_then(|(.., verdict)| *verdict));
            let mut row = vec![
                ReportCell::figures(Some(*direction), 6),
                ReportCell::text(condition_word(*condition)),
                ReportCell::number(Some(here.cases as f64), 0),
            ];
            row.extend(here.results.iter().map(|value| ReportCell::figures(*value, FIGURES)));
            row.extend([
                ReportCell::quantity(here.tension.as_ref().map(|(t, _)| *t), Dim::Force, view.units),
                ReportCell::text(here.tension.as_ref().map_or("", |(_, line)| line)),
                ReportCell::number(here.factor.as_ref().map(|(factor, ..)| *factor), 2).toned(verdict.tone),
                ReportCell::text(here.factor.as_ref().map_or("", |(_, line, _)| line)),
                ReportCell::text(here.case),
                verdict,
            ]);
            table.rows.push(row);
        }
    }
    let series = |of: &dyn Fn(&OfDirection) -> Option<f64>| -> Vec<(&'static str, Vec<(f64, f64)>)> {
        let points = |list: &Vec<(f64, OfDirection)>| {
            list.iter().filter_map(|(direction, here)| Some((*direction, of(here)?))).collect::<Vec<_>>()
        };
        let made = found.iter().map(|(condition, list)| (condition_word(*condition), points(list)));
        made.filter(|(_, points)| !points.is_empty()).collect()
    };
    for (at, name) in offsets.iter().enumerate() {
        let points = series(&|here| here.results.get(at).copied().flatten());
        draw_polar(
            &mut section,
            &format!("direction-{}", name.0.to_lowercase()),
            &format!("Largest {} by {column}", with_unit(*name)),
            &points,
        );
    }
    if offsets.is_empty() {
        section.say("No result has OFFSET, EXCURSION or DISPLACEMENT in its name: offsets are not drawn.");
    }
    let force = |here: &OfDirection| in_units(here.tension.as_ref().map(|(t, _)| *t), Dim::Force, view.units);
    draw_polar(&mut section, "direction-tension", &format!("{tension_head} of any line by {column}"), &series(&force));
    section.show(table);
    section
}

/// A polar chart of a value over directions in degrees, a curve a condition.
fn draw_polar(section: &mut Section, file: &str, caption: &str, curves: &[(&str, Vec<(f64, f64)>)]) {
    let mut directions: Vec<f64> = curves.iter().flat_map(|(_, points)| points.iter().map(|(d, _)| *d)).collect();
    directions.sort_by(f64::total_cmp);
    directions.dedup();
    if directions.len() < 3 {
        return;
    }
    // directions all around close the curve
    let largest_gap = directions.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
    let (first, last) = (directions.first().copied().unwrap_or(0.0), directions.last().copied().unwrap_or(0.0));
    let closing = 360.0 - (last - first);
    let closes = closing > 0.0 && closing <= 1.5 * largest_gap;
    let mut angles: Vec<f64> = directions.clone();
    if closes {
        angles.push(first);
    }
    let angle = Column::new("", "Direction", Dim::Angle, Digits::Usual, angles.iter().map(|d| d.to_radians()));
    let mut columns = vec![angle];
    for (name, points) in curves {
        let value = |direction: &f64| {
            points.iter().find(|(d, _)| d == direction).map_or(Cell::Missing, |(_, v)| Cell::Number(*v))
        };
        columns.push(Column::new("", name, Dim::None, Digits::Usual, angles.iter().map(value)));
    }
    let table = Table::from_columns(caption, columns);
    let svg = Chart::polar(&table, windlass_base::units::UnitSystem::SI).and_then(|chart| {
        let label = "directions from +X (right) toward +Y (up)".to_owned();
        Chart { x_label: label, size: PlotSize { width: 560, height: 560 }, ..chart }.svg()
    });
    section.draw(file, caption, svg);
}

/// The table of extremes over seeds, where the study has one.
pub fn ensemble_section(table: Option<Result<ReportTable, String>>) -> Section {
    let mut section = Section::new("ensembles", "Extremes over seeds");
    match table {
        None => section.say("The study has no ensembles.csv: extremes over seeds are not in this report."),
        Some(Err(error)) => section.say_in(Tone::Unconfirmed, format!("ensembles.csv cannot be read: {error}")),
        Some(Ok(mut table)) => {
            let rows = table.rows.len();
            table.rows.truncate(MOST_ROWS);
            section.show(table);
            if rows > MOST_ROWS {
                section.say(format!("{} rows more are in ensembles.csv.", rows - MOST_ROWS));
            }
        }
    }
    section
}

/// A CSV file as a table.
///
/// # Errors
/// What the reader of CSV says.
pub fn read_csv(bytes: &[u8]) -> Result<ReportTable, String> {
    let mut reader = csv::ReaderBuilder::new().flexible(true).from_reader(bytes);
    let heads: Vec<String> = reader.headers().map_err(|e| e.to_string())?.iter().map(str::to_owned).collect();
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|e| e.to_string())?;
        let cell = |at: usize| {
            let text = record.get(at).map(crate::report::csv::remove_guard);
            let number = text.and_then(|text| text.parse::<f64>().ok()).filter(|n| n.is_finite());
            number.map_or_else(|| ReportCell::text(text.unwrap_or_default()), |n| ReportCell::figures(Some(n), 6))
        };
        rows.push((0..heads.len()).map(cell).collect());
    }
    Ok(ReportTable { heads, rows })
}

/// A row a case: inputs, how it ended, results, its least safety factor.
pub fn case_section(view: &StudyView, governing: &[Governing]) -> Section {
    let mut section = Section::new("cases", "Cases");
    let (inputs, results) = (input_names(view), result_names(view));
    let mut heads = vec!["Case".to_owned()];
    heads.extend(inputs.iter().map(|name| (*name).to_owned()));
    heads.push("Status".into());
    heads.extend(results.iter().map(|name| with_unit(*name)));
    heads.extend(["Least safety factor", "Of line", "Verdict", "Seconds"].map(str::to_owned));
    let records = &view.records;
    let governs: BTreeSet<&str> = governing.iter().map(|found| found.record.case.as_str()).collect();
    let is_cut = records.len() > MOST_ROWS;
    let shown =
        records.iter().filter(|r| !is_cut || r.status == CaseStatus::Failed || governs.contains(r.case.as_str()));
    let row = |record: &CaseRecord| {
        let least = record.lines.iter().filter_map(|row| Some((row.safety_factor?, row)));
        let least = least.reduce(|a, b| if b.0 < a.0 { b } else { a });
        let worst = record.lines.iter().filter_map(|row| row.verdict).max();
        let verdict = match record.lines.as_slice() {
            [] => ReportCell::text(""),
            _ if !record.judges_tension() => ReportCell::text("offset alone"),
            _ => view.verdict(worst),
        };
        let mut cells = vec![ReportCell::text(&record.case)];
        cells.extend(inputs.iter().map(|name| input_cell(input(record, name))));
        let tone = if record.status == CaseStatus::Done { Tone::Plain } else { Tone::Fail };
        cells.push(ReportCell::text(record.status.text()).toned(tone));
        cells.extend(results.iter().map(|name| ReportCell::figures(result(record, *name), FIGURES)));
        cells.push(ReportCell::number(least.map(|(factor, _)| factor), 2).toned(verdict.tone));
        cells.push(ReportCell::text(least.map_or_else(String::new, |(_, row)| row.label())));
        cells.push(verdict);
        cells.push(ReportCell::number(Some(record.seconds), 1));
        cells
    };
    let rows: Vec<_> = shown.take(MOST_ROWS).map(row).collect();
    if is_cut {
        section.say(format!(
            "{} of {} cases: those that failed or govern. results.csv and results.parquet have all.",
            rows.len(),
            records.len()
        ));
    }
    section.show(ReportTable { heads, rows });
    section
}

/// The failed cases, each with its reason.
pub fn failed_section(view: &StudyView) -> Section {
    let mut section = Section::new("failed", "Failed and overloaded cases");
    let wrong: Vec<&CaseRecord> = view.records.iter().filter(|record| record.status != CaseStatus::Done).collect();
    let mut table = ReportTable::new(&["Case", "Status", "Reason"]);
    for record in wrong.iter().take(MOST_ROWS) {
        let reason = match record.status {
            CaseStatus::Overloaded => "a tension is beyond its break",
            _ => record.reason.as_str(),
        };
        table.rows.push(vec![
            ReportCell::text(&record.case),
            ReportCell::text(record.status.text()).toned(Tone::Fail),
            ReportCell::text(reason),
        ]);
    }
    if wrong.is_empty() {
        section.say("None.");
    } else {
        section.say("A failed case has no part in any other figure of this report.");
    }
    section.show(table);
    if wrong.len() > MOST_ROWS {
        section.say(format!("{} more are in results.csv.", wrong.len() - MOST_ROWS));
    }
    let missing = view.study.info.cases.len().saturating_sub(view.records.len());
    if missing > 0 {
        section.say_in(
            Tone::Fail,
            format!("{missing} cases of the table have not been run: the same command of the study goes on."),
        );
    }
    section
}

/// Texts with how many cases have each, and the first of these; the order is that of the cases.
fn count_texts<'a>(records: impl Iterator<Item = (&'a str, &'a [String])>) -> Vec<(&'a str, usize, &'a str)> {
    let mut found: Vec<(&str, usize, &str)> = Vec::new();
    let mut places: BTreeMap<&str, usize> = BTreeMap::new();
    for (case, texts) in records {
        for (at, text) in texts.iter().enumerate() {
            if texts.get(..at).is_some_and(|earlier| earlier.contains(text)) {
                continue;
            }
            let place = *places.entry(text.as_str()).or_insert_with(|| {
                found.push((text, 0, case));
                found.len() - 1
            });
            if let Some(entry) = found.get_mut(place) {
                entry.1 += 1;
            }
        }
    }
    found
}

/// What is missing in the model and was accepted, shortcuts, and the messages of the cases.
pub fn message_section(view: &StudyView) -> Section {
    let mut section = Section::new("messages", "Caveats and messages");
    let records = &view.records;
    let caveats = count_texts(records.iter().map(|record| (record.case.as_str(), record.caveats.as_slice())));
    let mut table = ReportTable::new(&["Caveat", "Cases", "First case"]);
    let mut accepted = false;
    for (text, count, case) in caveats {
        let is_missing = text.contains("-ACCEPT_MISSING");
        accepted |= is_missing;
        let tone = if is_missing { Tone::Unconfirmed } else { Tone::Plain };
        table.rows.push(vec![
            ReportCell::text(text).toned(tone),
            ReportCell::number(Some(count as f64), 0),
            ReportCell::text(case),
        ]);
    }
    section.show(table);
    if !accepted {
        section.say("Nothing is missing by &PARAMETER -ACCEPT_MISSING.");
    }
    let messages = count_texts(records.iter().map(|record| (record.case.as_str(), record.messages.as_slice())));
    let mut table = ReportTable::new(&["Message", "Cases", "First case"]);
    let left = messages.len().saturating_sub(MOST_MESSAGES);
    for (text, count, case) in messages.into_iter().take(MOST_MESSAGES) {
        table.rows.push(vec![
            ReportCell::text(text),
            ReportCell::number(Some(count as f64), 0),
            ReportCell::text(case),
        ]);
    }
    if table.rows.is_empty() {
        section.say("No case has an error or a warning.");
    }
    section.show(table);
    if left > 0 {
        section.say(format!("{left} messages more are in results.csv."));
    }
    section
}

/// Whether a case goes on without something by -ACCEPT_MISSING.
pub fn accepts_missing(view: &StudyView) -> usize {
    let accepts = |record: &&CaseRecord| record.caveats.iter().any(|text| text.contains("-ACCEPT_MISSING"));
    view.records.iter().filter(accepts).count()
}

/// The files that the cases have read, with their hashes, and the versions of the program.
pub fn file_section(view: &StudyView) -> Section {
    let mut section = Section::new("files", "Files and versions");
    let info = &view.study.info;
    let mut facts = ReportTable::new(&["What", "Value"]);
    let mut versions: BTreeMap<&str, usize> = BTreeMap::new();
    for record in view.records {
        *versions.entry(&record.version).or_default() += 1;
    }
    let versions: Vec<String> =
        versions.iter().map(|(version, count)| format!("windlass {version} ({count} cases)")).collect();
    for (what, value) in [
        ("Script", info.model.clone()),
        ("Table of cases", info.table.clone()),
        ("Seed of the study", info.seed.to_string()),
        ("Cases made by", versions.join(", ")),
        ("Report made by", format!("windlass {}", env!("CARGO_PKG_VERSION"))),
    ] {
        facts.rows.push(vec![ReportCell::text(what), ReportCell::text(value)]);
    }
    section.show(facts);
    let mut files: BTreeMap<(&str, &str, u64), usize> = BTreeMap::new();
    for read in view.records.iter().flat_map(|record| &record.read) {
        *files.entry((&read.path, &read.hash, read.size)).or_default() += 1;
    }
    let mut table = ReportTable::new(&["File", "Bytes", "SHA-256", "Read by cases"]);
    let mut paths: BTreeMap<&str, usize> = BTreeMap::new();
    for (path, ..) in files.keys() {
        *paths.entry(path).or_default() += 1;
    }
    for ((path, hash, size), count) in &files {
        let tone = if paths.get(path).is_some_and(|n| *n > 1) { Tone::Unconfirmed } else { Tone::Plain };
        table.rows.push(vec![
            ReportCell::text(*path).toned(tone),
            ReportCell::number(Some(*size as f64), 0),
            ReportCell::text(*hash),
            ReportCell::number(Some(*count as f64), 0),
        ]);
    }
    section.show(table);
    if paths.values().any(|n| *n > 1) {
        section.say_in(
            Tone::Unconfirmed,
            "A file has changed while the study ran: cases have read different contents of it.",
        );
    }
    section
}
