//! Tables of cases: CSV, or a grid of lists in TOML.

use crate::kept::MooringCondition;
use crate::lost::{
    CONDITION, LOST, LostLines, PROBABILITY, condition_of, count_combinations, every_loss, find_intact_cases,
};
use crate::record::CaseRecord;
use crate::stiffness::{CaseStiffness, STIFFNESS};
use indexmap::IndexMap;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// Most cases of a table, unless more are asked for: beyond it a grid is more likely a slip than a wish.
pub const MOST_CASES: usize = 1_000_000;
/// Longest name of a case and of a column.
const MAX_NAME: usize = 80;
/// The column of names.
pub const CASE: &str = "case";
/// The column of whole numbers that tell cases of one sea apart.
pub const MEMBER: &str = "member";
/// The column of names that stand for the case in its seed.
pub const SEED_OF: &str = "seed_of";
/// The column of seeds given outright.
pub const SEED: &str = "seed";

/// What is wrong with a table.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{file}{}: {message}", place(*.line, .column))]
pub struct TableError {
    /// The file.
    pub file: String,
    /// Its line, or its row where the file has no lines, from 1.
    pub line: Option<u64>,
    /// The column of the table.
    pub column: Option<String>,
    /// What is wrong.
    pub message: String,
}

fn place(line: Option<u64>, column: &Option<String>) -> String {
    let line = line.map_or_else(String::new, |line| format!(":{line}"));
    column.as_ref().map_or(line.clone(), |column| format!("{line}: column {column}"))
}

/// A case of a table.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Case {
    /// Its name.
    pub name: String,
    /// Values of the columns behind the name, as written.
    pub values: Vec<String>,
    /// Its seed.
    pub seed: u64,
    /// The lines it is without, where the table has a column `lost`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lost: Option<LostLines>,
    /// The intact case that a transient one follows.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub intact: Option<String>,
    /// Lines that transient cases lose which follow this one: it keeps their peaks.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub peaks_of: Vec<String>,
    /// The stiffness of its fibre ropes, where the table has a column `stiffness`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stiffness: Option<CaseStiffness>,
}

impl Case {
    /// A case of a record of it, with its columns.
    ///
    /// # Errors
    /// What is wrong with its cells.
    pub fn from_record(record: &CaseRecord) -> Result<(Self, Vec<String>), String> {
        let (columns, values): (Vec<String>, Vec<String>) = record.values.iter().cloned().unzip();
        let cell = |name: &str| {
            columns.iter().zip(&values).find(|(head, _)| head.eq_ignore_ascii_case(name)).map(|(_, cell)| cell.as_str())
        };
        let lost = cell(LOST).map(|lost| LostLines::parse(lost, cell(CONDITION))).transpose();
        let lost = lost.map_err(|(column, message)| format!("column {column}: {message}"))?;
        let intact = record.intact.as_ref().map(|intact| intact.case.clone());
        let peaks_of = record.peaks.iter().map(|peaks| peaks.line.clone()).collect();
        let stiffness = record.stiffness();
        Ok((Case { name: record.case.clone(), values, seed: record.seed, lost, intact, peaks_of, stiffness }, columns))
    }
}

/// A table of cases.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CaseTable {
    /// Columns but that of the names. Each is a variable of the script.
    pub columns: Vec<String>,
    /// The cases, in the order of the table.
    pub cases: Vec<Case>,
    /// Columns of a grid that the forms of `case` and `seed_of` name.
    pub naming: Vec<String>,
}

impl CaseTable {
    /// Reads a table: TOML where the file ends so, else CSV with a head.
    ///
    /// # Errors
    /// A head that cannot name variables, a name of a case that is missing or comes twice, cells that are empty or hold what a record
    /// would take for something else, numbers that are not finite, lists of unequal length, more than `most` cases: of a grid before
    /// any of them is made.
    pub fn parse(file: &str, text: &str, study_seed: u64, most: usize) -> Result<Self, TableError> {
        let is_toml = file.len() > 5 && file.to_ascii_lowercase().ends_with(".toml");
        let rows = if is_toml { grid_rows(file, text, most)? } else { csv_rows(file, text, most)? };
        rows.into_table(file, study_seed)
    }

    /// The table of rows of cells under heads, as another reader has them.
    ///
    /// # Errors
    /// As [`CaseTable::parse`]; rows are counted from 1.
    pub fn from_rows(
        file: &str,
        heads: Vec<String>,
        rows: Vec<Vec<String>>,
        study_seed: u64,
    ) -> Result<Self, TableError> {
        let rows = rows.into_iter().zip(1..).map(|(row, number)| (Some(number), row)).collect();
        Rows { heads, rows, naming: Vec::new() }.into_table(file, study_seed)
    }
}

/// Rows before they are checked.
struct Rows {
    heads: Vec<String>,
    rows: Vec<(Option<u64>, Vec<String>)>,
    naming: Vec<String>,
}

fn csv_rows(file: &str, text: &str, most: usize) -> Result<Rows, TableError> {
    let wrong = |line, message: String| TableError { file: file.into(), line, column: None, message };
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut reader = csv::ReaderBuilder::new().flexible(true).trim(csv::Trim::All).from_reader(text.as_bytes());
    let heads: Vec<String> =
        reader.headers().map_err(|e| wrong(Some(1), e.to_string()))?.iter().map(str::to_owned).collect();
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|e| wrong(e.position().map(csv::Position::line), e.to_string()))?;
        let line = record.position().map(csv::Position::line);
        if record.len() != heads.len() {
            let message = format!("{} cells under {} heads", record.len(), heads.len());
            return Err(wrong(line, message));
        }
        rows.push((line, record.iter().map(str::to_owned).collect()));
        if rows.len() > most {
            return Err(wrong(line, format!("more than {most} cases: --max-cases allows more")));
        }
    }
    Ok(Rows { heads, rows, naming: Vec::new() })
}

/// A grid as it is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Grid {
    /// The name of a case, with the values of columns in braces.
    case: String,
    /// What stands for the case in its seed, likewise.
    seed_of: Option<String>,
    /// Lists, each value with every other.
    #[serde(default)]
    grid: IndexMap<String, Vec<toml::Value>>,
    /// Groups of lists of one length, side by side; each group with every value of the others.
    #[serde(default)]
    zip: Vec<IndexMap<String, Vec<toml::Value>>>,
    /// Lines that are lost, one and more at a time.
    lost: Option<LostGrid>,
    /// Cases with all of these values are left out.
    #[serde(default)]
    exclude: Vec<IndexMap<String, toml::Value>>,
}

/// Losses of lines as a grid has them.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LostGrid {
    /// Names of the lines.
    lines: Vec<String>,
    /// How many are lost at once; 0 is the intact mooring.
    #[serde(default = "none_and_one")]
    at_once: Vec<usize>,
    /// Conditions of those with lines lost.
    #[serde(default = "damaged")]
    conditions: Vec<String>,
}

fn none_and_one() -> Vec<usize> {
    vec![0, 1]
}

fn damaged() -> Vec<String> {
    vec![MooringCondition::Damaged.word().to_owned()]
}

impl LostGrid {
    /// The columns `LOST` and `CONDITION`, side by side.
    fn columns(&self, most: usize) -> Result<IndexMap<String, Vec<String>>, String> {
        let mut conditions = Vec::new();
        for word in &self.conditions {
            match condition_of(word) {
                Some(condition) if condition != MooringCondition::Intact => conditions.push(condition),
                _ => return Err(format!("`{word}` of conditions is neither damaged nor transient")),
            }
        }
        if conditions.contains(&MooringCondition::Transient) && !self.at_once.contains(&0) {
            return Err("a transient case follows an intact one: at_once = [0, ..]".into());
        }
        if let Some(many) = self.at_once.iter().find(|count| **count > self.lines.len()) {
            return Err(format!("at_once loses {many} of {} lines", self.lines.len()));
        }
        let counts = self.at_once.iter().map(|count| count_combinations(self.lines.len(), *count));
        let total = counts.sum::<Option<usize>>().and_then(|n| n.checked_mul(conditions.len().max(1)));
        if total.is_none_or(|n| n > most) {
            return Err(format!("its losses are more than {most} cases: --max-cases allows more"));
        }
        let rows = every_loss(&self.lines, &self.at_once, &conditions);
        let (lost, condition) = rows.into_iter().map(|[lost, condition]| (lost, condition)).unzip();
        Ok(IndexMap::from([(LOST.to_ascii_uppercase(), lost), (CONDITION.to_ascii_uppercase(), condition)]))
    }
}

fn value_text(value: &toml::Value) -> Option<String> {
    match value {
        toml::Value::String(text) => Some(text.clone()),
        toml::Value::Integer(number) => Some(number.to_string()),
        toml::Value::Float(number) if number.is_finite() => Some(number.to_string()),
        _ => None,
    }
}

fn grid_rows(file: &str, text: &str, most: usize) -> Result<Rows, TableError> {
    let wrong = |line, column: Option<&str>, message: String| TableError {
        file: file.into(),
        line,
        column: column.map(str::to_owned),
        message,
    };
    let grid: Grid = toml::from_str(text).map_err(|error| {
        let line = error.span().map(|span| 1 + text[..span.start.min(text.len())].matches('\n').count() as u64);
        wrong(line, None, error.message().to_owned())
    })?;
    // groups of columns that go side by side; a list of the grid is a group of its own
    let mut groups: Vec<IndexMap<String, Vec<String>>> = Vec::new();
    let lists = grid.grid.into_iter().map(|(name, list)| IndexMap::from([(name, list)]));
    for group in lists.chain(grid.zip) {
        let mut texts = IndexMap::new();
        for (name, list) in &group {
            let list: Option<Vec<String>> = list.iter().map(value_text).collect();
            let list = list.ok_or_else(|| wrong(None, Some(name), "a value is a number or a text".into()))?;
            if list.is_empty() {
                return Err(wrong(None, Some(name), "the list is empty".into()));
            }
            if groups.iter().any(|g: &IndexMap<String, Vec<String>>| g.contains_key(name)) {
                return Err(wrong(None, Some(name), "it stands twice, in [grid] and [[zip]]".into()));
            }
            texts.insert(name.clone(), list);
        }
        let mut lengths = texts.iter().map(|(name, list)| (name, list.len()));
        if let Some((first, length)) = lengths.next()
            && let Some((other, unequal)) = lengths.find(|(_, l)| *l != length)
        {
            let message = format!("{unequal} values beside {length} of {first}: lists of [[zip]] have one length");
            return Err(wrong(None, Some(other), message));
        }
        groups.push(texts);
    }
    if let Some(lost) = &grid.lost {
        let texts = lost.columns(most).map_err(|m| wrong(None, Some(LOST), m))?;
        let is_a_list = |name: &&String| groups.iter().any(|g| g.keys().any(|known| known.eq_ignore_ascii_case(name)));
        if let Some(name) = texts.keys().find(is_a_list) {
            return Err(wrong(None, Some(name), "it stands twice, in [lost] and in a list".into()));
        }
        if texts.values().any(Vec::is_empty) {
            return Err(wrong(None, Some(LOST), "it loses no line: lines and at_once say which".into()));
        }
        groups.push(texts);
    }
    groups.retain(|group| !group.is_empty());
    let total = groups.iter().try_fold(1_usize, |n, g| n.checked_mul(g.values().next().map_or(1, Vec::len)));
    let total = total.filter(|n| *n <= most).ok_or_else(|| {
        wrong(None, None, format!("the lists multiply to more than {most} cases: --max-cases allows more"))
    })?;
    let columns: Vec<String> = groups.iter().flat_map(IndexMap::keys).cloned().collect();
    let mut excluded = Vec::new();
    for rule in &grid.exclude {
        let mut set = Vec::new();
        for (name, value) in rule {
            let at = columns.iter().position(|c| c == name).ok_or_else(|| {
                wrong(None, Some(name), format!("[[exclude]] names no list; there are {}", columns.join(" ")))
            })?;
            let text =
                value_text(value).ok_or_else(|| wrong(None, Some(name), "a value is a number or a text".into()))?;
            set.push((at, text));
        }
        excluded.push(set);
    }
    let mut heads = vec![CASE.to_owned()];
    heads.extend(columns.iter().cloned());
    heads.extend(grid.seed_of.iter().map(|_| SEED_OF.to_owned()));
    let mut rows = Vec::new();
    for number in 0..total {
        let (mut rest, mut picks) = (number, vec![0; groups.len()]);
        // the last list turns fastest
        for (pick, group) in picks.iter_mut().zip(&groups).rev() {
            let length = group.values().next().map_or(1, Vec::len);
            (*pick, rest) = (rest % length, rest / length);
        }
        let values: Vec<String> = groups
            .iter()
            .zip(&picks)
            .flat_map(|(group, pick)| group.values().filter_map(|list| list.get(*pick).cloned()))
            .collect();
        let is_out =
            |set: &Vec<(usize, String)>| !set.is_empty() && set.iter().all(|(at, text)| values.get(*at) == Some(text));
        if excluded.iter().any(is_out) {
            continue;
        }
        let known: HashMap<&str, &str> =
            columns.iter().map(String::as_str).zip(values.iter().map(String::as_str)).collect();
        let mut row = vec![fill(&grid.case, &known).map_err(|m| wrong(None, Some(CASE), m))?];
        if let Some(form) = &grid.seed_of {
            let seed_of = fill(form, &known).map_err(|m| wrong(None, Some(SEED_OF), m))?;
            row.extend(values);
            row.push(seed_of);
        } else {
            row.extend(values);
        }
        rows.push((None, row));
    }
    let forms = || std::iter::once(&grid.case).chain(&grid.seed_of);
    let is_in_a_form = |column: &&String| forms().any(|form| form.contains(&format!("{{{column}}}")));
    let naming = columns.iter().filter(is_in_a_form).cloned().collect();
    Ok(Rows { heads, rows, naming })
}

/// A form with the values of columns in braces.
fn fill(form: &str, values: &HashMap<&str, &str>) -> Result<String, String> {
    let (mut made, mut rest) = (String::new(), form);
    while let Some((before, behind)) = rest.split_once('{') {
        let (name, after) = behind.split_once('}').ok_or_else(|| format!("`{form}` has a {{ without a }}"))?;
        let value = values.get(name).ok_or_else(|| format!("`{{{name}}}` is no column of the grid"))?;
        made.push_str(before);
        made.push_str(value);
        rest = after;
    }
    made.push_str(rest);
    Ok(made)
}

fn is_name(text: &str, more: &[char]) -> bool {
    let fits = |c: char| c.is_ascii_alphanumeric() || c == '_' || more.contains(&c);
    !text.is_empty() && text.len() <= MAX_NAME && text.chars().all(fits)
}

impl Rows {
    fn into_table(self, file: &str, study_seed: u64) -> Result<CaseTable, TableError> {
        let wrong = |line, column: &str, message: String| TableError {
            file: file.into(),
            line,
            column: (!column.is_empty()).then(|| column.to_owned()),
            message,
        };
        let first = self.rows.first().and_then(|row| row.0).map(|_| 1);
        let mut known: Vec<&str> = Vec::new();
        for head in &self.heads {
            if !is_name(head, &[]) || !head.starts_with(|c: char| c.is_ascii_alphabetic()) {
                let message = "a column is a variable of the script: a letter, then letters, digits and _".to_owned();
                return Err(wrong(first, head, message));
            }
            if known.iter().any(|other| other.eq_ignore_ascii_case(head)) {
                return Err(wrong(first, head, "it stands twice".into()));
            }
            known.push(head);
        }
        let find = |name: &str| self.heads.iter().position(|head| head.eq_ignore_ascii_case(name));
        let Some(name_at) = find(CASE) else {
            let message = format!("there is no column case, which names the rows; there are {}", self.heads.join(" "));
            return Err(wrong(first, "", message));
        };
        if self.rows.is_empty() {
            return Err(wrong(None, "", "it has no cases".into()));
        }
        let (member_at, seed_of_at, seed_at) = (find(MEMBER), find(SEED_OF), find(SEED));
        let (lost_at, condition_at, stiffness_at) = (find(LOST), find(CONDITION), find(STIFFNESS));
        let mut seen: HashMap<String, Option<u64>> = HashMap::new();
        let mut cases = Vec::with_capacity(self.rows.len());
        let mut lines = Vec::with_capacity(self.rows.len());
        for (line, row) in self.rows {
            for (head, cell) in self.heads.iter().zip(&row) {
                if cell.is_empty() {
                    return Err(wrong(line, head, "the cell is empty".into()));
                }
                // the sea of a name may be called so: only a variable is taken for a number
                if !head.eq_ignore_ascii_case(CASE)
                    && !head.eq_ignore_ascii_case(SEED_OF)
                    && cell.parse::<f64>().is_ok_and(|number| !number.is_finite())
                {
                    return Err(wrong(line, head, format!("`{cell}` is not a finite number")));
                }
                if let Some(c) =
                    cell.chars().find(|c| c.is_control() || matches!(c, '%' | '\'' | '"' | '$' | '&' | '\\'))
                {
                    let message = format!(
                        "`{}` has `{}`, which a record reads as something else",
                        cell.escape_debug(),
                        c.escape_debug()
                    );
                    return Err(wrong(line, head, message));
                }
            }
            let cell = |at: usize| row.get(at).map(String::as_str).unwrap_or_default();
            let name = cell(name_at).to_owned();
            if !is_name(&name, &['-', '.', '+']) || name.starts_with('.') {
                let message = format!(
                    "`{name}` cannot name a case: letters, digits and _ - + ., {MAX_NAME} at most, not a . first"
                );
                return Err(wrong(line, CASE, message));
            }
            if let Some(before) = seen.insert(name.to_ascii_lowercase(), line) {
                let there = before.map_or_else(String::new, |line| format!(", first in line {line}"));
                return Err(wrong(line, CASE, format!("`{name}` stands twice{there}")));
            }
            let whole = |at: usize, what: &str| {
                let text = cell(at);
                text.parse::<u32>().map_err(|_| wrong(line, what, format!("`{text}` is not a whole number from 0 on")))
            };
            let member = member_at.map_or(Ok(0), |at| whole(at, MEMBER))?;
            let seed = match seed_at {
                Some(at) => u64::from(whole(at, SEED)?),
                None => {
                    let stands = seed_of_at.map_or(name.as_str(), cell);
                    crate::seeds::seed_of_case(study_seed, stands, u64::from(member))
                }
            };
            let lost = lost_at.map(|at| LostLines::parse(cell(at), condition_at.map(cell))).transpose();
            let lost = lost.map_err(|(column, message)| wrong(line, column, message))?;
            let stiffness = stiffness_at.map(|at| CaseStiffness::parse(cell(at))).transpose();
            let stiffness = stiffness.map_err(|message| wrong(line, STIFFNESS, message))?;
            let values =
                row.iter().enumerate().filter(|(at, _)| *at != name_at).map(|(_, cell)| cell.clone()).collect();
            cases.push(Case { name, values, seed, lost, intact: None, peaks_of: Vec::new(), stiffness });
            lines.push(line);
        }
        let columns = self.heads.iter().enumerate().filter(|(at, _)| *at != name_at).map(|(_, head)| head.clone());
        let columns: Vec<String> = columns.collect();
        let own = [MEMBER, SEED_OF, SEED, LOST, CONDITION, PROBABILITY];
        let is_compared = |head: &String| !own.iter().any(|known| known.eq_ignore_ascii_case(head));
        let intact = find_intact_cases(&cases, &columns.iter().map(is_compared).collect::<Vec<_>>());
        let intact = intact.map_err(|at| {
            let message = "there is no intact case with the same seed whose other columns are the same: seed_of gives cases the same seas";
            wrong(lines.get(at).copied().flatten(), CONDITION, message.into())
        })?;
        let mut followed: HashMap<String, Vec<String>> = HashMap::new();
        for (case, intact) in cases.iter_mut().zip(intact) {
            let Some(name) = intact else { continue };
            let known = followed.entry(name.clone()).or_default();
            for line in case.lost.iter().flat_map(|lost| &lost.lines) {
                if !known.iter().any(|other| other.eq_ignore_ascii_case(line)) {
                    known.push(line.clone());
                }
            }
            case.intact = Some(name);
        }
        for case in &mut cases {
            case.peaks_of = followed.remove(&case.name).unwrap_or_default();
        }
        Ok(CaseTable { columns, cases, naming: self.naming })
    }
}
