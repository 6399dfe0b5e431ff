//! The coverage list: every test it names exists, ids are unique and stand under their source, and what is said to be shown is shown
//! by more than windlass's own output. It prints how many items there are of each state.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

const SOURCES: [&str; 11] = [
    "MOSES-FLEX",
    "MOSES-REF",
    "AQWA-CONN",
    "AQWA-TETHER",
    "AQWA-REF",
    "MAP-PP",
    "ORCAFLEX-A01",
    "MOORDYN-2",
    "API-RP-2SK",
    "API-RP-2SM",
    "GUMBEL-1958",
];
const STATES: [&str; 3] = ["shown", "unshown", "refused"];
/// Where the number of a test may come from.
const MAKERS: [&str; 6] = ["closed form", "listing", "published case", "other program", "refusal", "rule"];

fn sources(folder: &Path, list: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap().flatten() {
        let path = entry.path();
        if path.is_dir() {
            sources(&path, list);
        } else if path.extension().is_some_and(|e| e == "rs") {
            list.push(path);
        }
    }
}

/// Whether a test of this name stands in a file of this name.
fn exists(test: &str, files: &[(String, String)]) -> bool {
    let Some((file, name)) = test.split_once("::") else { return false };
    match file {
        "golden" => {
            Path::new(&format!("tests/golden/{name}.txt")).exists()
                && (name == "study"
                    || ["cif", "dat"].iter().any(|end| Path::new(&format!("scripts/{name}.{end}")).exists()))
        }
        "errors" => Path::new(&format!("tests/errors/{name}.cif")).exists(),
        _ => files.iter().any(|(stem, text)| {
            stem == file
                && text.match_indices(&format!("fn {name}()")).any(|(at, _)| text[..at].trim_end().ends_with("#[test]"))
        }),
    }
}

/// What is wrong with an item.
fn faults(item: &toml::Value, files: &[(String, String)]) -> Vec<String> {
    let text = |key: &str| item.get(key).and_then(|v| v.as_str()).unwrap_or_default();
    let (id, source, state) = (text("id"), text("source"), text("state"));
    let mut wrong = Vec::new();
    for key in ["section", "kind", "what"] {
        if text(key).is_empty() {
            wrong.push(format!("{id} lacks {key}"));
        }
    }
    if !SOURCES.contains(&source) || !id.starts_with(&format!("{source}.")) {
        wrong.push(format!("{id} stands under no key of a source"));
    }
    let tests: Vec<&str> = item["tests"].as_array().unwrap().iter().map(|v| v.as_str().unwrap()).collect();
    wrong.extend(tests.iter().filter(|t| !exists(t, files)).map(|t| format!("{id}: there is no test {t}")));
    match state {
        "shown" => {
            if !MAKERS.contains(&text("by")) {
                wrong.push(format!("{id} does not say who made its number"));
            }
            if tests.iter().all(|t| t.starts_with("golden::")) {
                wrong.push(format!("{id} is said to be shown by windlass's own output"));
            }
        }
        "refused" if !tests.iter().any(|t| t.starts_with("errors::")) => {
            wrong.push(format!("{id} is said to be refused and has no error script"));
        }
        "unshown" if text("remark").is_empty() => wrong.push(format!("{id} does not say what is missing")),
        _ if STATES.contains(&state) => {}
        _ => wrong.push(format!("{id}: there is no state `{state}`")),
    }
    wrong
}

#[test]
fn coverage_list_names_existing_tests_and_valid_states() {
    let list: toml::Table = toml::from_str(&fs::read_to_string("tests/coverage.toml").unwrap()).unwrap();
    let mut paths = Vec::new();
    for folder in ["tests", "src", "crates"] {
        sources(Path::new(folder), &mut paths);
    }
    let files: Vec<(String, String)> = paths
        .iter()
        .map(|p| (p.file_stem().unwrap().to_string_lossy().into_owned(), fs::read_to_string(p).unwrap()))
        .collect();
    let mut ids = BTreeSet::new();
    let mut counts: BTreeMap<&str, BTreeMap<&str, usize>> = BTreeMap::new();
    let mut wrong = Vec::new();
    for item in list["item"].as_array().unwrap() {
        let text = |key: &str| item.get(key).and_then(|v| v.as_str()).unwrap_or_default();
        if !ids.insert(text("id")) {
            wrong.push(format!("{} stands twice", text("id")));
        }
        *counts.entry(text("source")).or_default().entry(text("state")).or_default() += 1;
        wrong.extend(faults(item, &files));
    }
    // past the capture of the test runner, which shows what is printed of failed tests alone
    let mut out = std::io::stdout();
    for (source, states) in counts {
        let count = |state: &&str| format!("{} {state}", states.get(*state).copied().unwrap_or(0));
        writeln!(out, "coverage of {source}: {}", STATES.iter().map(count).collect::<Vec<_>>().join(", ")).unwrap();
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
