//! The formatted report of a table.
//!
//! Layout after reference/solve.md, "Report page layout": a box with the program, date and titles; a spaced title
//! between `+++`, underlined; the process and units line; facts; group heads `/---- text ----/`; heads, units, dashes,
//! rows.

use super::format;
use crate::language::units::UnitSystem;
use crate::table::{Cell, Table};
use comfy_table::presets::NOTHING;
use comfy_table::{CellAlignment, Table as Grid};

/// What stands at the head of a page.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PageHead {
    /// Date, if one is printed.
    pub date: Option<String>,
    /// Title and subtitle lines.
    pub titles: [String; 2],
    /// Process name.
    pub process: String,
}

/// Widest page (characters); the box and titles are centred in the width of the table, within this.
const PAGE: usize = 132;
/// Narrowest page.
const NARROW: usize = 72;

/// The whole report of a table: page head, title, facts, rows, notes. Plain ASCII, no trailing blanks.
pub fn render(table: &Table, heads: &[(usize, String)], units: UnitSystem, head: &PageHead) -> String {
    let body = grid(table, heads, units);
    let width = body.iter().map(String::len).max().unwrap_or(0).clamp(NARROW, PAGE);
    let mut lines = Vec::new();
    lines.extend(banner(head, width));
    let spaced = spaced(&table.title);
    let title = format!("+++ {spaced} +++");
    lines.push(centre(&title, width));
    lines.push(centre(&"=".repeat(title.len()), width));
    lines.push(String::new());
    let process = if head.process.is_empty() { "DEFAULT" } else { &head.process };
    lines.push(centre(&format!("Process is {process}: Units Are {units} Unless Specified"), width));
    lines.push(String::new());
    for (name, cell, dim) in &table.facts {
        let label = dim.label(units);
        let value = format::report(cell, *dim, crate::table::Digits::Usual, units);
        let unit = if label.is_empty() || *cell == Cell::Missing { String::new() } else { format!(" {label}") };
        lines.push(format!("   {name:<32} = {value}{unit}"));
    }
    if !table.facts.is_empty() {
        lines.push(String::new());
    }
    lines.extend(body);
    if !table.notes.is_empty() {
        lines.push(String::new());
        lines.extend(table.notes.iter().map(|n| format!("   {n}")));
    }
    let mut text = lines.iter().map(|l| l.trim_end()).collect::<Vec<_>>().join("\n");
    text.push('\n');
    text
}

/// The rows of a table with their heads, without page head and title: what `VIEW` and listings use.
pub fn grid(table: &Table, heads: &[(usize, String)], units: UnitSystem) -> Vec<String> {
    let name = |index: usize, own: &str| {
        heads.iter().find(|(i, _)| *i == index).map_or_else(|| own.to_string(), |(_, text)| text.clone())
    };
    let mut rows: Vec<Vec<String>> = vec![
        table.columns.iter().enumerate().map(|(i, c)| name(i, &c.name)).collect(),
        table.columns.iter().map(|c| c.dim.label(units)).collect(),
    ];
    if rows.get(1).is_some_and(|labels| labels.iter().all(String::is_empty)) {
        rows.truncate(1);
    }
    let heads = rows.len();
    for row in 0..table.rows() {
        rows.push(
            table
                .columns
                .iter()
                .map(|c| c.cells.get(row).map_or(String::new(), |cell| format::report(cell, c.dim, c.digits, units)))
                .collect(),
        );
    }
    let text_column: Vec<bool> = table
        .columns
        .iter()
        .map(|c| c.cells.iter().all(|cell| matches!(cell, Cell::Text(_) | Cell::Missing)) && !c.cells.is_empty())
        .collect();
    lay_out(table, &rows, heads, &text_column)
}

/// As [`grid`], every column to the right.
pub fn grid_right(table: &Table, units: UnitSystem) -> Vec<String> {
    let mut copy = table.clone();
    for column in &mut copy.columns {
        // an empty integer column never shows, but keeps texts that are numbers to the right
        column.cells.push(Cell::Integer(0));
    }
    let mut lines = grid(&copy, &[], units);
    lines.pop();
    lines
}

/// Aligns rows with comfy-table and adds group heads and dashes.
fn lay_out(table: &Table, rows: &[Vec<String>], heads: usize, text_column: &[bool]) -> Vec<String> {
    let mut grid = Grid::new();
    grid.load_style(NOTHING);
    for row in rows {
        grid.add_row(row);
    }
    for (index, text) in text_column.iter().enumerate() {
        if let Some(column) = grid.column_mut(index) {
            let side = if *text { CellAlignment::Left } else { CellAlignment::Right };
            column.set_cell_alignment(side);
            column.set_padding((1, 1));
        }
    }
    let mut lines: Vec<String> = grid.lines().map(|l| l.trim_end().to_string()).collect();
    let widths: Vec<usize> = (0..text_column.len())
        .map(|i| rows.iter().filter_map(|r| r.get(i)).map(String::len).max().unwrap_or(0) + 2)
        .collect();
    let total: usize = widths.iter().sum();
    lines.insert(heads.min(lines.len()), "-".repeat(total));
    if let Some(groups) = group_heads(table, &widths) {
        lines.insert(0, groups);
    }
    lines
}

/// The line of group heads, `/---- Tension ----/` over the columns of each group; `None` without groups.
fn group_heads(table: &Table, widths: &[usize]) -> Option<String> {
    if table.columns.iter().all(|c| c.group.is_empty()) {
        return None;
    }
    let mut line = String::new();
    let mut at = 0;
    while let Some(column) = table.columns.get(at) {
        let run = table.columns.iter().skip(at).take_while(|c| c.group == column.group).count();
        let width: usize = widths.iter().skip(at).take(run).sum();
        if column.group.is_empty() || width < column.group.len() + 2 {
            line.push_str(&format!("{:^width$}", column.group.get(..column.group.len().min(width)).unwrap_or("")));
        } else {
            let room = width - 3;
            let text =
                if room >= column.group.len() + 4 { format!(" {} ", column.group) } else { column.group.clone() };
            line.push_str(&format!(" /{text:-^room$}/"));
        }
        at += run;
    }
    Some(line)
}

fn banner(head: &PageHead, width: usize) -> Vec<String> {
    let inner = width - 4;
    let boxed = |text: &str| {
        let cut: String = text.chars().take(inner).collect();
        format!("* {cut:^inner$} *")
    };
    let mut lines = vec!["*".repeat(width), boxed("*** WINDLASS ***"), boxed(&"-".repeat(16))];
    lines.extend(head.date.iter().map(|d| boxed(d)));
    lines.extend(head.titles.iter().filter(|t| !t.is_empty()).map(|t| boxed(t)));
    lines.push("*".repeat(width));
    lines.push(String::new());
    lines
}

/// `+++ L I K E   T H I S +++` without the plus signs.
fn spaced(title: &str) -> String {
    let words: Vec<String> = title
        .to_uppercase()
        .split_whitespace()
        .map(|word| word.chars().map(String::from).collect::<Vec<_>>().join(" "))
        .collect();
    words.join("   ")
}

/// Text in the middle of a width.
pub fn centre(text: &str, width: usize) -> String {
    format!("{:>width$}", text, width = (width + text.chars().count()) / 2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::units::Dim;
    use crate::table::Digits;

    #[test]
    fn a_report_has_its_title_units_groups_and_aligned_rows() {
        let mut table = Table::new("Properties of Line A")
            .fact("Water Depth", 100.0 * 0.3048, Dim::Length)
            .column("", "X", Dim::Length, Digits::Usual)
            .column("Tension", "Top", Dim::Force, Digits::Usual)
            .column("Tension", "T/TB", Dim::None, Digits::Decimals(3));
        table.push(vec![0.3048.into(), 44_482.216_152_605.into(), 0.25.into()]).unwrap();
        table.note("said once");
        let head = PageHead { titles: ["Title".into(), String::new()], ..PageHead::default() };
        let text = render(&table, &[], UnitSystem::default(), &head);
        let want = "
************************************************************************
*                           *** WINDLASS ***                           *
*                           ----------------                           *
*                                Title                                 *
************************************************************************

        +++ P R O P E R T I E S   O F   L I N E   A +++
        ===============================================

   Process is DEFAULT: Units Are Degrees, Feet, and Kips Unless Specified

   Water Depth                      = 100.00 ft

       /- Tension -/
    X     Top   T/TB
   ft    kips
--------------------
 1.00  10.00  0.250

   said once
";
        // whitespace inside the centred lines is fixed by the width of the page
        let squeeze = |s: &str| {
            s.lines().map(|l| l.split_whitespace().collect::<Vec<_>>().join(" ")).collect::<Vec<_>>().join("\n")
        };
        assert_eq!(squeeze(&text), squeeze(want.trim_start_matches('\n')), "{text}");
        assert!(text.lines().all(|l| l == l.trim_end()));
    }
}
