//! Keys of values are made while compiling: in a `const { }` block or in a constant. A key made elsewhere would compile with any
//! name, and panic where a record is read.

use std::fs;
use std::path::{Path, PathBuf};

/// The functions of declarations that find a value by its name.
const MAKERS: [&str; 5] = ["number", "numbers", "integer", "word", "choice"];

fn sources(folder: &Path, list: &mut Vec<(PathBuf, String)>) {
    for entry in fs::read_dir(folder).unwrap().flatten() {
        let path = entry.path();
        if path.is_dir() {
            sources(&path, list);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let text = fs::read_to_string(&path).unwrap();
            list.push((path, text));
        }
    }
}

/// The places where a declaration, a constant in capitals, is asked for a key.
fn makers(text: &str) -> Vec<usize> {
    let mut found = Vec::new();
    for maker in MAKERS {
        for (at, _) in text.match_indices(&format!(".{maker}")) {
            let rest = &text[at + 1 + maker.len()..];
            let called = rest.starts_with('(') || rest.starts_with("::<");
            let before = text[..at].trim_end();
            let receiver = before.rsplit(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or_default();
            let capitals = receiver.chars().all(|c| c.is_ascii_uppercase() || c.is_ascii_digit() || c == '_');
            if called && capitals && receiver.starts_with(|c: char| c.is_ascii_uppercase()) {
                found.push(at);
            }
        }
        let by_type = text.match_indices("DatumKey::").map(|(at, key)| (at, &text[at + key.len()..]));
        found.extend(by_type.filter(|(_, rest)| rest.starts_with(&format!("{maker}("))).map(|(at, _)| at));
    }
    found
}

/// Whether a statement is a constant: its text from its beginning to a place within it.
fn is_constant(statement: &str) -> bool {
    statement.lines().any(|line| {
        let line = line.trim_start();
        let line = line.strip_prefix("pub(crate) ").or(line.strip_prefix("pub(super) ")).unwrap_or(line);
        let line = line.strip_prefix("pub ").unwrap_or(line);
        line.starts_with("static ") || line.strip_prefix("const ").is_some_and(|rest| !rest.starts_with("fn"))
    })
}

/// Whether a place lies in a `const { }` block, or in the value of a constant.
fn is_const(text: &str, position: usize) -> bool {
    let mut closed = 0;
    let mut end_of_statement = None;
    for (at, c) in text[..position].char_indices().rev() {
        match c {
            '}' | ')' | ']' => closed += 1,
            '{' | '(' | '[' if closed > 0 => closed -= 1,
            '{' if text[..at].trim_end().ends_with("const") => return true,
            ';' | '{' if closed == 0 => end_of_statement = end_of_statement.or(Some(at)),
            _ => {}
        }
        if closed == 1 && c == '}' {
            end_of_statement = end_of_statement.or(Some(at));
        }
    }
    is_constant(&text[end_of_statement.map_or(0, |at| at + 1)..position])
}

#[test]
fn value_keys_are_made_while_compiling() {
    let mut list = Vec::new();
    for folder in ["src", "crates"] {
        sources(Path::new(folder), &mut list);
    }
    let mut count = 0;
    let mut found = Vec::new();
    // what makes keys of a declaration's own values
    let makes = |path: &Path| path.ends_with("base/src/spec.rs") || path.ends_with("language/src/spec.rs");
    for (path, text) in list.iter().filter(|(path, _)| !makes(path)) {
        for position in makers(text) {
            count += 1;
            if !is_const(text, position) {
                let line = text[..position].lines().count();
                found.push(format!("{}:{line}", path.display()));
            }
        }
    }
    assert!(count > 100, "only {count} keys are found");
    assert!(found.is_empty(), "keys outside `const {{ }}`:\n{}", found.join("\n"));
}

#[test]
fn choices_are_declared_by_their_enum() {
    let mut list = Vec::new();
    for folder in ["src", "crates"] {
        sources(Path::new(folder), &mut list);
    }
    let spelt = |text: &str| text.contains("Kind::Choice(&") || text.contains("Kind::Choice([");
    let found: Vec<_> = list.iter().filter(|(_, text)| spelt(text)).map(|(path, _)| path.display()).collect();
    assert!(found.is_empty(), "{found:?} spell out words: ValueSpec::choice takes those of an enum");
}

#[test]
fn key_outside_const_is_found() {
    let is = |text: &str| makers(text).into_iter().map(|position| is_const(text, position)).collect::<Vec<_>>();
    assert_eq!(is("fn f() { given.number(const { TIME.number(\"T\") }) }"), [true]);
    assert_eq!(is("const T: ValueKey<f64> = TIME.number(\"T\");"), [true]);
    assert_eq!(is("fn f() {\n    const T: [X; 2] = [A, TIME\n        .number(\"T\")];\n}"), [true]);
    assert_eq!(is("fn f() { given.number(TIME.number(\"T\")) }"), [false]);
    assert_eq!(is("const X: DatumKey<f64> = DatumKey::number(DATA, \"X\");"), [true]);
    assert_eq!(is("fn f() { args.number(DatumKey::number(DATA, \"X\")) }"), [false]);
    assert_eq!(is("const A: X = 1;\nfn f() { let t = { TIME.choice::<Sense>(\"T\") }; }"), [false]);
    assert_eq!(is("fn f() { let x = const { 1 }; given.number(TIME.number(\"T\")) }"), [false]);
}
