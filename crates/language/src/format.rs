//! The layout of scripts: blanks and empty lines, never a word.
//!
//! What a layout is: records inside `&IF`, `&LOOP` and `&MACRO` are two blanks further in than the block, records of menus are not (which
//! record opens a menu hangs on the model and on files). A line that continues a record is two blanks further in than its record, and four
//! where it goes on with the values of an option that began a line; lines that the writer has begun below the second word of their record
//! stay below it. One blank stands between words; between numbers two where the writer has left
//! two or more. Lines of the same form one below the other are a table: where one of them has further blanks, all their words stand in
//! columns, numbers by their units (decimal points below each other) but for a first word; comments behind records likewise. No blanks end a
//! line, no two empty lines follow each other, and the last line has its end. Case, words, commas, quotes, comments and `\` stay as they are.
//!
//! Records whose text counts as typed ([`Spacing::AsTyped`], and all that hold a string function) are only moved as a whole.

use super::flow::macros::control_word;
use super::flow::specs::CONTROL;
use super::record::{self, LONGEST_RECORD, Record};
use super::select::Owner;
use super::token::{self, TokenKind};
use windlass_base::span::SourceId;

/// How the blanks within a record are treated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spacing {
    /// The record is read as words: blanks only part them.
    Words,
    /// Its text is read, blanks and all.
    AsTyped,
    /// Its text is read, and so are the records up to the next `END`.
    RowsAsTyped,
}

/// What a layout must know of the commands that the language itself does not have.
pub struct Commands<'a> {
    /// All internal commands, which share one name space of abbreviations, as [`super::flow::Interpreter::new`] takes them, with the
    /// control records among them.
    pub internal: &'a [(&'static str, Owner)],
    /// How a record is read, by its first word.
    pub spacing: &'a dyn Fn(&str) -> Spacing,
}

/// Blanks that a level of blocks or of continuation is further in.
const STEP: usize = 2;
/// Deepest level that is shown: a hostile script would otherwise grow as the square of its length.
const DEEPEST_LEVEL: usize = 32;
/// Widest line that is laid out in columns (characters), for the same reason.
const WIDEST_ROW: usize = 240;

/// Longest first word below whose second one lines that continue a record may begin (characters), for the same reason.
const LONGEST_HUNG: usize = 24;

/// What the lexer takes for a blank.
fn is_blank(c: char) -> bool {
    matches!(c, ' ' | '\t' | '\r' | '\n' | '\u{b}' | '\u{c}')
}

/// A run of tokens without blanks between them.
struct Cell<'t> {
    text: &'t str,
    is_number: bool,
    is_option: bool,
    /// It begins with the mark of a name (`~ * :`).
    is_marked: bool,
    kind: TokenKind,
    /// Characters between it and the cell before.
    gap: usize,
}

impl Cell<'_> {
    /// Characters up to the units of a number and behind them: `-1.25` has 2 and 3, `2e6` 1 and 2.
    fn parts(&self) -> [usize; 2] {
        let digits = self.text.trim_start_matches(['+', '-']);
        let behind = width(digits.trim_start_matches(|c: char| c.is_ascii_digit()));
        [width(self.text) - behind, behind]
    }
}

/// A line of the layout.
enum Body<'t> {
    /// Text that stays as it is.
    Kept(&'t str),
    /// Words, whether the line is continued, and the comment behind them with the blanks before it.
    Words { cells: Vec<Cell<'t>>, is_continued: bool, comment: Option<(&'t str, usize)> },
}

struct Line<'t> {
    indent: usize,
    /// It continues the record of the line before.
    continues: bool,
    /// The lines that continue its record begin below its second word, which therefore stands one blank behind the first.
    has_hung_lines: bool,
    body: Body<'t>,
}

impl<'t> Line<'t> {
    fn cells(&self) -> &[Cell<'t>] {
        match &self.body {
            Body::Words { cells, .. } => cells,
            Body::Kept(_) => &[],
        }
    }

    /// Whether two lines can be rows of one table.
    fn is_alike(&self, other: &Line<'_>) -> bool {
        let (own, others) = (self.cells(), other.cells());
        self.continues == other.continues
            && !(self.has_hung_lines || other.has_hung_lines)
            && self.indent == other.indent
            && own.len() > 1
            && own.len() == others.len()
            && own.iter().zip(others).enumerate().all(|(index, (a, b))| {
                let is_name = a.is_option || (index == 0 && !self.continues && !a.is_marked);
                a.kind == b.kind && a.is_number == b.is_number && (!is_name || a.text.eq_ignore_ascii_case(b.text))
            })
    }
}

/// A script in its layout. The words of its records, their order and its comments are those of `text`; a layout is its own layout. A text
/// with a record that is too long to be read stays as it is.
pub fn format(text: &str, commands: &Commands<'_>) -> String {
    let Some((lines, ends_open)) = lay_out(text, commands) else { return text.to_string() };
    let mut rows: Vec<String> = Vec::with_capacity(lines.len());
    let mut rest = lines.as_slice();
    while let Some(first) = rest.first() {
        let count = 1 + rest.iter().skip(1).take_while(|line| line.is_alike(first)).count();
        let (table, below) = rest.split_at(count);
        rows.extend(align(table));
        rest = below;
    }
    append_comments(&lines, &mut rows);
    let end = if text.split('\n').next().is_some_and(|line| line.ends_with('\r')) { "\r\n" } else { "\n" };
    let mut out = rows.join(end);
    // the end of a line would hide that the text ends inside a record
    if !rows.is_empty() && !ends_open {
        out.push_str(end);
    }
    out
}

/// The lines of a script with their indentation, empty ones that follow each other taken off, and whether the text ends inside a record.
fn lay_out<'t>(text: &'t str, commands: &Commands<'_>) -> Option<(Vec<Line<'t>>, bool)> {
    let mut lines: Vec<Line<'t>> = Vec::new();
    let mut blocks: Vec<&'static str> = Vec::new();
    let (mut rows_follow, mut was_empty, mut ends_open) = (false, false, false);
    let mut at = 0;
    while at < text.len() {
        let (record, next, open) = record::read(text, SourceId::default(), at);
        if record.text().len() > LONGEST_RECORD {
            return None;
        }
        let typed = text.get(at..next).unwrap_or_default();
        let typed = typed.strip_suffix('\n').unwrap_or(typed);
        (at, ends_open) = (next, open);
        if typed.trim_matches(is_blank).is_empty() {
            if !was_empty {
                lines.push(Line { indent: 0, continues: false, has_hung_lines: false, body: Body::Kept("") });
            }
            was_empty = true;
            continue;
        }
        was_empty = false;
        let word = record.first_word();
        let control = control_word(word, commands.internal);
        let level = match control {
            Some(name) => level_of(name, &mut blocks),
            None => blocks.len(),
        };
        let indent = STEP * level.min(DEEPEST_LEVEL);
        let is_end = word.get(..3).is_some_and(|head| head.eq_ignore_ascii_case("END"));
        rows_follow &= !is_end;
        let spacing = match control {
            Some(name) if CONTROL.iter().any(|spec| spec.name == name) => Spacing::AsTyped,
            Some(name) if !rows_follow => (commands.spacing)(name),
            Some(_) => Spacing::AsTyped,
            None if rows_follow => Spacing::AsTyped,
            None if is_end || record.is_blank() => Spacing::Words,
            None => (commands.spacing)(word),
        };
        rows_follow |= spacing == Spacing::RowsAsTyped;
        if spacing == Spacing::Words && !holds_function(record.text()) && !quotes_line_end(&record, typed) {
            lay_out_words(typed, indent, &mut lines);
        } else {
            lay_out_typed(typed, indent, &mut lines);
        }
    }
    Some((lines, ends_open))
}

/// The level of a control record, which may open or close a block.
fn level_of(name: &'static str, blocks: &mut Vec<&'static str>) -> usize {
    let opened = match name {
        "&IF" | "&LOOP" | "&MACRO" => {
            blocks.push(name);
            return blocks.len() - 1;
        }
        "&ELSE" | "&ELSEIF" | "&ENDIF" => "&IF",
        "&ENDLOOP" => "&LOOP",
        "&ENDMACRO" => "&MACRO",
        _ => return blocks.len(),
    };
    let Some(at) = blocks.iter().rposition(|block| *block == opened) else { return blocks.len() };
    blocks.truncate(if name.starts_with("&END") { at } else { at + 1 });
    at
}

/// Whether a string function may stand in a record: its arguments may be text.
fn holds_function(record: &str) -> bool {
    let behind = record.trim_start_matches(is_blank).get(1..);
    behind.is_some_and(|rest| rest.split_once('&').is_some_and(|(_, name)| name.contains('(')))
}

/// Whether quotes hold the end of a line of a record, so that the blanks around it count.
fn quotes_line_end(record: &Record, typed: &str) -> bool {
    let is_word = |token: &token::Token| token.kind != TokenKind::Empty;
    let words = |text: &str| -> Vec<String> {
        let all = token::words(text).into_iter().filter(is_word);
        all.map(|word| text.get(word.range).unwrap_or_default().to_string()).collect()
    };
    let of_line = |line: &str| words(line.get(..token::line_end(line).0).unwrap_or_default());
    let has_quotes = typed.contains('\n') && record.text().contains(['\'', '"']);
    has_quotes && typed.split('\n').flat_map(of_line).ne(words(record.text()))
}

/// Whether a line holds what only looks like a blank, or what is no text.
fn is_odd(line: &str) -> bool {
    let line = line.trim_matches(is_blank);
    line.chars().any(|c| (c.is_whitespace() || c.is_control()) && !matches!(c, ' ' | '\t' | '\r'))
}

/// A record whose text counts: its lines stay, but for the indentation of the first and blanks at their ends.
fn lay_out_typed<'t>(record: &'t str, indent: usize, lines: &mut Vec<Line<'t>>) {
    for (index, line) in record.split('\n').enumerate() {
        let kept = line.trim_end_matches(is_blank);
        let line = if index > 0 || is_odd(line) {
            Line { indent: 0, continues: index > 0, has_hung_lines: false, body: Body::Kept(kept) }
        } else {
            Line {
                indent,
                continues: false,
                has_hung_lines: false,
                body: Body::Kept(kept.trim_start_matches(is_blank)),
            }
        };
        lines.push(line);
    }
}

/// A record of words, or a comment.
fn lay_out_words<'t>(record: &'t str, indent: usize, lines: &mut Vec<Line<'t>>) {
    let mut gives_values = false;
    let hung = hung_below(record);
    for (index, line) in record.split('\n').enumerate() {
        if is_odd(line) {
            lines.push(Line {
                indent: 0,
                continues: index > 0,
                has_hung_lines: false,
                body: Body::Kept(line.trim_end_matches(is_blank)),
            });
            continue;
        }
        let trimmed = line.trim_matches(is_blank);
        let body = read_line(trimmed);
        let begins_option = matches!(&body, Body::Words { cells, .. } if cells.first().is_some_and(|c| c.is_option));
        let further = match index {
            0 => 0,
            _ if begins_option => 1,
            _ if gives_values => 2,
            _ => 1,
        };
        gives_values |= begins_option && index > 0;
        let indent = match hung {
            _ if trimmed.is_empty() => 0,
            Some(further) if index > 0 => indent + further,
            _ => indent + STEP * further,
        };
        lines.push(Line { indent, continues: index > 0, has_hung_lines: index == 0 && hung.is_some(), body });
    }
}

/// How much further in than its record the lines that continue it are, where the writer has begun all of them below the second word.
fn hung_below(record: &str) -> Option<usize> {
    let mut lines = record.split('\n');
    let first = lines.next()?;
    let margin = |line: &str| width(line) - width(line.trim_start_matches(is_blank));
    let Body::Words { cells, .. } = read_line(first.trim_matches(is_blank)) else { return None };
    let [word, second, ..] = cells.as_slice() else { return None };
    let below = margin(first) + width(word.text) + second.gap;
    let mut others = lines.filter(|line| !line.trim_matches(is_blank).is_empty()).peekable();
    let is_hung = others.peek().is_some() && !record.contains('\t') && others.all(|line| margin(line) == below);
    let further = width(word.text) + 1;
    (is_hung && !is_odd(first) && further <= LONGEST_HUNG).then_some(further)
}

/// The words and the comment of a line without blanks around it.
fn read_line(line: &str) -> Body<'_> {
    let tokens = token::tokens(line);
    let (record_end, is_continued) = token::line_end(line);
    let mut cells: Vec<Cell<'_>> = Vec::new();
    let mut comment = None;
    // where the cell being read began, and where the last token ended
    let (mut begun, mut end) = (0, 0);
    for token in tokens {
        match token.kind {
            TokenKind::Blank => continue,
            TokenKind::Comment => {
                let text = line.get(token.range.clone()).unwrap_or_default();
                comment = Some((text.trim_end_matches(is_blank), token.range.start - end));
                break;
            }
            // the mark that continues the record
            TokenKind::Continuation if is_continued && token.range.start == record_end => {
                end = token.range.end;
                continue;
            }
            _ => {}
        }
        let is_number = matches!(token.kind, TokenKind::Number);
        match cells.last_mut() {
            Some(cell) if token.range.start == end => {
                cell.text = line.get(begun..token.range.end).unwrap_or_default();
                // a number with the comma behind it is still one
                cell.is_number &= token.kind == TokenKind::Comma;
            }
            _ => {
                begun = token.range.start;
                let is_marked = matches!(token.kind, TokenKind::Class | TokenKind::Point | TokenKind::Selector);
                cells.push(Cell {
                    text: line.get(token.range.clone()).unwrap_or_default(),
                    is_number,
                    is_option: token.kind == TokenKind::Option,
                    is_marked,
                    kind: token.kind,
                    gap: line.get(end..begun).map_or(0, |gap| if gap.contains('\t') { 2 } else { gap.len() }),
                });
            }
        }
        end = token.range.end;
    }
    match (cells.is_empty() && !is_continued, comment) {
        (true, _) => Body::Kept(line),
        (false, comment) => Body::Words { cells, is_continued, comment },
    }
}

fn width(text: &str) -> usize {
    text.chars().count()
}

/// The lines of a table without their comments; a line of its own is a table of one row.
fn align(table: &[Line<'_>]) -> Vec<String> {
    let columns = table.first().map_or(0, |line| line.cells().len());
    let cell = |line: usize, column: usize| table.get(line).and_then(|line: &Line<'_>| line.cells().get(column));
    let cells = |column: usize| (0..table.len()).filter_map(move |line| cell(line, column));
    // blanks before each column, where none are filled in: what the writer has left in all lines, or left free from top to bottom
    let mut ends = vec![0; table.len()];
    let gaps: Vec<usize> = (0..columns)
        .map(|column| {
            let numbers = column > 1 && cells(column).chain(cells(column - 1)).all(|cell| cell.is_number);
            let least = cells(column).map(|cell| cell.gap).min().unwrap_or(0);
            let farthest = ends.iter().copied().max().unwrap_or(0);
            let nearest = ends.iter().zip(cells(column)).map(|(end, cell)| end + cell.gap).min().unwrap_or(0);
            for (end, cell) in ends.iter_mut().zip(cells(column)) {
                *end += cell.gap + width(cell.text);
            }
            if column == 0 { 0 } else { 1 + usize::from(numbers && least > 1 && nearest != farthest + 1) }
        })
        .collect();
    let is_wide = (1..columns).any(|column| cells(column).any(|cell| Some(&cell.gap) > gaps.get(column)));
    // of each column: characters up to the units of its numbers and behind them; a column of words has its width behind
    let parts = |index: usize, cell: &Cell<'_>| {
        if cell.is_number && index > 0 { cell.parts() } else { [0, width(cell.text)] }
    };
    let widths: Vec<[usize; 2]> = (0..columns)
        .map(|column| {
            let widest = |part: usize| cells(column).map(|cell| parts(column, cell)[part]).max().unwrap_or(0);
            [widest(0), widest(1)]
        })
        .collect();
    let total = widths.as_flattened().iter().chain(&gaps).sum::<usize>();
    let in_columns = table.len() > 1 && is_wide && total <= WIDEST_ROW;
    table
        .iter()
        .map(|line| {
            let mut row = " ".repeat(line.indent);
            let (cells, is_continued) = match &line.body {
                Body::Kept(text) => {
                    row.push_str(text);
                    return row;
                }
                Body::Words { cells, is_continued, .. } => (cells, is_continued),
            };
            // blanks that fill a column are written only where a word follows
            let mut owed = 0;
            for (index, ((cell, gap), column)) in cells.iter().zip(&gaps).zip(&widths).enumerate() {
                let own = parts(index, cell);
                let [before, behind] = if in_columns { [column[0] - own[0], column[1] - own[1]] } else { [0; 2] };
                row.push_str(&" ".repeat(owed + gap + before));
                row.push_str(cell.text);
                owed = behind;
            }
            if *is_continued {
                let gap = usize::from(!cells.is_empty());
                row.push_str(&" ".repeat(gap));
                row.push('\\');
            }
            row
        })
        .collect()
}

/// The comment behind a record, and how many characters before it.
fn comment_of<'t>(line: &Line<'t>) -> Option<(&'t str, usize)> {
    match line.body {
        Body::Words { comment, .. } => comment,
        Body::Kept(_) => None,
    }
}

/// Puts the comments behind their records, in a column where the writer has put one of them further out.
fn append_comments(lines: &[Line<'_>], rows: &mut [String]) {
    let mut at = 0;
    while at < lines.len() {
        let run: Vec<(&str, usize)> = lines.get(at..).unwrap_or_default().iter().map_while(comment_of).collect();
        let own = rows.get_mut(at..at + run.len()).unwrap_or_default();
        let gap = if run.iter().all(|(_, gap)| *gap > 1) { 2 } else { 1 };
        let widest = own.iter().map(|row| width(row)).max().unwrap_or(0);
        let in_column = run.iter().any(|(_, typed)| *typed > gap) && widest <= WIDEST_ROW;
        for (row, (comment, _)) in own.iter_mut().zip(&run) {
            let filling = if in_column { widest - width(row) } else { 0 };
            row.push_str(&" ".repeat(gap + filling));
            row.push_str(comment);
        }
        at += run.len() + 1;
    }
}

#[cfg(test)]
mod tests;
