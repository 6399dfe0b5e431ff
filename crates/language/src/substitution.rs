//! Textual substitution before a record is read: `%VAR%`, `%VAR`, `%(VAR)` and string functions `&NAME(...)`.
//!
//! Source: [MOSES-REF lang_local, lang_sfun]. The text put in is not looked at again, so that no value can make
//! the interpreter run in circles.

use super::functions;
use super::record::{LONGEST_RECORD, Record, Word};
use super::select::{self, Owner, SearchResult};
use super::variables::Variables;
use windlass_base::diagnostic::{Diagnostic, Outcome, did_you_mean};
use windlass_base::span::Span;

/// Stands for a value that a check of a script cannot know, as nothing is solved in it. A function of it is not known either.
pub const UNKNOWN: &str = "\u{FFFC}";

/// Deepest nesting of functions within functions.
const MAX_NESTING: usize = 32;

/// What the floors above the language answer: string functions about the model and the session.
pub trait FunctionHost {
    /// Names of the functions answered here, without `&`.
    fn function_names(&self) -> &'static [&'static str];

    /// The value of a function; `words` are its arguments.
    ///
    /// # Errors
    /// Whatever is wrong with the arguments, at their place.
    fn function(&mut self, name: &str, words: &[Word], span: Span) -> Outcome<String>;

    /// Whether a script is only checked: what is solved for is [`UNKNOWN`].
    fn is_checking(&self) -> bool {
        false
    }

    /// The menus in which a command keeps a macro of this name from being called, empty for every menu; `None` when
    /// there is no such command.
    fn menus_of_command(&self, _: &str) -> Option<Vec<&'static str>> {
        None
    }

    /// Variables that functions have set since the last call: name and value.
    fn assignments(&mut self) -> Vec<(String, String)> {
        Vec::new()
    }
}

/// A world without functions, for a language used on its own.
pub struct NoFunctions;

impl FunctionHost for NoFunctions {
    fn function_names(&self) -> &'static [&'static str] {
        &[]
    }

    fn function(&mut self, name: &str, _: &[Word], span: Span) -> Outcome<String> {
        Err(Diagnostic::error(format!("unknown function &{name}"), span))
    }
}

/// A record with every variable and function replaced.
///
/// # Errors
/// An undefined variable, an unknown function or wrong arguments, unbalanced parentheses, a result that is too long.
pub fn substitute(record: &Record, variables: &Variables, world: &mut dyn FunctionHost) -> Outcome<Record> {
    let text = record.text();
    if !text.contains('%') && !text.contains('&') {
        return Ok(record.clone());
    }
    if !text.contains('%') && !text.contains('(') {
        return Ok(record.clone());
    }
    expand(record, variables, world, 0)
}

fn expand(record: &Record, variables: &Variables, world: &mut dyn FunctionHost, depth: usize) -> Outcome<Record> {
    let text = record.text();
    let mut out = Record::default();
    let mut kept = 0;
    let mut at = 0;
    while let Some(found) = text.get(at..).and_then(|rest| rest.find(['%', '&'])) {
        let mark = at + found;
        let end = if text[mark..].starts_with('%') {
            variable(record, mark, kept, &mut out, variables)?
        } else {
            function(record, mark, kept, &mut out, variables, world, depth)?
        };
        match end {
            Some(end) => {
                kept = end;
                at = end;
            }
            None => at = mark + 1,
        }
        if out.text().len() > LONGEST_RECORD {
            return Err(Diagnostic::error("the record is too long after substitution", record.whole()));
        }
    }
    out.push_range(record, kept..text.len());
    Ok(out)
}

fn name_length(text: &str) -> usize {
    text.bytes().take_while(|b| b.is_ascii_alphanumeric() || *b == b'_').count()
}

/// Replaces the variable at `mark`; returns where the text goes on, `None` when the `%` is only a character.
fn variable(
    record: &Record,
    mark: usize,
    kept: usize,
    out: &mut Record,
    variables: &Variables,
) -> Outcome<Option<usize>> {
    let text = record.text();
    let rest = text.get(mark + 1..).unwrap_or_default();
    let (name, end) = if rest.starts_with('(') {
        let Some(close) = rest.find(')') else {
            return Err(Diagnostic::error("`%(` without its `)`", record.span(mark..mark + 2)));
        };
        let (inner, close) = match rest.get(1..close).and_then(|s| s.find("%(").map(|_| ())) {
            // one level of recursion: %(A%(B))
            Some(()) => {
                let second = rest.get(close + 1..).and_then(|s| s.find(')')).map(|i| close + 1 + i);
                let Some(second) = second else {
                    return Err(Diagnostic::error("`%(` without its `)`", record.span(mark..mark + 2)));
                };
                (rest.get(1..second).unwrap_or_default(), second)
            }
            None => (rest.get(1..close).unwrap_or_default(), close),
        };
        (inner_name(record, mark, inner, variables)?, mark + 1 + close + 1)
    } else {
        let length = name_length(rest);
        if length == 0 {
            return Ok(None);
        }
        let closed = rest.as_bytes().get(length) == Some(&b'%');
        (rest.get(..length).unwrap_or_default().to_string(), mark + 1 + length + usize::from(closed))
    };
    let span = record.span(mark..end);
    let Some(value) = variables.get(&name) else {
        let mut error = Diagnostic::error(format!("undefined variable {name}"), span);
        error.help.extend(did_you_mean(&name, variables.names()));
        return Err(error);
    };
    out.push_range(record, kept..mark);
    out.push_replaced(value, span);
    Ok(Some(end))
}

/// The name inside `%( )`, in which one further variable may stand.
fn inner_name(record: &Record, mark: usize, inner: &str, variables: &Variables) -> Outcome<String> {
    let Some(at) = inner.find('%') else { return Ok(inner.trim().to_string()) };
    let rest = inner.get(at + 1..).unwrap_or_default();
    let (name, after) = match rest.strip_prefix('(') {
        Some(body) => {
            let close = body.find(')').unwrap_or(body.len());
            (body.get(..close).unwrap_or_default(), body.get(close + 1..).unwrap_or_default())
        }
        None => {
            let length = name_length(rest);
            let after = rest.get(length..).unwrap_or_default();
            (rest.get(..length).unwrap_or_default(), after.strip_prefix('%').unwrap_or(after))
        }
    };
    let span = record.span(mark..mark + inner.len() + 2);
    let value = variables.get(name).ok_or_else(|| Diagnostic::error(format!("undefined variable {name}"), span))?;
    Ok(format!("{}{value}{after}", inner.get(..at).unwrap_or_default()).trim().to_string())
}

/// Replaces the function at `mark`; `None` when the `&` begins no function call.
fn function(
    record: &Record,
    mark: usize,
    kept: usize,
    out: &mut Record,
    variables: &Variables,
    world: &mut dyn FunctionHost,
    depth: usize,
) -> Outcome<Option<usize>> {
    let text = record.text();
    let rest = text.get(mark + 1..).unwrap_or_default();
    let length = name_length(rest);
    let follows_word = text.get(..mark).is_some_and(|head| head.ends_with(|c: char| c.is_alphanumeric()));
    if length == 0 || follows_word || rest.as_bytes().get(length) != Some(&b'(') {
        return Ok(None);
    }
    let name = rest.get(..length).unwrap_or_default();
    let open = mark + 1 + length;
    let Some(close) = closing(text, open) else {
        return Err(Diagnostic::error(format!("&{name}( without its `)`"), record.span(mark..open + 1)));
    };
    let span = record.span(mark..close + 1);
    if depth >= MAX_NESTING {
        return Err(Diagnostic::error(format!("functions are nested deeper than {MAX_NESTING}"), span));
    }
    let known = functions::NAMES.iter().chain(world.function_names()).map(|n| (*n, Owner::Moses, *n));
    let name = match select::keyword(name, known.clone()) {
        SearchResult::One(name) => name,
        _ if mark == text.len() - text.trim_start().len() => return Ok(None),
        SearchResult::Several(list) => {
            return Err(Diagnostic::error(format!("ambiguous function &{name}"), span)
                .label(format!("could be &{}", list.join(", &"))));
        }
        SearchResult::None => {
            let mut error = Diagnostic::error(format!("unknown function &{name}"), span);
            error.help.extend(did_you_mean(name, known.map(|(n, _, _)| n)));
            return Err(error);
        }
    };
    let mut arguments = Record::default();
    arguments.push_range(record, open + 1..close);
    let arguments = expand(&arguments, variables, world, depth + 1)?;
    let words = arguments.words();
    if world.is_checking() && arguments.text().contains(UNKNOWN) {
        out.push_range(record, kept..mark);
        out.push_replaced(UNKNOWN, span);
        return Ok(Some(close + 1));
    }
    let value = match functions::call(name, &arguments, &words, variables, span) {
        Some(result) => result?,
        None => world.function(name, &words, span)?,
    };
    out.push_range(record, kept..mark);
    out.push_replaced(&value, span);
    Ok(Some(close + 1))
}

/// The parenthesis that closes the one at `open`.
fn closing(text: &str, open: usize) -> Option<usize> {
    let mut depth = 0usize;
    for (index, byte) in text.bytes().enumerate().skip(open) {
        match byte {
            b'(' => depth += 1,
            b')' => {
                depth -= 1;
                if depth == 0 {
                    return Some(index);
                }
            }
            _ => {}
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(text: &str) -> Outcome<String> {
        let mut variables = Variables::default();
        for (name, value) in [("DOG", "20"), ("CAT", "20*2000"), ("I", "3"), ("P3", "third"), ("SUM", "1+1")] {
            variables.set(name, value).unwrap();
        }
        let record = Record::verbatim(text, Span::new(Default::default(), 0, text.len()));
        substitute(&record, &variables, &mut NoFunctions).map(|r| r.text().to_string())
    }

    #[test]
    fn three_substitution_forms_of_reference_are_replaced() {
        assert_eq!(run("%DOG%A %(DOG)A %DOG, x").unwrap(), "20A 20A 20, x");
        assert_eq!(run("%CAT").unwrap(), "20*2000");
        assert_eq!(run("%(P%I)").unwrap(), "third");
        assert_eq!(run("%(P%(I))").unwrap(), "third");
        assert_eq!(run("%SUM%*2").unwrap(), "1+1*2");
        assert_eq!(run("50% of it").unwrap(), "50% of it");
    }

    #[test]
    fn functions_nest_and_collapse_expressions() {
        assert_eq!(run("&NUMBER(REAL (%SUM%)*2)").unwrap(), "4");
        assert_eq!(run("a&NUMBER(REAL 1)").unwrap(), "a&NUMBER(REAL 1)");
        assert_eq!(run("x &NUMBER(MAX 1 &NUMBER(REAL 2*3) 4)").unwrap(), "x 6");
    }

    #[test]
    fn unknown_variable_is_error() {
        assert!(run("%NONE").unwrap_err().message.contains("undefined variable NONE"));
        assert!(run("x &NONSENSE(1)").unwrap_err().message.contains("unknown function"));
        assert!(run("x &NUMBER(REAL 1").unwrap_err().message.contains("without its"));
        let deep = format!("x {}1{}", "&NUMBER(REAL ".repeat(10_000), ")".repeat(10_000));
        assert!(run(&deep).is_err());
    }
}
