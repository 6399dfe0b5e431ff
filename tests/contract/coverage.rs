//! The coverage list: every test it names exists, ids are unique, and every item of a closed issue has a test.

#![allow(clippy::unwrap_used)]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

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
                && Path::new(&format!("scripts/{name}.cif")).exists()
        }
        "errors" => Path::new(&format!("tests/errors/{name}.cif")).exists(),
        _ => files.iter().any(|(stem, text)| {
            stem == file
                && text.match_indices(&format!("fn {name}()")).any(|(at, _)| text[..at].trim_end().ends_with("#[test]"))
        }),
    }
}

#[test]
fn every_test_named_by_the_coverage_list_exists_and_closed_issues_have_all_of_theirs() {
    let list: toml::Table = toml::from_str(&fs::read_to_string("tests/coverage.toml").unwrap()).unwrap();
    let closed: Vec<i64> = list["closed"].as_array().unwrap().iter().map(|v| v.as_integer().unwrap()).collect();
    let mut paths = Vec::new();
    sources(Path::new("tests"), &mut paths);
    for folder in ["src", "crates"] {
        sources(Path::new(folder), &mut paths);
    }
    let files: Vec<(String, String)> = paths
        .iter()
        .map(|p| (p.file_stem().unwrap().to_string_lossy().into_owned(), fs::read_to_string(p).unwrap()))
        .collect();
    let mut ids = BTreeSet::new();
    let mut wrong = Vec::new();
    for item in list["item"].as_array().unwrap() {
        let id = item["id"].as_str().unwrap();
        if !ids.insert(id) {
            wrong.push(format!("{id} stands twice"));
        }
        for key in ["seed", "section", "kind", "what"] {
            assert!(item.get(key).and_then(|v| v.as_str()).is_some_and(|s| !s.is_empty()), "{id} lacks {key}");
        }
        let issue = item["issue"].as_integer().unwrap();
        assert!((2..=7).contains(&issue), "{id}: there is no issue {issue}");
        let tests: Vec<&str> = item
            .get("tests")
            .and_then(|t| t.as_array())
            .map(|t| t.iter().map(|v| v.as_str().unwrap()).collect())
            .unwrap_or_default();
        wrong.extend(tests.iter().filter(|t| !exists(t, &files)).map(|t| format!("{id}: there is no test {t}")));
        if closed.contains(&issue) && tests.is_empty() {
            wrong.push(format!("{id} belongs to issue {issue}, which is closed, and has no test"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
