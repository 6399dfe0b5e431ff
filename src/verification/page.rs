//! Verification as files: Markdown and CSV; and the texts of numbers that all pages share.

use super::case::{Bound, Case, Reference};
use super::installation::Installation;
use super::judge::Verdict;
use super::run::{CaseResult, Comparison};
use crate::manual::markdown::{code, escape, table};
use crate::report::format::number_in_full;

/// Longest text of a printed number on the screen.
const MAX_PRINTED: usize = 12;

/// The printed number; of more than twelve characters it is rounded on the screen, files have all of them.
pub fn printed_text(comparison: &Comparison) -> String {
    let Some(printed) = &comparison.printed else { return "-".into() };
    if printed.text.chars().count() <= MAX_PRINTED {
        return printed.text.clone();
    }
    short(printed.value)
}

/// The result, with a digit more than the printed number has.
pub fn ours_text(comparison: &Comparison) -> String {
    match (comparison.ours, &comparison.printed) {
        (Some(ours), Some(printed)) if printed.text.chars().count() <= MAX_PRINTED => {
            let text = printed.like(ours, 1);
            if text.chars().count() <= MAX_PRINTED + 1 { text } else { short(ours) }
        }
        (Some(ours), _) => short(ours),
        (None, _) => "-".into(),
    }
}

/// A number in at most twelve characters.
fn short(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-4..1e9).contains(&size) {
        return format!("{value:.5e}");
    }
    let whole = if size < 1.0 { 1 } else { size.log10().floor() as usize + 1 };
    format!("{value:.*}", 9_usize.saturating_sub(whole))
}

/// Below this a fraction is rounding of the last binary digits, and its own digits are those of a machine.
const ROUNDING: f64 = 1e-9;

/// The error: in percent of the printed number, or as it is where that is zero.
pub fn error_text(comparison: &Comparison) -> String {
    match (comparison.relative_error(), comparison.error()) {
        (Some(share), _) if share.abs() < ROUNDING => "0".into(),
        (Some(share), _) => format!("{} %", signed(100.0 * share)),
        (None, Some(error)) => signed(error),
        (None, None) => "-".into(),
    }
}

/// Errors of more units of the last digit than this are of numbers printed with more digits than are meant.
const MAX_LAST_DIGITS: f64 = 1e6;

/// The error in units of the last printed digit; none of numbers with more digits than are meant.
pub fn last_digits_text(comparison: &Comparison) -> String {
    let Some(digits) = comparison.last_digits() else { return "-".into() };
    match digits.abs() {
        size if size < 0.05 => "0.0".into(),
        size if size < 9.95 => format!("{digits:+.1}"),
        size if size < MAX_LAST_DIGITS => format!("{digits:+.0}"),
        _ => "-".into(),
    }
}

/// A number with its sign and two figures.
fn signed(value: f64) -> String {
    match value.abs() {
        0.0 => "0".into(),
        size if size >= 99.5 => format!("{value:+.0}"),
        size if size >= 0.001 => {
            let decimals = if size >= 9.95 { 0 } else { (1.0 - size.log10().floor()) as usize };
            format!("{value:+.decimals$}")
        }
        _ => format!("{value:+.1e}"),
    }
}

/// The bounds that decide a verdict, each once, with the names of the quantities they decide.
pub fn bounds<'c>(case: &'c Case, result: &CaseResult, verdict: Verdict) -> Vec<(&'c Bound, Vec<&'c str>)> {
    let mut list: Vec<(&Bound, Vec<&str>)> = Vec::new();
    for (quantity, comparison) in case.quantities.iter().zip(&result.comparisons) {
        let deciding = match verdict {
            _ if comparison.verdict != verdict => None,
            Verdict::Met => quantity.tolerance.as_ref(),
            Verdict::Explained => quantity.explained.as_ref(),
            Verdict::MetToDigits | Verdict::Missed => None,
        };
        let Some(bound) = deciding else { continue };
        match list.iter_mut().find(|(known, _)| *known == bound) {
            Some((_, names)) => names.push(&quantity.name),
            None => list.push((bound, vec![&quantity.name])),
        }
    }
    list
}

/// Names listed before their number is given instead.
const MAX_NAMES: usize = 3;

/// A bound in a sentence, with the quantities it decides where these are not all.
pub fn bound_text(case: &Case, verdict: Verdict, bound: &Bound, names: &[&str]) -> String {
    let of = match names.len() {
        count if count == case.quantities.len() => String::new(),
        0..=MAX_NAMES => format!(" ({})", names.join("; ")),
        count => format!(" ({count} quantities)"),
    };
    format!("{}{of}: within {}; {}", verdict.text(), bound.text, bound.reason)
}

/// The page as Markdown. Without an installation it is the page of the manual, which no machine or date changes.
pub fn markdown(installation: Option<&Installation>, results: &[(&Case, CaseResult)]) -> String {
    let mut text = String::new();
    if let Some(installation) = installation {
        text.push_str("# Verification of windlass\n\n");
        let rows = installation.lines().map(|(name, value)| [name.to_string(), escape(&value)]);
        text.push_str(&table(["Installation", ""], &rows));
    }
    text.push_str(&summary(results));
    for (case, result) in results {
        text.push_str(&case_section(case, result));
    }
    text
}

fn summary(results: &[(&Case, CaseResult)]) -> String {
    let mut rows = Vec::new();
    for reference in Reference::ALL {
        let of = || results.iter().filter(|(case, _)| case.reference == reference);
        let count = |verdict: Verdict| {
            of().flat_map(|(_, result)| &result.comparisons).filter(|one| one.verdict == verdict).count().to_string()
        };
        let quantities: usize = of().map(|(case, _)| case.quantities.len()).sum();
        let [digits, met, explained, missed] = Verdict::ALL.map(count);
        rows.push([
            reference.text().into(),
            of().count().to_string(),
            quantities.to_string(),
            digits,
            met,
            explained,
            missed,
        ]);
    }
    let sum = |at: usize| rows.iter().filter_map(|row| row[at].parse::<usize>().ok()).sum::<usize>().to_string();
    rows.push(["all".into(), sum(1), sum(2), sum(3), sum(4), sum(5), sum(6)]);
    table(["Reference", "Cases", "Quantities", "Met to its digits", "Met", "Explained", "Missed"], &rows)
}

fn case_section(case: &Case, result: &CaseResult) -> String {
    let mut text = format!("### {}\n\n{}", case.name, escape(&case.shows));
    let end = if case.shows.ends_with('.') { "" } else { "." };
    text.push_str(&format!("{end} {}: {}.\n\n", sentence_case(case.reference.text()), escape(&case.source)));
    let mut rows = Vec::new();
    let mut remarks = Vec::new();
    for (quantity, comparison) in case.quantities.iter().zip(&result.comparisons) {
        let printed = comparison.printed.as_ref().map_or("-", |printed| &printed.text);
        let count = if comparison.count > 1 { format!(", worst of {}", comparison.count) } else { String::new() };
        let bound = quantity.tolerance.as_ref().map_or(String::new(), |bound| bound.text.clone());
        rows.push([
            escape(&format!("{}{count}", quantity.name)),
            escape(&quantity.unit),
            printed.to_string(),
            ours_text(comparison),
            error_text(comparison),
            last_digits_text(comparison),
            bound,
            comparison.verdict.text().to_string(),
        ]);
        remarks.extend(comparison.trouble.iter().map(|trouble| format!("{}: {trouble}", quantity.name)));
    }
    text.push_str(&table(["Quantity", "Unit", "Printed", "Ours", "Error", "Digits", "Tolerance", "Verdict"], &rows));
    for verdict in [Verdict::Met, Verdict::Explained] {
        let deciding = bounds(case, result, verdict);
        remarks.extend(deciding.iter().map(|(bound, names)| bound_text(case, verdict, bound, names)));
    }
    remarks.extend(result.errors.iter().map(|error| format!("The script was refused: {error}")));
    if !remarks.is_empty() {
        let lines: Vec<String> =
            remarks.iter().map(|remark| format!("- {}\n", escape(remark).replace('\n', " "))).collect();
        text.push_str(&format!("{}\n", lines.concat()));
    }
    text
}

fn sentence_case(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| format!("{}{}", first.to_uppercase(), letters.as_str()))
}

/// The page as CSV: a row a quantity, with version, commit, machine and date in each.
///
/// # Errors
/// What the CSV writer refuses.
pub fn csv(installation: &Installation, results: &[(&Case, CaseResult)]) -> Result<Vec<u8>, String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let heads = [
        "case",
        "reference",
        "source",
        "quantity",
        "unit",
        "numbers",
        "printed",
        "ours",
        "error",
        "relative_error",
        "last_digits",
        "tolerance",
        "verdict",
        "reason",
        "seconds",
        "version",
        "commit",
        "machine",
        "date",
    ];
    writer.write_record(heads).map_err(|error| error.to_string())?;
    let number = |value: Option<f64>| value.map_or(String::new(), number_in_full);
    for (case, result) in results {
        for (quantity, comparison) in case.quantities.iter().zip(&result.comparisons) {
            let bound = match comparison.verdict {
                Verdict::Explained => quantity.explained.as_ref(),
                _ => quantity.tolerance.as_ref(),
            };
            let reason = comparison.trouble.clone().or_else(|| bound.map(|bound| bound.reason.clone()));
            let row = [
                case.name.clone(),
                case.reference.text().into(),
                case.source.clone(),
                quantity.name.clone(),
                quantity.unit.clone(),
                comparison.count.to_string(),
                comparison.printed.as_ref().map_or(String::new(), |printed| printed.text.clone()),
                number(comparison.ours),
                number(comparison.error()),
                number(comparison.relative_error()),
                number(comparison.last_digits()),
                bound.map_or(String::new(), |bound| bound.text.clone()),
                comparison.verdict.text().into(),
                reason.unwrap_or_default(),
                format!("{:.3}", result.seconds),
                installation.version.into(),
                installation.commit.into(),
                installation.machine.clone(),
                installation.date.clone(),
            ];
            writer.write_record(row).map_err(|error| error.to_string())?;
        }
    }
    writer.into_inner().map_err(|error| error.to_string())
}

/// A case with its script, as Markdown shows it.
pub fn script_block(case: &Case) -> String {
    let files: Vec<String> = case.files.iter().map(|(name, _)| code(name)).collect();
    let reads = if files.is_empty() { String::new() } else { format!("reads {}\n", files.join(", ")) };
    let lines: Vec<String> = case.script.trim_end().lines().map(|line| format!("  {line}\n")).collect();
    format!("{reads}{}\n", lines.concat())
}
