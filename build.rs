//! Puts the verification cases into the program, and the commit it is built from.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Files that the scripts of verification cases read, besides those in `share/verification/data`.
const DATA: [&str; 4] = [
    "tests/data/aqwa_tether_spectrum.csv",
    "tests/data/catenary_2000.csv",
    "tests/data/moordyn/driven/body_like.txt",
    "tests/data/moordyn/driven/clump.txt",
];

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-changed=share/verification");
    let mut text = list("CASES", files("share/verification", "toml"));
    let data = DATA.iter().map(PathBuf::from).chain(files("share/verification/data", "")).collect();
    text.push_str(&list("DATA", data));
    let out = PathBuf::from(std::env::var_os("OUT_DIR").unwrap_or_default()).join("verification.rs");
    if let Err(error) = std::fs::write(&out, text) {
        println!("cargo:error={}: {error}", out.display());
    }
    println!("cargo:rustc-env=WINDLASS_COMMIT={}", commit());
}

/// The files of a folder with an ending, by name; all of them where the ending is empty.
fn files(folder: &str, ending: &str) -> Vec<PathBuf> {
    let mut list: Vec<PathBuf> = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|e| e.path()).collect();
    list.retain(|path| path.is_file() && (ending.is_empty() || path.extension().is_some_and(|end| end == ending)));
    list.sort();
    list
}

/// A static list of names and texts.
fn list(name: &str, files: Vec<PathBuf>) -> String {
    let root = std::env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from).unwrap_or_default();
    let mut text = format!("/// Names and texts.\npub static {name}: &[(&str, &str)] = &[\n");
    for file in files {
        println!("cargo:rerun-if-changed={}", file.display());
        let called = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
        // writing to a string cannot fail
        let _ = writeln!(text, "    ({called:?}, include_str!({:?})),", root.join(&file).display().to_string());
    }
    text.push_str("];\n");
    text
}

/// The commit, with a plus sign where files differ from it. Only a release build asks: any other would be built anew with every commit.
fn commit() -> String {
    if std::env::var("PROFILE").is_ok_and(|profile| profile != "release") {
        return "not recorded by a debug build".into();
    }
    for file in [".git/HEAD", ".git/logs/HEAD", ".git/index"] {
        if Path::new(file).exists() {
            println!("cargo:rerun-if-changed={file}");
        }
    }
    let ask = |words: &[&str]| {
        let answer = Command::new("git").args(words).output().ok().filter(|answer| answer.status.success())?;
        Some(String::from_utf8_lossy(&answer.stdout).trim().to_string())
    };
    // a package made by cargo has the commit in a file of its own
    let packaged = || {
        let text = std::fs::read_to_string(".cargo_vcs_info.json").ok()?;
        let (_, rest) = text.split_once("\"sha1\": \"")?;
        rest.split('"').next().map(str::to_string)
    };
    if let Some(found) = packaged() {
        return found.chars().take(12).collect();
    }
    match ask(&["rev-parse", "--short=12", "HEAD"]).filter(|_| Path::new(".git").exists()) {
        Some(found) => {
            let changed = ask(&["status", "--porcelain", "--untracked-files=no"]).is_none_or(|text| !text.is_empty());
            format!("{found}{}", if changed { "+" } else { "" })
        }
        None => "not known".into(),
    }
}
