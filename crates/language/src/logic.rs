//! Logical phrases: `%A .EQ. 3 .AND. .NOT. %DONE`.
//!
//! Source: [MOSES-REF lang_loop_if]. `.EQ.` and `.NE.` compare any words (as numbers when both are numbers,
//! else as text, upper and lower case alike); the other comparisons need numbers. `.NOT.` binds tighter than `.AND.`,
//! that tighter than `.OR.`. A parenthesis that its own word does not match groups conditions: `(1 .EQ. 1)`; matched ones
//! are arithmetic: `(1+2)*3`.

use super::number;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;

/// Deepest nesting of parentheses and `.NOT.`.
const MAX_NESTING: usize = 64;

/// `.TRUE.` or `.FALSE.`.
pub fn word(value: bool) -> &'static str {
    if value { ".TRUE." } else { ".FALSE." }
}

const OPERATORS: &[&str] =
    &[".EQ.", ".NE.", ".LT.", ".LE.", ".GT.", ".GE.", ".AND.", ".OR.", ".NOT.", ".TRUE.", ".FALSE."];

/// Why a phrase has no value.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
enum LogicError {
    #[error("`{0}` has no place here")]
    Surplus(String),
    #[error("nested too deeply")]
    Nested,
    #[error("a `)` is missing")]
    Unclosed,
    #[error("a word is missing at the end")]
    Missing,
    #[error("`{0}` is neither .TRUE. nor .FALSE.")]
    NotLogical(String),
    #[error("{operator} compares numbers, and `{text}` is none")]
    NotANumber { operator: String, text: String },
}

/// The value of a phrase.
///
/// # Errors
/// A phrase that cannot be read, or text compared as a number; the place is that of the whole phrase.
pub fn evaluate(phrase: &str, span: Span) -> Outcome<bool> {
    let words = split(phrase);
    let mut reader = LogicReader { words: &words, at: 0 };
    let result = reader.either(0).and_then(|value| match reader.peek() {
        None => Ok(value),
        Some(word) => Err(LogicError::Surplus(word.to_string())),
    });
    result.map_err(|why| {
        Diagnostic::error("the logical phrase cannot be evaluated", span)
            .label(why.to_string())
            .help(format!("read as: {}", words.join(" ")))
    })
}

/// Words of a phrase; an operator is a word of its own even when no blank stands before it.
fn split(phrase: &str) -> Vec<String> {
    let mut words = Vec::new();
    for raw in phrase.split([' ', '\t', ',']).filter(|w| !w.is_empty()) {
        let upper = raw.to_ascii_uppercase();
        let (mut from, mut at) = (0, 0);
        while at < raw.len() {
            let operator = upper.get(at..).and_then(|rest| OPERATORS.iter().find(|op| rest.starts_with(**op)));
            match operator {
                Some(operator) => {
                    operand(raw.get(from..at).unwrap_or_default(), &mut words);
                    words.push((*operator).to_string());
                    at += operator.len();
                    from = at;
                }
                None => at += 1,
            }
        }
        operand(raw.get(from..).unwrap_or_default(), &mut words);
    }
    words
}

/// Adds a word that holds no operator; the parentheses at its ends that it does not match itself are words of their own.
fn operand(mut word: &str, words: &mut Vec<String>) {
    let (mut open, mut surplus) = (0usize, 0usize);
    for character in word.chars() {
        match character {
            '(' => open += 1,
            ')' if open > 0 => open -= 1,
            ')' => surplus += 1,
            _ => {}
        }
    }
    while let Some(rest) = word.strip_prefix('(').filter(|_| open > 0) {
        words.push("(".into());
        (word, open) = (rest, open - 1);
    }
    let mut closing = 0;
    while let Some(rest) = word.strip_suffix(')').filter(|_| closing < surplus) {
        (word, closing) = (rest, closing + 1);
    }
    if !word.is_empty() {
        words.push(word.to_string());
    }
    words.extend(std::iter::repeat_n(")".to_string(), closing));
}

struct LogicReader<'a> {
    words: &'a [String],
    at: usize,
}

impl LogicReader<'_> {
    fn peek(&self) -> Option<&str> {
        self.words.get(self.at).map(String::as_str)
    }

    fn next_token(&mut self) -> Option<String> {
        let word = self.words.get(self.at).cloned();
        self.at += 1;
        word
    }

    fn either(&mut self, depth: usize) -> Result<bool, LogicError> {
        let mut value = self.both(depth)?;
        while self.peek() == Some(".OR.") {
            self.at += 1;
            value |= self.both(depth)?;
        }
        Ok(value)
    }

    fn both(&mut self, depth: usize) -> Result<bool, LogicError> {
        let mut value = self.parse_negation(depth)?;
        while self.peek() == Some(".AND.") {
            self.at += 1;
            value &= self.parse_negation(depth)?;
        }
        Ok(value)
    }

    fn parse_negation(&mut self, depth: usize) -> Result<bool, LogicError> {
        if depth > MAX_NESTING {
            return Err(LogicError::Nested);
        }
        match self.peek() {
            Some(".NOT.") => {
                self.at += 1;
                Ok(!self.parse_negation(depth + 1)?)
            }
            Some("(") => {
                self.at += 1;
                let value = self.either(depth + 1)?;
                match self.next_token().as_deref() {
                    Some(")") => Ok(value),
                    _ => Err(LogicError::Unclosed),
                }
            }
            _ => self.comparison(),
        }
    }

    fn comparison(&mut self) -> Result<bool, LogicError> {
        let is_comparison = |w: &str| matches!(w, ".EQ." | ".NE." | ".LT." | ".LE." | ".GT." | ".GE.");
        // a variable or function that came to nothing leaves its place empty: the null string
        let left = match self.peek() {
            Some(word) if is_comparison(word) => String::new(),
            _ => self.next_token().ok_or(LogicError::Missing)?,
        };
        let Some(operator) = self.peek().filter(|w| is_comparison(w)) else {
            return match left.as_str() {
                ".TRUE." => Ok(true),
                ".FALSE." => Ok(false),
                _ => Err(LogicError::NotLogical(left)),
            };
        };
        let operator = operator.to_string();
        self.at += 1;
        let right = match self.peek() {
            None | Some(".AND." | ".OR." | ")") => String::new(),
            Some(_) => self.next_token().unwrap_or_default(),
        };
        let numbers = (number::evaluate(&left), number::evaluate(&right));
        if let (Ok(a), Ok(b)) = numbers {
            return Ok(match operator.as_str() {
                ".EQ." => a == b,
                ".NE." => a != b,
                ".LT." => a < b,
                ".LE." => a <= b,
                ".GT." => a > b,
                _ => a >= b,
            });
        }
        match operator.as_str() {
            ".EQ." => Ok(left.eq_ignore_ascii_case(&right)),
            ".NE." => Ok(!left.eq_ignore_ascii_case(&right)),
            _ => {
                let text = if numbers.0.is_err() { left } else { right };
                Err(LogicError::NotANumber { operator, text })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is(phrase: &str) -> bool {
        evaluate(phrase, Span::default()).unwrap()
    }

    #[test]
    fn comparisons_follow_precedence() {
        assert!(is("1 .EQ. 1.0"));
        assert!(is("abc .eq. ABC"));
        assert!(is("2.EQ.2 .AND. .NOT. 1 .GT. 2"));
        assert!(is(".TRUE. .OR. .FALSE. .AND. .FALSE."));
        assert!(!is("( .TRUE. .OR. .FALSE. ) .AND. .FALSE."));
        assert!(is("2*3 .GE. 6"));
        assert!(is("A .NE. B"));
        assert!(is(".EQ. .AND. A .NE.") && !is(".EQ. X"));
    }

    #[test]
    fn parentheses_group_conditions_with_and_without_blanks() {
        assert!(is("(1 .EQ. 1)") && !is("(1 .EQ. 2)") && is("(3 .GT. 2)") && is("(.TRUE.)"));
        assert!(is("(2 .EQ. 3) .OR. (1 .EQ. 1)") && is("(1.EQ.2).OR.(1.EQ.1)"));
        assert!(!is("((1 .EQ. 1) .OR. .TRUE.) .AND. (.FALSE.)"));
        assert!(is(".NOT. (A .EQ. B)") && is(".NOT.(A.EQ.B)") && is("(A .EQ. ) .OR. ( .EQ. )"));
    }

    #[test]
    fn arithmetic_and_function_parentheses_stay_in_their_words() {
        assert!(is("(1+2)*3 .EQ. 9") && is("((1+2)*3 .EQ. 9)") && is("9 .EQ. 3*(1+2)"));
        assert!(is("(SQRT(16) .EQ. 4)") && is("(3*(1+2) .EQ. (4+5))") && is("((3) .GT. (2))"));
        for phrase in ["(1 .EQ. 1", "1 .EQ. 1)", "((1 .EQ. 1)", "1) .EQ. 1", "()"] {
            assert!(evaluate(phrase, Span::default()).is_err(), "{phrase}");
        }
    }

    #[test]
    fn incomparable_values_are_errors() {
        for phrase in ["", "A", "A .LT. 2", "1 .LT.", ".TRUE. .TRUE.", "( .TRUE."] {
            assert!(evaluate(phrase, Span::default()).is_err(), "{phrase}");
        }
        assert!(evaluate(&".NOT. ".repeat(100_000), Span::default()).is_err());
        assert!(evaluate(&"( ".repeat(100_000), Span::default()).is_err());
        assert!(evaluate(&"(".repeat(100_000), Span::default()).is_err());
    }
}
