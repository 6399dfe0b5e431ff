//! The house: no file of a floor uses a floor above it. Read from the sources themselves.

#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::{Path, PathBuf};

/// The floors from top to bottom; a floor may use those below its own line.
const FLOORS: &[&[&str]] = &[
    &["main"],
    &["cli", "repl"],
    &["session"],
    &["command", "aqwa"],
    &["report"],
    &["solve"],
    &["tether"],
    &["connector"],
    &["rod"],
    &["hydro"],
    &["post"],
    &["model"],
    &["table"],
    &["language"],
];

/// Beside its own floor the command line may call the editor: they are the two front doors of one storey.
const SIDEWAYS: &[(&str, &str)] = &[("cli", "repl")];

fn height(floor: &str) -> Option<usize> {
    FLOORS.iter().position(|names| names.contains(&floor))
}

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

#[test]
fn no_floor_uses_a_floor_above_it() {
    let mut list = Vec::new();
    sources(Path::new("src"), &mut list);
    let mut wrong = Vec::new();
    for path in list {
        let parts: Vec<String> = path.iter().map(|p| p.to_string_lossy().into_owned()).collect();
        let floor = parts[1].trim_end_matches(".rs").to_string();
        if floor == "lib" {
            continue;
        }
        let own = height(&floor).unwrap_or_else(|| panic!("{} is on no floor of the house", path.display()));
        for (number, line) in fs::read_to_string(&path).unwrap().lines().enumerate() {
            for used in line.split("crate::").skip(1) {
                let name: String = used.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
                let Some(other) = height(&name) else { continue };
                let sideways = other == own && name != floor && !SIDEWAYS.contains(&(floor.as_str(), name.as_str()));
                if other < own || sideways {
                    wrong.push(format!("{}:{}: {floor} uses {name}", path.display(), number + 1));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn files_stay_within_what_one_reads_in_a_sitting() {
    // design.md: files under some 400 lines; a tenth more is let pass before a file must be divided
    let mut list = Vec::new();
    sources(Path::new("src"), &mut list);
    let long: Vec<String> = list
        .iter()
        .map(|p| (p, fs::read_to_string(p).unwrap().lines().count()))
        .filter(|(_, lines)| *lines > 440)
        .map(|(p, lines)| format!("{} has {lines} lines", p.display()))
        .collect();
    assert!(long.is_empty(), "{}", long.join("\n"));
}
