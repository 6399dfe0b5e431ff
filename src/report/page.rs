//! The formatted report of a table.
//!
//! Layout after [MOSES-RUNS windus]: a box with the program, date and titles; a spaced title
//! between `+++`, underlined; the process and units line; facts; group heads `/---- text ----/`; heads, units, dashes,
//! rows.

use super::format;
use comfy_table::presets::NOTHING;
use comfy_table::{CellAlignment, Table as Grid};
use windlass_base::table::{Cell, Column, Digits, Fact, Table};
use windlass_base::units::{Dim, UnitSystem};

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
const MAX_PAGE_WIDTH: usize = 160;
/// Narrowest page.
const MIN_PAGE_WIDTH: usize = 72;

/// The whole report of a table: page head, title, facts, rows, notes. Plain ASCII, no trailing blanks.
pub fn render(table: &Table, units: UnitSystem, head: &PageHead) -> String {
    let body = grid(table, units);
    let width = body.iter().map(|l| l.chars().count()).max().unwrap_or(0).clamp(MIN_PAGE_WIDTH, MAX_PAGE_WIDTH);
    let mut lines = vec![String::new()];
    lines.extend(banner(head, width));
    let spaced = space_letters(&table.title);
    let title = format!("+++ {spaced} +++");
    lines.push(centre(&title, width));
    lines.push(centre(&"=".repeat(title.len()), width));
    lines.push(String::new());
    let process = if head.process.is_empty() { "DEFAULT" } else { &head.process };
    lines.push(centre(&format!("Process is {process}: Units Are {units} Unless Specified"), width));
    lines.push(String::new());
    lines.extend(facts(table, units));
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

/// The facts of a table, a line each.
fn facts(table: &Table, units: UnitSystem) -> impl Iterator<Item = String> {
    table.facts.iter().map(move |Fact { name, value, dim, digits }| match value {
        Cell::Missing => format!("   {name:<32} = not given"),
        _ => format!("   {name:<32} = {} {}", format::report(value, *dim, *digits, units), dim.label(units)),
    })
}

/// A page of a deck's listing: its title spaced between stars, its facts, rows and notes.
pub fn listing(table: &Table, units: UnitSystem) -> Vec<String> {
    let mut lines = vec![String::new(), format!(" * * * * {} * * * *", space_letters(&table.title)), String::new()];
    let parts: [Vec<String>; 3] = [
        facts(table, units).map(|line| line.trim_end().to_string()).collect(),
        if table.columns().is_empty() { Vec::new() } else { grid(table, units) },
        table.notes.iter().map(|note| format!("   {note}")).collect(),
    ];
    for part in parts.into_iter().filter(|part| !part.is_empty()) {
        if lines.last().is_some_and(|line| !line.is_empty()) {
            lines.push(String::new());
        }
        lines.extend(part);
    }
    lines
}

/// The rows of a table with their heads, without page head and title: what listings use.
pub fn grid(table: &Table, units: UnitSystem) -> Vec<String> {
    format_rows(table, units, format::report)
}

/// As [`grid`] with three digits more and the row numbers `numbers` (from 0) counted from 1: what `VIEW` shows.
pub fn view(table: &Table, numbers: &[usize], units: UnitSystem) -> Vec<String> {
    let mut lines = format_rows(table, units, format::view);
    let heads = lines.len().saturating_sub(numbers.len() + 1);
    for (index, line) in lines.iter_mut().enumerate() {
        let label = match index.checked_sub(heads) {
            None => "     ".to_string(),
            Some(0) => "-----".to_string(),
            Some(row) => format!("{:>5}", numbers.get(row - 1).map_or(0, |n| n + 1)),
        };
        line.insert_str(0, &label);
        line.truncate(line.trim_end().len());
    }
    lines
}

/// How a cell becomes text.
type CellFormat = fn(&Cell, Dim, Digits, UnitSystem) -> String;

/// Aligns the rows with comfy-table and adds heads, units, group heads and dashes. Numbers stand to the right.
fn format_rows(table: &Table, units: UnitSystem, shown: CellFormat) -> Vec<String> {
    let mut rows: Vec<Vec<String>> = vec![
        table.columns().iter().map(|c| c.name.clone()).collect(),
        table.columns().iter().map(|c| c.dim.label(units)).collect(),
    ];
    rows.retain(|row| row.iter().any(|text| !text.is_empty()));
    let heads = rows.len();
    let cell = |column: &Column, row: usize| {
        column.cells.get(row).map_or(String::new(), |cell| shown(cell, column.dim, column.digits, units))
    };
    rows.extend((0..table.rows()).map(|row| table.columns().iter().map(|c| cell(c, row)).collect()));
    make_room(table, &mut rows);
    let mut grid = Grid::new();
    grid.load_style(NOTHING);
    for row in &rows {
        grid.add_row(row);
    }
    for (index, column) in table.columns().iter().enumerate() {
        let text = |c: &Cell| matches!(c, Cell::Text(_));
        let words = column.cells.iter().any(text) && column.cells.iter().all(|c| text(c) || *c == Cell::Missing);
        if let Some(place) = grid.column_mut(index) {
            place.set_cell_alignment(if words { CellAlignment::Left } else { CellAlignment::Right });
            place.set_padding((1, 1));
        }
    }
    let mut lines: Vec<String> = grid.lines().map(|l| l.trim_end().to_string()).collect();
    let width = |i: usize| rows.iter().filter_map(|r| r.get(i)).map(|t| t.chars().count()).max().unwrap_or(0) + 2;
    let widths: Vec<usize> = (0..table.columns().len()).map(width).collect();
    lines.insert(heads.min(lines.len()), "-".repeat(widths.iter().sum()));
    if let Some(groups) = group_heads(table, &widths) {
        lines.insert(0, groups);
    }
    lines
}

/// Widens the last head of a group whose columns are together narrower than the group's own head.
fn make_room(table: &Table, rows: &mut [Vec<String>]) {
    let width = |rows: &[Vec<String>], i: usize| {
        rows.iter().filter_map(|r| r.get(i)).map(|t| t.chars().count()).max().unwrap_or(0)
    };
    let mut at = 0;
    while let Some(column) = table.columns().get(at) {
        let run = table.columns().iter().skip(at).take_while(|c| c.group == column.group).count();
        let last = at + run - 1;
        let have: usize = (at..=last).map(|i| width(rows, i) + 2).sum();
        let want = if column.group.is_empty() { 0 } else { column.group.chars().count() + 3 };
        if want > have {
            let wide = width(rows, last) + want - have;
            if let Some(head) = rows.first_mut().and_then(|r| r.get_mut(last)) {
                *head = format!("{head:>wide$}");
            }
        }
        at += run;
    }
}

/// The line of group heads, `/---- Tension ----/` over the columns of each group; `None` without groups.
fn group_heads(table: &Table, widths: &[usize]) -> Option<String> {
    if table.columns().iter().all(|c| c.group.is_empty()) {
        return None;
    }
    let mut line = String::new();
    let mut at = 0;
    while let Some(column) = table.columns().get(at) {
        let run = table.columns().iter().skip(at).take_while(|c| c.group == column.group).count();
        let width: usize = widths.iter().skip(at).take(run).sum();
        if column.group.is_empty() {
            line.push_str(&" ".repeat(width));
        } else {
            let room = width.saturating_sub(3);
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
fn space_letters(title: &str) -> String {
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

    #[test]
    fn page_report_has_title_units_groups_and_aligned_rows() {
        let mut table = Table::new("Properties of Line A")
            .fact("Water Depth", 100.0 * 0.3048, Dim::Length)
            .with_rows(&[(0.3048, 44_482.216_152_605, 0.25)])
            .column("", "X", Dim::Length, Digits::Usual, |row| row.0)
            .column("Tension", "Top", Dim::Force, Digits::Usual, |row| row.1)
            .column("Tension", "T/TB", Dim::None, Digits::Decimals(3), |row| row.2)
            .build();
        table.note("said once");
        let head = PageHead { titles: ["Title".into(), String::new()], ..PageHead::default() };
        let text = render(&table, UnitSystem::default(), &head);
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
        assert_eq!(squeeze(&text), squeeze(want), "{text}");
        assert!(text.lines().all(|l| l == l.trim_end()));
    }
}
