//! The pages of the manual: each formula converts, each link leads to a page and a heading that are there, each page is in the list.

#![allow(missing_docs, clippy::unwrap_used)]

use pulldown_cmark::{Event, Parser, Tag, TagEnd};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Component, Path, PathBuf};
use windlass_book::{markdown_options, process_book, replace_formulas};

fn docs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs").canonicalize().unwrap()
}

fn collect_pages(folder: &Path, pages: &mut BTreeMap<PathBuf, String>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            collect_pages(&path, pages);
        } else if path.extension().is_some_and(|e| e == "md") {
            let text = fs::read_to_string(&path).unwrap();
            pages.insert(path, text);
        }
    }
}

/// The pages of the manual, and the others of the project that have links.
fn pages() -> BTreeMap<PathBuf, String> {
    let mut pages = BTreeMap::new();
    collect_pages(&docs(), &mut pages);
    for name in ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md"] {
        let path = docs().parent().unwrap().join(name);
        let text = fs::read_to_string(&path).unwrap();
        pages.insert(path, text);
    }
    pages
}

/// The names of the headings of a page, as mdBook and GitHub make them.
fn anchors(page: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut heading: Option<String> = None;
    for event in Parser::new_ext(page, markdown_options()) {
        match event {
            Event::Start(Tag::Heading { .. }) => heading = Some(String::new()),
            Event::End(TagEnd::Heading(_)) => {
                let text = heading.take().unwrap_or_default().to_lowercase();
                let kept = text.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
                found.insert(kept.map(|c| if c == ' ' { '-' } else { c }).collect());
            }
            Event::Text(text) | Event::Code(text) => {
                if let Some(heading) = &mut heading {
                    heading.push_str(&text);
                }
            }
            _ => {}
        }
    }
    found
}

/// A path without `.` and `..`.
fn normalize(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => {
                plain.pop();
            }
            Component::CurDir => {}
            other => plain.push(other),
        }
    }
    plain
}

#[test]
fn every_link_leads_to_file_and_heading_that_exist() {
    let pages = pages();
    let mut wrong = Vec::new();
    for (path, text) in &pages {
        for event in Parser::new_ext(text, markdown_options()) {
            let (Event::Start(Tag::Link { dest_url, .. }) | Event::Start(Tag::Image { dest_url, .. })) = event else {
                continue;
            };
            if dest_url.contains("://") {
                continue;
            }
            let (file, heading) = dest_url.split_once('#').unwrap_or((&dest_url, ""));
            let target = if file.is_empty() { path.clone() } else { normalize(&path.parent().unwrap().join(file)) };
            let is_there = match pages.get(&target) {
                Some(page) => heading.is_empty() || anchors(page).contains(heading),
                None => target.exists() && heading.is_empty(),
            };
            if !is_there {
                wrong.push(format!("{}: {dest_url}", path.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_page_stands_in_summary_of_book() {
    let pages = pages();
    let summary = docs().join("SUMMARY.md");
    let mut listed = BTreeSet::from([summary.clone()]);
    for event in Parser::new_ext(&pages[&summary], markdown_options()) {
        if let Event::Start(Tag::Link { dest_url, .. }) = event {
            listed.insert(docs().join(&*dest_url));
        }
    }
    let lost: Vec<_> = pages.keys().filter(|path| path.starts_with(docs()) && !listed.contains(*path)).collect();
    assert!(lost.is_empty(), "not in docs/SUMMARY.md: {lost:?}");
}

#[test]
fn every_formula_of_manual_becomes_mathml() {
    let mut formulas = 0;
    for (path, text) in pages().iter().filter(|(path, _)| path.starts_with(docs())) {
        let made = replace_formulas(text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        assert!(!made.contains("merror"), "{}", path.display());
        formulas += made.matches("<math").count();
    }
    assert!(formulas > 100, "{formulas}");
}

#[test]
fn book_is_returned_with_formulas_replaced_in_all_chapters() {
    let book = r#"[{"root": "."}, {"items": [{"Chapter": {"name": "A", "content": "$x^2$ and `$y`", "sub_items":
        [{"Chapter": {"name": "B", "content": "$$\\frac{1}{2}$$", "sub_items": []}}]}}, "Separator"]}]"#;
    let made = process_book(book).unwrap();
    assert!(made.contains("<msup>") && made.contains("<mfrac>") && made.contains("`$y`"), "{made}");
    for (wrong, why) in [("{", "EOF"), ("[1]", "no pair"), ("[1, {}]", "no chapters")] {
        assert!(process_book(wrong).unwrap_err().to_string().contains(why), "{wrong}");
    }
    let unknown = book.replace("x^2", "\\\\nonsense");
    assert!(process_book(&unknown).unwrap_err().to_string().contains("nonsense"));
}
