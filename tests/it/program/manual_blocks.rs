//! The records of the manual: all `cif` blocks of a page, in order, are one script that a reader types, and it runs without an error.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The pages whose blocks are typed, below `docs`. Those of the reference are examples of the declarations, which have a test of their own.
fn pages() -> Vec<PathBuf> {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    let folders = [docs.clone(), docs.join("howto")];
    let files = folders.iter().flat_map(|folder| fs::read_dir(folder).unwrap()).flatten().map(|entry| entry.path());
    let mut pages: Vec<PathBuf> = files.filter(|path| path.extension().is_some_and(|e| e == "md")).collect();
    pages.sort();
    pages
}

/// The text of all `cif` blocks of a page.
fn blocks(page: &str) -> String {
    let mut inside = false;
    let mut script = String::new();
    for line in page.lines() {
        if inside && line.starts_with("```") {
            inside = false;
        } else if inside {
            script.push_str(line);
            script.push('\n');
        } else if line.trim_end() == "```cif" {
            inside = true;
        }
    }
    script
}

#[test]
fn records_of_every_manual_page_run_without_error() {
    let mut run = 0;
    for page in pages() {
        let script = blocks(&fs::read_to_string(&page).unwrap());
        if script.is_empty() {
            continue;
        }
        let folder = tempfile::tempdir().unwrap();
        let mut child = Command::new(env!("CARGO_BIN_EXE_windlass"))
            .args(["-", "--out"])
            .arg(folder.path().join("out"))
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        std::io::Write::write_all(&mut child.stdin.take().unwrap(), script.as_bytes()).unwrap();
        let output = child.wait_with_output().unwrap();
        let text = format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
        assert_eq!(output.status.code(), Some(0), "{}:\n{text}", page.display());
        run += 1;
    }
    assert!(run >= 10, "{run} pages have records");
}

#[test]
fn script_of_tutorial_is_the_records_of_its_page() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let page = blocks(&fs::read_to_string(root.join("docs/tutorial.md")).unwrap());
    let script = fs::read_to_string(root.join("scripts/tutorial.cif")).unwrap();
    let records: String = script.lines().skip(2).flat_map(|line| [line, "\n"]).collect();
    assert_eq!(records, page);
}
