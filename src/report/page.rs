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
/// Narrowest page, unless the screen is narrower.
const MIN_PAGE_WIDTH: usize = 72;
/// The narrowest screen for which reports are laid out; on a narrower one the terminal wraps them.
const NARROWEST: usize = 40;
/// A number below this share of the largest beside it is rounding.
const ROUNDING_SHARE: f64 = 1e-12;

/// The whole report of a table: page head, title, facts, rows, notes. Plain ASCII, no trailing blanks. With a `width` nothing is wider
/// that can be folded: columns that do not fit go on in blocks below, each behind the row heads.
pub fn render(table: &Table, units: UnitSystem, head: &PageHead, width: Option<usize>) -> String {
    let limit = width.map(|w| w.max(NARROWEST));
    let body = grid(table, units, limit);
    let widest = body.iter().map(|l| l.chars().count()).max().unwrap_or(0).clamp(MIN_PAGE_WIDTH, MAX_PAGE_WIDTH);
    let width = limit.map_or(widest, |limit| widest.min(limit));
    let mut lines = vec![String::new()];
    lines.extend(banner(head, width));
    lines.extend(heading(&table.title, limit.map(|_| width)).iter().map(|line| centre(line, width)));
    lines.push(String::new());
    let process = if head.process.is_empty() { "DEFAULT" } else { &head.process };
    let said = format!("Process is {process}: Units Are {units} Unless Specified");
    lines.extend(fold(&said, limit).iter().map(|line| centre(line.trim(), width)));
    lines.push(String::new());
    lines.extend(facts(table, units).flat_map(|line| fold(&line, limit)));
    if !table.facts.is_empty() {
        lines.push(String::new());
    }
    lines.extend(body);
    if !table.notes.is_empty() {
        lines.push(String::new());
        lines.extend(table.notes.iter().flat_map(|n| fold(&format!("   {n}"), limit)));
    }
    let mut text = lines.iter().map(|l| l.trim_end()).collect::<Vec<_>>().join("\n");
    text.push('\n');
    text
}

/// The reports of some tables, one after the other.
pub fn render_all(tables: &[Table], units: UnitSystem, head: &PageHead, width: Option<usize>) -> String {
    tables.iter().map(|table| render(table, units, head, width)).collect::<Vec<_>>().join("\n")
}

/// The title between plus signs, spaced where there is room, and what underlines it.
fn heading(title: &str, width: Option<usize>) -> Vec<String> {
    let spaced = format!("+++ {} +++", space_letters(title));
    let fits = |line: &String| width.is_none_or(|width| line.chars().count() <= width);
    let mut lines =
        if fits(&spaced) { vec![spaced] } else { fold(&format!("+++ {} +++", title.to_uppercase()), width) };
    let under = lines.iter().map(|line| line.trim().len()).max().unwrap_or(0);
    lines.push("=".repeat(under));
    lines
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
        if table.columns().is_empty() { Vec::new() } else { grid(table, units, None) },
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

/// The rows of a table with their heads, without page head and title: what listings use. With a `width` columns that do not fit go on
/// in blocks below.
pub fn grid(table: &Table, units: UnitSystem, width: Option<usize>) -> Vec<String> {
    join_blocks(blocks(&without_rounding(table), units, format::report, width))
}

/// A table for the page: numbers of fixed decimals that are rounding beside the others of their column, or of its group in the same dimension, are zero.
fn without_rounding(table: &Table) -> Table {
    let size = |column: &Column| {
        let numbers = column.cells.iter().filter_map(Cell::number).filter(|value| value.is_finite());
        numbers.fold(0.0, |most: f64, value| most.max(value.abs()))
    };
    let largest: Vec<f64> = table.columns().iter().map(size).collect();
    let beside = |column: &Column| {
        let is_beside =
            |other: &&Column| !column.group.is_empty() && other.group == column.group && other.dim == column.dim;
        let own =
            table.columns().iter().zip(&largest).filter(|(other, _)| std::ptr::eq(*other, column) || is_beside(other));
        own.map(|(_, largest)| *largest).fold(0.0, f64::max)
    };
    let cleaned = |column: &Column| {
        let least = ROUNDING_SHARE * beside(column);
        let mut made = column.clone();
        if !matches!(column.digits, Digits::Scientific(_)) {
            let is_rounding = |cell: &Cell| matches!(cell, Cell::Number(value) if value.abs() < least);
            made.cells.iter_mut().filter(|cell| is_rounding(cell)).for_each(|cell| *cell = Cell::Number(0.0));
        }
        made
    };
    Table::from_columns("", table.columns().iter().map(cleaned).collect())
}

/// As [`grid`] with three digits more and the row numbers `numbers` (from 0) counted from 1: what `VIEW` shows.
pub fn view(table: &Table, numbers: &[usize], units: UnitSystem, width: Option<usize>) -> Vec<String> {
    let mut made = blocks(table, units, format::view, width.map(|w| w.saturating_sub(5)));
    for lines in &mut made {
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
    }
    join_blocks(made)
}

/// Blocks one below the other, an empty line between them.
fn join_blocks(blocks: Vec<Vec<String>>) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for block in blocks {
        if !lines.is_empty() {
            lines.push(String::new());
        }
        lines.extend(block);
    }
    lines
}

/// The rows of a table in as many blocks as a width makes of its columns, each with the row heads.
fn blocks(table: &Table, units: UnitSystem, shown: CellFormat, width: Option<usize>) -> Vec<Vec<String>> {
    let columns = table.columns();
    let whole = || vec![format_rows(table, units, shown)];
    let Some(limit) = width else { return whole() };
    let widths: Vec<usize> = columns.iter().map(|column| column_width(column, units, shown)).collect();
    let all: Vec<usize> = (0..columns.len()).collect();
    if block_width(columns, &widths, &all) <= limit {
        return whole();
    }
    let chosen = split_columns(columns, &widths, limit);
    let part = |indices: Vec<usize>| {
        let part = indices.into_iter().filter_map(|i| columns.get(i).cloned()).collect();
        format_rows(&Table::from_columns("", part), units, shown)
    };
    chosen.into_iter().map(part).collect()
}

/// The columns of each block: the row heads, and as many of the others as fit, at least one. A group of columns stays together where a
/// block has room for it.
fn split_columns(columns: &[Column], widths: &[usize], limit: usize) -> Vec<Vec<usize>> {
    let heads = row_heads(columns, widths, limit);
    let fits = |list: &[usize]| block_width(columns, widths, list) <= limit;
    let mut made: Vec<Vec<usize>> = Vec::new();
    let mut block: Vec<usize> = (0..heads).collect();
    let mut at = heads;
    while let Some(column) = columns.get(at) {
        let grouped = |c: &&Column| !column.group.is_empty() && c.group == column.group;
        let run = columns.iter().skip(at).take_while(grouped).count().max(1);
        let group: Vec<usize> = (at..at + run).collect();
        let alone: Vec<usize> = (0..heads).chain(group.iter().copied()).collect();
        let with = |block: &[usize], more: &[usize]| -> Vec<usize> { block.iter().chain(more).copied().collect() };
        if !fits(&with(&block, &group)) && block.len() > heads && fits(&alone) {
            made.push(std::mem::replace(&mut block, (0..heads).collect()));
        }
        for index in group {
            if !fits(&with(&block, &[index])) && block.len() > heads {
                made.push(std::mem::replace(&mut block, (0..heads).collect()));
            }
            block.push(index);
        }
        at += run;
    }
    if block.len() > heads || made.is_empty() {
        made.push(block);
    }
    made
}

/// How many columns at the left say what a row is: the first, and the words beside it, within half of the width.
fn row_heads(columns: &[Column], widths: &[usize], limit: usize) -> usize {
    let words = columns.iter().take_while(|c| c.group.is_empty() && is_words(c)).count().max(1);
    let mut taken = 0;
    let narrow = widths.iter().take(words).take_while(|width| {
        taken += **width;
        2 * taken <= limit
    });
    narrow.count().clamp(1, columns.len().max(1))
}

/// Whether a column holds words.
fn is_words(column: &Column) -> bool {
    let text = |c: &Cell| matches!(c, Cell::Text(_));
    column.cells.iter().any(text) && column.cells.iter().all(|c| text(c) || *c == Cell::Missing)
}

/// Characters a column takes, the blanks beside it counted.
fn column_width(column: &Column, units: UnitSystem, shown: CellFormat) -> usize {
    let cells = column.cells.iter().map(|cell| shown(cell, column.dim, column.digits, units).chars().count());
    let heads = column.name.chars().count().max(column.dim.label(units).chars().count());
    cells.max().unwrap_or(0).max(heads) + 2
}

/// Characters some columns take side by side, with the heads of their groups.
fn block_width(columns: &[Column], widths: &[usize], chosen: &[usize]) -> usize {
    let group = |index: &usize| columns.get(*index).map_or("", |c| c.group.as_str());
    chosen
        .chunk_by(|a, b| group(a) == group(b))
        .map(|run| {
            let have: usize = run.iter().filter_map(|i| widths.get(*i)).sum();
            let head = run.first().map_or("", group);
            if head.is_empty() { have } else { have.max(head.chars().count() + 3) }
        })
        .sum()
}

/// A line in lines of at most `width` characters; those that go on are indented to where its second column begins.
fn fold(line: &str, width: Option<usize>) -> Vec<String> {
    let Some(width) = width.filter(|width| line.chars().count() > *width) else { return vec![line.to_string()] };
    let indent = hanging_indent(line).min(width / 2);
    let start = line.chars().take_while(|c| *c == ' ').count();
    let mut lines: Vec<String> = Vec::new();
    let mut now = " ".repeat(start);
    let mut empty = true;
    // the blanks of what stands in columns are kept in the first line
    for word in line.get(start..).unwrap_or_default().split(' ') {
        let room = now.chars().count() + usize::from(!empty) + word.chars().count() <= width;
        if !empty && !room && !word.is_empty() {
            lines.push(std::mem::replace(&mut now, " ".repeat(indent)).trim_end().to_string());
            empty = true;
        }
        if !empty {
            now.push(' ');
        }
        if !(word.is_empty() && empty) {
            now.push_str(word);
            empty = false;
        }
    }
    lines.push(now.trim_end().to_string());
    lines
}

/// Where the text of a line goes on below: behind its first gap of two blanks or more, else two blanks into it.
fn hanging_indent(line: &str) -> usize {
    let start = line.chars().take_while(|c| *c == ' ').count();
    let body = line.get(start..).unwrap_or_default();
    body.find("  ").map_or(start + 2, |gap| {
        let rest = body.get(gap..).unwrap_or_default();
        start
            + body.get(..gap).unwrap_or_default().chars().count()
            + rest.chars().take_while(|c| *c == ' ' || *c == '=').count()
    })
}

/// Text whose lines are folded to a width; without one it stays as it is.
pub fn fold_text(text: &str, width: Option<usize>) -> String {
    text.lines().flat_map(|line| fold(line, width.map(|w| w.max(NARROWEST)))).collect::<Vec<_>>().join("\n")
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
        if let Some(position) = grid.column_mut(index) {
            position.set_cell_alignment(if is_words(column) { CellAlignment::Left } else { CellAlignment::Right });
            position.set_padding((1, 1));
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
        let text = render(&table, UnitSystem::default(), &head, None);
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

    /// A table of names with groups of numbers, as of a mooring moved.
    fn wide_table(rows: usize, groups: usize) -> Table {
        let names: Vec<String> = (1..=rows).map(|n| format!("LINE{n}")).collect();
        let mut made = Table::new("Forces of Connectors").with_rows(&names).text("Name", |name| name.as_str());
        for group in 1..=groups {
            made = made.columns(&format!("G{group}"), ["Tension", "T/MBL"], Dim::Force, Digits::Usual, |_| [1e6, 2e6]);
        }
        let mut table = made.build();
        table.note("a remark of many words that goes on and on, well beyond the width of any of the screens that are tried here");
        table
    }

    #[test]
    fn columns_beyond_the_width_go_on_below_repeated_row_heads() {
        let table = wide_table(3, 8);
        let head = PageHead::default();
        let full = render(&table, UnitSystem::default(), &head, None);
        for width in [60, 100, 200] {
            let text = render(&table, UnitSystem::default(), &head, Some(width));
            assert!(text.lines().all(|line| line.chars().count() <= width), "{width}: {text}");
            // a cell is printed once, a row head once a block
            assert_eq!(text.matches("224.81").count() + text.matches("449.62").count(), 3 * 16, "{text}");
            let blocks = text.matches("LINE1 ").count();
            assert_eq!(blocks, text.matches("LINE3 ").count());
            assert!((width == 200) == (blocks == 1), "{text}");
            assert!((1..=8).all(|n| text.contains(&format!("- G{n} -"))), "{text}");
        }
        assert_eq!(full.matches("LINE1 ").count(), 1);
        assert_eq!(render(&table, UnitSystem::default(), &head, Some(500)), full);
    }

    #[test]
    fn numbered_rows_keep_their_numbers_in_every_block() {
        let lines = view(&wide_table(2, 6), &[4, 6], UnitSystem::default(), Some(60));
        assert!(lines.iter().all(|line| line.chars().count() <= 60));
        let numbered = lines.iter().filter(|line| line.starts_with("    5") || line.starts_with("    7")).count();
        let blocks = lines.iter().filter(|line| line.starts_with("-----")).count();
        assert!(blocks > 1 && numbered == 2 * blocks, "{lines:?}");
    }

    #[test]
    fn long_line_is_folded_below_its_second_column() {
        let folded = fold_text("   -LEN L                       length of the segment between its two ends", Some(50));
        assert_eq!(
            folded,
            "   -LEN L                       length of the\n                         segment between its two\n                         ends"
        );
        assert_eq!(fold_text("short", Some(50)), "short");
    }
}
