//! Lines lost: the columns `lost` and `condition` of a table, and the intact case that a transient one follows.

use crate::kept::MooringCondition;
use crate::table::Case;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// The column of the lines that a case is without.
pub const LOST: &str = "lost";
/// The column of the condition of the mooring.
pub const CONDITION: &str = "condition";
/// How often the sea of a case occurs: it tells no two cases of one sea apart.
pub const PROBABILITY: &str = "probability";
/// What stands in `lost` where no line is.
pub const NO_LINE: &str = "NONE";
/// What stands between the names of lines in one cell: a case may be named by the cell.
pub const BETWEEN_LINES: char = '+';

/// Lines that a case is without, and how it lost them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct LostLines {
    /// Their names, as the cell has them.
    pub lines: Vec<String>,
    /// Intact without lines; else damaged, or transient where the column `condition` says so.
    pub condition: MooringCondition,
}

impl LostLines {
    /// From the cells of `lost` and, where the table has it, `condition`.
    ///
    /// # Errors
    /// The column that is wrong, and why: an empty name or one twice, a word that is no condition, a condition that does not go with the
    /// lines.
    pub fn parse(lost: &str, condition: Option<&str>) -> Result<Self, (&'static str, String)> {
        let mut lines: Vec<String> = Vec::new();
        if !lost.eq_ignore_ascii_case(NO_LINE) {
            for name in lost.split(BETWEEN_LINES) {
                let has_blank = name.chars().any(|c| c.is_whitespace() || matches!(c, ',' | ';'));
                if name.is_empty() || has_blank || name.eq_ignore_ascii_case(NO_LINE) {
                    let message =
                        format!("`{lost}` is no list of lines: {NO_LINE}, or names with {BETWEEN_LINES} between them");
                    return Err((LOST, message));
                }
                if lines.iter().any(|known| known.eq_ignore_ascii_case(name)) {
                    return Err((LOST, format!("`{lost}` names {name} twice")));
                }
                lines.push(name.to_owned());
            }
        }
        let usual = if lines.is_empty() { MooringCondition::Intact } else { MooringCondition::Damaged };
        let condition = match condition {
            None => usual,
            Some(word) => condition_of(word)
                .ok_or_else(|| (CONDITION, format!("`{word}` is no condition: intact, damaged or transient")))?,
        };
        if lines.is_empty() != (condition == MooringCondition::Intact) {
            let message = format!("{} does not go with `{lost}` of {LOST}", condition.word());
            return Err((CONDITION, message));
        }
        Ok(LostLines { lines, condition })
    }

    /// The lines as the variable `%LOST%` has them: names with blanks between, as `&CONNECTOR` takes them.
    pub fn variable(&self) -> String {
        if self.lines.is_empty() { NO_LINE.to_owned() } else { self.lines.join(" ") }
    }
}

/// The condition of a word, in capitals or not.
pub fn condition_of(word: &str) -> Option<MooringCondition> {
    use MooringCondition::{Damaged, Intact, Transient};
    [Intact, Damaged, Transient].into_iter().find(|known| known.word().eq_ignore_ascii_case(word))
}

/// Cells of `lost` and `condition` for every choice of so many lines at once out of some: each line for 1, each pair for 2. Without
/// lines the condition is intact, with lines each of `conditions`.
pub(crate) fn every_loss(lines: &[String], at_once: &[usize], conditions: &[MooringCondition]) -> Vec<[String; 2]> {
    let mut made = Vec::new();
    for count in at_once {
        for chosen in combinations(lines.len(), *count) {
            let names: Vec<&str> = chosen.iter().filter_map(|at| lines.get(*at)).map(String::as_str).collect();
            if names.is_empty() {
                made.push([NO_LINE.to_owned(), MooringCondition::Intact.word().to_owned()]);
            } else {
                let cell = names.join(&BETWEEN_LINES.to_string());
                made.extend(conditions.iter().map(|condition| [cell.clone(), condition.word().to_owned()]));
            }
        }
    }
    made
}

/// How many choices there are of some of a number of things; `None` beyond the range of numbers.
pub(crate) fn count_combinations(of: usize, count: usize) -> Option<usize> {
    let mut made = 1_usize;
    for k in 0..count {
        made = made.checked_mul(of.checked_sub(k)?)? / (k + 1);
    }
    Some(made)
}

/// The choices of some of a number of things, in order.
fn combinations(of: usize, count: usize) -> Vec<Vec<usize>> {
    if count > of {
        return Vec::new();
    }
    let (mut made, mut chosen) = (Vec::new(), (0..count).collect::<Vec<usize>>());
    loop {
        made.push(chosen.clone());
        // the last that can move on does, and those behind it follow closely
        let Some(at) = (0..count).rev().find(|at| chosen.get(*at).is_some_and(|n| *n < of - count + at)) else {
            return made;
        };
        let first = chosen.get(at).copied().unwrap_or_default() + 1;
        chosen.truncate(at);
        chosen.extend((first..).take(count - at));
    }
}

/// For each case the name of the intact one that it follows, where it is transient: the first with the same seed and the same values in
/// the columns that are compared.
///
/// # Errors
/// The place of a transient case that has none.
pub(crate) fn find_intact_cases(cases: &[Case], is_compared: &[bool]) -> Result<Vec<Option<String>>, usize> {
    let condition = |case: &Case| case.lost.as_ref().map(|lost| lost.condition);
    if cases.iter().all(|case| condition(case) != Some(MooringCondition::Transient)) {
        return Ok(vec![None; cases.len()]);
    }
    let key = |case: &'_ Case| -> (Vec<String>, u64) {
        let compared = case.values.iter().zip(is_compared).filter(|(_, is)| **is);
        (compared.map(|(cell, _)| cell.clone()).collect(), case.seed)
    };
    let mut intact: HashMap<(Vec<String>, u64), &str> = HashMap::new();
    for case in cases.iter().filter(|case| condition(case) == Some(MooringCondition::Intact)) {
        intact.entry(key(case)).or_insert(&case.name);
    }
    let find = |(at, case): (usize, &Case)| match condition(case) {
        Some(MooringCondition::Transient) => intact.get(&key(case)).map(|name| Some((*name).to_owned())).ok_or(at),
        _ => Ok(None),
    };
    cases.iter().enumerate().map(find).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pair_of_four_lines_comes_once() {
        let lines: Vec<String> = ["A", "B", "C", "D"].map(str::to_owned).into();
        let cells = |at_once: &[usize]| -> Vec<String> {
            every_loss(&lines, at_once, &[MooringCondition::Damaged]).into_iter().map(|[lost, _]| lost).collect()
        };
        assert_eq!(cells(&[0, 1]), ["NONE", "A", "B", "C", "D"]);
        assert_eq!(cells(&[2]), ["A+B", "A+C", "A+D", "B+C", "B+D", "C+D"]);
        assert_eq!(cells(&[3, 4]), ["A+B+C", "A+B+D", "A+C+D", "B+C+D", "A+B+C+D"]);
        assert_eq!(cells(&[5]), Vec::<String>::new());
        // Pascal's triangle: 8 lines have 28 pairs
        assert_eq!([0, 1, 2, 3].map(|n| count_combinations(8, n)), [Some(1), Some(8), Some(28), Some(56)]);
        assert_eq!(combinations(8, 2).len(), 28);
    }

    #[test]
    fn cells_are_lines_with_their_condition() {
        use MooringCondition::{Damaged, Intact, Transient};
        let parse = |lost: &str, condition| LostLines::parse(lost, condition).map(|l| (l.variable(), l.condition));
        assert_eq!(parse("none", None), Ok(("NONE".to_owned(), Intact)));
        assert_eq!(parse("L1+L2", None), Ok(("L1 L2".to_owned(), Damaged)));
        assert_eq!(parse("L1", Some("Transient")), Ok(("L1".to_owned(), Transient)));
        for (lost, condition, column) in [
            ("L1+", None, LOST),
            ("L1 L2", None, LOST),
            ("L1+NONE", None, LOST),
            ("L1+l1", None, LOST),
            ("L1", Some("lost"), CONDITION),
            ("NONE", Some("damaged"), CONDITION),
            ("L1", Some("intact"), CONDITION),
        ] {
            assert_eq!(LostLines::parse(lost, condition).map_err(|(at, _)| at), Err(column), "{lost}");
        }
    }
}
