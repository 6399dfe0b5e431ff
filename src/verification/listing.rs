//! Verification on the screen, at most 100 columns wide.

use super::case::{Case, Cost, Reference};
use super::installation::Installation;
use super::judge::Verdict;
use super::page::{bound_text, bounds, error_text, last_digits_text, ours_text, printed_text};
use super::run::CaseResult;

/// Widest line (characters).
const WIDTH: usize = 100;
/// Width of the name of a quantity.
const NAME_WIDTH: usize = 36;

/// The head: what is verified, where and when.
pub fn head(installation: &Installation, cases: usize, left_out: usize) -> String {
    let mut text = String::from("windlass verify: results beside numbers that windlass did not make\n\n");
    for (name, value) in installation.lines() {
        text.push_str(&wrap_after(&format!("{name:<8} "), &value));
    }
    let more = if left_out == 0 { String::new() } else { format!("; {left_out} more with --all") };
    text.push_str(&format!("Cases    {cases}{more}\n\n"));
    text.push_str("error: of the printed number; digits: in units of its last digit\n\n");
    text
}

/// A case with its comparisons.
pub fn case_block(case: &Case, result: &CaseResult) -> String {
    let heads = format!("{:>12} {:>13} {:>10} {:>7} {}", "printed", "ours", "error", "digits", "verdict");
    let name = &case.name;
    let mut text = if name.chars().count() < NAME_WIDTH {
        format!("{name:<NAME_WIDTH$} {heads}\n")
    } else {
        format!("{name}\n{:<NAME_WIDTH$} {heads}\n", "")
    };
    text.push_str(&wrap(&case.shows, 1, 1));
    text.push_str(&wrap(&format!("{}: {}", case.reference.text(), case.source), 1, 3));
    for (quantity, comparison) in case.quantities.iter().zip(&result.comparisons) {
        let unit = if quantity.unit.is_empty() { String::new() } else { format!(" ({})", quantity.unit) };
        let label = format!("  {}{unit}", quantity.name);
        if label.chars().count() > NAME_WIDTH {
            text.push_str(&wrap(&label, 2, 4));
            text.push_str(&" ".repeat(NAME_WIDTH));
        } else {
            text.push_str(&format!("{label:<NAME_WIDTH$}"));
        }
        let row = format!(
            " {:>12} {:>13} {:>10} {:>7} {}",
            printed_text(comparison),
            ours_text(comparison),
            error_text(comparison),
            last_digits_text(comparison),
            comparison.verdict.text()
        );
        text.push_str(row.trim_end());
        text.push('\n');
        if comparison.count > 1 {
            text.push_str(&wrap(&format!("the worst of {} numbers", comparison.count), 6, 6));
        }
        if let Some(trouble) = &comparison.trouble {
            text.push_str(&wrap(trouble, 6, 6));
        }
    }
    for verdict in [Verdict::Met, Verdict::Explained] {
        for (bound, names) in bounds(case, result, verdict) {
            text.push_str(&wrap(&bound_text(case, verdict, bound, &names), 2, 4));
        }
    }
    for error in &result.errors {
        text.push_str("  the script was refused:\n");
        error.lines().for_each(|line| text.push_str(&format!("    {line}\n")));
    }
    text.push('\n');
    text
}

/// The sum of all cases.
pub fn summary(results: &[(&Case, CaseResult)], unreadable: usize, seconds: f64) -> String {
    let all = || results.iter().flat_map(|(_, result)| &result.comparisons);
    let quantities = all().count();
    let mut text = format!("{} cases, {quantities} quantities, {seconds:.1} s\n", results.len());
    for verdict in Verdict::ALL {
        let count = all().filter(|comparison| comparison.verdict == verdict).count();
        text.push_str(&format!("  {:<18} {count:>5}\n", verdict.text()));
    }
    let mut parts = Vec::new();
    for reference in Reference::ALL {
        let of = results.iter().filter(|(case, _)| case.reference == reference);
        let (cases, count) = of.fold((0, 0), |(n, count), (case, _)| (n + 1, count + case.quantities.len()));
        if cases > 0 {
            parts.push(format!("{} {count} in {cases}", reference.text()));
        }
    }
    text.push_str(&wrap(&format!("by reference: {}", parts.join("; ")), 0, 2));
    let missed: Vec<&str> = results
        .iter()
        .filter(|(_, result)| result.verdict() == Verdict::Missed)
        .map(|(case, _)| case.name.as_str())
        .collect();
    if !missed.is_empty() {
        text.push_str(&wrap(&format!("missed in: {}", missed.join(", ")), 0, 2));
    }
    if unreadable > 0 {
        text.push_str(&format!("{unreadable} case files could not be read\n"));
    }
    text
}

/// The names of the cases, what each shows, its kind of reference and its number of quantities.
pub fn list(cases: &[Case]) -> String {
    let mut text = String::new();
    for case in cases {
        let cost = match case.cost {
            Cost::Quick | Cost::Heavy => "",
            Cost::Long => ", with --all",
        };
        let kind = format!("{}, {} quantities{cost}", case.reference.text(), case.quantities.len());
        text.push_str(&format!("{:<42} {kind}\n", case.name));
        text.push_str(&wrap(&case.shows, 4, 4));
    }
    let quantities: usize = cases.iter().map(|case| case.quantities.len()).sum();
    text.push_str(&format!("{} cases, {quantities} quantities\n", cases.len()));
    text
}

/// Text behind a lead, in lines of at most [`WIDTH`] characters that begin below it.
fn wrap_after(lead: &str, text: &str) -> String {
    let indent = lead.chars().count();
    let wrapped = wrap(text, indent, indent);
    format!("{lead}{}", wrapped.get(indent..).unwrap_or_default())
}

/// Text in lines of at most [`WIDTH`] characters; the first is indented by `first`, the others by `rest`.
pub fn wrap(text: &str, first: usize, rest: usize) -> String {
    let mut made = String::new();
    let mut line = " ".repeat(first);
    let mut is_empty = true;
    for word in text.split_whitespace() {
        if !is_empty && line.chars().count() + 1 + word.chars().count() > WIDTH {
            made.push_str(&line);
            made.push('\n');
            line = " ".repeat(rest);
            is_empty = true;
        }
        if !is_empty {
            line.push(' ');
        }
        line.push_str(word);
        is_empty = false;
    }
    made.push_str(&line);
    made.push('\n');
    made
}
