//! Citations: every key cited stands in docs/bibliography.md, and nothing cites what a reader does not have.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

const BIBLIOGRAPHY: &str = "docs/bibliography.md";

/// The text files of the tree, without what is built or found at run time.
fn texts(folder: &Path, list: &mut Vec<(PathBuf, String)>) {
    for entry in fs::read_dir(folder).unwrap().flatten() {
        let path = entry.path();
        let name = entry.file_name();
        if path.is_dir() {
            if !["target", ".git", "artifacts", "coverage"].iter().any(|built| name == *built) {
                texts(&path, list);
            }
        } else if let Ok(text) = fs::read_to_string(&path) {
            list.push((path.strip_prefix(".").unwrap_or(&path).to_path_buf(), text));
        }
    }
}

fn tree() -> Vec<(PathBuf, String)> {
    let mut list = Vec::new();
    texts(Path::new("."), &mut list);
    list
}

/// The key that a text begins with, as `AQWA-TETHER`: capitals and digits in parts joined by hyphens.
fn key(text: &str) -> Option<&str> {
    let end = text.find(|c: char| !(c.is_ascii_uppercase() || c.is_ascii_digit() || c == '-'))?;
    let key = &text[..end];
    let ends = text[end..].starts_with([' ', ']', ';', ',', '\n']);
    let mut parts = key.split('-');
    let first = parts.next()?;
    let begins = first == "W" || first.len() > 1 && first.starts_with(|c: char| c.is_ascii_uppercase());
    let rest: Vec<&str> = parts.collect();
    (ends && begins && !rest.is_empty() && rest.iter().all(|part| !part.is_empty())).then_some(key)
}

/// The keys of the citations of a text: `[KEY place]` or `[KEY place; KEY place]`.
fn find_citations(text: &str) -> Vec<&str> {
    let inside = text.match_indices('[').filter_map(|(at, _)| {
        let rest = &text[at + 1..];
        key(rest).and(rest.find(']').map(|end| &rest[..=end]))
    });
    let margin = |c: char| c.is_whitespace() || ['/', '!', '$', '#'].contains(&c);
    inside.flat_map(|all| all.split(';').filter_map(move |one| key(one.trim_start_matches(margin)))).collect()
}

fn bibliography() -> Vec<String> {
    let text = fs::read_to_string(BIBLIOGRAPHY).unwrap();
    let entries = text.lines().filter_map(|line| line.strip_prefix("- **["));
    entries.map(|entry| key(entry).unwrap_or_else(|| panic!("no key begins `{entry}`")).to_string()).collect()
}

#[test]
fn every_cited_key_is_in_the_bibliography() {
    let keys: BTreeSet<String> = bibliography().into_iter().collect();
    assert_eq!(keys.len(), bibliography().len(), "a key stands twice");
    let mut missing = BTreeSet::new();
    let mut count = 0;
    for (path, text) in tree() {
        for key in find_citations(&text) {
            count += 1;
            if !keys.contains(key) {
                missing.insert(format!("{}: [{key}]", path.display()));
            }
        }
    }
    assert!(count > 300, "only {count} citations are found");
    assert!(missing.is_empty(), "not in {BIBLIOGRAPHY}:\n{}", missing.into_iter().collect::<Vec<_>>().join("\n"));
}

/// Whether a text has `issue` or `issues` with a number behind it.
fn numbers_an_issue(line: &str) -> bool {
    line.match_indices("issue").any(|(at, word)| {
        let before = line[..at].chars().next_back();
        let rest = &line[at + word.len()..];
        let rest = rest.strip_prefix('s').unwrap_or(rest);
        let rest = rest.strip_prefix(" #").or(rest.strip_prefix(' '));
        before.is_none_or(|c| !c.is_alphanumeric()) && rest.is_some_and(|r| r.starts_with(|c: char| c.is_ascii_digit()))
    })
}

#[test]
fn no_file_cites_unpublished_documents() {
    // put together here, so that this file has none of them
    let pages = ["model", "solve", "language", "aqwa-cards", "moses-commands", "studies", "diffraction", "ecosystem"];
    let pages = pages.map(|page| format!("reference/{page}"));
    let folders = ["shared", "validation"].map(|folder| format!("{folder}/"));
    let others =
        [["seed", " 00"].concat(), ["seeds", " 00"].concat(), ["seed", "_00"].concat(), ["design", ".md"].concat()];
    let mut found = Vec::new();
    for (path, text) in tree() {
        let manual = path.starts_with("docs");
        for (number, line) in text.lines().enumerate() {
            let small = line.to_lowercase();
            let has = |words: &[String]| words.iter().any(|word| small.contains(word));
            let page = !manual && has(&pages) && !small.contains("docs/reference/");
            if page || has(&folders) || has(&others) || numbers_an_issue(&small) {
                found.push(format!("{}:{}: {}", path.display(), number + 1, line.trim()));
            }
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// The sources of a crate and its tests, all together.
fn crate_text(folder: &str) -> String {
    let wanted: Vec<_> = ["src", "tests"].map(|part| PathBuf::from(folder).join(part)).into();
    let here = |path: &PathBuf| wanted.iter().any(|part| path.starts_with(part));
    tree().into_iter().filter(|(path, _)| here(path)).map(|(_, text)| text).collect()
}

#[test]
fn tests_named_in_theory_and_verification_exist() {
    let mut wrong = Vec::new();
    for (path, text) in tree().into_iter().filter(|(path, _)| path.starts_with("docs/theory")) {
        for command in text.split('`').filter(|code| code.starts_with("cargo test -p ")) {
            let words: Vec<&str> = command.split_whitespace().skip(3).collect();
            let folder = match words[0].strip_prefix("windlass-") {
                Some(name) => format!("crates/{name}"),
                None => String::new(),
            };
            let text = crate_text(&folder);
            let filters = words[1..]
                .iter()
                .filter(|w| !w.starts_with('-') && !["it", "contract", "golden", "errors"].contains(*w));
            for part in filters.flat_map(|filter| filter.split("::")) {
                let is_module = text.contains(&format!("mod {part};")) || text.contains(&format!("mod {part} {{"));
                let is_test = text.lines().any(|line| line.trim_start().starts_with("fn ") && line.contains(part));
                if !is_module && !is_test {
                    wrong.push(format!("{}: {command}: no {part}", path.display()));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn files_named_in_architecture_exist() {
    let text = fs::read_to_string("ARCHITECTURE.md").unwrap();
    let code = text.split('`').skip(1).step_by(2);
    let folders = ["crates/", "src/", "docs/", "share/", "tests/", "scripts/"];
    let paths: Vec<&str> = code.filter(|word| folders.iter().any(|folder| word.starts_with(folder))).collect();
    assert!(paths.len() > 100, "{}", paths.len());
    let lost: Vec<&&str> = paths.iter().filter(|path| !Path::new(path).exists()).collect();
    assert!(lost.is_empty(), "ARCHITECTURE.md names files that are not there: {lost:?}");
}
