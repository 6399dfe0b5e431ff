//! Numbers as Fortran-style arithmetic: `29000*0.1`, `37.51/1000`, `2**3**2`, `1.5D3`, `-(2+3)`.
//!
//! meval reads the expression and orders its operations; its named constants are not offered, so that a name typed for
//! a number is an error and never 2.718. The operations are then carried out one by one, so that a division by zero is
//! found even where the end result would be finite again.
//!
//! Source: [MOSES-REF lang_number]. `**` binds tighter than a sign and to the right, then `* /`, then `+ -`.

use meval::shunting_yard::to_rpn;
use meval::tokenizer::{Operation, Token, tokenize};
use std::f64::consts::FRAC_1_SQRT_2;

/// Longest expression taken (bytes).
const MAX_EXPRESSION_BYTES: usize = 4096;
/// Deepest nesting of parentheses taken.
const MAX_NESTING: usize = 200;

/// Why a word is not a number.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NumberError {
    /// The word is not an expression at all.
    #[error("this is not a number")]
    NotANumber,
    /// A character that has no place; its byte offset in the word.
    #[error("`{1}` has no place in a number")]
    Unexpected(usize, String),
    /// Parentheses do not match.
    #[error("the parentheses do not match")]
    Parentheses,
    /// Something is missing at the end.
    #[error("the expression ends too early")]
    Incomplete,
    /// Division by zero somewhere inside.
    #[error("division by zero")]
    DivisionByZero,
    /// An operation left the real, finite numbers.
    #[error("the result of {0} is not a finite real number")]
    NotFinite(&'static str),
    /// A name that is no function.
    #[error("unknown name `{0}` in an expression")]
    UnknownName(String),
    /// A function given the wrong number of arguments.
    #[error("{0} takes one argument")]
    Arguments(String),
    /// Longer or deeper than is taken.
    #[error(
        "the expression is too long or too deeply nested (at most {MAX_EXPRESSION_BYTES} characters, {MAX_NESTING} parentheses)"
    )]
    TooBig,
}

/// A function by name.
type Function = (&'static str, fn(f64) -> f64);

/// The functions an expression may call, all of one argument; angles in radians, `D` at the end for degrees.
pub const FUNCTIONS: &[Function] = &[
    ("SQRT", f64::sqrt),
    ("EXP", f64::exp),
    ("LN", f64::ln),
    ("LOG10", f64::log10),
    ("ABS", f64::abs),
    ("SIN", f64::sin),
    ("COS", f64::cos),
    ("TAN", f64::tan),
    ("ASIN", f64::asin),
    ("ACOS", f64::acos),
    ("ATAN", f64::atan),
    ("SIND", sine_of_degrees),
    ("COSD", cosine_of_degrees),
    ("TAND", tangent_of_degrees),
];

/// The sine of an angle in degrees, exact at the multiples of 30 and 90 where a double can be.
pub fn sine_of_degrees(angle: f64) -> f64 {
    // the remainder and both differences are exact
    let turn = angle.abs() % 360.0;
    let (half, sign) = if turn >= 180.0 { (turn - 180.0, -1.0) } else { (turn, 1.0) };
    let acute = if half > 90.0 { 180.0 - half } else { half };
    sign * angle.signum() * acute_sine(acute) + 0.0
}

/// The cosine of an angle in degrees, exact at the multiples of 60 and 90 where a double can be.
pub fn cosine_of_degrees(angle: f64) -> f64 {
    let turn = angle.abs() % 360.0;
    let half = if turn > 180.0 { 360.0 - turn } else { turn };
    if half > 90.0 { -acute_cosine(180.0 - half) } else { acute_cosine(half) }
}

/// The tangent of an angle in degrees; infinite at the odd multiples of 90, where it has no value.
pub fn tangent_of_degrees(angle: f64) -> f64 {
    sine_of_degrees(angle) / cosine_of_degrees(angle) + 0.0
}

/// The sine of 0 to 90 degrees, from the nearer of the two axes.
fn acute_sine(angle: f64) -> f64 {
    match angle {
        30.0 => 0.5,
        45.0 => FRAC_1_SQRT_2,
        small if small < 45.0 => small.to_radians().sin(),
        _ => (90.0 - angle).to_radians().cos(),
    }
}

/// The cosine of 0 to 90 degrees, from the nearer of the two axes.
fn acute_cosine(angle: f64) -> f64 {
    match angle {
        60.0 => 0.5,
        45.0 => FRAC_1_SQRT_2,
        small if small < 45.0 => small.to_radians().cos(),
        _ => (90.0 - angle).to_radians().sin(),
    }
}

/// The value of a word read as a number.
///
/// # Errors
/// [`NumberError`] when the word is no expression, or when an operation has no finite real result.
pub fn evaluate(word: &str) -> Result<f64, NumberError> {
    if let Some(value) = plain(word) {
        return if value.is_finite() { Ok(value) } else { Err(NumberError::NotFinite("reading it")) };
    }
    if word.len() > MAX_EXPRESSION_BYTES || word.bytes().filter(|b| *b == b'(').count() > MAX_NESTING {
        return Err(NumberError::TooBig);
    }
    let text = to_meval(word)?;
    let tokens = tokenize(&text).map_err(|error| match error {
        meval::ParseError::UnexpectedToken(_) => NumberError::NotANumber,
        meval::ParseError::MissingRParen(_) => NumberError::Parentheses,
        meval::ParseError::MissingArgument => NumberError::Incomplete,
    })?;
    let rpn = to_rpn(&tokens).map_err(|error| match error {
        meval::RPNError::MismatchedLParen(_) | meval::RPNError::MismatchedRParen(_) => NumberError::Parentheses,
        meval::RPNError::UnexpectedComma(_) => NumberError::NotANumber,
        meval::RPNError::NotEnoughOperands(_) | meval::RPNError::TooManyOperands => NumberError::Incomplete,
    })?;
    evaluate_tokens(&rpn)
}

/// A number without operations, the common case: digits, point, exponent with E or D.
fn plain(word: &str) -> Option<f64> {
    let digits = word.strip_prefix(['+', '-']).unwrap_or(word);
    if !digits.starts_with(|c: char| c.is_ascii_digit() || c == '.') {
        return None;
    }
    match word.parse::<f64>() {
        Ok(value) => Some(value),
        Err(_) if word.contains(['d', 'D']) => word.replace(['d', 'D'], "E").parse().ok(),
        Err(_) => None,
    }
}

/// Rewrites Fortran spelling to meval's: `**` to `^`, `.5` to `0.5`, D exponents to E, names to lower case.
fn to_meval(word: &str) -> Result<String, NumberError> {
    let bytes = word.as_bytes();
    let mut out = String::with_capacity(word.len() + 8);
    let mut at = 0;
    while let Some(&byte) = bytes.get(at) {
        if byte.is_ascii_digit() || byte == b'.' {
            let end = number_end(bytes, at);
            let literal = word.get(at..end).unwrap_or_default();
            let value = plain(literal).ok_or_else(|| NumberError::Unexpected(at, literal.to_string()))?;
            if !value.is_finite() {
                return Err(NumberError::NotFinite("reading it"));
            }
            out.push_str(&format!("{value:?}"));
            at = end;
        } else if byte.is_ascii_alphabetic() {
            let length = bytes.iter().skip(at).take_while(|b| b.is_ascii_alphanumeric() || **b == b'_').count();
            out.push_str(&word.get(at..at + length).unwrap_or_default().to_ascii_lowercase());
            at += length;
        } else if byte == b'*' && bytes.get(at + 1) == Some(&b'*') {
            out.push('^');
            at += 2;
        } else if b"+-*/()".contains(&byte) {
            out.push(char::from(byte));
            at += 1;
        } else {
            let odd = word.get(at..).and_then(|rest| rest.chars().next()).unwrap_or('?');
            return Err(NumberError::Unexpected(at, odd.to_string()));
        }
    }
    if out.is_empty() { Err(NumberError::NotANumber) } else { Ok(out) }
}

/// One past the last byte of the literal that starts at `start`: digits, a point, an exponent.
fn number_end(bytes: &[u8], start: usize) -> usize {
    let digits = |from: usize| from + bytes.iter().skip(from).take_while(|b| b.is_ascii_digit()).count();
    let mut end = digits(start);
    if bytes.get(end) == Some(&b'.') {
        end = digits(end + 1);
    }
    if bytes.get(end).is_some_and(|b| b"eEdD".contains(b)) {
        let signed = end + 1 + usize::from(bytes.get(end + 1).is_some_and(|b| b"+-".contains(b)));
        let exponent = digits(signed);
        if exponent > signed {
            end = exponent;
        }
    }
    end
}

/// Carries out the operations in meval's order, each result checked.
fn evaluate_tokens(rpn: &[Token]) -> Result<f64, NumberError> {
    let mut stack: Vec<f64> = Vec::with_capacity(rpn.len());
    for token in rpn {
        let value = match token {
            Token::Number(value) => *value,
            Token::Unary(operation) => {
                let x = stack.pop().ok_or(NumberError::Incomplete)?;
                if *operation == Operation::Minus { -x } else { x }
            }
            Token::Binary(operation) => {
                let right = stack.pop().ok_or(NumberError::Incomplete)?;
                let left = stack.pop().ok_or(NumberError::Incomplete)?;
                binary(*operation, left, right)?
            }
            Token::Func(name, Some(1)) => {
                let x = stack.pop().ok_or(NumberError::Incomplete)?;
                let (known, function) = FUNCTIONS
                    .iter()
                    .find(|(known, _)| known.eq_ignore_ascii_case(name))
                    .ok_or_else(|| NumberError::UnknownName(name.to_ascii_uppercase()))?;
                finite(function(x), known)?
            }
            Token::Func(name, _) => return Err(NumberError::Arguments(name.to_ascii_uppercase())),
            Token::Var(name) => return Err(NumberError::UnknownName(name.to_ascii_uppercase())),
            Token::LParen | Token::RParen | Token::Comma => return Err(NumberError::Parentheses),
        };
        stack.push(value);
    }
    match stack.as_slice() {
        [value] => Ok(*value),
        _ => Err(NumberError::Incomplete),
    }
}

fn binary(operation: Operation, left: f64, right: f64) -> Result<f64, NumberError> {
    match operation {
        Operation::Plus => finite(left + right, "+"),
        Operation::Minus => finite(left - right, "-"),
        Operation::Times => finite(left * right, "*"),
        Operation::Div if right == 0.0 => Err(NumberError::DivisionByZero),
        Operation::Div => finite(left / right, "/"),
        Operation::Pow if left == 0.0 && right < 0.0 => Err(NumberError::DivisionByZero),
        Operation::Pow => finite(left.powf(right), "**"),
        Operation::Rem => Err(NumberError::NotANumber),
    }
}

fn finite(value: f64, by: &'static str) -> Result<f64, NumberError> {
    if value.is_finite() { Ok(value) } else { Err(NumberError::NotFinite(by)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_follow_fortran_spelling_and_precedence() {
        for (text, want) in [
            ("29000*0.1", 2900.0),
            ("37.51/1000", 0.03751),
            ("-2**2", -4.0),
            ("2**3**2", 512.0),
            ("(2+3)**8/2.", 195_312.5),
            ("1.5E-3", 0.0015),
            ("1.5D3", 1500.0),
            ("2*1.5d0", 3.0),
            (".5", 0.5),
            (".5*.5", 0.25),
            ("-(2+3)", -5.0),
            ("+4", 4.0),
            ("2*-3", -6.0),
            ("1+1*2", 3.0),
            ("SQRT(16)*2", 8.0),
            ("sind(30)", 0.5),
            ("20*2000", 40_000.0),
        ] {
            let got = evaluate(text).unwrap();
            assert!((got - want).abs() <= 1e-12 * want.abs(), "{text} gave {got}, not {want}");
        }
    }

    #[test]
    fn degrees_are_exact_at_quarters_and_representable_values() {
        for (text, want) in [
            ("SIND(180)", 0.0),
            ("SIND(-360)", 0.0),
            ("SIND(270)", -1.0),
            ("SIND(-90)", -1.0),
            ("SIND(30)", 0.5),
            ("SIND(150)", 0.5),
            ("SIND(-390)", -0.5),
            ("COSD(90)", 0.0),
            ("COSD(-270)", 0.0),
            ("COSD(180)", -1.0),
            ("COSD(60)", 0.5),
            ("COSD(240)", -0.5),
            ("COSD(360000060)", 0.5),
            ("TAND(45)", 1.0),
            ("TAND(135)", -1.0),
            ("TAND(180)", 0.0),
        ] {
            let got = evaluate(text).unwrap();
            assert!(got == want && (got != 0.0 || got.is_sign_positive()), "{text} gave {got}, not {want}");
        }
        for text in ["TAND(90)", "TAND(-90)", "TAND(270)", "TAND(450)"] {
            assert_eq!(evaluate(text), Err(NumberError::NotFinite("TAND")), "{text}");
        }
    }

    #[test]
    fn degrees_agree_with_radians_over_full_circle() {
        for tenth in -8000..8000 {
            let degrees = f64::from(tenth) / 10.0 + 0.03;
            let radians = degrees.to_radians();
            assert!((sine_of_degrees(degrees) - radians.sin()).abs() < 5e-15, "{degrees}");
            assert!((cosine_of_degrees(degrees) - radians.cos()).abs() < 5e-15, "{degrees}");
        }
    }

    #[test]
    fn names_cannot_be_constants() {
        for text in ["e", "pi", "E", "2*e", "inf", "nan", "infinity", "NaN"] {
            assert!(evaluate(text).is_err(), "{text} was read as a number");
        }
    }

    #[test]
    fn division_by_zero_is_found_inside_finite_result() {
        assert_eq!(evaluate("1/0"), Err(NumberError::DivisionByZero));
        assert_eq!(evaluate("5/(1/0)"), Err(NumberError::DivisionByZero));
        assert_eq!(evaluate("0/0"), Err(NumberError::DivisionByZero));
        assert!(matches!(evaluate("(-8)**0.5"), Err(NumberError::NotFinite(_))));
        assert!(matches!(evaluate("9**9**9**9"), Err(NumberError::NotFinite(_))));
        assert!(matches!(evaluate("1E400"), Err(NumberError::NotFinite(_))));
    }

    #[test]
    fn invalid_expression_is_error_and_never_panics() {
        for text in ["", " ", "\t", "(", ")", "1+", "*", "2 3", "1..2", "1e", "2^3", "7%3", "abc", "1,2", "é", "()"] {
            assert!(evaluate(text).is_err(), "{text:?} was read as a number");
        }
        assert_eq!(evaluate(&"(".repeat(10_000)), Err(NumberError::TooBig));
    }
}
